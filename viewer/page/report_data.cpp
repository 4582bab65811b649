#include "viewer/page/report_data.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/base/text.h"
#include "viewer/page/cause_data.h"
#include "viewer/page/film_data.h"
#include "viewer/page/graph_data.h"
#include "viewer/page/report_context.h"
#include "viewer/page/subject_data.h"

namespace aerascope {
namespace {

using nlohmann::json;

std::string Plural(std::int64_t count, const std::string& word) {
  return std::to_string(count) + " " + word + (count == 1 ? "" : "s");
}

class ReportAuthor {
 public:
  ReportAuthor(const ReportContext& context, const ReportFrames& frames,
               const std::vector<std::string>& images, const ReportOptions& options)
      : context_(context),
        run_(context.run),
        knowledge_(context.knowledge),
        summary_(context.summary),
        frames_(frames),
        images_(images),
        options_(options) {
    for (const PredictionRecordOfRun& prediction : summary_.predictions)
      counted_.insert(prediction.prediction);
  }

  json Write() const {
    const json subjects = SubjectData(context_);
    return {{"title", Printable(run_.title())},
            {"summary", Summary()},
            {"provenance", Provenance()},
            {"warning", Warning()},
            {"clock", Clock()},
            {"film", FilmData(frames_, images_)},
            {"objects", Objects()},
            {"moments", Moments()},
            {"story", Story()},
            {"graph", GraphData(context_)},
            {"pieces", Pieces()},
            {"lanes", Lanes()},
            {"events", TellEvents(context_, subjects)},
            {"subjects", subjects},
            {"aliases", Aliases()}};
  }

 private:
  // ---- heading, sources

  json Summary() const {
    const auto drives = static_cast<std::int64_t>(summary_.drives.size());
    const auto learned = static_cast<std::int64_t>(summary_.learned.size());
    const auto analogies = static_cast<std::int64_t>(summary_.by_analogy.size());
    std::int64_t failed_goals = 0;
    for (const DriveOutcome& drive : summary_.drives)
      failed_goals += drive.outcome == Outcome::kFailed ? 1 : 0;
    const auto item = [](std::string text, const char* filter, bool failed) {
      return json{{"text", std::move(text)}, {"filter", filter}, {"failed", failed}};
    };
    json items = json::array();
    if (drives > 0) {
      items.push_back(
          item(std::to_string(summary_.drives_reached) + " of " + Plural(drives, "goal") + " reached", "goal",
               failed_goals > 0));
    }
    items.push_back(item(Plural(learned, "piece") + " of knowledge learned", "learned", false));
    if (analogies > 0) items.push_back(item(std::to_string(analogies) + " by analogy", "analogy", false));
    items.push_back(item(std::to_string(summary_.score.came_true) + " of " +
                             Plural(summary_.score.made, "prediction") + " came true",
                         "prediction", summary_.score.failed > 0));
    return items;
  }

  std::string Provenance() const {
    std::string text = options_.file_name.empty() ? "" : Printable(options_.file_name) + ", ";
    text += SecondsText(run_.end()) + " in " +
            Plural(static_cast<std::int64_t>(run_.frames().size()), "frame") + ", " +
            Plural(static_cast<std::int64_t>(run_.events().size()), "event") + "\n";
    text += "engine " + Printable(run_.header().program_version) + ", seed " +
            std::to_string(run_.started().seed);
    return text + ", " + DigestText();
  }

  Hash128 Digest() const {
    EventDigest digest;
    for (const Event& event : run_.events()) digest.Add(event);
    return digest.Value();
  }

  std::string DigestText() const {
    const Hash128 digest = Digest();
    const std::string name = "digest " + ToText(digest).substr(0, 8);
    if (!run_.complete()) return name + ", incomplete";
    if (!run_.stored_digest()) return name;
    return name + (*run_.stored_digest() == digest ? ", verified" : ", NOT the one stored");
  }

