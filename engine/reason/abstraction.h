// An Abstraction puts variables in the place of values, the same variable for the same value in the same
// role: what turns facts into patterns (semantics 5.1, abstraction).
#pragma once

#include <string>
#include <vector>

#include "engine/kb/match.h"
#include "engine/reason/roles.h"

namespace aerascope {

class Abstraction {
 public:
  explicit Abstraction(ValueRoles roles) : roles_(roles) {}

  // The variable for an entity; entities have no role: one individual, one variable.
  Term Entity(const Term& entity);
  // The variable for a number, a vector of numbers or an instant; equal values share one only in the same
  // role. Where roles are not kept apart, equal numbers and vectors always share one.
  Term Value(const Term& value, const std::string& role, const std::string& name);
  // A variable of its own, remembered as standing for `value`.
  Term Fresh(const Term& value, const std::string& name);

  // Entities, quantities and instants replaced; ontology symbols stay; sets and structs are walked into.
  Term Abstract(const Term& value, const std::string& role, const std::string& name);
  // A ground payload with each value abstracted in the role it has there.
  Term Payload(const Term& payload, const KnownDefinitions& knowledge);

  // The variable already made for a value (of that role, where roles count), if any.
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

  ValueRoles roles_;
  std::vector<Entry> entries_;
  Bindings instance_;
  std::vector<std::string> names_;
};

// "position" -> "P", "h" -> "H": the name people see for a variable that stands for such a thing.
std::string VariableNameFor(const std::string& word);

}  // namespace aerascope
