#include "engine/reason/expectation.h"

#include <algorithm>

namespace aerascope {
namespace {

// Predictions that rest on others, open at a time. Where models branch, a chain grows in breadth as well.
constexpr std::size_t kMaxExpectations = 1000;

void Join(const std::vector<PredictionId>& more, std::vector<PredictionId>* all) {
  for (const PredictionId id : more) {
    if (std::find(all->begin(), all->end(), id) == all->end()) all->push_back(id);
  }
}

bool FiresOnFacts(const Model& model) {
  const ModelKind kind = KindOf(model);
  return kind == ModelKind::kCausal || kind == ModelKind::kReuse;
}

std::int64_t FramesAhead(Time time, Time frame, Duration period) {
  return time <= frame ? 0 : (time - frame).us / period.us;
}

}  // namespace

// What is expected to hold in one frame, and on which predictions each fact there rests.
struct Expectations::ExpectedFrame {
  Situation situation;
  std::map<std::size_t, std::vector<PredictionId>> grounds;  // by position; none: it does not rest on any

  std::vector<PredictionId> GroundsOf(std::size_t position) const {
    const auto it = grounds.find(position);
    return it == grounds.end() ? std::vector<PredictionId>{} : it->second;
  }
};

// ------------------------------------------------------------------------------------------------ giving up

void Expectations::Invalidate(const PredictionInvalidated& end, EventId because, Conclusions* concluded,
                              Time now) {
  const EventId made = journal_.knowledge().predictions().at(end.prediction).event;
  const EventId event = journal_.Write(now, end, {because, made});
  (*concluded)[end.prediction] = {event, false, end.by, end.surer};
  links_.erase(end.prediction);
}

void Expectations::Outweigh(const Outweighed& one, Conclusions* concluded, Time now) {
  const auto& open = journal_.knowledge().predictions();
  outweighed_.emplace(one.surer, open.at(one.prediction));
  Invalidate({one.prediction, {}, InvalidationReason::kOutweighed, one.surer}, open.at(one.surer).event,
             concluded, now);
}

void Expectations::GiveUp(Conclusions* concluded, Time now) {
  std::erase_if(reported_, [&](const auto& entry) {
    return !journal_.knowledge().predictions().contains(std::get<1>(entry));
  });
  // A prediction is older than what rests on it, unless it took another's place; then it rests on facts.
  for (auto it = links_.begin(); it != links_.end();) {
    const auto [id, link] = *it++;
    for (const PredictionId ground : link.grounds) {
      const auto end = concluded->find(ground);
      if (end == concluded->end() || end->second.came_true) continue;
      const Conclusion why = end->second;
      Invalidate({id, why.shown_by,
                  why.surer.valid() ? InvalidationReason::kPremiseOutweighed
                                    : InvalidationReason::kPremiseContradicted,
                  why.surer},
                 why.event, concluded, now);
      break;
    }
  }
}

std::vector<Expectations::Renewal> Expectations::Renew(Conclusions* concluded, Time now) {
  std::vector<Renewal> renewals;
  const auto& open = journal_.knowledge().predictions();
  std::map<PredictionId, InvalidationReason> given_up;
  for (auto it = links_.begin(); it != links_.end();) {
    const PredictionId id = it->first;
    Link& link = it->second;
    ++it;
    std::optional<InvalidationReason> with_its_ground;
    for (const PredictionId ground : link.grounds) {
      if (const auto found = given_up.find(ground); found != given_up.end()) with_its_ground = found->second;
      const auto end = concluded->find(ground);
      if (end == concluded->end()) continue;
      link.seen = end->second.event;
      link.shown_by = end->second.shown_by;
    }
    if (with_its_ground) {
      given_up[id] = *with_its_ground;
      Invalidate({id, link.shown_by, *with_its_ground}, link.seen, concluded, now);
      continue;
    }
    std::erase_if(link.grounds, [&](PredictionId ground) { return concluded->contains(ground); });
    const PredictionRecord& record = open.at(id);
    if (!link.grounds.empty()) {
      if (record.target.interval.before + kTimeTolerance <= now)
        Invalidate({id, {}, InvalidationReason::kOverdue}, record.event, concluded, now);
      continue;
    }
    const auto anew = std::find_if(open.begin(), open.end(), [&](const auto& entry) {
      const PredictionRecord& other = entry.second;
      return other.grounds.empty() && other.model == record.model && other.target.confidence > 0 &&
             other.target.positive == record.target.positive &&
             SameValue(other.target.payload, record.target.payload) &&
             other.target.interval.Overlaps(record.target.interval);
    });
    const FactId by = link.shown_by;
    if (anew == open.end()) {
      given_up[id] = InvalidationReason::kNotRenewed;
      Invalidate({id, by, InvalidationReason::kNotRenewed}, link.seen, concluded, now);
      continue;
    }
    const PredictionRecord renewed = anew->second;
    const bool same = renewed.target.interval == record.target.interval &&
                      renewed.target.confidence == record.target.confidence;
    if (same) {
      for (auto& [other, rests] : links_)
        std::replace(rests.grounds.begin(), rests.grounds.end(), id, renewed.id);
    } else {
      given_up[id] = InvalidationReason::kRenewed;
    }
    Invalidate({id, by, InvalidationReason::kRenewed}, renewed.event, concluded, now);
    renewals.push_back({id, renewed.id});
  }
  return renewals;
}

// --------------------------------------------------------------------------------------------- chaining on

void Expectations::Extend(const Situation& present, const std::vector<Requirement>& said, Time now) {
  const KnowledgeBase& knowledge = journal_.knowledge();
  std::erase_if(outweighed_,
                [&](const auto& entry) { return !knowledge.predictions().contains(entry.first); });
  for (auto it = knowledge.models().upper_bound(last_seen_); it != knowledge.models().end(); ++it) {
    last_seen_ = it->first;
    if (FiresOnFacts(it->second.model) && IsIcst(it->second.model.lhs.payload)) on_states_.insert(it->first);
  }
  std::erase_if(on_states_, [&](ModelId id) { return knowledge.Find(id)->state == ModelState::kDeleted; });
  const Time frame = present.interval().after;
  // Frames in order; one may add expectations to itself and to later ones.
  std::int64_t next = 0;
  while (true) {
    std::optional<std::int64_t> ahead;
    for (const auto& [id, prediction] : knowledge.predictions()) {
      const Fact& target = prediction.target;
      const std::int64_t at = FramesAhead(target.interval.after, frame, period_);
      if (target.confidence <= 0 || at < next || (ahead && at >= *ahead)) continue;
      if (MayChain(target)) ahead = at;
    }
    if (!ahead) return;
    for (int round = 0; round <= parameters_.max_prediction_chain; ++round) {
      ExpectedFrame expected = Imagine(*ahead, present, said);
      if (!ExtendIn(&expected, now)) break;
    }
    next = *ahead + 1;
  }
}

// Could anything follow from it?
bool Expectations::MayChain(const Fact& expected) const {
  if (!on_states_.empty()) return true;
  const KnowledgeBase& knowledge = journal_.knowledge();
  const std::vector<ModelId> models = knowledge.ModelsByLhs(expected.payload);
  return std::any_of(models.begin(), models.end(),
                     [&](ModelId id) { return FiresOnFacts(knowledge.Find(id)->model); });
}

Expectations::ExpectedFrame Expectations::Imagine(std::int64_t frames_ahead, const Situation& present,
                                                  const std::vector<Requirement>& said) const {
  const TimeInterval interval{present.interval().after + period_ * frames_ahead,
                              present.interval().before + period_ * frames_ahead};
  ExpectedFrame frame{frames_ahead == 0 ? present : Situation(interval), {}};
  if (frames_ahead > 0) {
    for (const SituationFact& fact : present.facts()) {
      if (fact.permanent && fact.fact.interval.Overlaps(interval)) frame.situation.Add(fact);
    }
    for (const Requirement& requirement : said) {
      if (requirement.imdl.interval.Overlaps(interval)) frame.situation.Add(requirement);
    }
  }
  // Of equal expectations the surest, of equally sure ones the first.
  std::vector<const PredictionRecord*> predictions;
  for (const auto& [id, prediction] : journal_.knowledge().predictions()) {
    if (prediction.target.confidence > 0 && prediction.target.interval.Overlaps(interval))
      predictions.push_back(&prediction);
  }
  std::stable_sort(predictions.begin(), predictions.end(),
                   [](const auto* a, const auto* b) { return a->target.confidence > b->target.confidence; });
  for (const PredictionRecord* prediction : predictions) {
    const Fact& target = prediction->target;
    if (frame.situation.FindMatch(target.payload, target.positive, {}) != Situation::npos) continue;
    SituationFact expected;
    expected.fact = target;
    expected.event = prediction->event;
    frame.grounds[frame.situation.Add(std::move(expected))] = {prediction->id};
  }
  return frame;
}

// True if something new is expected.
bool Expectations::ExtendIn(ExpectedFrame* frame, Time now) {
  const KnowledgeBase& knowledge = journal_.knowledge();
  Situation& situation = frame->situation;
  for (const std::size_t position : AddInstances(knowledge, &situation)) {
    std::vector<PredictionId> grounds;
    for (const std::size_t component : situation[position].components)
      Join(frame->GroundsOf(component), &grounds);
    if (!grounds.empty()) frame->grounds[position] = std::move(grounds);
  }
  // What was said about facts that are there has been said.
  const bool present = std::any_of(situation.requirements().begin(), situation.requirements().end(),
                                   [](const Requirement& said) { return said.from != Situation::npos; });
  for (const ModelId id : RequirementModelsFor(knowledge, situation)) {
    for (Requirement& said : StatementsOf(*knowledge.Find(id), knowledge, situation)) {
      if (!present || frame->grounds.contains(said.from)) situation.Add(std::move(said));
    }
  }
  bool extended = false;
  const auto inputs = frame->grounds;
  for (const auto& [position, grounds] : inputs) {
    const Fact input = situation[position].fact;
    // It has its effects in the frame in which it begins.
    if (input.interval.after < situation.interval().after) continue;
    extended = FireOn(input, grounds, situation[position].event, frame, now, 0) || extended;
  }
  return extended;
}

bool Expectations::FireOn(const Fact& input, const std::vector<PredictionId>& grounds, EventId because,
                          ExpectedFrame* frame, Time now, int ridden) {
  const KnowledgeBase& knowledge = journal_.knowledge();
  bool extended = false;
  for (const ModelId id : knowledge.ModelsByLhs(input.payload)) {
    const ModelRecord& record = *knowledge.Find(id);
    std::optional<ChainingDecision> decision;
    const std::vector<Firing> firings = Fire(record, knowledge, input, frame->situation, &decision);
    if (!decision) continue;
    Report(id, *decision, grounds, because, *frame, now);
    for (const Firing& firing : firings) {
      const Fact& target = firing.target;
      if (firing.vetoed || target.confidence <= 0 || target.interval.before <= now || Predicted(id, target))
        continue;
      std::vector<PredictionId> all = grounds;
      std::vector<EventId> causes{because};
      for (const std::vector<std::size_t>* words : {&firing.requirements, &firing.vetoes}) {
        for (const std::size_t i : *words) {
          const Requirement& said = frame->situation.requirements()[i];
          if (words == &firing.requirements) Join(frame->GroundsOf(said.from), &all);
          causes.push_back(said.event.valid() ? said.event : knowledge.Find(said.requirement)->event);
        }
      }
      for (const PredictionId ground : all) causes.push_back(knowledge.predictions().at(ground).event);
      causes.push_back(record.event);
      std::map<PredictionId, int> depths;
      if (links_.size() >= kMaxExpectations || DepthOf(all, &depths) >= parameters_.max_prediction_chain) {
        ChainingDecision too_deep;
        too_deep.status = ChainingStatus::kTooDeep;
        Report(id, too_deep, grounds, because, *frame, now);
        continue;
      }
      const PredictionId prediction = journal_.NewId<PredictionId>();
      const EventId made = journal_.Write(
          now, PredictionMade{prediction, id, SpokenFor(firing, frame->situation), {}, target, all}, causes);
      links_[prediction] = {std::move(all), {}, {}};
      extended = true;
      // Its instance is expected as well; a model that rides on it rests on the same.
      if (!firing.instance.ground() || ridden >= parameters_.max_plan_depth) continue;
      const std::vector<PredictionId> rests = links_.at(prediction).grounds;
      FireOn({true, firing.instance, input.interval, target.confidence}, rests, made, frame, now, ridden + 1);
    }
  }
  return extended;
}

bool Expectations::Predicted(ModelId model, const Fact& target) const {
  const auto same = [&](const auto& entry) {
    const PredictionRecord& other = entry.second;
    return other.model == model && other.target.confidence > 0 && other.target.positive == target.positive &&
           other.target.interval == target.interval && SameValue(other.target.payload, target.payload);
  };
  const auto& open = journal_.knowledge().predictions();
  return std::any_of(open.begin(), open.end(), same) ||
         std::any_of(outweighed_.begin(), outweighed_.end(), same);
}

// How many predictions rest on one another below something with these grounds.
int Expectations::DepthOf(const std::vector<PredictionId>& grounds,
                          std::map<PredictionId, int>* known) const {
  int depth = 0;
  for (const PredictionId ground : grounds) {
    const auto link = links_.find(ground);
    if (link == links_.end()) continue;
    auto it = known->find(ground);
    if (it == known->end()) it = known->emplace(ground, 1 + DepthOf(link->second.grounds, known)).first;
    depth = std::max(depth, it->second);
  }
  return depth;
}

// Each decision about an expectation is said once.
void Expectations::Report(ModelId model, const ChainingDecision& decision,
                          const std::vector<PredictionId>& grounds, EventId because,
                          const ExpectedFrame& frame, Time now) {
  if (!journal_.Records<ChainingDecided>()) return;
  if (!reported_.insert({model, grounds.front(), decision.status}).second) return;
  const KnowledgeBase& knowledge = journal_.knowledge();
  ChainingDecided report{model, {}, decision.status, {}, {}, grounds.front()};
  std::vector<EventId> causes{because, knowledge.predictions().at(grounds.front()).event};
  for (const std::size_t i : decision.considered) {
    const Requirement& said = frame.situation.requirements()[i];
    report.considered.push_back({said.requirement, said.imdl.positive, said.imdl.confidence});
    causes.push_back(said.event.valid() ? said.event : knowledge.Find(said.requirement)->event);
  }
  if (decision.winner != Situation::npos)
    report.winner = frame.situation.requirements()[decision.winner].requirement;
  journal_.Write(now, std::move(report), causes);
}

}  // namespace aerascope