  std::string Warning() const {
    std::vector<std::string> sentences;
    if (!run_.complete())
      sentences.push_back("This run is incomplete: it stops after event " +
                          std::to_string(run_.events().size()) + " at " +
                          SecondsText(run_.events().empty() ? Time{} : run_.events().back().time) +
                          ". What follows in the world is not known.");
    if (run_.complete() && run_.stored_digest() && *run_.stored_digest() != Digest())
      sentences.push_back(
          "The events do not give the digest stored with them: the file was changed after the run.");
    return Join(sentences, " ");
  }

  // ---- clock, things

  json Clock() const {
    json starts = json::array();
    for (const RunFrame& frame : run_.frames()) starts.push_back(frame.interval.after.us);
    const std::int64_t start = run_.frames().empty() ? 0 : run_.frames().front().interval.after.us;
    return {{"start", start},
            {"end", std::max(run_.end().us, start)},
            {"period", run_.started().sampling_period_us},
            {"frames", starts}};
  }

  // Entities with what was seen of them: properties, and each value whenever it changed.
  json Objects() const {
    std::map<std::string, json> seen;
    std::map<std::string, std::map<std::string, std::string>> last;
    std::map<std::string, std::vector<std::string>> properties;
    for (const EventId id : run_.OfKind<FactObserved>()) {
      const Event& event = *run_.Find(id);
      const auto& observed = *run_.FindBody<FactObserved>(id);
      const Term& payload = observed.fact.payload;
      if (event.simulation.valid() || !observed.fact.positive || !IsValue(payload)) continue;
      if (!payload[0].is(TermKind::kEntity)) continue;
      const std::string name = Printable(payload[0].name());
      if (observed.source == FactSource::kProperty) {
        auto& words = properties[name];
        const std::string word = ValueText(payload[2]);
        if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
        seen.try_emplace(name, json::array());
        continue;
      }
      if (observed.source != FactSource::kSensor) continue;
      const std::string attribute = Printable(payload[1].name());
      const std::string value = ValueText(payload[2]);
      seen.try_emplace(name, json::array());
      std::string& before = last[name][attribute];
      if (before == value) continue;
      before = value;
      json change = {{"at", observed.fact.interval.after.us}, {"attribute", attribute}, {"value", value}};
      if (const json place = Place(payload[2]); !place.empty()) change["place"] = place;
      seen[name].push_back(std::move(change));
    }
    json objects = json::array();
    for (auto& [name, changes] : seen)
      objects.push_back(
          {{"name", name}, {"what", Join(properties[name], " ")}, {"changes", std::move(changes)}});
    return objects;
  }

  // Up to two coordinates of a number or vector; empty for anything else.
  static json Place(const Term& value) {
    json place = json::array();
    if (value.is(TermKind::kNumber)) place.push_back(value.number());
    if (value.IsStruct("vec2") || value.IsStruct("vec3"))
      for (const Term& item : value.items())
        if (item.is(TermKind::kNumber) && place.size() < 2) place.push_back(item.number());
    return place;
  }

  json Moments() const {
    json moments = json::array();
    for (std::size_t i = 0; i < run_.frames().size(); ++i) moments.push_back(SentenceOfFrame(run_, i));
    return moments;
  }

  // ---- story

  // The kind of a story row; empty for events that the story leaves out.
  std::string StoryKind(const Event& event) const {
    if (event.simulation.valid()) return "";
    if (const auto* goal = std::get_if<GoalAchieved>(&event.body)) return IsDrive(goal->goal) ? "goal" : "";
    if (const auto* goal = std::get_if<GoalFailed>(&event.body)) return IsDrive(goal->goal) ? "goal" : "";
    if (std::holds_alternative<DriveInjected>(event.body)) return "goal";
    if (std::holds_alternative<CommandIssued>(event.body)) return "command";
    if (std::holds_alternative<CommandRefused>(event.body)) return "command";
    if (std::holds_alternative<AnalogyCompared>(event.body)) return "analogy";
    if (std::holds_alternative<ModelStateChanged>(event.body)) return "learned";
    if (const auto* made = std::get_if<ModelCreated>(&event.body))
      return IsRequirement(made->model) && made->origin != Origin::kSeed && made->origin != Origin::kAnalogy
                 ? "learned"
                 : "";
    if (const auto* made = std::get_if<PredictionMade>(&event.body))
      return IsCounted(made->prediction) ? "prediction" : "";
    if (const auto* right = std::get_if<PredictionSucceeded>(&event.body))
      return IsCounted(right->prediction) ? "prediction" : "";
    if (const auto* wrong = std::get_if<PredictionFailed>(&event.body))
      return IsCounted(wrong->prediction) ? "prediction" : "";
    return "";
  }

