#include "viewer/page/event_log_data.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <variant>

#include "engine/base/text.h"
#include "engine/query/describe.h"
#include "viewer/page/analogy_data.h"
#include "viewer/page/columns.h"
#include "viewer/page/event_fields.h"
#include "viewer/page/overloaded.h"
#include "viewer/page/page_json.h"
#include "viewer/page/shortened.h"
#include "viewer/page/text_columns.h"

namespace aerascope {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestSentence = 1000;  // code points

// Bits of a sign and of a step of confidence, see the header.
constexpr unsigned kFailure = 8, kImagined = 16, kWorthALine = 32, kSpeaksAgainst = 64;
constexpr unsigned kWasWrong = 1, kWasDeleted = 2, kIsStrong = 4, kIsPhasedOut = 8;

// Whether an effect is worth a line; what is only thought on the way is looked through.
bool IsWorthALine(const Event& event) {
  if (event.simulation.valid()) return false;
  return std::visit(
      Overloaded{[](const PredictionSucceeded&) { return true; },
                 [](const PredictionFailed&) { return true; }, [](const AnalogyCompared&) { return true; },
                 [](const ModelCreated&) { return true; }, [](const ModelStateChanged&) { return true; },
                 [](const CommandIssued&) { return true; }, [](const CommandRefused&) { return true; },
                 [](const GoalAchieved&) { return true; }, [](const GoalFailed&) { return true; },
                 [](const DriveInjected&) { return true; }, [](const auto&) { return false; }},
      event.body);
}

// Whether it is a reason why a goal, a prediction or a command did not come out: skipped, rejected, refused
// or contradicted on the way. That something holds or is expected already is none.
bool SpeaksAgainst(const Event& event) {
  return std::visit(
      Overloaded{[](const GoalSkipped& e) { return Hinders(e.reason); },
                 [](const AnalogyCompared& e) {
                   return e.verdict != AnalogyVerdict::kAccepted && e.verdict != AnalogyVerdict::kNotRequired;
                 },
                 [](const GoalDropped& e) {
                   return e.reason == GoalDropReason::kRequirementContradicted ||
                          e.reason == GoalDropReason::kNoPlan;
                 },
                 [](const SimulationEnded& e) { return e.outcome != SimulationOutcome::kReached; },
                 [](const PlanRejected&) { return true; }, [](const CommandRefused&) { return true; },
                 [](const PredictionFailed&) { return true; },
                 [](const PredictionInvalidated&) { return true; }, [](const auto&) { return false; }},
      event.body);
}

class LogAuthor {
 public:
  LogAuthor(const ReportContext& context, const SubjectTable& subjects, PageBlocks* first, PageBlocks* later)
      : context_(context),
        run_(context.run),
        subjects_(subjects),
        first_(first),
        later_(later),
        by_kind_(Sorted(context.run.events())) {}

  Result<json> Write() {
    WriteColumns();
    WriteCauses();
    if (Status written = first_->AddPacked("events", "log", kBytes, columns_.bytes()); !written)
      return written.error();
    if (Status written = first_->AddPacked("events", "log-causes", kBytes, causes_.bytes()); !written)
      return written.error();
    if (Status written = WriteChunks(); !written) return written.error();
    return json{{"count", run_.events().size()},
                {"chunk", kEventsAChunk},
                {"kinds", DescribeKinds()},
                {"marks", marks_}};
  }

 private:
  static constexpr std::string_view kBytes = "application/octet-stream";
  using ByKind = std::vector<std::vector<const Event*>>;

  static ByKind Sorted(std::span<const Event> events) {
    ByKind by_kind(std::variant_size_v<EventBody>);
    for (const Event& event : events) by_kind[event.body.index()].push_back(&event);
    return by_kind;
  }

  std::uint8_t MarkNumber(const std::string& mark) {
    const auto [entry, is_new] = mark_numbers_.try_emplace(mark, marks_.size());
    if (is_new) marks_.push_back(mark);
    return static_cast<std::uint8_t>(entry->second);
  }

