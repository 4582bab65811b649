#include "engine/reason/planner.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "engine/kb/term_codec.h"
#include "engine/reason/chaining.h"

namespace aerascope {
namespace {

// Plans kept for one goal, partial arrangements looked at, and plans tried in the head for one decision.
constexpr std::size_t kMaxPlansPerGoal = 16;
constexpr std::size_t kMaxArrangements = 256;
constexpr std::size_t kMaxSimulations = 8;

struct Step {
  Term command;
  ModelId causal_model;
  ModelId requirement;  // of a hypothesis: the requirement it generalises
  int hypothesis = -1;  // index into the planner's candidates
};

struct Plan {
  std::vector<Step> steps;
  double score = 1;
  Situation end;
};

// A comparison worth a hypothesis, and the definitions it would add.
struct Candidate {
  Comparison comparison;
  GoalId goal;
  EventId goal_event;
  Hypothesis hypothesis;
  bool in_a_plan = false;
  bool accepted = false;
  bool black_listed = false;
};

class Planner {
 public:
  Planner(const PlanningTask& task, const ReasonerParameters& parameters, Duration period, const Situation& situation,
          const OfferKnowledge& offer, Journal* journal)
      : task_(task),
        parameters_(parameters),
        period_(period),
        situation_(situation),
        offer_(offer),
        journal_(*journal),
        kb_(journal->knowledge()) {}

  std::optional<Decision> Run() {
    IndexCausalModels();
    root_ = SetGoal(task_.drive, task_.drive_event, {}, task_.goal, task_.positive);

    std::vector<Plan> plans = Achieve(task_.goal, task_.positive, situation_, root_, 0);
    std::optional<Tried> best;
    std::vector<SimulationId> tried;
    for (std::size_t i = 0; i < plans.size() && i < kMaxSimulations; ++i) {
      const Tried outcome = Simulate(plans[i], {});
      tried.push_back(outcome.simulation);
      if (outcome.reached && (!best || outcome.score > best->score)) best = outcome;
    }
    if (!best && parameters_.analogy_min_psi < 1) {
      hypothesise_ = true;
      nodes_ = 0;
      plans = Achieve(task_.goal, task_.positive, situation_, root_, 0);
      for (const Plan& plan : plans) {
        for (const Step& step : plan.steps) {
          if (step.hypothesis >= 0) candidates_[static_cast<std::size_t>(step.hypothesis)].in_a_plan = true;
        }
      }
      ReportRejected();
      for (std::size_t i = 0; i < plans.size() && i < kMaxSimulations && !best; ++i) {
        const std::vector<EventId> hypothesised = Hypothesise(plans[i]);
        const Tried outcome = Simulate(plans[i], hypothesised);
        tried.push_back(outcome.simulation);
        if (outcome.reached) best = outcome;
      }
    } else {
      ReportRejected();
    }
    ReportLeftOver();
    if (!best) return std::nullopt;
    const EventId committed = journal_.Write(
        task_.commit_time, PlanCommitted{root_.id, best->simulation, tried, best->score}, {best->event, root_.event});
    return Decision{best->first_command, committed};
  }

 private:
  struct GoalNode {
    GoalId id;
    EventId event;
  };
  struct Tried {
    SimulationId simulation;
    EventId event;
    Term first_command;
    bool reached = false;
    double score = 0;
  };

  void IndexCausalModels() {
    for (const auto& [id, record] : kb_.models()) {
      if (record.state != ModelState::kActive) continue;
      const Model& model = record.model;
      if (KindOf(model) != ModelKind::kCausal || !IsCommand(model.lhs.payload) || !IsValue(model.rhs.payload)) continue;
      by_attribute_[model.rhs.payload[1]].push_back(&record);
    }
  }

  const std::vector<const ModelRecord*>& ModelsFor(const Term& payload) const {
    static const std::vector<const ModelRecord*> none;
    if (!IsValue(payload)) return none;
    const auto it = by_attribute_.find(payload[1]);
    return it == by_attribute_.end() ? none : it->second;
  }