  bool IsDrive(GoalId id) const {
    return std::any_of(summary_.drives.begin(), summary_.drives.end(),
                       [&](const DriveOutcome& drive) { return drive.goal == id; });
  }
  bool IsCounted(PredictionId id) const { return counted_.contains(id); }

  json Story() const {
    json story = json::array();
    for (const Event& event : run_.events()) {
      const std::string kind = StoryKind(event);
      if (kind.empty()) continue;
      json row = {
          {"at", event.time.us}, {"kind", kind}, {"mark", MarkOf(event)}, {"text", SentenceOf(run_, event)}};
      if (const std::string subject = context_.SubjectOf(event); !subject.empty()) row["subject"] = subject;
      if (TellsOfFailure(event)) row["failed"] = true;
      story.push_back(std::move(row));
    }
    return story;
  }

  // ---- lanes

  json Lanes() const {
    json phases = json::array();
    for (const Phase& phase : summary_.phases)
      phases.push_back(
          {{"from", phase.interval.after.us},
           {"to", phase.interval.before.us},
           {"text", phase.by == Commander::kTeacher ? "Guided experimentation: the teacher commands"
                                                    : "Task solving: the agent commands"}});
    json goals = json::array();
    for (const DriveOutcome& drive : summary_.drives)
      goals.push_back({{"from", FrameStart(drive.from).us},
                       {"to", BarEnd(drive.from, drive.until).us},
                       {"text", Printable(drive.title)},
                       {"outcome", OutcomeWord(drive.outcome)},
                       {"subject", IdText(drive.goal)}});
    json commands = json::array();
    for (const IssuedCommand& command : CommandsOf(run_))
      commands.push_back({{"from", FrameStart(command.time).us},
                          {"to", BarEnd(command.time, command.interval.before).us},
                          {"text", CommandWord(command.command)},
                          {"full", PayloadText(knowledge_, command.command)},
                          {"by", std::string(EnumName(command.by))},
                          {"refused", command.refused.valid()},
                          {"subject", IdText(command.event)}});
    json predictions = json::array();
    for (const PredictionRecordOfRun& prediction : summary_.predictions)
      predictions.push_back({{"from", FrameStart(prediction.time).us},
                             {"to", BarEnd(prediction.time, prediction.until).us},
                             {"text", ShortTarget(prediction)},
                             {"full", FactText(knowledge_, prediction.target)},
                             {"outcome", OutcomeWord(prediction.outcome)},
                             {"subject", IdText(prediction.prediction)}});
    json taught = json::array();
    json analogy = json::array();
    bool all_taught = true;
    for (const ModelId id : summary_.learned) {
      const ModelRecord* record = knowledge_.Find(id);
      if (record == nullptr) continue;
      const bool derived = record->origin == Origin::kAnalogy;
      (derived ? analogy : taught)
          .push_back({{"at", record->created.us},
                      {"text", TitleOf(knowledge_, id)},
                      {"short", ShortTitle(record->model)},
                      {"subject", IdText(id)}});
      all_taught = all_taught && (derived || context_.TaughtAt(record->created));
    }
    return {{"phases", phases},     {"goals", goals},
            {"commands", commands}, {"predictions", predictions},
            {"taught", taught},     {"taught_label", all_taught ? "Learned: taught" : "Learned"},
            {"analogy", analogy}};
  }