  void WriteColumns() {
    const std::vector<Event>& events = run_.events();
    for (const Event& event : events) columns_.Byte(static_cast<std::uint8_t>(event.body.index()));
    for (const Event& event : events)
      columns_.Byte(static_cast<std::uint8_t>(
          static_cast<unsigned>(ChapterOf(context_, subjects_, event)) |
          (TellsOfFailure(event) ? kFailure : 0u) | (event.simulation.valid() ? kImagined : 0u) |
          (IsWorthALine(event) ? kWorthALine : 0u) | (SpeaksAgainst(event) ? kSpeaksAgainst : 0u)));
    for (const Event& event : events) columns_.Byte(MarkNumber(MarkOf(event)));
    Time before;
    for (const Event& event : events) {
      columns_.Signed(event.time.us - before.us);
      before = event.time;
    }
    for (const Event& event : events)
      columns_.Unsigned(static_cast<std::uint64_t>(std::max<std::int64_t>(event.simulation.value, 0)));
    WriteLists(&columns_, [&](const Event& event) {
      const std::vector<std::size_t> mentioned = subjects_.MentionedBy(event);
      return std::vector<std::int64_t>(mentioned.begin(), mentioned.end());
    });
    WriteSure();
  }

  void WriteSure() {
    std::map<std::size_t, const ModelHistory*> histories;
    for (const auto& [id, history] : context_.histories)
      if (const auto number = subjects_.Find(id)) histories[*number] = &history;
    for (std::size_t number = 0; number < subjects_.list().size(); ++number) {
      const auto found = histories.find(number);
      if (found == histories.end()) {
        columns_.Unsigned(0);
        continue;
      }
      columns_.Unsigned(found->second->steps.size());
      Time before;
      EventId event;
      for (const ConfidenceStep& step : found->second->steps) {
        columns_.Signed(step.time.us - before.us);
        columns_.Unsigned(
            static_cast<std::uint64_t>(std::clamp(step.evidence.rate(), 0.0, 1.0) * 10000 + 0.5));
        columns_.Byte(static_cast<std::uint8_t>((step.success && !*step.success ? kWasWrong : 0u) |
                                                (step.state == ModelState::kDeleted ? kWasDeleted : 0u) |
                                                (step.strong ? kIsStrong : 0u) |
                                                (step.state == ModelState::kPhasedOut ? kIsPhasedOut : 0u)));
        columns_.Signed(step.event.value - event.value);
        before = step.time;
        event = step.event;
      }
    }
  }

  void WriteCauses() {
    WriteLists(&causes_, [](const Event& event) {
      std::vector<std::int64_t> back;
      // A cause is an earlier event; a file in which it is not points at nothing.
      for (const EventId cause : event.causes)
        back.push_back(cause.value < event.id.value ? event.id.value - cause.value : 0);
      return back;
    });
  }

  // A list of numbers for each event, see the header.
  template <class ListOf>
  void WriteLists(ColumnWriter* columns, const ListOf& list_of) {
    ColumnWriter items;
    for (const std::vector<const Event*>& of_kind : by_kind_) {
      std::vector<std::vector<std::int64_t>> lists;
      for (const Event* event : of_kind) {
        lists.push_back(list_of(*event));
        columns->Unsigned(lists.back().size());
      }
      for (std::size_t place = 0;; ++place) {
        std::erase_if(lists, [&](const auto& list) { return list.size() <= place; });
        if (lists.empty()) break;
        std::int64_t before = 0;
        for (const std::vector<std::int64_t>& list : lists) {
          items.Signed(list[place] - before);
          before = list[place];
        }
      }
    }
    columns->Append(items);
  }

  Status WriteChunks() {
    const std::vector<Event>& events = run_.events();
    for (std::size_t start = 0, n = 0; start < events.size(); start += kEventsAChunk, ++n) {
      const std::size_t end = std::min(start + kEventsAChunk, events.size());
      const ByKind by_kind = Sorted({events.data() + start, end - start});
      TextColumns sentences, fields;
      for (const std::vector<const Event*>& of_kind : by_kind) {
        if (of_kind.empty()) continue;
        WriteSentences(of_kind, &sentences);
        WriteFields(of_kind, &fields);
      }
      const std::string number = std::to_string(n);
      for (const auto& [name, columns] : {std::pair{"text-", &sentences}, std::pair{"fields-", &fields}})
        if (Status written = later_->AddPacked("events", name + number, kBytes, columns->bytes()); !written)
          return written;
    }
    return {};
  }

