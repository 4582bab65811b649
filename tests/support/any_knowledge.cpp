#include "tests/support/any_knowledge.h"

#include <algorithm>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/text.h"

namespace aerascope {
namespace {

Term E(const std::string& name) {
  return Term::Entity(name);
}
Term O(const std::string& name) {
  return Term::Ontology(name);
}
Term Op(const std::string& op, Term a, Term b) {
  return Term::Struct(op, {std::move(a), std::move(b)});
}

class Maker {
 public:
  explicit Maker(std::uint64_t seed) : random_(seed) {}

  SeedKnowledge Make() {
    for (const char* name : {"h", "c1", "c2", "s1", "run"}) seed_.symbols.push_back(E(name));
    for (const char* name : {"position", "velocity", "holding", "size", "essence", "large", "cube", "hand",
                             "move", "push", "grab"}) {
      seed_.symbols.push_back(O(name));
    }
    const int rounds = 1 + Below(6);
    for (int i = 0; i < rounds; ++i) {
      // In any order: what comes later refers to what is there.
      switch (Below(4)) {
        case 0:
          AddState();
          break;
        case 1:
          AddCausalModel();
          break;
        case 2:
          if (seed_.models.empty()) AddCausalModel();
          AddModelOnModel();
          break;
        default:
          AddState();
          AddCausalModel();
          AddModelOnModel();
          break;
      }
    }
    if (Chance()) AddDrive();
    for (int i = Below(4); i > 0; --i) AddFact();
    return std::move(seed_);
  }

 private:
  int Below(int limit) { return static_cast<int>(random_() % static_cast<std::uint64_t>(limit)); }
  bool Chance() { return Below(2) == 0; }
  template <class List>
  const auto& OneOf(const List& list) {
    return list[static_cast<std::size_t>(Below(static_cast<int>(list.size())))];
  }

  // ------------------------------------------------------------------------------------------ variables and
  // values

  static constexpr int kVariables = 14;
  // A new definition: its variables have any numbers and any names.
  void BeginDefinition() {
    numbers_.clear();
    for (int i = 0; i < kVariables; ++i) numbers_.push_back(i + (Chance() ? 20 : 0));
    std::shuffle(numbers_.begin(), numbers_.end(), random_);
    names_.clear();
    static const std::vector<std::string> kNames{"H",   "P",  "h",   "c1",    "T0",    "",
                                                 "nil", "v2", "a b", "cst_1", "mdl_2", "fact"};
    for (int i = Below(40); i > 0; --i) names_.push_back(OneOf(kNames));
  }
  Term V(int i) const { return Term::Variable(numbers_[static_cast<std::size_t>(i % kVariables)]); }
  int N(int i) const { return V(i).variable(); }
  // 0 and 1 are the interval of the left side, 2 and 3 of the right side; the others are free.
  Term AnyVariable() { return V(4 + Below(kVariables - 4)); }

  double Real() {
    switch (Below(4)) {
      case 0:
        return Below(20) - 10;
      case 1:
        return Below(1000) / 7.0;
      case 2:
        return std::ldexp(static_cast<double>(random_() % 1'000'003), Below(200) - 100);
      default:
        return -Below(1000) / 1000.0;
    }
  }
  Term Number() { return Term::Number(Real()); }
  Duration AnyDuration() {
    static const std::vector<std::int64_t> kSteps{1, 1000, 1'000'000, 100'000, 20'000};
    return {(Below(2000) - 1000) * OneOf(kSteps)};
  }
  Time AnyTime() { return Below(6) == 0 ? kForever : Time{AnyDuration().us}; }
  std::string Text() {
    std::string text;
    for (int i = Below(8); i > 0; --i) text += static_cast<char>(Below(256));
    return text;
  }

  // A value; `open` ones may hold variables and wildcards.
  Term Value(bool open, int depth = 3) {
    switch (Below(depth > 0 ? 16 : 11)) {
      case 0:
        return E(OneOf(std::vector<std::string>{"h", "c1", "c2", "s1"}));
      case 1:
        return O(OneOf(std::vector<std::string>{"large", "cube", "hand"}));
      case 2:
        return Number();
      case 3:
        return Term::String(Text());
      case 4:
        return Term::Bool(Chance());
      case 5:
        return Term::Nil();
      case 6:
        return Term::Span(AnyDuration());
      case 7:
        return Term::Instant(AnyTime());
      case 8:
      case 9:
        return open ? AnyVariable() : Number();
      case 10:
        return open ? Term::Wildcard() : Number();
      case 11:
      case 12: {
        std::vector<Term> items;
        for (int i = Below(4); i > 0; --i) items.push_back(Value(open, depth - 1));
        return Term::Set(std::move(items));
      }
      case 13:
        return Term::Struct("vec2", {Value(open, 0), Value(open, 0)});
      case 14:
        return Term::Struct("vec3", {Value(open, 0), Value(open, 0), Value(open, 0)});
      default:
        return Term::Struct("ti",
                            {open ? AnyVariable() : Term::Instant(AnyTime()), Term::Instant(AnyTime())});
    }
  }