  // Could a causal model bring this about, through a condition that is at least familiar? A condition that asks for
  // unchangeable things which do not hold (a sphere that should be a hand) is no way to anything.
  bool CanBringAboutPayload(const Term& payload) const {
    const Term open = Closed(payload);
    for (const ModelRecord* record : ModelsFor(payload)) {
      const Model& model = record->model;
      Bindings bindings;
      if (!model.rhs.positive || !Match(model.rhs.payload, open, bindings)) continue;
      if (model.template_arguments.empty()) return true;
      const Term imdl = Closed(InstancePayload(model, bindings));
      for (const ModelId id : kb_.RequirementsOf(model.id)) {
        const ModelRecord& requirement = *kb_.Find(id);
        Bindings required;
        if (requirement.state == ModelState::kActive && requirement.model.rhs.positive &&
            Match(requirement.model.rhs.payload, imdl, required) &&
            Conceivable(Substitute(requirement.model.lhs.payload, required)) > parameters_.analogy_min_psi) {
          return true;
        }
      }
    }
    return false;
  }

  // The share of conditions that hold now or concern something a model can change.
  double Conceivable(const Term& payload) const {
    const CompositeStateRecord* record =
        IsIcst(payload) ? kb_.Find(payload[0].composite_state()) : nullptr;
    Bindings bindings;
    if (!record || !BindInstance(record->state, Closed(payload), bindings)) return 0;
    double conceivable = 0;
    for (const FactPattern& component : record->state.components) {
      const Term part = Substitute(component.payload, bindings);
      const bool holds = situation_.FindMatch(component.payload, component.positive, bindings) != Situation::npos;
      if (holds || (IsIcst(part) ? Conceivable(part) == 1 : !ModelsFor(part).empty())) conceivable += 1;
    }
    return conceivable / static_cast<double>(record->state.components.size());
  }

  // The goal node for this target under its super goal; written once, however often the search comes by.
  GoalNode SetGoal(GoalId super, EventId super_event, ModelId model, const Term& payload, bool positive) {
    const Term closed = Closed(payload);
    const std::string key = std::to_string(super.value) + "/" + std::to_string(model.value) + "/" + Encode(closed);
    const auto it = goals_.find(key);
    if (it != goals_.end()) return it->second;
    GoalNode node;
    node.id = journal_.NewId<GoalId>();
    const ModelRecord* record = kb_.Find(model);
    node.event = journal_.Write(
        task_.now, GoalSet{node.id, super, model, Fact{positive, closed, task_.interval, 1}},
        {super_event, record ? record->event : EventId{}});
    goals_.emplace(key, node);
    return node;
  }

  void Skip(const GoalNode& super, const Term& payload, bool positive, GoalSkipReason reason) {
    const Term closed = Closed(payload);
    if (!skipped_.insert(std::to_string(super.id.value) + "/" + Encode(closed)).second) return;
    journal_.Write(task_.now, GoalSkipped{super.id, Fact{positive, closed, task_.interval, 1}, reason}, {super.event});
  }

  // Plans that bring about the payload from the situation, best first.
  std::vector<Plan> Achieve(const Term& payload, bool positive, const Situation& from, const GoalNode& goal, int depth) {
    std::vector<Plan> plans;
    if (++nodes_ > parameters_.max_simulation_nodes) {
      Skip(goal, payload, positive, GoalSkipReason::kBudget);
      return plans;
    }
    if (depth > parameters_.max_plan_depth) {
      Skip(goal, payload, positive, GoalSkipReason::kTooDeep);
      return plans;
    }
    stack_.push_back(Closed(payload));
    bool any_model = false;
    for (const ModelRecord* record : ModelsFor(payload)) {
      Bindings bindings;
      if (record->model.rhs.positive != positive || !Match(record->model.rhs.payload, Closed(payload), bindings)) continue;
      any_model = true;
      AchieveThrough(*record, bindings, payload, from, goal, depth, &plans);
    }
    stack_.pop_back();
    if (!any_model) Skip(goal, payload, positive, GoalSkipReason::kNoModel);
    std::stable_sort(plans.begin(), plans.end(), [](const Plan& a, const Plan& b) {
      if (a.score != b.score) return a.score > b.score;
      return a.steps.size() < b.steps.size();
    });
    if (plans.size() > kMaxPlansPerGoal) plans.erase(plans.begin() + kMaxPlansPerGoal, plans.end());
    return plans;
  }

