#include "engine/reason/arrangement.h"

#include <algorithm>

namespace aerascope {
namespace {

class Flattener {
 public:
  Flattener(const KnowledgeBase& knowledge, const CompositeState& state) : knowledge_(knowledge) {
    const auto reserve = [&](int v) { next_variable_ = std::max(next_variable_, v + 1); };
    for (const FactPattern& component : state.components) {
      ForEachVariable(component.payload, reserve);
      ForEachVariable(component.after, reserve);
      ForEachVariable(component.before, reserve);
    }
    for (const Guard& guard : state.guards) {
      if (guard.target) reserve(*guard.target);
      ForEachVariable(guard.expression, reserve);
    }
    for (const FactPattern& component : state.components) AddPart(component, 0);
    flat_.guards.insert(flat_.guards.end(), state.guards.begin(), state.guards.end());
  }

  FlatState Result() && { return std::move(flat_); }

 private:
  void AddPart(const FactPattern& part, int depth) {
    const CompositeStateRecord* nested = nullptr;
    if (part.positive && IsIcst(part.payload) && part.payload[0].is(TermKind::kCompositeState) &&
        depth < kMaxTermDepth) {
      nested = knowledge_.Find(part.payload[0].composite_state());
    }
    if (!nested || !Open(nested->state, part, depth)) {
      if (std::find(flat_.parts.begin(), flat_.parts.end(), part) == flat_.parts.end())
        flat_.parts.push_back(part);
    }
  }

  bool Open(const CompositeState& state, const FactPattern& part, int depth) {
    const std::vector<int> arguments = ArgumentVariables(state);
    if (!part.payload[2].is(TermKind::kSet) || part.payload[2].size() != arguments.size()) return false;
    Bindings outer;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      const Term& given = part.payload[2][i];
      outer.Set(arguments[i], given.is(TermKind::kWildcard) ? Term::Variable(next_variable_++) : given);
    }
    for (const FactPattern& inner : state.components) {
      AddPart({inner.positive, Substitute(inner.payload, outer), part.after, part.before}, depth + 1);
    }
    for (const Guard& guard : state.guards) {
      const Term expression = Substitute(guard.expression, outer);
      const Term* target = guard.target ? outer.Find(*guard.target) : nullptr;
      if (!guard.target) {
        flat_.guards.push_back({std::nullopt, expression});
      } else if (target && target->is(TermKind::kVariable)) {
        flat_.guards.push_back({target->variable(), expression});
      } else if (target) {
        flat_.guards.push_back({std::nullopt, Term::Struct("=", {*target, expression})});
      }
    }
    return true;
  }

  const KnowledgeBase& knowledge_;
  int next_variable_ = 0;
  FlatState flat_;
};

class Arranger {
 public:
  Arranger(const FlatState& state, const Situation& situation, const MayBeLeft& may_be_left,
           std::size_t limit)
      : state_(state), situation_(situation), may_be_left_(may_be_left), limit_(limit) {}

  std::vector<Arrangement> Run(const Bindings& bindings, std::size_t count) {
    Extend({bindings, {}}, 0, count);
    return std::move(found_);
  }

  std::size_t steps() const { return steps_; }

 private:
  // Each step looks at one fact or leaves one part; steps are counted, so the work is bounded as well as the
  // result.
  void Extend(const Arrangement& so_far, std::size_t next, std::size_t to_leave) {
    if (found_.size() >= limit_ || ++steps_ > 64 * limit_) return;
    if (state_.parts.size() - next < to_leave) return;
    if (next == state_.parts.size()) {
      Arrangement done = so_far;
      if (RunGuards(state_.guards, done.bindings, OnUnbound::kDefer)) found_.push_back(std::move(done));
      return;
    }
    const FactPattern& part = state_.parts[next];
    for (const std::size_t i : situation_.Candidates(part.payload, so_far.bindings)) {
      if (situation_[i].fact.positive != part.positive) continue;
      Arrangement extended = so_far;
      if (Match(part.payload, situation_[i].fact.payload, extended.bindings))
        Extend(extended, next + 1, to_leave);
    }
    if (to_leave == 0) return;
    const FactPattern bound{part.positive, Substitute(part.payload, so_far.bindings), part.after,
                            part.before};
    if (!may_be_left_(bound)) return;
    Arrangement later = so_far;
    later.left.push_back(next);
    Extend(later, next + 1, to_leave - 1);
  }

  const FlatState& state_;
  const Situation& situation_;
  const MayBeLeft& may_be_left_;
  std::size_t limit_;
  std::size_t steps_ = 0;
  std::vector<Arrangement> found_;
};

}  // namespace

FlatState Flatten(const KnowledgeBase& knowledge, const CompositeState& state) {
  return Flattener(knowledge, state).Result();
}

std::vector<Arrangement> Arrange(const FlatState& state, const Situation& situation, const Bindings& bindings,
                                 std::size_t count, const MayBeLeft& may_be_left, std::size_t limit,
                                 std::size_t* steps) {
  Arranger arranger(state, situation, may_be_left, limit);
  std::vector<Arrangement> arrangements = arranger.Run(bindings, count);
  *steps += arranger.steps();
  return arrangements;
}

}  // namespace aerascope
