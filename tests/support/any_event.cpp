#include "tests/support/any_event.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <type_traits>

namespace aerascope {
namespace {

// A value of any type that a field may have.
class Filler {
 public:
  explicit Filler(AnyEvents& any) : any_(any) {}

  template <class Tag>
  void Fill(Id<Tag>* value) {
    value->value = any_.Below(5) == 0 ? 0 : 1 + any_.Below(1'000'000'000'000);
  }
  void Fill(bool* value) { *value = any_.Chance(); }
  void Fill(std::int64_t* value) { *value = any_.Integer(); }
  void Fill(double* value) { *value = any_.Real(); }
  void Fill(std::string* value) { *value = any_.Name(); }
  void Fill(Term* value) { *value = any_.AnyTerm(); }
  void Fill(Time* value) { *value = any_.Instant(); }
  void Fill(TimeInterval* value) { *value = any_.Interval(); }
  void Fill(Fact* value) { *value = {any_.Chance(), any_.AnyTerm(), any_.Interval(), any_.Real()}; }
  void Fill(FactPattern* value) {
    *value = {any_.Chance(), any_.AnyTerm(), any_.AnyTerm(0), any_.AnyTerm(0)};
  }
  void Fill(Evidence* value) { *value = {any_.Real(), any_.Real()}; }
  void Fill(Guard* value) {
    // A test is a comparison of two; other shapes are assignments.
    if (any_.Chance()) {
      *value = {static_cast<int>(any_.Below(20)), any_.AnyTerm()};
    } else {
      *value = {std::nullopt, Term::Struct(any_.Chance() ? "<>" : "<", {any_.AnyTerm(), any_.AnyTerm()})};
    }
  }
  void Fill(CompositeState* value) {
    value->id = {1 + any_.Below(1000)};
    Fill(&value->components);
    value->components.emplace_back();
    Fill(&value->components.back());
    Fill(&value->guards);
    Fill(&value->variable_names);
  }
  void Fill(Model* value) {
    value->id = {1 + any_.Below(1000)};
    value->template_arguments = any_.AnyTerms(2);
    Fill(&value->lhs);
    Fill(&value->rhs);
    Fill(&value->forward);
    Fill(&value->backward);
    Fill(&value->variable_names);
  }
  template <class T>
  void Fill(std::vector<T>* value) {
    for (std::int64_t n = any_.Below(5); n > 0; --n) Fill(&value->emplace_back());
  }
  template <class T>
  requires std::is_enum_v<T>
  void Fill(T* value) {
    *value = static_cast<T>(any_.Below(static_cast<std::int64_t>(kEnumNames<T>.size())));
  }
  template <class T>
  requires requires { T::Fields(); }
  void Fill(T* value) {
    *value = T();
    ForEachField<T>([&](const auto& field) { Fill(&(value->*(field.member))); });
  }

 private:
  AnyEvents& any_;
};

// Every field of two values of one type is equal, bit for bit.
template <class T>
bool SameField(const T& a, const T& b) {
  if constexpr (requires { T::Fields(); }) {
    bool same = true;
    ForEachField<T>(
        [&](const auto& field) { same = same && SameField(a.*(field.member), b.*(field.member)); });
    return same;
  } else if constexpr (requires { a.begin(); } && !std::is_same_v<T, std::string>) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (!SameField(a[i], b[i])) return false;
    }
    return true;
  } else {
    return a == b;
  }
}

}  // namespace

std::string AnyEvents::Name() {
  static const std::vector<std::string> kNames{"h",
                                               "c1",
                                               "position",
                                               "nil",
                                               "inf",
                                               "nan",
                                               "infinity",
                                               "Infinity",
                                               "INF",
                                               "NaN",
                                               "t5",
                                               "d-7",
                                               "1e5",
                                               "-",
                                               "+",
                                               "",
                                               " ",
                                               "a b",
                                               "|",
                                               "\\",
                                               "\"",
                                               "'; DROP TABLE event; --",
                                               "<script>",
                                               "]",
                                               ")",
                                               "$3",
                                               "~c1",
                                               "#t",
                                               "@",
                                               ":",
                                               "fact",
                                               "line\nbreak",
                                               "\x1f\x1e",
                                               "\xff\xfe not UTF-8",
                                               "gr\xc3\xb6\xc3\x9f"
                                               "e",
                                               "\xe2\x80\xae"
                                               "olleh",
                                               "%s%n",
                                               std::string("zero\0byte", 9),
                                               std::string(300, 'x')};
  if (Below(3) == 0) return kNames[static_cast<std::size_t>(Below(static_cast<std::int64_t>(kNames.size())))];
  std::string name;
  for (std::int64_t length = Below(6); length >= 0; --length) name += static_cast<char>('a' + Below(26));
  return name;
}

