#include "engine/reason/chaining.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <tuple>
#include <utility>

namespace aerascope {
namespace {

// Depth-first join over the facts of the frame, no partial matches kept (TREAT, semantics 11.2); at each step
// the open component with the fewest candidates is taken.
class Joiner {
 public:
  Joiner(const CompositeState& state, const Situation& situation, const JoinLimits& limits)
      : state_(state), situation_(situation), limits_(limits) {}

  std::vector<JointMatch> Join(const Bindings& bindings, JoinWork* work) {
    so_far_.bindings = bindings;
    so_far_.facts.assign(state_.components.size(), Situation::npos);
    so_far_.interval = kAlways;
    Extend(state_.components.size());
    if (work) {
      work->steps += static_cast<std::int64_t>(steps_);
      work->cut += cut_ ? 1 : 0;
    }
    // The order of joining depends on selectivity; the answer is sorted by what was found.
    std::sort(matches_.begin(), matches_.end(),
              [](const JointMatch& a, const JointMatch& b) { return a.facts < b.facts; });
    return std::move(matches_);
  }

 private:
  void Extend(std::size_t open) {
    if (open == 0) return Finish();
    std::size_t best = 0;
    Situation::Positions candidates;
    for (std::size_t i = 0; i < so_far_.facts.size(); ++i) {
      if (so_far_.facts[i] != Situation::npos) continue;
      const auto found = situation_.Candidates(state_.components[i].payload, so_far_.bindings);
      if (found.empty()) return;
      if (!candidates.empty() && found.size() >= candidates.size()) continue;
      best = i;
      candidates = found;
    }
    const FactPattern& component = state_.components[best];
    const TimeInterval interval = so_far_.interval;
    const double confidence = so_far_.confidence;
    const Bindings::Mark mark = so_far_.bindings.Save();
    for (const std::size_t candidate : candidates) {
      if (matches_.size() >= limits_.matches || steps_ >= limits_.steps) {
        cut_ = true;
        return;
      }
      ++steps_;
      const Fact& fact = situation_[candidate].fact;
      if (fact.positive != component.positive) continue;
      if (std::find(so_far_.facts.begin(), so_far_.facts.end(), candidate) != so_far_.facts.end()) continue;
      const auto common = Intersection(interval, fact.interval);
      if (common && Match(component.payload, fact.payload, so_far_.bindings)) {
        so_far_.interval = *common;
        so_far_.confidence = std::min(confidence, fact.confidence);
        so_far_.facts[best] = candidate;
        Extend(open - 1);
        so_far_.facts[best] = Situation::npos;
        so_far_.interval = interval;
        so_far_.confidence = confidence;
      }
      so_far_.bindings.Restore(mark);
    }
  }

  void Finish() {
    JointMatch done = so_far_;
    const FactPattern& first = state_.components.front();
    if (!Match(first.after, Term::Instant(done.interval.after), done.bindings) ||
        !Match(first.before, Term::Instant(done.interval.before), done.bindings)) {
      return;
    }
    if (RunGuards(state_.guards, done.bindings)) matches_.push_back(std::move(done));
  }

