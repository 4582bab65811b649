// The parts that knowledge is made of, written out: nested composite states and models replaced by what they
// say, in the variables of the piece of knowledge that was asked about. Used by everything that makes words
// of knowledge.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/kb/knowledge_base.h"

namespace aerascope {

// In which order the components of nested states are written out: as they were given, or as in their
// canonical form, so that equal content reads the same.
enum class Writing { kAsGiven, kCanonical };

// A payload without instances of composite states (unless unknown or nested too deeply), and where it stands.
struct Part {
  bool positive = true;
  Term payload;
  std::size_t component = 0;  // the component or side it came from
  std::size_t instance =
      0;               // which composite state it is a component of: 0 the outermost, counted up from there
  bool apart = false;  // makes no line with parts that are not `apart`
  Term since = Term::Wildcard();  // from when it holds, in the variables of the outermost
};

// What became of a pattern: its parts, and the terms (variables) in places of time.
struct Parts {
  std::vector<Part> parts;
  std::vector<Term> times;
  std::size_t instances = 0;  // how many nested instances were written out
};

// Written out to a fixed depth and number of parts; beyond, instances stay as they are.
inline constexpr int kMaxNesting = 6;
inline constexpr std::size_t kMaxParts = 2000;

// Adds the parts of one pattern. Instances of models become the two sides of the model.
void AddParts(const KnowledgeBase& knowledge, const FactPattern& pattern, std::size_t component, Parts* parts,
              Writing writing = Writing::kAsGiven);

Parts PartsOf(const KnowledgeBase& knowledge, const CompositeState& state,
              Writing writing = Writing::kAsGiven);
// The same state with its components in the order of its canonical form.
CompositeState InCanonicalOrder(const CompositeStateRecord& record);
// Component 0 is the left side, 1 the right side.
Parts PartsOf(const KnowledgeBase& knowledge, const Model& model, Writing writing = Writing::kAsGiven);

// What each variable of the referenced knowledge stands for in an instance: terms of the instance's own
// numbering; a wildcard where nothing is said. False if the lists do not fit (then every entry is a
// wildcard).
bool ArgumentsOf(const CompositeState& state, const Term& icst, std::vector<Term>* arguments);
bool ArgumentsOf(const Model& model, const Term& imdl, std::vector<Term>* arguments);

// The term with each variable replaced by its argument; variables without one become wildcards.
Term WithArguments(const Term& term, const std::vector<Term>& arguments);

// How many variables the numbering reaches: the greatest number + 1.
std::size_t VariableCount(const CompositeState& state);
std::size_t VariableCount(const Model& model);

// The right side of a model with its forward guards written into it.
Term RightSide(const Model& model);

// What a variable is, as told by where it stands; the basis of made-up names.
enum class VariableRole { kTime, kThing, kValue, kOther };
struct RoleOfVariable {
  VariableRole role = VariableRole::kOther;
  std::string attribute;  // of a value
};
std::vector<RoleOfVariable> RolesOf(const Parts& parts, std::size_t variables);

// Makes names that are missing (empty), each different from all others, in the given order of variables.
void FillNames(const std::vector<RoleOfVariable>& roles, const std::vector<int>& order,
               std::vector<std::string>* names);

// One thing and what is said of it: a line of a composite state.
struct Line {
  struct Predicate {
    enum class Kind { kNoun, kAttribute, kPlace, kOther };
    Kind kind = Kind::kOther;
    bool positive = true;
    std::string attribute;
    Term value;
    Term since = Term::Wildcard();  // of the part
  };
  Term subject;  // nil for a payload of another form, which then is the value of the one predicate
  std::vector<Predicate> predicates;
  std::vector<std::size_t> components;  // ascending
  std::size_t instance = 0;
  bool apart = false;
};
// Parts of one composite state about one thing make one line, but each attribute has a line of its own: nouns
// first, then the attribute, then places, then what is not. What several of them say at the same time is said
// once.
std::vector<Line> LinesOf(const std::vector<Part>& parts);

// The words of one attribute (describe.h).
Line::Predicate::Kind KindOfAttribute(std::string_view attribute);
bool NamesAKind(std::string_view attribute);   // its values are nouns: essence, shape
bool NamesAPlace(std::string_view attribute);  // its values are where something is: position, at

}  // namespace aerascope
