#include "engine/query/run.h"

#include <algorithm>
#include <charconv>

#include "engine/base/text.h"
#include "engine/event/apply.h"

namespace aerascope {
namespace {

// In order of the alternatives of ObjectId.
constexpr std::array<std::string_view, std::variant_size_v<ObjectId>> kPrefixes = {
    "#", "fact_", "goal_", "pred_", "cst_", "mdl_", "sim_"};

// Knowledge bases kept along the events: every kFirstSpacing events, and twice as far apart whenever there
// are more than kMaxCheckpoints, so that memory stays bounded whatever the length of the run.
constexpr std::size_t kFirstSpacing = 1024;
constexpr std::size_t kMaxCheckpoints = 32;

std::int64_t NumberOf(const ObjectId& id) {
  return std::visit([](auto typed) { return typed.value; }, id);
}

template <std::size_t I = 0>
ObjectId MakeObjectId(std::size_t kind, std::int64_t number) {
  if constexpr (I < std::variant_size_v<ObjectId>) {
    if (kind == I) return std::variant_alternative_t<I, ObjectId>{number};
    return MakeObjectId<I + 1>(kind, number);
  } else {
    return EventId{number};
  }
}

std::string IdText(std::size_t kind, std::int64_t number) {
  return std::string(kPrefixes[kind]) + std::to_string(number);
}

// What an event brings into being.
struct Created {
  void operator()(const FactObserved& e) { id = e.fact_id; }
  void operator()(const IcstFound& e) { id = e.fact_id; }
  void operator()(const ImdlPredicted& e) { id = e.fact_id; }
  void operator()(const ImdlFired& e) { id = e.fact_id; }
  void operator()(const DriveInjected& e) { id = e.goal; }
  void operator()(const GoalSet& e) { id = e.goal; }
  void operator()(const PredictionMade& e) { id = e.prediction; }
  void operator()(const CompositeStateCreated& e) { id = e.state.id; }
  void operator()(const ModelCreated& e) { id = e.model.id; }
  void operator()(const SimulationStarted& e) { id = e.simulation; }
  template <class Other>
  void operator()(const Other&) {}
  ObjectId id = EventId{};
};

}  // namespace

std::string IdText(const ObjectId& id) {
  const std::int64_t number = NumberOf(id);
  return number == 0 ? "none" : IdText(id.index(), number);
}

Result<ObjectId> ParseObjectId(std::string_view text) {
  const std::size_t digits = text.find_first_of("0123456789");
  const std::string_view prefix = text.substr(0, digits);
  const std::string_view rest = digits == std::string_view::npos ? "" : text.substr(digits);
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  const bool is_number =
      !rest.empty() && error == std::errc() && end == rest.data() + rest.size() && number > 0;
  const auto known = std::find(kPrefixes.begin(), kPrefixes.end(), prefix);
  if (is_number && prefix.empty()) return ObjectId{EventId{number}};
  if (is_number && known != kPrefixes.end()) {
    return MakeObjectId(static_cast<std::size_t>(known - kPrefixes.begin()), number);
  }
  std::string message =
      "expected an id such as mdl_14, cst_12, fact_3, goal_7, pred_9, sim_4 or #214 (an event), found \"" +
      Printable(text.substr(0, 80)) + "\"";
  const std::string closest = ClosestWord(prefix, {kPrefixes.begin() + 1, kPrefixes.end()});
  if (is_number && !closest.empty()) message += "; did you mean " + closest + std::to_string(number) + "?";
  return Error{message};
}

Run Run::FromEvents(EpisodeFile file) {
  Run run;
  run.file_ = std::move(file);
  // The reader of files gives no gaps; events put together otherwise end at the first one.
  std::vector<Event>& events = run.file_.events;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (events[i].id.value == static_cast<std::int64_t>(i) + 1) continue;
    events.resize(i);
    run.file_.complete = false;
  }
  run.IndexEvents();
  run.IndexCreations();
  run.IndexEffects();
  run.IndexFrames();
  run.FoldKnowledge();
  return run;
}

Result<Run> OpenRun(const std::string& path) {
  Result<EpisodeFile> file = ReadEpisode(path);
  if (!file) return file.error();
  return Run::FromEvents(std::move(file).value());
}