double AnyEvents::Real() {
  static const double kReals[] = {0,
                                  1,
                                  0.1,
                                  1.0 / 3,
                                  -2.5,
                                  1e-300,
                                  1e300,
                                  4.9e-324,
                                  1.7976931348623157e308,
                                  0.30000000000000004,
                                  1e15 + 0.5,
                                  123456789.123456789};
  if (Chance()) return kReals[Below(std::size(kReals))];
  return std::uniform_real_distribution<double>(-1000, 1000)(random_);
}

std::int64_t AnyEvents::Integer() {
  switch (Below(4)) {
    case 0:
      return std::numeric_limits<std::int64_t>::max();
    case 1:
      return std::numeric_limits<std::int64_t>::min();
    case 2:
      return 0;
    default:
      return Below(1'000'000) - 500'000;
  }
}

Term AnyEvents::AnyTerm(int depth) {
  switch (Below(depth > 0 ? 14 : 12)) {
    case 0:
      return Term::Nil();
    case 1:
      return Term::Entity(Name());
    case 2:
      return Term::Ontology(Name());
    case 3:
      return Term::Number(Real());
    case 4:
      return Term::Instant(Instant());
    case 5:
      return Term::Span({Below(1'000'000) - 500'000});
    case 6:
      return Term::String(Name());
    case 7:
      return Term::Bool(Chance());
    case 8:
      return Term::Variable(static_cast<int>(Below(20)));
    case 9:
      return Term::Wildcard();
    case 10:
      return Term::Reference(CompositeStateId{1 + Below(1000)});
    case 11:
      return Term::Reference(ModelId{1 + Below(1000)});
    case 12:
      return Term::Set(AnyTerms(depth - 1));
    default:
      return Term::Struct(Name(), AnyTerms(depth - 1));
  }
}

std::vector<Term> AnyEvents::AnyTerms(int depth) {
  std::vector<Term> terms;
  for (std::int64_t n = Below(4); n > 0; --n) terms.push_back(AnyTerm(depth));
  return terms;
}

Event AnyEvents::AnyEvent(std::int64_t id, std::size_t kind) {
  Event event;
  event.id = {id};
  event.time = Instant();
  event.frame = Below(1000);
  if (Below(4) == 0) event.simulation = {1 + Below(1000)};
  for (std::int64_t cause = id - 1; cause > 0 && event.causes.size() < 6 && Chance(); cause -= 1 + Below(5)) {
    event.causes.push_back({cause});
  }
  event.body = AnyBody(kind);
  return event;
}

EventBody AnyEvents::AnyBody(std::size_t kind) {
  EventBody body;
  std::size_t at = 0;
  ForEachKind([&]<class Body>() {
    if (at++ == kind) Filler(*this).Fill(&body.emplace<Body>());
  });
  return body;
}

bool SameContent(const EventBody& a, const EventBody& b) {
  return a.index() == b.index() &&
         std::visit(
             [&](const auto& body) { return SameField(body, std::get<std::decay_t<decltype(body)>>(b)); }, a);
}

bool SameContent(const Event& a, const Event& b) {
  return a.id == b.id && a.time == b.time && a.frame == b.frame && a.simulation == b.simulation &&
         a.causes == b.causes && SameContent(a.body, b.body);
}

bool SameContent(const std::vector<Event>& a, const std::vector<Event>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Event& one, const Event& other) { return SameContent(one, other); });
}

}  // namespace aerascope
