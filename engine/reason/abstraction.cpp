#include "engine/reason/abstraction.h"

#include <algorithm>
#include <cctype>

namespace aerascope {

bool IsQuantity(const Term& value) {
  if (value.is(TermKind::kNumber)) return true;
  if (!value.is(TermKind::kStruct) || value.size() == 0) return false;
  return std::all_of(value.items().begin(), value.items().end(),
                     [](const Term& item) { return item.is(TermKind::kNumber); });
}

std::string VariableNameFor(const std::string& word) {
  for (const char c : word) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80 && std::isalpha(byte)) return std::string(1, static_cast<char>(std::toupper(byte)));
  }
  return "V";
}

std::string Abstraction::UniqueName(std::string name) {
  const auto taken = [&](const std::string& candidate) {
    return std::find(names_.begin(), names_.end(), candidate) != names_.end();
  };
  if (!taken(name)) return name;
  for (int i = 1;; ++i) {
    std::string candidate = name + std::to_string(i);
    if (!taken(candidate)) return candidate;
  }
}

Term Abstraction::Fresh(const Term& value, const std::string& name) {
  const int index = static_cast<int>(names_.size());
  names_.push_back(UniqueName(name));
  instance_.Set(index, value);
  return Term::Variable(index);
}

const Term* Abstraction::Find(const Term& value, const std::string& role) const {
  for (const Entry& entry : entries_) {
    if (SameValue(entry.value, value) && (entry.role == role || value.is(TermKind::kEntity))) return &entry.variable;
  }
  return nullptr;
}

Term Abstraction::Entity(const Term& entity) {
  if (const Term* known = Find(entity, "")) return *known;
  Term variable = Fresh(entity, VariableNameFor(entity.name()));
  entries_.push_back({entity, "", variable});
  return variable;
}

Term Abstraction::Value(const Term& value, const std::string& role, const std::string& name) {
  if (const Term* known = Find(value, role)) return *known;
  Term variable = Fresh(value, name);
  entries_.push_back({value, role, variable});
  return variable;
}

Term Abstraction::Abstract(const Term& value, const std::string& role, const std::string& name) {
  if (value.is(TermKind::kEntity)) return Entity(value);
  if (IsQuantity(value)) return Value(value, role, name);
  if (value.items().empty()) return value;
  std::vector<Term> items;
  for (const Term& item : value.items()) items.push_back(Abstract(item, role, name));
  return value.is(TermKind::kSet) ? Term::Set(std::move(items)) : Term::Struct(value.name(), std::move(items));
}

std::string RoleOfVariable(const CompositeState& state, int variable, const FindCompositeState& find, int depth) {
  if (depth > 16) return "";
  const Term wanted = Term::Variable(variable);
  for (const FactPattern& component : state.components) {
    const Term& payload = component.payload;
    if (IsValue(payload) && payload[2] == wanted) return payload[1].name();
    if (!IsIcst(payload)) continue;
    const CompositeState* nested = find(payload[0].composite_state());
    if (!nested) continue;
    const std::vector<int> arguments = ArgumentVariables(*nested);
    for (std::size_t i = 0; i < arguments.size() && i < payload[2].size(); ++i) {
      if (!(payload[2][i] == wanted)) continue;
      std::string role = RoleOfVariable(*nested, arguments[i], find, depth + 1);
      if (!role.empty()) return role;
    }
  }
  return "";
}

Term AbstractInstance(const Term& icst_payload, const CompositeState& state, const FindCompositeState& find,
                      Abstraction* abstraction) {
  const std::vector<int> arguments = ArgumentVariables(state);
  std::vector<Term> abstracted;
  for (std::size_t i = 0; i < icst_payload[2].size(); ++i) {
    const std::string role = i < arguments.size() ? RoleOfVariable(state, arguments[i], find) : "";
    abstracted.push_back(abstraction->Abstract(icst_payload[2][i], role, VariableNameFor(role.empty() ? "V" : role)));
  }
  return Term::Struct("icst", {icst_payload[0], icst_payload[1], Term::Set(std::move(abstracted))});
}

}  // namespace aerascope