  void WriteSentences(const std::vector<const Event*>& events, TextColumns* columns) const {
    std::vector<TextCell> column;
    for (const Event* event : events)
      column.push_back({event->id.value, Shortened(SentenceOf(run_, *event), kLongestSentence)});
    columns->Add(column);
  }

  void WriteFields(const std::vector<const Event*>& events, TextColumns* columns) const {
    std::vector<std::vector<TextCell>> texts, links;  // by field
    for (const Event* event : events) {
      std::vector<std::optional<FieldText>> fields = FieldsOf(run_, *event);
      texts.resize(fields.size());
      links.resize(fields.size());
      for (std::size_t i = 0; i < fields.size(); ++i) {
        TextCell &text = texts[i].emplace_back(), &link = links[i].emplace_back();
        text.row = link.row = event->id.value;
        if (!fields[i]) continue;
        text.text = std::move(fields[i]->text);
        if (!fields[i]->link.empty()) link.text = std::move(fields[i]->link);
      }
    }
    for (std::size_t i = 0; i < texts.size(); ++i) {
      columns->Add(texts[i]);
      columns->Add(links[i]);
    }
    if (!std::holds_alternative<AnalogyCompared>(events.front()->body)) return;
    std::vector<TextCell> comparisons;
    for (const Event* event : events)
      comparisons.push_back({event->id.value, PageJson(ComparisonData(context_, *event))});
    columns->Add(comparisons);
  }

  const ReportContext& context_;
  const Run& run_;
  const SubjectTable& subjects_;
  PageBlocks* first_;
  PageBlocks* later_;
  ByKind by_kind_;  // all events
  ColumnWriter columns_;
  ColumnWriter causes_;
  std::vector<std::string> marks_;
  std::map<std::string, std::size_t> mark_numbers_;
};

}  // namespace

StoryChapter ChapterOf(const ReportContext& context, const SubjectTable& subjects, const Event& event) {
  if (event.simulation.valid()) return StoryChapter::kNone;
  const auto of_goal = [&](GoalId id) {
    const auto number = subjects.Find(id);
    if (!number) return StoryChapter::kNone;
    const GoalNode& goal = context.goals.goals[subjects.list()[*number].position];
    return goal.drive ? StoryChapter::kGoal : StoryChapter::kNone;
  };
  // Those about requirement models and those made in the head are not counted, and not told.
  const auto of_prediction = [&](PredictionId id) {
    return subjects.Find(id) ? StoryChapter::kPrediction : StoryChapter::kNone;
  };
  return std::visit(Overloaded{[&](const DriveInjected&) { return StoryChapter::kGoal; },
                               [&](const GoalAchieved& e) { return of_goal(e.goal); },
                               [&](const GoalFailed& e) { return of_goal(e.goal); },
                               [](const CommandIssued&) { return StoryChapter::kCommand; },
                               [](const CommandRefused&) { return StoryChapter::kCommand; },
                               [](const AnalogyCompared&) { return StoryChapter::kAnalogy; },
                               [](const ModelStateChanged&) { return StoryChapter::kLearned; },
                               [](const ModelCreated& e) {
                                 return IsRequirement(e.model) && e.origin != Origin::kSeed &&
                                                e.origin != Origin::kAnalogy
                                            ? StoryChapter::kLearned
                                            : StoryChapter::kNone;
                               },
                               [&](const PredictionMade& e) { return of_prediction(e.prediction); },
                               [&](const PredictionSucceeded& e) { return of_prediction(e.prediction); },
                               [&](const PredictionFailed& e) { return of_prediction(e.prediction); },
                               [](const auto&) { return StoryChapter::kNone; }},
                    event.body);
}

Result<json> AddEventLog(const ReportContext& context, const SubjectTable& subjects, PageBlocks* first,
                         PageBlocks* later) {
  return LogAuthor(context, subjects, first, later).Write();
}

}  // namespace aerascope
