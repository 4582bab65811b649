// A Role says what a value is the value *of*: of an attribute, of a command's third argument, of a model's
// effect interval. Learning compares quantities only within one role, so that a coincidence (the hand moves
// by 5 and arrives at 5) does not become a rule (semantics 10.4, this project's choice; OpenAERA compares
// values alone, and so does this program where value_roles is "together"). Individuals have no role: one
// entity is the same wherever it stands.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/kb/knowledge_base.h"
#include "engine/reason/parameters.h"

namespace aerascope {

// The definitions by which roles are found: those of the knowledge base, and one composite state that is
// being made and is not in it yet. Refers to both.
class KnownDefinitions {
 public:
  KnownDefinitions(const KnowledgeBase& knowledge, const CompositeState* in_the_making = nullptr)
      : knowledge_(knowledge), in_the_making_(in_the_making) {}

  const CompositeState* Find(CompositeStateId id) const;
  const Model* Find(ModelId id) const;

 private:
  const KnowledgeBase& knowledge_;
  const CompositeState* in_the_making_;
};

// A value that learning may replace by a variable: a number, or a vector of numbers.
bool IsQuantity(const Term& value);

// Does it matter in which role the value stands? Not for entities; for quantities as the parameter says;
// always for instants.
bool HasRole(const Term& value, ValueRoles roles);

// What a variable stands for. In a composite state: the attribute whose value it is, looked for in nested
// states too. In a model: the same, or "argument 1" of its command, or a place in its timing. "" if unknown.
std::string RoleOfVariable(const CompositeState& state, int variable, const KnownDefinitions& knowledge);
std::string RoleOfVariable(const Model& model, int variable, const KnownDefinitions& knowledge);

// The places of instants.
inline constexpr char kTemplateAfter[] = "template after";
inline constexpr char kTemplateBefore[] = "template before";
inline constexpr char kCauseAfter[] = "cause after";
inline constexpr char kCauseBefore[] = "cause before";
inline constexpr char kEffectAfter[] = "effect after";
inline constexpr char kEffectBefore[] = "effect before";

// The role of the i-th argument of a command.
std::string ArgumentRole(std::size_t i);

// Calls visit(value, role) for each entity, quantity and instant of a ground payload, in reading order.
using VisitValue = std::function<void(const Term& value, const std::string& role)>;
void ForEachValue(const Term& payload, const KnownDefinitions& knowledge, const VisitValue& visit);

// The entities and quantities of payloads: what facts can have in common. Ontology symbols and instants do
// not count (semantics 5.1, "share a value").
class SharedValues {
 public:
  SharedValues(const KnowledgeBase& knowledge, ValueRoles roles) : knowledge_(knowledge), roles_(roles) {}

  void Add(const Term& payload);
  bool SharedBy(const Term& payload) const;

 private:
  struct Entry {
    Term value;
    std::string role;
  };
  bool Contains(const Term& value, const std::string& role) const;

  KnownDefinitions knowledge_;
  ValueRoles roles_;
  std::vector<Entry> entries_;
};

}  // namespace aerascope
