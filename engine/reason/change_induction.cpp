#include "engine/reason/change_induction.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "engine/reason/adoption.h"
#include "engine/reason/causal_model_builder.h"
#include "engine/reason/composite_state_builder.h"
#include "engine/reason/guard_form.h"
#include "engine/reason/requirement_builder.h"
#include "engine/reason/roles.h"

namespace aerascope {
namespace {

constexpr int kMaxNesting = 3;  // how deep in an instance the premise may stand (semantics 5.1)

class ChangeInduction {
 public:
  ChangeInduction(const Change& change, const Situation& before, ValueRoles roles, Time now, Journal* journal)
      : change_(change),
        premise_(before[change.premise]),
        before_(before),
        roles_(roles),
        adoption_(InductionKind::kChange, roles, now, journal),
        values_(journal->knowledge(), roles) {
    values_.Add(premise_.fact.payload);
    values_.Add(change_.consequent.fact.payload);
    value_change_ = {premise_.fact.payload[1].name(), premise_.fact.payload[2],
                     change_.consequent.fact.payload[2],
                     change_.consequent.fact.interval.after - premise_.fact.interval.after};
    if (IsQuantity(value_change_.before)) delta_ = Difference(value_change_.after, value_change_.before);
  }

  void Run() {
    KeepInputs();
    adoption_.Start(premise_.id, change_.consequent.id, {change_.consequent.event, premise_.event},
                    std::move(inputs_));
    for (const auto& [i, verdict] : no_causes_) adoption_.Report(before_[i], verdict);
    for (const std::size_t i : causes_) TryCause(before_[i]);
  }

 private:
  const KnowledgeBase& kb() const { return adoption_.knowledge(); }

  bool EveryComponentShares(std::size_t position) const {
    const SituationFact& fact = before_[position];
    if (fact.components.empty()) return values_.SharedBy(fact.fact.payload);
    return std::all_of(fact.components.begin(), fact.components.end(),
                       [&](std::size_t i) { return EveryComponentShares(i); });
  }

  bool HoldsDelta(const Term& imdl) const {
    bool holds = false;
    ForEachValue(imdl, kb(), [&](const Term& value, const std::string&) {
      holds = holds || (delta_ && SameValue(value, *delta_));
    });
    return holds;
  }

  // Selective attention: which inputs may be conditions, and which may be causes.
  void KeepInputs() {
    const bool listed = adoption_.records_inputs();
    for (std::size_t i = 0; i < before_.facts().size(); ++i) {
      if (i == change_.premise) continue;
      const InputVerdict verdict = VerdictOn(i);
      if (listed) inputs_.push_back({before_[i].id, verdict});
      if (verdict == InputVerdict::kCondition) conditions_.push_back(i);
      if (verdict == InputVerdict::kCause) {
        causes_.push_back(i);
      } else if (MayBeCause(before_[i])) {
        no_causes_.emplace_back(i, WhyNoCause(verdict));
      }
    }
  }

  static bool MayBeCause(const SituationFact& input) {
    return !input.concluded && !input.permanent && !IsIcst(input.fact.payload);
  }

  // Of an input that could be a cause and is none.
  static CauseVerdict WhyNoCause(InputVerdict verdict) {
    if (verdict == InputVerdict::kNoSharedValue) return CauseVerdict::kNoSharedValue;
    if (verdict == InputVerdict::kTooLate) return CauseVerdict::kTooLate;
    return CauseVerdict::kSimultaneous;
  }

  InputVerdict VerdictOn(std::size_t i) const {
    const SituationFact& input = before_[i];
    const Term& payload = input.fact.payload;
    const TimeInterval& interval = input.fact.interval;
    if (input.concluded) return InputVerdict::kNotEligible;
    const bool in_step = InSync(interval, premise_.fact.interval);
    if (IsIcst(payload)) {
      if (!in_step) return InputVerdict::kOutOfStep;
      return EveryComponentShares(i) ? InputVerdict::kCondition : InputVerdict::kPartNotShared;
    }
    if (!values_.SharedBy(payload) && !(IsImdl(payload) && HoldsDelta(payload)))
      return InputVerdict::kNoSharedValue;
    if (input.permanent) return InputVerdict::kCondition;
    if (interval.after >= change_.consequent.fact.interval.after) return InputVerdict::kTooLate;
    if (IsCommand(payload) || IsImdl(payload)) return InputVerdict::kCause;
    if (in_step) return InputVerdict::kCondition;
    return Synchronous(interval.after, premise_.fact.interval.after) ? InputVerdict::kOutOfStep
                                                                     : InputVerdict::kCause;
  }