  void AchieveThrough(const ModelRecord& causal, const Bindings& bindings, const Term& payload, const Situation& from,
                      const GoalNode& goal, int depth, std::vector<Plan>* plans) {
    const Model& model = causal.model;
    const Term imdl = Closed(InstancePayload(model, bindings));
    bool needs_requirement = false;
    std::optional<GoalNode> imdl_goal;
    for (const ModelId id : kb_.RequirementsOf(model.id)) {
      const ModelRecord& requirement = *kb_.Find(id);
      if (requirement.state != ModelState::kActive || !requirement.model.rhs.positive) continue;
      needs_requirement = true;
      const CompositeStateRecord* required = kb_.Find(RequiredState(requirement.model));
      Bindings requirement_bindings;
      if (!required || !Match(requirement.model.rhs.payload, imdl, requirement_bindings)) continue;
      Bindings state_bindings;
      const Term icst = Closed(Substitute(requirement.model.lhs.payload, requirement_bindings));
      if (!BindInstance(required->state, icst, state_bindings)) continue;
      if (!imdl_goal) imdl_goal = SetGoal(goal.id, goal.event, model.id, imdl, true);
      const GoalNode icst_goal = SetGoal(imdl_goal->id, imdl_goal->event, id, icst, true);

      const Route route{&causal, &bindings, &payload, &requirement.model, requirement.evidence.rate(), id, -1};
      const std::size_t before = plans->size();
      const bool partial = !TakeRoute(route, required->state, state_bindings, from, icst_goal, depth, plans);
      if (partial || plans->size() == before) {
        ConsiderAnalogy(causal, bindings, payload, requirement, *required, state_bindings, from, icst_goal, depth, plans);
      }
    }
    if (!needs_requirement && model.template_arguments.empty()) {
      const Route route{&causal, &bindings, &payload, nullptr, 1, {}, -1};
      Plan plan{{}, 1, from};
      FinishStep(route, Term(), plan, plans);
    }
  }

  // How a causal model is reached: through which requirement, real or hypothetical.
  struct Route {
    const ModelRecord* causal;
    const Bindings* bindings;  // of the causal model, from the goal
    const Term* payload;       // wanted
    const Model* requirement;  // null if it needs none
    double requirement_rate;
    ModelId requirement_id;
    int hypothesis;
  };

  // Plans by which the composite state comes to hold and the causal model then fires. False if some component neither
  // holds nor can be brought about (so nothing but analogy could help).
  bool TakeRoute(const Route& route, const CompositeState& state, const Bindings& bindings, const Situation& from,
                 const GoalNode& goal, int depth, std::vector<Plan>* plans) {
    const std::vector<JointMatch> matches = JointMatches(state, from, bindings, kMaxArrangements);
    for (const JointMatch& match : matches) {
      FinishStep(route, InstancePayload(state, match.bindings), Plan{{}, 1, from}, plans);
    }
    if (!matches.empty()) return true;
    for (const FactPattern& component : state.components) {
      if (Status(component, from, bindings) == ComponentStatus::kMissed) return false;
    }
    // The fewest sub-goals first; more only if these lead nowhere.
    std::vector<Arrangement> arrangements;
    Arrange(state, from, {bindings, {}}, 0, &arrangements);
    std::erase_if(arrangements, [&](const Arrangement& arrangement) {
      return std::any_of(arrangement.deferred.begin(), arrangement.deferred.end(), [&](std::size_t i) {
        return !KeepsToIndividuals(state.components[i], from, bindings, arrangement.bindings);
      });
    });
    std::stable_sort(arrangements.begin(), arrangements.end(), [](const Arrangement& a, const Arrangement& b) {
      return a.deferred.size() < b.deferred.size();
    });
    const std::size_t before = plans->size();
    std::size_t fewest = 0;
    for (const Arrangement& arrangement : arrangements) {
      if (plans->size() > before && arrangement.deferred.size() > fewest) break;
      fewest = arrangement.deferred.size();
      PursueDeferred(route, state, arrangement, from, goal, depth, plans);
    }
    return true;
  }

  ComponentStatus Status(const FactPattern& component, const Situation& from, const Bindings& bindings) const {
    return StatusOf(component, kb_, from, bindings, [this](const Term& payload) { return CanBringAboutPayload(payload); });
  }

  // A way to bind the components to facts, leaving some to be brought about.
  struct Arrangement {
    Bindings bindings;
    std::vector<std::size_t> deferred;
  };

