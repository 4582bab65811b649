// Short words for building terms in tests: E("h"), O("position"), N(5), V(0) ...
#pragma once

#include <string_view>

#include "engine/kb/composite_state.h"
#include "engine/kb/model.h"

namespace aerascope {

inline Term E(std::string_view name) {
  return Term::Entity(name);
}
inline Term O(std::string_view name) {
  return Term::Ontology(name);
}
inline Term N(double value) {
  return Term::Number(value);
}
inline Term V(int index) {
  return Term::Variable(index);
}
inline Term T(std::int64_t ms) {
  return Term::Instant({ms * 1000});
}
inline Term D(std::int64_t ms) {
  return Term::Span({ms * 1000});
}
inline Term W() {
  return Term::Wildcard();
}
inline Term Set(std::vector<Term> items) {
  return Term::Set(std::move(items));
}
inline Term Struct(const char* head, std::vector<Term> items) {
  return Term::Struct(head, std::move(items));
}

inline TimeInterval Ms(std::int64_t after, std::int64_t before) {
  return {{after * 1000}, {before * 1000}};
}
inline Fact Holds(Term payload, TimeInterval interval) {
  return {true, std::move(payload), interval, 1};
}
inline Fact HoldsNot(Term payload, TimeInterval interval) {
  return {false, std::move(payload), interval, 1};
}

// A component of a composite state: a value over the common interval, the variables 0 and 1.
inline FactPattern Component(Term object, const char* attribute, Term value) {
  return {true, MakeValue(std::move(object), O(attribute), std::move(value)), V(0), V(1)};
}

}  // namespace aerascope