  Term AnyAttribute() {
    return O(OneOf(std::vector<std::string>{"position", "velocity", "holding", "size", "essence"}));
  }
  Term AnyObject(bool open) { return open && Below(4) > 0 ? AnyVariable() : E(Chance() ? "h" : "c1"); }
  Term ValuePayload(bool open) { return MakeValue(AnyObject(open), AnyAttribute(), Value(open)); }

  // -----------------------------------------------------------------------------------------------------
  // instances

  std::vector<Term> Arguments(std::size_t count, bool open) {
    std::vector<Term> arguments;
    for (std::size_t i = 0; i < count; ++i)
      arguments.push_back(open && Below(5) > 0 ? AnyVariable() : Value(open, 1));
    return arguments;
  }
  Term Icst(bool open) {
    const CompositeState& state = OneOf(seed_.composite_states).state;
    return MakeIcst(state.id, {}, Arguments(ArgumentVariables(state).size(), open));
  }
  Term Imdl(const Model& model, bool open) {
    std::vector<Term> template_arguments;
    for (const Term& argument : model.template_arguments) {
      const bool interval = argument.IsStruct("ti");
      template_arguments.push_back(interval && open ? Term::Struct("ti", {V(0), V(1)}) : Value(open, 1));
    }
    return MakeImdl(model.id, std::move(template_arguments), Arguments(ExposedVariables(model).size(), open));
  }

  // --------------------------------------------------------------------------------------------------------
  // guards

  Term Operand(int depth) {
    if (depth > 0 && Below(3) == 0) return Op(AnyArithmetic(), Operand(depth - 1), Operand(depth - 1));
    if (Below(3) == 0) return Below(3) == 0 ? Term::Span(AnyDuration()) : Number();
    return Chance() ? AnyVariable() : Term::Struct("vec2", {AnyVariable(), Number()});
  }
  std::string AnyArithmetic() { return OneOf(std::vector<std::string>{"+", "-", "*", "/"}); }
  Guard AnyGuard() {
    if (Chance()) return {N(4 + Below(8)), Chance() ? Operand(3) : Value(false, 1)};
    return {std::nullopt,
            Op(OneOf(std::vector<std::string>{"=", "<>", "<", ">", "<=", ">="}), Operand(2), Operand(2))};
  }
  std::vector<Guard> AnyGuards() {
    std::vector<Guard> guards;
    for (int i = Below(4); i > 0; --i) guards.push_back(AnyGuard());
    return guards;
  }
  // The forms of induction (semantics 5.1): timing alone, sum, product, rate over a period, constant.
  void AddLearnedGuards(Model* model) {
    const Term before = V(4);
    const Term after = V(5);
    const Term given = V(6);
    const Term constant = Number();
    const Duration period = AnyDuration();
    const auto timing = [&](int target, int source, Duration by) {
      model->forward.push_back({N(target), Op("+", V(source), Term::Span(by))});
      model->backward.push_back({N(source), Op("-", V(target), Term::Span(by))});
    };
    timing(2, 7, period);
    timing(3, 8, period);
    switch (Below(6)) {
      case 0:
        break;
      case 1:
        model->forward.push_back({N(5), Op("+", before, given)});
        model->backward.push_back({std::nullopt, Op("<>", after, before)});
        model->backward.push_back({N(6), Op("-", after, before)});
        break;
      case 2:
        model->forward.push_back({N(5), Op("*", before, given)});
        model->backward.push_back({N(6), Op("/", after, before)});
        break;
      case 3:
        model->forward.push_back({N(5), Op("+", before, Op("*", given, Term::Span(period)))});
        break;
      case 4:
        model->forward.push_back({N(5), Op("+", before, constant)});
        model->backward.push_back({N(4), Op("-", after, constant)});
        break;
      default:
        model->forward.push_back({N(5), Op("*", before, Term::Struct("vec3", {constant, constant, given}))});
        break;
    }
  }

  // ---------------------------------------------------------------------------------------------------
  // definitions