  const CompositeState& state_;
  const Situation& situation_;
  const JoinLimits& limits_;
  JointMatch so_far_;
  std::size_t steps_ = 0;
  bool cut_ = false;
  std::vector<JointMatch> matches_;
};

void ReportMet(const CompositeState& state, const Situation& situation, const OnComponentMet& on_met) {
  std::vector<ComponentMet> met;
  for (std::size_t i = 0; i < state.components.size(); ++i) {
    const FactPattern& component = state.components[i];
    const std::size_t fact = situation.FindMatch(component.payload, component.positive, {});
    if (fact != Situation::npos) met.push_back({state.id, i, fact, 0, state.components.size()});
  }
  for (ComponentMet& component : met) {
    component.met = met.size();
    on_met(component);
  }
}

bool ContainsCommand(const Situation& situation, const JointMatch& match) {
  return std::any_of(match.facts.begin(), match.facts.end(),
                     [&](std::size_t i) { return IsCommand(situation[i].fact.payload); });
}

}  // namespace

std::vector<JointMatch> JointMatches(const CompositeState& state, const Situation& situation,
                                     const Bindings& bindings, const JoinLimits& limits, JoinWork* work) {
  return Joiner(state, situation, limits).Join(bindings, work);
}

std::vector<std::size_t> AddInstances(const CompositeState& state, Situation* situation, JoinWork* work) {
  std::vector<std::size_t> added;
  for (const JointMatch& match : JointMatches(state, *situation, {}, {}, work)) {
    if (ContainsCommand(*situation, match)) continue;
    Term payload = InstancePayload(state, match.bindings);
    if (!payload.ground() || situation->FindMatch(payload, true, {}) != Situation::npos) continue;
    SituationFact instance;
    instance.fact = {true, std::move(payload), match.interval, match.confidence};
    instance.components = match.facts;
    added.push_back(situation->Add(std::move(instance)));
  }
  return added;
}

std::vector<std::size_t> AddInstances(const KnowledgeBase& knowledge, Situation* situation, JoinWork* work,
                                      const OnComponentMet& on_met) {
  // Knowledge refers only to knowledge with a smaller number, so ascending numbers find nested instances
  // first.
  std::set<CompositeStateId> ready;
  const auto offer = [&](std::size_t fact) {
    knowledge.ForEachStateFor((*situation)[fact].fact.payload,
                              [&](CompositeStateId state) { ready.insert(state); });
  };
  for (std::size_t i = 0; i < situation->facts().size(); ++i) offer(i);
  std::vector<std::size_t> added;
  for (auto next = ready.begin(); next != ready.end(); ++next) {
    const CompositeState& state = knowledge.Find(*next)->state;
    if (on_met) ReportMet(state, *situation, on_met);
    for (const std::size_t instance : AddInstances(state, situation, work)) {
      added.push_back(instance);
      offer(instance);
    }
  }
  return added;
}

namespace {

// How many requirement models stand between this one and the model that it is about in the end. A model
// refers only to models with smaller numbers.
int LevelOf(const Model& requirement, const KnowledgeBase& knowledge) {
  int level = 0;
  const ModelRecord* target = knowledge.Find(TargetModel(requirement));
  for (; target && IsRequirement(target->model); ++level) target = knowledge.Find(TargetModel(target->model));
  return level;
}

}  // namespace

std::vector<ModelId> RequirementModelsFor(const KnowledgeBase& knowledge, const Situation& situation) {
  std::set<std::tuple<int, bool, ModelId>> found;  // those about requirement models first, weak ones last
  for (const SituationFact& fact : situation.facts()) {
    for (const ModelId id : knowledge.ModelsByLhs(fact.fact.payload)) {
      const Model& model = knowledge.Find(id)->model;
      if (!IsRequirement(model)) continue;
      found.emplace(-LevelOf(model, knowledge), KindOf(model) == ModelKind::kWeakRequirement, id);
    }
  }
  std::vector<ModelId> models;
  models.reserve(found.size());
  for (const auto& [level, weak, id] : found) models.push_back(id);
  return models;
}

std::vector<Requirement> RequirementsFrom(const ModelRecord& requirement, const Situation& situation) {
  std::vector<Requirement> found;
  const Model& model = requirement.model;
  if (requirement.state == ModelState::kDeleted || !IsRequirement(model)) return found;
  // What is phased out speaks without weight: it changes nothing, but may be found right again.
  const double rate = requirement.state == ModelState::kActive ? requirement.evidence.rate() : 0;
  for (const std::size_t candidate : situation.Candidates(model.lhs.payload, {})) {
    const SituationFact& from = situation[candidate];
    Bindings bindings;
    // A property holds always; here it counts for this frame.
    Fact in_frame = from.fact;
    if (auto common = Intersection(in_frame.interval, situation.interval())) in_frame.interval = *common;
    if (!MatchFact(model.lhs, in_frame, bindings) || !RunGuards(model.forward, bindings)) continue;
    Requirement entry;
    entry.requirement = model.id;
    entry.target = TargetModel(model);
    entry.from = candidate;
    // Exposed values the left side does not bind stay open: they match anything (semantics 1.6).
    const Term after = Substitute(model.rhs.after, bindings);
    const Term before = Substitute(model.rhs.before, bindings);
    if (!after.is(TermKind::kTime) || !before.is(TermKind::kTime)) continue;
    entry.imdl = {model.rhs.positive,
                  Closed(Substitute(model.rhs.payload, bindings)),
                  {after.time(), before.time()},
                  from.fact.confidence * rate};
    found.push_back(std::move(entry));
  }
  return found;
}

namespace {

// A way to fire, as a positive requirement (or none: npos) gives it.
struct Allowed {
  Bindings bindings;
  std::size_t requirement;
  double confidence;  // 0: of a requirement model that is phased out, or not allowed to speak
};

// What the requirement models on a model say about the instance that `from_input` begins.
struct Words {
  bool has_weak = false;  // there is one that could allow it
  std::vector<Allowed> allowed;
  std::vector<std::size_t> negative;
};

Words WordsOn(const Model& model, const KnowledgeBase& knowledge, const Situation& situation,
              const Bindings& from_input) {
  Words words;
  for (const ModelId id : knowledge.RequirementsOf(model.id)) {
    const ModelRecord* requirement = knowledge.Find(id);
    words.has_weak = words.has_weak || (requirement && requirement->model.rhs.positive);
  }
  for (const std::size_t i : situation.RequirementsOn(model.id)) {
    const Requirement& requirement = situation.requirements()[i];
    if (!requirement.imdl.interval.Overlaps(situation.interval())) continue;
    Bindings bindings = from_input;
    if (!BindInstance(model, requirement.imdl.payload, bindings)) continue;
    if (requirement.imdl.positive) {
      words.allowed.push_back({std::move(bindings), i, requirement.imdl.confidence});
    } else {
      words.negative.push_back(i);
    }
  }
  return words;
}

ChainingDecision Decide(const ModelRecord& record, const Situation& situation, const Words& words) {
  const auto& [has_weak, allowed, negative] = words;
  ChainingDecision decision;
  const Allowed* surest = nullptr;
  for (const Allowed& way : allowed) {
    decision.considered.push_back(way.requirement);
    if (!surest || way.confidence > surest->confidence) surest = &way;
  }
  std::size_t veto = Situation::npos;
  double veto_confidence = 0;
  for (const std::size_t i : negative) {
    decision.considered.push_back(i);
    const double confidence = situation.requirements()[i].imdl.confidence;
    if (confidence <= veto_confidence) continue;
    veto = i;
    veto_confidence = confidence;
  }
  const bool vetoed = veto != Situation::npos;
  if (record.state == ModelState::kPhasedOut) {
    decision.status = ChainingStatus::kPhasedOut;
  } else if (!surest || surest->confidence == 0) {
    decision.status = has_weak ? ChainingStatus::kWeakDisabled
                      : vetoed ? ChainingStatus::kStrongDisabled
                               : ChainingStatus::kNoRequirement;
    if (!has_weak) decision.winner = veto;
  } else if (vetoed && surest->confidence <= veto_confidence) {
    decision.status = ChainingStatus::kVetoed;  // a tie goes to the veto (semantics 3.3)
    decision.winner = veto;
  } else {
    decision.status = vetoed ? ChainingStatus::kEnabledAgainstVeto : ChainingStatus::kEnabled;
    decision.winner = surest->requirement;
  }
  return decision;
}

}  // namespace

std::vector<Firing> Fire(const ModelRecord& record, const KnowledgeBase& knowledge, const Fact& input,
                         const Situation& situation, std::optional<ChainingDecision>* decision) {
  std::vector<Firing> firings;
  const Model& model = record.model;
  const ModelKind kind = KindOf(model);
  if (record.state == ModelState::kDeleted || (kind != ModelKind::kCausal && kind != ModelKind::kReuse))
    return firings;
  Bindings from_input;
  if (!MatchFact(model.lhs, input, from_input)) return firings;

  Words words = WordsOn(model, knowledge, situation, from_input);
  if (decision) *decision = Decide(record, situation, words);
  auto& [has_weak, allowed, negative] = words;
  // Without a requirement's word a model fires if it needs none, and else predicts silently; it can do
  // neither if it lacks values that only a requirement model gives.
  if (allowed.empty() && model.template_arguments.empty()) {
    allowed.push_back({from_input, Situation::npos, has_weak ? 0.0 : 1.0});
  }

  for (const Allowed& way : allowed) {
    Firing firing;
    firing.model = model.id;
    firing.bindings = way.bindings;
    if (!RunGuards(model.forward, firing.bindings)) continue;
    auto target = Instantiate(model.rhs, firing.bindings, input.confidence * record.evidence.rate());
    if (!target) continue;
    double veto = 0;
    for (const std::size_t i : negative) {
      const Fact& warning = situation.requirements()[i].imdl;
      Bindings same = firing.bindings;
      if (!BindInstance(model, warning.payload, same)) continue;
      firing.vetoes.push_back(i);
      veto = std::max(veto, warning.confidence);
    }
    // A tie goes to the veto, and where only vetoes speak they win (semantics 3.3). A phased-out model
    // predicts silently until it has recovered.
    const bool alone = way.requirement == Situation::npos;
    firing.vetoed = (veto > 0 && (alone || way.confidence <= veto)) || way.confidence == 0 ||
                    record.state == ModelState::kPhasedOut;
    if (firing.vetoed) target->confidence = 0;
    firing.target = std::move(*target);
    firing.instance = InstancePayload(model, firing.bindings);
    const auto same = std::find_if(firings.begin(), firings.end(), [&](const Firing& other) {
      return other.target.payload == firing.target.payload && other.target.interval == firing.target.interval;
    });
    Firing* firing_in_list = nullptr;
    if (same != firings.end()) {
      firing_in_list = &*same;
      // One requirement that gets through is enough.
      if (same->vetoed && !firing.vetoed) {
        same->vetoed = false;
        same->target.confidence = firing.target.confidence;
      }
      for (const std::size_t i : firing.vetoes) {
        if (std::find(same->vetoes.begin(), same->vetoes.end(), i) == same->vetoes.end())
          same->vetoes.push_back(i);
      }
    } else {
      firings.push_back(std::move(firing));
      firing_in_list = &firings.back();
    }
    if (way.requirement != Situation::npos) firing_in_list->requirements.push_back(way.requirement);
  }
  return firings;
}

std::vector<Requirement> StatementsOf(const ModelRecord& requirement, const KnowledgeBase& knowledge,
                                      const Situation& situation, std::vector<ChainingDecision>* decisions) {
  std::vector<Requirement> found = RequirementsFrom(requirement, situation);
  const Model& model = requirement.model;
  if (knowledge.RequirementsOf(model.id).empty()) return found;
  for (Requirement& said : found) {
    Bindings bindings;
    Fact from = situation[said.from].fact;
    if (auto common = Intersection(from.interval, situation.interval())) from.interval = *common;
    if (!MatchFact(model.lhs, from, bindings) || !RunGuards(model.forward, bindings)) continue;
    ChainingDecision decision =
        Decide(requirement, situation, WordsOn(model, knowledge, situation, bindings));
    said.above = decision.considered;
    switch (decision.status) {
      case ChainingStatus::kNoRequirement:
      case ChainingStatus::kEnabled:
      case ChainingStatus::kEnabledAgainstVeto:
      case ChainingStatus::kPhasedOut:  // speaks without weight anyway
      case ChainingStatus::kTooDeep:
        break;
      case ChainingStatus::kWeakDisabled:
      case ChainingStatus::kStrongDisabled:
      case ChainingStatus::kVetoed:
        said.allowed = false;
        said.imdl.confidence = 0;
        break;
    }
    if (decisions) decisions->push_back(std::move(decision));
  }
  return found;
}

namespace {

// The statements that a firing rests on and those above them, each once, nearest first.
std::vector<std::size_t> WordsAbout(const Firing& firing, const Situation& situation) {
  std::vector<std::size_t> words;
  const auto add = [&](const std::vector<std::size_t>& more) {
    for (const std::size_t i : more) {
      if (std::find(words.begin(), words.end(), i) == words.end()) words.push_back(i);
    }
  };
  add(firing.requirements);
  add(firing.vetoes);
  for (std::size_t next = 0; next < words.size(); ++next) add(situation.requirements()[words[next]].above);
  return words;
}

}  // namespace

std::vector<ModelId> SpokenFor(const Firing& firing, const Situation& situation) {
  std::vector<ModelId> models;
  for (const std::size_t i : WordsAbout(firing, situation)) {
    const ModelId id = situation.requirements()[i].requirement;
    if (std::find(models.begin(), models.end(), id) == models.end()) models.push_back(id);
  }
  return models;
}

std::vector<ModelId> SilencedIn(const Firing& firing, const Situation& situation) {
  std::set<ModelId> allowed;
  std::set<ModelId> silenced;
  for (const std::size_t i : WordsAbout(firing, situation)) {
    const Requirement& said = situation.requirements()[i];
    (said.allowed ? allowed : silenced).insert(said.requirement);
  }
  std::vector<ModelId> models;
  std::set_difference(silenced.begin(), silenced.end(), allowed.begin(), allowed.end(),
                      std::back_inserter(models));
  return models;
}

}  // namespace aerascope