  // Bars of the lanes cover whole frames: reasoning and commands begin a little after a frame does.
  Time FrameStart(Time t) const {
    const auto frame = run_.FrameAt(t);
    return frame ? run_.frames()[*frame].interval.after : t;
  }
  // The start of the frame in which `until` lies, or that frame's end where the bar would be empty.
  Time BarEnd(Time from, Time until) const {
    const Time end = FrameStart(until);
    if (end > FrameStart(from)) return end;
    const auto frame = run_.FrameAt(from);
    return frame ? run_.frames()[*frame].interval.before : std::max(until, from);
  }

  static std::string OutcomeWord(Outcome outcome) {
    switch (outcome) {
      case Outcome::kOpen:
        return "open";
      case Outcome::kReached:
        return "true";
      case Outcome::kFailed:
        return "failed";
    }
    return "open";
  }

  std::string CommandWord(const Term& command) const {
    if (!IsCommand(command)) return PayloadText(knowledge_, command);
    std::string word = Printable(command[0].name());
    std::replace(word.begin(), word.end(), '_', ' ');
    return word;
  }

  // What a requirement model is about in a word: the command of its causal model, else its title.
  std::string ShortTitle(const Model& requirement) const {
    const ModelRecord* target = knowledge_.Find(TargetModel(requirement));
    if (target != nullptr && IsCommand(target->model.lhs.payload))
      return CommandWord(target->model.lhs.payload);
    return TitleOf(knowledge_, requirement.id);
  }

  // What is predicted in a word or two: the value, or the thing that has this value now ("at s1").
  std::string ShortTarget(const PredictionRecordOfRun& prediction) const {
    const Term& payload = prediction.target.payload;
    if (!IsValue(payload)) return FactText(knowledge_, prediction.target);
    const std::string sign = prediction.target.positive ? "" : "not ";
    const bool place = !Place(payload[2]).empty();
    if (!place) return sign + ValueText(payload[2]);
    const std::string relation = payload[1].name() == "position" ? "at " : Printable(payload[1].name()) + " ";
    const KnowledgeBase then = run_.KnowledgeBaseAt(prediction.time);
    for (const auto& [id, record] : then.facts()) {
      const Term& other = record.fact.payload;
      if (!record.fact.positive || !IsValue(other) || !(other[1] == payload[1]) || other[0] == payload[0])
        continue;
      if (SameValue(other[2], payload[2])) return sign + relation + ValueText(other[0]);
    }
    return sign + relation + ValueText(payload[2]);
  }

  // ---- pieces

  // Pieces of knowledge: requirement models, in order of creation, with what lanes and counters need of them.
  json Pieces() const {
    json pieces = json::array();
    for (const auto& [id, record] : knowledge_.models()) {
      if (!IsRequirement(record.model)) continue;
      pieces.push_back({{"subject", IdText(id)},
                        {"text", TitleOf(knowledge_, id)},
                        {"born", record.created.us},
                        {"learned", record.origin != Origin::kSeed}});
    }
    return pieces;
  }

  // Other ids under which the inspector's subjects are known: composite states by their requirement model.
  json Aliases() const {
    json aliases = json::object();
    for (const auto& [state, requirement] : context_.requirement_on)
      aliases[IdText(state)] = IdText(requirement);
    return aliases;
  }

  const ReportContext& context_;
  const Run& run_;
  const KnowledgeBase& knowledge_;
  const EpisodeSummary& summary_;
  const ReportFrames& frames_;
  const std::vector<std::string>& images_;
  const ReportOptions& options_;
  std::set<PredictionId> counted_;  // predictions that the summary counts
};

}  // namespace

std::string ReportData(const Run& run, const ReportFrames& frames, const std::vector<std::string>& images,
                       const ReportOptions& options) {
  const ReportContext context(run);
  // Text of an episode is any bytes; what is not UTF-8 is replaced rather than refused.
  return ReportAuthor(context, frames, images, options)
      .Write()
      .dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string ReportTitle(const Run& run) {
  return Printable(run.title()) + ": episode report";
}

}  // namespace aerascope
