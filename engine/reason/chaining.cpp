#include "engine/reason/chaining.h"

#include <algorithm>
#include <set>

namespace aerascope {
namespace {

// Depth-first join; at each step the open component with the fewest candidates is taken.
class Joiner {
 public:
  Joiner(const CompositeState& state, const Situation& situation, std::size_t limit)
      : state_(state), situation_(situation), limit_(limit) {}

  std::vector<JointMatch> Join(const Bindings& bindings) {
    JointMatch start;
    start.bindings = bindings;
    start.facts.assign(state_.components.size(), Situation::npos);
    start.interval = kAlways;
    Extend(start, state_.components.size());
    // The order of joining depends on selectivity; the answer is sorted by what was found.
    std::sort(matches_.begin(), matches_.end(),
              [](const JointMatch& a, const JointMatch& b) { return a.facts < b.facts; });
    return std::move(matches_);
  }

 private:
  void Extend(const JointMatch& match, std::size_t open) {
    if (matches_.size() >= limit_) return;
    if (open == 0) return Finish(match);
    std::size_t best = 0;
    std::size_t best_count = static_cast<std::size_t>(-1);
    for (std::size_t i = 0; i < match.facts.size(); ++i) {
      if (match.facts[i] != Situation::npos) continue;
      const std::size_t count = situation_.Candidates(state_.components[i].payload, match.bindings).size();
      if (count < best_count) {
        best = i;
        best_count = count;
      }
    }
    const FactPattern& component = state_.components[best];
    for (const std::size_t candidate : situation_.Candidates(component.payload, match.bindings)) {
      const Fact& fact = situation_[candidate].fact;
      if (fact.positive != component.positive) continue;
      if (std::find(match.facts.begin(), match.facts.end(), candidate) != match.facts.end()) continue;
      JointMatch next = match;
      if (!Match(component.payload, fact.payload, next.bindings)) continue;
      const auto common = Intersection(match.interval, fact.interval);
      if (!common) continue;
      next.interval = *common;
      next.confidence = std::min(next.confidence, fact.confidence);
      next.facts[best] = candidate;
      Extend(next, open - 1);
    }
  }

  void Finish(const JointMatch& match) {
    JointMatch done = match;
    const FactPattern& first = state_.components.front();
    if (!Match(first.after, Term::Instant(done.interval.after), done.bindings) ||
        !Match(first.before, Term::Instant(done.interval.before), done.bindings)) {
      return;
    }
    if (RunGuards(state_.guards, done.bindings)) matches_.push_back(std::move(done));
  }

  const CompositeState& state_;
  const Situation& situation_;
  std::size_t limit_;
  std::vector<JointMatch> matches_;
};

bool ContainsCommand(const Situation& situation, const JointMatch& match) {
  return std::any_of(match.facts.begin(), match.facts.end(),
                     [&](std::size_t i) { return IsCommand(situation[i].fact.payload); });
}

}  // namespace

std::vector<JointMatch> JointMatches(const CompositeState& state, const Situation& situation, const Bindings& bindings,
                                     std::size_t limit) {
  return Joiner(state, situation, limit).Join(bindings);
}

std::vector<std::size_t> AddInstances(const CompositeState& state, Situation* situation) {
  std::vector<std::size_t> added;
  for (const JointMatch& match : JointMatches(state, *situation, {})) {
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

std::vector<std::size_t> AddInstances(const KnowledgeBase& knowledge, Situation* situation) {
  // Knowledge refers only to knowledge with a smaller number, so ascending numbers find nested instances first.
  std::vector<std::size_t> added;
  for (const auto& [id, record] : knowledge.composite_states()) {
    const std::vector<std::size_t> more = AddInstances(record.state, situation);
    added.insert(added.end(), more.begin(), more.end());
  }
  return added;
}

std::vector<Requirement> RequirementsFrom(const ModelRecord& requirement, const Situation& situation) {
  std::vector<Requirement> found;
  const Model& model = requirement.model;
  if (requirement.state != ModelState::kActive || !IsRequirement(model)) return found;
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
                  from.fact.confidence * requirement.evidence.rate()};
    found.push_back(std::move(entry));
  }
  return found;
}

std::vector<Firing> Fire(const ModelRecord& record, const KnowledgeBase& knowledge, const Fact& input,
                         const Situation& situation) {
  std::vector<Firing> firings;
  const Model& model = record.model;
  const ModelKind kind = KindOf(model);
  if (record.state == ModelState::kDeleted || (kind != ModelKind::kCausal && kind != ModelKind::kReuse)) return firings;
  Bindings from_input;
  if (!MatchFact(model.lhs, input, from_input)) return firings;

  bool has_weak = false;
  for (const ModelId id : knowledge.RequirementsOf(model.id)) {
    const ModelRecord* requirement = knowledge.Find(id);
    has_weak = has_weak || (requirement && requirement->model.rhs.positive && requirement->state == ModelState::kActive);
  }
  struct Allowed {
    Bindings bindings;
    std::size_t requirement;
    double confidence;
  };
  std::vector<Allowed> allowed;
  double veto = 0;
  for (std::size_t i = 0; i < situation.requirements().size(); ++i) {
    const Requirement& requirement = situation.requirements()[i];
    if (requirement.target != model.id) continue;
    Bindings bindings = from_input;
    if (!BindInstance(model, requirement.imdl.payload, bindings)) continue;
    if (requirement.imdl.positive) {
      allowed.push_back({std::move(bindings), i, requirement.imdl.confidence});
    } else {
      veto = std::max(veto, requirement.imdl.confidence);
    }
  }
  if (!has_weak) {
    if (!model.template_arguments.empty()) return firings;
    allowed.push_back({from_input, Situation::npos, 1});
  }

  for (const Allowed& way : allowed) {
    Firing firing;
    firing.model = model.id;
    firing.bindings = way.bindings;
    if (!RunGuards(model.forward, firing.bindings)) continue;
    auto target = Instantiate(model.rhs, firing.bindings, input.confidence * record.evidence.rate());
    if (!target) continue;
    // A tie goes to the veto (semantics 3.3). A phased-out model predicts silently until it has recovered.
    firing.vetoed = (veto > 0 && way.confidence <= veto) || record.state == ModelState::kPhasedOut;
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
    } else {
      firings.push_back(std::move(firing));
      firing_in_list = &firings.back();
    }
    if (way.requirement != Situation::npos) firing_in_list->requirements.push_back(way.requirement);
  }
  return firings;
}

}  // namespace aerascope