  void TryCause(const SituationFact& cause) {
    const auto formula = GuessFormula(value_change_, cause.fact.payload, kb());
    if (!formula) {
      adoption_.Report(cause, CauseVerdict::kNoGuardForm);
      return;
    }
    Fact premise = premise_.fact;
    premise.interval = Intersection(premise.interval, before_.interval()).value_or(before_.interval());
    ModelInstance model =
        BuildCausalModel({premise, cause.fact, change_.consequent.fact}, *formula, kb(), roles_);
    auto state = FindOrBuildState(model, cause);
    if (!state) {
      adoption_.Reject(cause, CauseVerdict::kNoCompositeState, std::move(model.model));
      return;
    }
    const TimeInterval valid = state->interval;
    adoption_.Adopt(
        {cause, ToText(formula->form), OnState(std::move(*state), before_), std::move(model), valid, true});
  }

  // The individuals that only the conditions can give.
  std::vector<Term> Wanted(const ModelInstance& model, const SituationFact& cause) const {
    std::vector<Term> wanted;
    for (const int variable : EffectVariablesLeftOpen(model.model)) {
      if (const Term* value = model.values.Find(variable)) wanted.push_back(*value);
    }
    if (!IsImdl(cause.fact.payload)) return wanted;
    ForEachTerm(cause.fact.payload, [&](const Term& part) {
      if (part.is(TermKind::kEntity)) wanted.push_back(part);
    });
    return wanted;
  }

  bool Names(std::size_t instance, const std::vector<Term>& wanted) const {
    std::set<Term> named;
    ForEachTerm(before_[instance].fact.payload, [&](const Term& part) { named.insert(part); });
    return std::all_of(wanted.begin(), wanted.end(),
                       [&](const Term& value) { return named.contains(value); });
  }

  // An instance that contains the premise, the most direct one first; else one put together from the
  // conditions.
  std::optional<StateInstance> FindOrBuildState(const ModelInstance& model,
                                                const SituationFact& cause) const {
    const std::vector<Term> wanted = Wanted(model, cause);
    std::vector<std::size_t> containing;
    for (const std::size_t i : conditions_) {
      if (IsIcst(before_[i].fact.payload) && Contains(before_, i, change_.premise, kMaxNesting))
        containing.push_back(i);
    }
    for (int depth = 1; depth <= kMaxNesting; ++depth) {
      std::optional<std::size_t> best;
      std::string best_key;
      for (const std::size_t i : containing) {
        if (!Contains(before_, i, change_.premise, depth) || !Names(i, wanted)) continue;
        std::string key = ContentKey(before_[i].fact.payload, kb());
        if (best && best_key <= key) continue;
        best = i;
        best_key = std::move(key);
      }
      if (best) return InstanceAt(*best, before_, kb());
    }
    std::vector<std::size_t> members{change_.premise};
    members.insert(members.end(), conditions_.begin(), conditions_.end());
    auto state = PutTogether(Outermost(members, before_), before_, kb(), roles_);
    if (state) state = KnownOrNew(std::move(*state), kb());
    return state;
  }

  const Change& change_;
  const SituationFact& premise_;
  const Situation& before_;
  ValueRoles roles_;
  Adoption adoption_;
  SharedValues values_;  // of premise and consequent
  ValueChange value_change_;
  std::optional<Term> delta_;
  std::vector<std::size_t> conditions_;
  std::vector<std::size_t> causes_;
  std::vector<std::pair<std::size_t, CauseVerdict>>
      no_causes_;                        // that could be causes, and why they are none
  std::vector<ConsideredInput> inputs_;  // while they are recorded
};

}  // namespace

void InduceFromChange(const Change& change, const Situation& before, ValueRoles roles, Time now,
                      Journal* journal) {
  ChangeInduction(change, before, roles, now, journal).Run();
}

}  // namespace aerascope