  void Arrange(const CompositeState& state, const Situation& from, const Arrangement& so_far, std::size_t next,
               std::vector<Arrangement>* arrangements) {
    if (arrangements->size() >= kMaxArrangements) return;
    if (next == state.components.size()) {
      if (!so_far.deferred.empty()) arrangements->push_back(so_far);
      return;
    }
    const FactPattern& component = state.components[next];
    for (const std::size_t i : from.Candidates(component.payload, so_far.bindings)) {
      Arrangement extended = so_far;
      if (from[i].fact.positive == component.positive &&
          Match(component.payload, from[i].fact.payload, extended.bindings)) {
        Arrange(state, from, extended, next + 1, arrangements);
      }
    }
    // Left for later: whether it can be had is asked again when everything else is bound.
    Arrangement later = so_far;
    later.deferred.push_back(next);
    Arrange(state, from, later, next + 1, arrangements);
  }

  void PursueDeferred(const Route& route, const CompositeState& state, const Arrangement& arrangement,
                      const Situation& from, const GoalNode& goal, int depth, std::vector<Plan>* plans) {
    std::vector<Term> wanted;
    for (const std::size_t i : arrangement.deferred) {
      if (!state.components[i].positive ||
          !CollectWanted(Substitute(state.components[i].payload, arrangement.bindings), from, &wanted)) {
        return;
      }
    }
    if (wanted.empty()) return;
    Plan plan{{}, 1, from};
    for (const Term& payload : wanted) {
      if (plan.end.FindMatch(payload, true, {}) != Situation::npos) continue;
      const Term closed = Closed(payload);
      const bool loop = std::any_of(stack_.begin(), stack_.end(), [&](const Term& other) { return other == closed; });
      if (loop) {
        Skip(goal, payload, true, GoalSkipReason::kLoop);
        return;
      }
      const GoalNode sub_goal = SetGoal(goal.id, goal.event, {}, payload, true);
      std::vector<Plan> ways = Achieve(payload, true, plan.end, sub_goal, depth + 1);
      if (ways.empty()) return;
      Plan& best = ways.front();
      plan.steps.insert(plan.steps.end(), best.steps.begin(), best.steps.end());
      plan.score *= best.score;
      plan.end = std::move(best.end);
    }
    // What was bound by facts may have changed on the way: join anew in the situation reached.
    for (const JointMatch& match : JointMatches(state, plan.end, arrangement.bindings, kMaxArrangements)) {
      FinishStep(route, InstancePayload(state, match.bindings), plan, plans);
    }
  }

  // The plain facts to bring about for a component: itself, or the parts of a nested state that do not hold. False if
  // one of them is not fully bound, or nothing could bring it about.
  bool CollectWanted(const Term& payload, const Situation& from, std::vector<Term>* wanted) const {
    if (from.FindMatch(payload, true, {}) != Situation::npos) return true;
    if (!IsIcst(payload)) {
      if (!payload.ground() || !CanBringAboutPayload(payload)) return false;
      if (std::find(wanted->begin(), wanted->end(), payload) == wanted->end()) wanted->push_back(payload);
      return true;
    }
    const CompositeStateRecord* nested = kb_.Find(payload[0].composite_state());
    Bindings bindings;
    if (!nested || !BindInstance(nested->state, payload, bindings)) return false;
    for (const FactPattern& part : nested->state.components) {
      if (!part.positive || !CollectWanted(Substitute(part.payload, bindings), from, wanted)) return false;
    }
    return true;
  }

