// An Abstraction puts variables in the place of values, the same variable for the same value in the same role: what
// turns facts into patterns (semantics 5.1, abstraction).
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/kb/composite_state.h"
#include "engine/kb/match.h"

namespace aerascope {

class Abstraction {
 public:
  // The variable for an entity; entities have no role: one individual, one variable.
  Term Entity(const Term& entity);
  // The variable for a number or a struct of numbers; equal values share a variable only in the same role.
  Term Value(const Term& value, const std::string& role, const std::string& name);
  // A variable of its own, remembered as standing for `value`.
  Term Fresh(const Term& value, const std::string& name);

  // Entities, numbers and structs replaced; ontology symbols stay; sets are walked into; a set stays a set.
  Term Abstract(const Term& value, const std::string& role, const std::string& name);

  // The variable already made for a value (of that role, if not an entity), if any.
  const Term* Find(const Term& value, const std::string& role) const;

  const Bindings& instance() const { return instance_; }            // variable -> the value it stands for
  const std::vector<std::string>& names() const { return names_; }  // "H", "C", "P", "T0" ...

 private:
  struct Entry {
    Term value;
    std::string role;
    Term variable;
  };
  std::string UniqueName(std::string name);

  std::vector<Entry> entries_;
  Bindings instance_;
  std::vector<std::string> names_;
};

// A value that learning may replace by a variable: a number, or a vector of numbers.
bool IsQuantity(const Term& value);

// "position" -> "P", "h" -> "H": the name people see for a variable that stands for such a thing.
std::string VariableNameFor(const std::string& word);

// The attribute whose value an argument of a composite state is, looked for in nested composite states too; "" if it is
// no value of an attribute. Knowledge of nested states comes through `find`.
using FindCompositeState = std::function<const CompositeState*(CompositeStateId)>;
std::string RoleOfVariable(const CompositeState& state, int variable, const FindCompositeState& find, int depth = 0);

// The instance payload (icst ...) with variables for its arguments, each in the role it has in the composite state.
Term AbstractInstance(const Term& icst_payload, const CompositeState& state, const FindCompositeState& find,
                      Abstraction* abstraction);

}  // namespace aerascope
