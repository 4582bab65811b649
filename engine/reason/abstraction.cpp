#include "engine/reason/abstraction.h"

#include <algorithm>
#include <cctype>

namespace aerascope {
namespace {

std::string NameForRole(const std::string& role) {
  if (role == kTemplateAfter) return "T0";
  if (role == kTemplateBefore) return "T1";
  if (role == kEffectAfter) return "T2";
  if (role == kEffectBefore) return "T3";
  return VariableNameFor(role);
}

}  // namespace

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
    if (SameValue(entry.value, value) && (entry.role == role || !HasRole(value, roles_)))
      return &entry.variable;
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
  if (IsQuantity(value) || value.is(TermKind::kTime)) return Value(value, role, name);
  if (value.items().empty()) return value;
  std::vector<Term> items;
  for (const Term& item : value.items()) items.push_back(Abstract(item, role, name));
  return value.is(TermKind::kSet) ? Term::Set(std::move(items))
                                  : Term::Struct(value.name(), std::move(items));
}

Term Abstraction::Payload(const Term& payload, const KnownDefinitions& knowledge) {
  std::vector<Term> variables;  // of the values, in reading order
  ForEachValue(payload, knowledge, [&](const Term& value, const std::string& role) {
    variables.push_back(Abstract(value, role, value.is(TermKind::kEntity) ? "" : NameForRole(role)));
  });
  std::size_t next = 0;
  const auto replaced = [&](const Term& term) {
    return Rewritten(term, [&](const Term& part) -> std::optional<Term> {
      if (!part.is(TermKind::kEntity) && !part.is(TermKind::kTime) && !IsQuantity(part)) return std::nullopt;
      return variables[next++];
    });
  };
  if (IsValue(payload)) {
    Term object = replaced(payload[0]);
    return MakeValue(std::move(object), payload[1], replaced(payload[2]));
  }
  if (IsCommand(payload)) return Term::Struct("cmd", {payload[0], replaced(payload[1])});
  if (IsIcst(payload) || IsImdl(payload)) {
    Term first = replaced(payload[1]);
    return Term::Struct(payload.name(), {payload[0], std::move(first), replaced(payload[2])});
  }
  return replaced(payload);
}

}  // namespace aerascope