  // The causal model fires at the end of the plan so far, if its command is fully known and its effect is as wanted.
  void FinishStep(const Route& route, const Term& icst, const Plan& so_far, std::vector<Plan>* plans) {
    const Model& model = route.causal->model;
    Bindings bindings = *route.bindings;
    if (route.requirement) {
      Bindings requirement = {};
      const FactPattern& lhs = route.requirement->lhs;
      if (!Match(lhs.payload, icst, requirement) ||
          !Match(lhs.after, Term::Instant(so_far.end.interval().after), requirement) ||
          !Match(lhs.before, Term::Instant(so_far.end.interval().before), requirement) ||
          !RunGuards(route.requirement->forward, requirement, OnUnbound::kDefer)) {
        return;
      }
      const Term imdl = Closed(Substitute(route.requirement->rhs.payload, requirement));
      if (!BindInstance(model, imdl, bindings)) return;
    }
    if (!RunGuards(model.backward, bindings, OnUnbound::kDefer)) return;
    if (!RunGuards(model.forward, bindings, OnUnbound::kDefer)) return;
    const Term command = Substitute(model.lhs.payload, bindings);
    const Term effect = Substitute(model.rhs.payload, bindings);
    Bindings none;
    if (!command.ground() || !effect.ground() || !Match(Closed(*route.payload), effect, none)) return;
    SituationFact changed;
    changed.fact = {model.rhs.positive, effect,
                    {so_far.end.interval().after + period_, so_far.end.interval().before + period_}, 1};
    Plan plan{so_far.steps, so_far.score * route.causal->evidence.rate() * route.requirement_rate,
              so_far.end.Successor({changed}, period_)};
    AddInstances(kb_, &plan.end);
    plan.steps.push_back({command, model.id, route.requirement_id, route.hypothesis});
    plans->push_back(std::move(plan));
  }

  void ConsiderAnalogy(const ModelRecord& causal, const Bindings& bindings, const Term& payload,
                       const ModelRecord& requirement, const CompositeStateRecord& required,
                       const Bindings& state_bindings, const Situation& from, const GoalNode& goal, int depth,
                       std::vector<Plan>* plans) {
    const std::string key = std::to_string(requirement.model.id.value) + "/" + Encode(Closed(payload));
    auto known = candidate_of_.find(key);
    if (known == candidate_of_.end()) {
      Candidate candidate;
      candidate.comparison =
          Compare(kb_, requirement, from, state_bindings, payload,
                  [this](const Term& p) { return CanBringAboutPayload(p); }, parameters_);
      candidate.goal = goal.id;
      candidate.goal_event = goal.event;
      if (candidate.comparison.rejection == AnalogyVerdict::kFullMatch) return;
      if (!candidate.comparison.rejection) {
        candidate.hypothesis = MakeHypothesis(required.state, requirement.model, candidate.comparison.kept);
        candidate.black_listed = BlackListed(candidate.hypothesis);
        if (candidate.black_listed) candidate.comparison.rejection = AnalogyVerdict::kBlackListed;
      }
      known = candidate_of_.emplace(key, candidates_.size()).first;
      candidates_.push_back(std::move(candidate));
    }
    if (!hypothesise_) return;
    const std::size_t index = known->second;
    if (candidates_[index].comparison.rejection) return;
    // The list may grow while plans are looked for below: keep copies.
    const Hypothesis hypothesis = candidates_[index].hypothesis;
    const Bindings& chosen = candidates_[index].comparison.bindings;
    Bindings hypothesis_bindings;
    for (std::size_t old_variable = 0; old_variable < hypothesis.variable_of.size(); ++old_variable) {
      const Term* value = chosen.Find(static_cast<int>(old_variable));
      if (hypothesis.variable_of[old_variable] >= 0 && value) {
        hypothesis_bindings.Set(hypothesis.variable_of[old_variable], *value);
      }
    }
    const double confidence = candidates_[index].comparison.confidence;
    const Route route{&causal, &bindings, &payload, &hypothesis.requirement, confidence, requirement.model.id,
                      static_cast<int>(index)};
    TakeRoute(route, hypothesis.state, hypothesis_bindings, from, goal, depth, plans);
  }

  // Was the same hypothesis made before, failed, and deleted?
  bool BlackListed(const Hypothesis& hypothesis) const {
    const CompositeStateId state = kb_.FindState(kb_.CanonicalOf(hypothesis.state).hash);
    if (!state.valid()) return false;
    const ModelId model = kb_.FindModel(kb_.CanonicalOf(WithState(hypothesis, *kb_.Find(state))).hash);
    return model.valid() && kb_.Find(model)->state == ModelState::kDeleted;
  }

