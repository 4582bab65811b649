#include "engine/reason/hypothesis.h"

#include <algorithm>

#include "engine/kb/term_codec.h"
#include "engine/reason/existence.h"

namespace aerascope {

int Hypotheses::Consider(const ModelRecord& requirement, const CompositeStateRecord& state,
                         const Bindings& bindings, ImaginedFrame* frame, const Fact& wanted,
                         const GoalEntry& goal, const CanBringAbout& can_bring_about) {
  const std::string key = std::to_string(requirement.model.id.value) + "/" + Encode(Closed(wanted.payload));
  const auto [it, is_new] = position_of_.try_emplace(key, -1);
  if (is_new) {
    const bool openaera = context_.parameters.analogy_mode == AnalogyMode::kOpenaera;
    frame->FindParts(knowledge_, state.state);
    Candidate candidate;
    candidate.goal = goal;
    // OpenAERA counts what is the case, not what is predicted.
    const Situation& situation = openaera ? context_.present : frame->situation();
    static const std::vector<SituationFact> nothing;
    candidate.comparison = Compare(knowledge_, requirement, situation, openaera ? nothing : frame->pending(),
                                   bindings, wanted.payload, can_bring_about, context_.parameters);
    if (candidate.comparison.rejection == AnalogyVerdict::kFullMatch) return -1;
    if (!candidate.comparison.rejection) {
      candidate.hypothesis = MakeHypothesis(state.state, requirement.model, candidate.comparison.kept);
      for (std::size_t old = 0; old < candidate.hypothesis.variable_of.size(); ++old) {
        const Term* value = candidate.comparison.bindings.Find(static_cast<int>(old));
        const int variable = candidate.hypothesis.variable_of[old];
        if (variable >= 0 && value) candidate.bindings.Set(variable, *value);
      }
      if (const ModelRecord* known = openaera ? nullptr : BlackListed(candidate.hypothesis)) {
        candidate.comparison.rejection = AnalogyVerdict::kBlackListed;
        journal_.ComeUpAgain(known->model.id);
        candidate.refuted = known->rated;
      }
    }
    it->second = static_cast<int>(candidates_.size());
    candidates_.push_back(std::move(candidate));
  }
  return it->second >= 0 && !(*this)[it->second].comparison.rejection ? it->second : -1;
}

// The same hypothesis, if it was made before, failed, and was deleted.
const ModelRecord* Hypotheses::BlackListed(const Hypothesis& hypothesis) const {
  const CompositeStateId state = knowledge_.FindState(knowledge_.CanonicalOf(hypothesis.state).hash);
  if (!state.valid()) return nullptr;
  const ModelRecord* equal = FindEqual(WithState(hypothesis, *knowledge_.Find(state)), knowledge_);
  return equal && equal->black_listed ? equal : nullptr;
}

// The hypothetical requirement, about a composite state that may list its variables in another order.
Model Hypotheses::WithState(const Hypothesis& hypothesis, const CompositeStateRecord& record) const {
  const Canonical own = knowledge_.CanonicalOf(hypothesis.state);
  const std::vector<int> own_arguments = ArgumentVariables(hypothesis.state);
  std::map<int, Term> term_of;  // variable of the record -> the requirement's term
  for (std::size_t i = 0; i < own.variables.size() && i < record.canonical.variables.size(); ++i) {
    const auto it = std::find(own_arguments.begin(), own_arguments.end(), own.variables[i]);
    if (it == own_arguments.end()) continue;
    term_of.emplace(
        record.canonical.variables[i],
        hypothesis.requirement.lhs.payload[2][static_cast<std::size_t>(it - own_arguments.begin())]);
  }
  std::vector<Term> arguments;
  for (const int variable : ArgumentVariables(record.state)) {
    const auto it = term_of.find(variable);
    arguments.push_back(it == term_of.end() ? Term::Wildcard() : it->second);
  }
  Model model = hypothesis.requirement;
  model.lhs.payload = MakeIcst(record.state.id, {}, std::move(arguments));
  return model;
}

AnalogyCompared Hypotheses::Describe(const Candidate& candidate, AnalogyVerdict verdict) const {
  const Comparison& comparison = candidate.comparison;
  AnalogyCompared event;
  event.goal = candidate.goal.id;
  event.requirement = comparison.requirement;
  event.source = comparison.source;
  event.causal_model = comparison.causal_model;
  event.bindings = Closed(InstancePayload(knowledge_.Find(comparison.source)->state, comparison.bindings));
  for (const ComparedComponent& component : comparison.components) {
    event.components.push_back(component);
    event.components.back().pattern = Closed(component.pattern);
  }
  event.matched = comparison.matched;
  event.achievable = comparison.achievable;
  event.total = static_cast<std::int64_t>(comparison.components.size());
  event.psi = comparison.psi;
  event.jaccard = comparison.jaccard;
  event.confidence = comparison.confidence;
  event.verdict = verdict;
  return event;
}

std::vector<EventId> Hypotheses::CausesOf(const Candidate& candidate) const {
  const ModelRecord& requirement = *knowledge_.Find(candidate.comparison.requirement);
  std::vector<EventId> causes{candidate.goal.event, requirement.event, requirement.rated,
                              knowledge_.Find(candidate.comparison.source)->event, candidate.refuted};
  for (const ComparedComponent& component : candidate.comparison.components) {
    for (const SituationFact& fact : context_.present.facts()) {
      const bool found = component.found.valid() && fact.id == component.found;
      const bool counterpart = !component.found.valid() && fact.fact.payload == component.counterpart;
      if (found || counterpart) {
        causes.push_back(fact.event);
        break;
      }
    }
  }
  return causes;
}

void Hypotheses::ReportRejected() {
  for (const Candidate& candidate : candidates_) {
    if (!candidate.comparison.rejection) continue;
    const EventId reported = journal_.Write(
        context_.now, Describe(candidate, *candidate.comparison.rejection), CausesOf(candidate));
    if (candidate.comparison.rejection == AnalogyVerdict::kBlackListed) refused_.push_back(reported);
    fruitless_.push_back(reported);
  }
}

void Hypotheses::ReportLeftOver(bool searched) {
  for (const Candidate& candidate : candidates_) {
    if (candidate.comparison.rejection || candidate.adopted) continue;
    const bool no_plan = searched && !candidate.in_a_plan;
    const EventId reported = journal_.Write(
        context_.now, Describe(candidate, no_plan ? AnalogyVerdict::kNoPlan : AnalogyVerdict::kNotRequired),
        CausesOf(candidate));
    if (no_plan) fruitless_.push_back(reported);
  }
}

void Hypotheses::AdoptOne(Candidate* candidate) {
  if (candidate->adopted) return;
  candidate->adopted = true;
  const bool avoid_duplicates = context_.parameters.analogy_mode == AnalogyMode::kPaper;
  AnalogyCompared compared = Describe(*candidate, AnalogyVerdict::kAccepted);
  CompositeState state = candidate->hypothesis.state;
  Model requirement = candidate->hypothesis.requirement;
  CompositeStateId known_state;
  ModelId known_requirement;
  if (avoid_duplicates) known_state = knowledge_.FindState(knowledge_.CanonicalOf(state).hash);
  state.id = known_state.valid() ? known_state : journal_.NewId<CompositeStateId>();
  compared.result_state = state.id;
  if (known_state.valid()) {
    requirement = WithState(candidate->hypothesis, *knowledge_.Find(known_state));
    const ModelRecord* equal = FindEqual(requirement, knowledge_);
    if (equal) known_requirement = equal->model.id;
  } else {
    requirement.lhs.payload = Term::Struct(
        "icst", {Term::Reference(state.id), requirement.lhs.payload[1], requirement.lhs.payload[2]});
  }
  requirement.id = known_requirement.valid() ? known_requirement : journal_.NewId<ModelId>();
  compared.result_requirement = requirement.id;
  candidate->requirement = requirement.id;
  const EventId comparison = journal_.Write(context_.now, compared, CausesOf(*candidate));
  if (!known_state.valid()) {
    journal_.Write(context_.now, CompositeStateCreated{state, Origin::kAnalogy, candidate->comparison.source},
                   {comparison, knowledge_.Find(candidate->comparison.source)->event});
  }
  if (!known_requirement.valid()) {
    candidate->created =
        journal_.Write(context_.now,
                       ModelCreated{requirement, Evidence{candidate->comparison.confidence, 1}, false,
                                    Origin::kAnalogy, candidate->comparison.requirement},
                       {comparison, knowledge_.Find(state.id)->event,
                        knowledge_.Find(candidate->comparison.causal_model)->event});
  }
  offer_(state.id, requirement.id);
}

std::vector<EventId> Hypotheses::Adopt(Plan* plan) {
  std::vector<EventId> created;
  for (auto step = plan->steps.rbegin(); step != plan->steps.rend(); ++step) {
    if (step->hypothesis < 0) continue;
    Candidate& candidate = candidates_[static_cast<std::size_t>(step->hypothesis)];
    const bool known = candidate.adopted;
    AdoptOne(&candidate);
    if (!known && candidate.created.valid()) created.push_back(candidate.created);
    step->requirement = candidate.requirement;
  }
  return created;
}

void Hypotheses::AdoptAll() {
  for (Candidate& candidate : candidates_) {
    if (!candidate.comparison.rejection) AdoptOne(&candidate);
  }
}

}  // namespace aerascope