  void AddState() {
    BeginDefinition();
    CompositeState state;
    for (int i = 1 + Below(5); i > 0; --i) {
      Term payload = !seed_.composite_states.empty() && Below(3) == 0 ? Icst(true) : ValuePayload(true);
      state.components.push_back({Below(4) > 0, std::move(payload), V(0), V(1)});
    }
    state.guards = AnyGuards();
    state.id = {NextId()};
    state.variable_names = names_;
    seed_.composite_states.push_back({Label(), std::move(state)});
  }

  void Add(Model model) {
    model.id = {NextId()};
    model.variable_names = names_;
    const int total = 1 + Below(50);
    const double positive = RoundNumber(Chance() ? Below(total + 1) : total * (random_() % 1000 / 999.0));
    seed_.models.push_back({Label(), std::move(model), {positive, static_cast<double>(total)}, Chance()});
    if (Below(5) == 0) seed_.models.back().state = ModelState::kPhasedOut;
  }

  FactPattern Side(Term payload, int after, int before) {
    const auto end = [&](int variable) {
      if (Below(8) == 0) return Term::Wildcard();
      return Below(12) == 0 ? Term::Instant(AnyTime()) : V(variable);
    };
    return {Below(4) > 0, std::move(payload), end(after), end(before)};
  }

  void AddCausalModel() {
    BeginDefinition();
    Model model;
    if (Below(5) > 0) {
      model.template_arguments = {Below(3) > 0 ? V(4) : Value(true, 2), Term::Struct("ti", {V(7), V(8)})};
      if (model.template_arguments[0].is(TermKind::kWildcard)) model.template_arguments[0] = Term::Set({});
    }
    Term cause = ValuePayload(true);
    if (Chance()) {
      cause =
          MakeCommand(O(OneOf(std::vector<std::string>{"move", "push", "grab"})), {V(9), V(6), Value(true)});
    } else if (!seed_.composite_states.empty() && Chance()) {
      cause = Icst(true);
    }
    model.lhs = Side(std::move(cause), 0, 1);
    model.rhs = Side(Chance() ? MakeValue(V(9), AnyAttribute(), V(5)) : ValuePayload(true), 2, 3);
    if (Chance()) {
      AddLearnedGuards(&model);
    } else {
      model.forward = AnyGuards();
      model.backward = AnyGuards();
    }
    Add(std::move(model));
  }

  // A requirement, weak or strong, of any model (of a requirement too), or a reuse model.
  void AddModelOnModel() {
    BeginDefinition();
    const Model target = OneOf(seed_.models).model;
    Model model;
    if (Below(3) == 0) {
      model.lhs = Side(Imdl(target, true), 0, 1);
      model.rhs = Side(ValuePayload(true), 2, 3);
    } else {
      const bool on_state = !seed_.composite_states.empty() && Below(4) > 0;
      model.lhs = Side(on_state ? Icst(true) : ValuePayload(true), 0, 1);
      model.rhs = Side(Imdl(target, true), 0, 1);
    }
    if (Chance()) model.forward = AnyGuards();
    if (Chance()) model.backward = AnyGuards();
    Add(std::move(model));
  }

  void AddDrive() {
    BeginDefinition();
    Model model;
    model.lhs = Side(ValuePayload(Chance()), 0, 1);
    model.rhs = {true, E("run"), V(0), V(1)};
    Add(std::move(model));
  }

  void AddFact() {
    Term payload = ValuePayload(false);
    if (Below(4) == 0) payload = MakeCommand(O("move"), {E("h"), Value(false)});
    if (!seed_.composite_states.empty() && Below(4) == 0) payload = Icst(false);
    if (!seed_.models.empty() && Below(4) == 0) payload = Imdl(OneOf(seed_.models).model, false);
    Time after = AnyTime();
    Time before = AnyTime();
    if (before < after) std::swap(after, before);
    const double confidence = Chance() ? 1 : static_cast<double>(random_() % 1'000'000'007) / 1'000'000'006;
    seed_.facts.push_back({Label(), {Chance(), std::move(payload), {after, before}, confidence}});
  }

  std::int64_t NextId() { return next_id_ += 1 + Below(4); }
  std::string Label() {
    static const std::vector<std::string> kLabels{"",      "",          "a", "b",  "cst_1",
                                                  "mdl_2", "not plain", "h", "nil"};
    return OneOf(kLabels);
  }

  std::mt19937_64 random_;
  SeedKnowledge seed_;
  std::vector<int> numbers_;
  std::vector<std::string> names_;
  std::int64_t next_id_ = 0;
};

}  // namespace

SeedKnowledge AnyKnowledge(std::uint64_t seed) {
  return Maker(seed).Make();
}

}  // namespace aerascope