void Run::IndexEvents() {
  by_kind_.resize(kEventKinds);
  latest_.reserve(events().size());
  Time latest;
  for (const Event& event : events()) {
    by_kind_[event.body.index()].push_back(event.id);
    latest = std::max(latest, event.time);
    latest_.push_back(latest);
  }
  end_ = latest;
  const auto starts = OfKind<EpisodeStarted>();
  if (!starts.empty()) started_ = *FindBody<EpisodeStarted>(starts.front());
}

void Run::IndexCreations() {
  for (const Event& event : events()) {
    Created created;
    std::visit(created, event.body);
    if (NumberOf(created.id) != 0)
      creations_[created.id.index()].emplace_back(NumberOf(created.id), event.id);
  }
  for (auto& kind : creations_) {
    std::stable_sort(kind.begin(), kind.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
  }
}

void Run::IndexEffects() {
  // Counted first, then filled: two flat arrays instead of a list an event.
  effects_begin_.assign(events().size() + 1, 0);
  const auto for_each_cause = [&](auto&& visit) {
    for (const Event& event : events()) {
      for (const EventId cause : event.causes) {
        const std::size_t position = PositionOf(cause);
        if (position < events().size()) visit(position, event.id);
      }
    }
  };
  for_each_cause([&](std::size_t cause, EventId) { ++effects_begin_[cause + 1]; });
  for (std::size_t i = 1; i < effects_begin_.size(); ++i) effects_begin_[i] += effects_begin_[i - 1];
  effects_.resize(effects_begin_.back());
  std::vector<std::size_t> next(effects_begin_.begin(), effects_begin_.end() - 1);
  for_each_cause([&](std::size_t cause, EventId effect) { effects_[next[cause]++] = effect; });
}

void Run::IndexFrames() {
  for (const EventId id : OfKind<FrameStarted>()) {
    const Event& event = *Find(id);
    if (!frames_.empty()) frames_.back().last = EventId{id.value - 1};
    frames_.push_back({event.frame, std::get<FrameStarted>(event.body).interval, id, id});
  }
  if (frames_.empty()) return;
  frames_.back().last = events().back().id;
  // An open-ended last frame says nothing about the length of the run.
  if (frames_.back().interval.before < kForever) end_ = std::max(end_, frames_.back().interval.before);
}

void Run::FoldKnowledge() {
  std::size_t spacing = kFirstSpacing;
  for (std::size_t i = 0; i < events().size(); ++i) {
    if (i > 0 && i % spacing == 0) checkpoints_.push_back({i, final_knowledge_});
    if (checkpoints_.size() > kMaxCheckpoints) {
      spacing *= 2;
      std::erase_if(checkpoints_,
                    [&](const Checkpoint& checkpoint) { return checkpoint.events % spacing != 0; });
    }
    Apply(events()[i], &final_knowledge_);
  }
}

const EpisodeEnded* Run::ended() const {
  const auto& ends = OfKind<EpisodeEnded>();
  return ends.empty() ? nullptr : FindBody<EpisodeEnded>(ends.back());
}

std::string Run::title() const {
  return started_.scenario.empty() ? "Untitled episode" : Printable(started_.scenario);
}

std::optional<std::size_t> Run::FrameAt(Time t) const {
  if (frames_.empty()) return std::nullopt;
  const auto after =
      std::upper_bound(frames_.begin(), frames_.end(), t,
                       [](Time time, const RunFrame& frame) { return time < frame.interval.after; });
  return after == frames_.begin() ? 0 : static_cast<std::size_t>(after - frames_.begin()) - 1;
}

std::size_t Run::PositionOf(EventId id) const {
  const auto position = static_cast<std::uint64_t>(id.value) - 1;  // ids are 1, 2, 3 ...
  return id.valid() && position < events().size() ? static_cast<std::size_t>(position) : events().size();
}

const Event* Run::Find(EventId id) const {
  const std::size_t position = PositionOf(id);
  return position < events().size() ? &events()[position] : nullptr;
}

std::span<const EventId> Run::Causes(EventId id) const {
  const Event* event = Find(id);
  return event ? std::span<const EventId>(event->causes) : std::span<const EventId>();
}

std::span<const EventId> Run::Effects(EventId id) const {
  const std::size_t position = PositionOf(id);
  if (position >= events().size()) return {};
  return std::span(effects_).subspan(effects_begin_[position],
                                     effects_begin_[position + 1] - effects_begin_[position]);
}

EventId Run::CreationOf(const ObjectId& id) const {
  if (const auto* event = std::get_if<EventId>(&id)) return Find(*event) ? *event : EventId{};
  const auto& numbers = creations_[id.index()];
  const auto it =
      std::lower_bound(numbers.begin(), numbers.end(), NumberOf(id),
                       [](const auto& entry, std::int64_t number) { return entry.first < number; });
  return it != numbers.end() && it->first == NumberOf(id) ? it->second : EventId{};
}

Result<ObjectId> Run::FindObject(std::string_view text) const {
  Result<ObjectId> id = ParseObjectId(text);
  if (!id || CreationOf(*id).valid()) return id;
  std::string message = "there is no " + IdText(*id) + " in this episode";
  const std::string nearest = NearestTo(*id);
  const std::string same_number = SameNumber(*id);
  if (!nearest.empty()) message += "; the nearest is " + nearest;
  if (!same_number.empty()) message += (nearest.empty() ? "; " : ", and ") + same_number + " has that number";
  return Error{message};
}

// Of the same kind.
std::string Run::NearestTo(const ObjectId& id) const {
  const std::int64_t number = NumberOf(id);
  if (std::holds_alternative<EventId>(id)) return events().empty() ? "" : IdText(events().back().id);
  const auto& numbers = creations_[id.index()];
  if (numbers.empty()) return {};
  const auto distance = [&](const auto& entry) {
    return static_cast<std::uint64_t>(std::max(entry.first, number)) -
           static_cast<std::uint64_t>(std::min(entry.first, number));
  };
  const auto nearest = std::min_element(numbers.begin(), numbers.end(), [&](const auto& a, const auto& b) {
    return distance(a) < distance(b);
  });
  return IdText(id.index(), nearest->first);
}

// Of another kind: all objects share one numbering, so the kind may have been mistaken.
std::string Run::SameNumber(const ObjectId& id) const {
  if (std::holds_alternative<EventId>(id)) return {};
  const std::int64_t number = NumberOf(id);
  for (std::size_t kind = 1; kind < kPrefixes.size(); ++kind) {
    if (CreationOf(MakeObjectId(kind, number)).valid()) return IdText(kind, number);
  }
  return {};
}

const Fact* Run::FindFact(FactId id) const {
  const Event* event = Find(CreationOf(id));
  if (!event) return nullptr;
  if (const auto* observed = std::get_if<FactObserved>(&event->body)) return &observed->fact;
  if (const auto* icst = std::get_if<IcstFound>(&event->body)) return &icst->fact;
  if (const auto* imdl = std::get_if<ImdlPredicted>(&event->body)) return &imdl->fact;
  if (const auto* fired = std::get_if<ImdlFired>(&event->body)) return &fired->fact;
  return nullptr;
}

KnowledgeBase Run::KnowledgeBaseAfterEvents(std::size_t count) const {
  if (count >= events().size()) return final_knowledge_;
  const auto after =
      std::upper_bound(checkpoints_.begin(), checkpoints_.end(), count,
                       [](std::size_t n, const Checkpoint& checkpoint) { return n < checkpoint.events; });
  KnowledgeBase knowledge;
  std::size_t done = 0;
  if (after != checkpoints_.begin()) {
    knowledge = std::prev(after)->knowledge;
    done = std::prev(after)->events;
  }
  for (; done < count; ++done) Apply(events()[done], &knowledge);
  return knowledge;
}

KnowledgeBase Run::KnowledgeBaseAt(Time t) const {
  const auto after = std::upper_bound(latest_.begin(), latest_.end(), t);
  return KnowledgeBaseAfterEvents(static_cast<std::size_t>(after - latest_.begin()));
}

KnowledgeBase Run::KnowledgeBaseAfter(EventId id) const {
  return KnowledgeBaseAfterEvents(Find(id) ? PositionOf(id) + 1 : 0);
}

}  // namespace aerascope