  // The hypothetical requirement, about a composite state that may list its variables in another order.
  Model WithState(const Hypothesis& hypothesis, const CompositeStateRecord& record) const {
    const Canonical own = kb_.CanonicalOf(hypothesis.state);
    const std::vector<int> own_arguments = ArgumentVariables(hypothesis.state);
    std::map<int, Term> term_of;  // variable of the record -> the requirement's term
    for (std::size_t i = 0; i < own.variables.size() && i < record.canonical.variables.size(); ++i) {
      const auto it = std::find(own_arguments.begin(), own_arguments.end(), own.variables[i]);
      if (it == own_arguments.end()) continue;
      term_of.emplace(record.canonical.variables[i],
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

  AnalogyCompared Describe(const Candidate& candidate, AnalogyVerdict verdict) const {
    const Comparison& comparison = candidate.comparison;
    AnalogyCompared event;
    event.goal = candidate.goal;
    event.requirement = comparison.requirement;
    event.source = comparison.source;
    event.causal_model = comparison.causal_model;
    event.bindings = Closed(InstancePayload(kb_.Find(comparison.source)->state, comparison.bindings));
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

  std::vector<EventId> CausesOf(const Candidate& candidate) const {
    std::vector<EventId> causes{candidate.goal_event, kb_.Find(candidate.comparison.requirement)->event,
                                kb_.Find(candidate.comparison.source)->event};
    for (const ComparedComponent& component : candidate.comparison.components) {
      for (const SituationFact& fact : situation_.facts()) {
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

  void ReportRejected() {
    for (const Candidate& candidate : candidates_) {
      if (!candidate.comparison.rejection) continue;
      journal_.Write(task_.now, Describe(candidate, *candidate.comparison.rejection), CausesOf(candidate));
    }
  }

  void ReportLeftOver() {
    for (const Candidate& candidate : candidates_) {
      if (candidate.comparison.rejection || candidate.accepted) continue;
      const bool no_plan = hypothesise_ && !candidate.in_a_plan;
      journal_.Write(task_.now, Describe(candidate, no_plan ? AnalogyVerdict::kNoPlan : AnalogyVerdict::kNotRequired),
                     CausesOf(candidate));
    }
  }

  // Makes the plan's hypotheses knowledge, nearest to the goal first (paper, figure 1 right: M2* before M1*). Returns
  // the events that created them.
  std::vector<EventId> Hypothesise(Plan& plan) {
    std::vector<EventId> created;
    for (auto step = plan.steps.rbegin(); step != plan.steps.rend(); ++step) {
      if (step->hypothesis < 0) continue;
      Candidate& candidate = candidates_[static_cast<std::size_t>(step->hypothesis)];
      if (!candidate.accepted) {
        candidate.accepted = true;
        AnalogyCompared compared = Describe(candidate, AnalogyVerdict::kAccepted);
        CompositeState state = candidate.hypothesis.state;
        const CompositeStateId known_state = kb_.FindState(kb_.CanonicalOf(state).hash);
        state.id = known_state.valid() ? known_state : journal_.NewId<CompositeStateId>();
        compared.result_state = state.id;
        Model requirement = candidate.hypothesis.requirement;
        ModelId known_requirement;
        if (known_state.valid()) {
          requirement = WithState(candidate.hypothesis, *kb_.Find(known_state));
          known_requirement = kb_.FindModel(kb_.CanonicalOf(requirement).hash);
        } else {
          requirement.lhs.payload = Term::Struct(
              "icst", {Term::Reference(state.id), requirement.lhs.payload[1], requirement.lhs.payload[2]});
        }
        requirement.id = known_requirement.valid() ? known_requirement : journal_.NewId<ModelId>();
        compared.result_requirement = requirement.id;
        const EventId comparison = journal_.Write(task_.now, compared, CausesOf(candidate));
        if (!known_state.valid()) {
          journal_.Write(task_.now, CompositeStateCreated{state, Origin::kAnalogy, candidate.comparison.source},
                         {comparison, kb_.Find(candidate.comparison.source)->event});
        }
        if (!known_requirement.valid()) {
          const EventId event = journal_.Write(
              task_.now,
              ModelCreated{requirement, Evidence{candidate.comparison.confidence, 1}, false, Origin::kAnalogy,
                           candidate.comparison.requirement},
              {comparison, kb_.Find(state.id)->event, kb_.Find(candidate.comparison.causal_model)->event});
          created.push_back(event);
        }
        offer_(state.id, requirement.id);
        result_of_[step->hypothesis] = requirement.id;
      }
      step->requirement = result_of_[step->hypothesis];
    }
    return created;
  }

  // Tries a plan in the head by the same forward chaining that runs for real.
  Tried Simulate(const Plan& plan, const std::vector<EventId>& hypothesised) {
    Tried tried;
    tried.simulation = journal_.NewId<SimulationId>();
    tried.first_command = plan.steps.front().command;
    tried.score = plan.score;
    std::vector<PlanStep> steps;
    for (const Step& step : plan.steps) steps.push_back({step.command, step.causal_model, step.requirement});
    std::vector<EventId> causes{root_.event};
    causes.insert(causes.end(), hypothesised.begin(), hypothesised.end());
    EventId last = journal_.Write(
        task_.now, SimulationStarted{tried.simulation, root_.id, std::move(steps), plan.score}, causes, tried.simulation);

    Situation imagined = situation_;
    SimulationOutcome outcome = SimulationOutcome::kNotReached;
    std::vector<EventId> predicted{last};
    for (const Step& step : plan.steps) {
      std::vector<SituationFact> effects = PredictInHead(step, imagined, tried.simulation, predicted.back());
      const bool enabled = std::any_of(effects.begin(), effects.end(), [&](const SituationFact& effect) {
        return effect.id.value == step.causal_model.value;
      });
      if (!enabled) {
        outcome = SimulationOutcome::kNotEnabled;
        break;
      }
      for (SituationFact& effect : effects) {
        effect.id = {};
        predicted.push_back(effect.event);
      }
      imagined = imagined.Successor(effects, period_);
      AddInstances(kb_, &imagined);
      for (const auto& [id, record] : kb_.models()) {
        for (Requirement& requirement : RequirementsFrom(record, imagined)) imagined.Add(std::move(requirement));
      }
    }
    if (outcome != SimulationOutcome::kNotEnabled &&
        imagined.FindMatch(Closed(task_.goal), task_.positive, {}) != Situation::npos) {
      outcome = SimulationOutcome::kReached;
    }
    tried.reached = outcome == SimulationOutcome::kReached;
    tried.event = journal_.Write(task_.now, SimulationEnded{tried.simulation, outcome}, predicted, tried.simulation);
    return tried;
  }

  // What all models predict of one imagined command. The effect's id carries the model that predicted it.
  std::vector<SituationFact> PredictInHead(const Step& step, const Situation& imagined, SimulationId simulation,
                                           EventId before) {
    const Fact command{true, step.command,
                       {imagined.interval().after + parameters_.command_offset, imagined.interval().before}, 1};
    std::vector<SituationFact> effects;
    for (const auto& [id, record] : kb_.models()) {
      if (!IsCommand(record.model.lhs.payload)) continue;
      for (const Firing& firing : Fire(record, kb_, command, imagined)) {
        if (firing.vetoed) continue;
        std::vector<EventId> causes{before, record.event};
        std::vector<ModelId> requirements;
        for (const std::size_t i : firing.requirements) {
          const Requirement& requirement = imagined.requirements()[i];
          requirements.push_back(requirement.requirement);
          causes.push_back(requirement.event.valid() ? requirement.event : kb_.Find(requirement.requirement)->event);
        }
        SituationFact effect;
        effect.fact = firing.target;
        effect.id = FactId{id.value};
        effect.event = journal_.Write(
            task_.now, PredictionMade{journal_.NewId<PredictionId>(), id, requirements, {}, firing.target}, causes,
            simulation);
        effects.push_back(std::move(effect));
      }
    }
    return effects;
  }

  const PlanningTask& task_;
  const ReasonerParameters& parameters_;
  Duration period_;
  const Situation& situation_;
  const OfferKnowledge& offer_;
  Journal& journal_;
  const KnowledgeBase& kb_;

  GoalNode root_;
  int nodes_ = 0;
  bool hypothesise_ = false;
  std::vector<Term> stack_;  // goals being pursued, outermost first
  std::map<Term, std::vector<const ModelRecord*>> by_attribute_;
  std::map<std::string, GoalNode> goals_;
  std::set<std::string> skipped_;
  std::vector<Candidate> candidates_;
  std::map<std::string, std::size_t> candidate_of_;
  std::map<int, ModelId> result_of_;  // candidate -> the requirement it became
};

}  // namespace

std::optional<Decision> PlanFor(const PlanningTask& task, const ReasonerParameters& parameters, Duration period,
                                const Situation& situation, const OfferKnowledge& offer, Journal* journal) {
  return Planner(task, parameters, period, situation, offer, journal).Run();
}

}  // namespace aerascope
