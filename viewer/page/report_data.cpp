#include "viewer/page/report_data.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/base/text.h"
#include "viewer/draw/lane_bars.h"
#include "viewer/page/event_log_data.h"
#include "viewer/page/film_data.h"
#include "viewer/page/graph_data.h"
#include "viewer/page/page_json.h"
#include "viewer/page/provenance.h"
#include "viewer/page/report_context.h"
#include "viewer/page/shortened.h"
#include "viewer/page/subject_data.h"
#include "viewer/page/subject_table.h"

namespace aerascope {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestStory = 1500;  // code points

class ReportAuthor {
 public:
  ReportAuthor(const ReportContext& context, const SubjectTable& subjects, const ReportFrames& frames,
               const std::vector<std::string>& images, const ReportOptions& options)
      : context_(context),
        subjects_(subjects),
        run_(context.run),
        knowledge_(context.knowledge),
        summary_(context.summary),
        frames_(frames),
        images_(images),
        options_(options) {}

  json Write(json log) const {
    return {{"title", Shortened(Printable(run_.title()), kLongestTitle)},
            {"story", Story()},
            {"summary", Summary()},
            {"provenance", ProvenanceOf(run_, options_.file_name)},
            {"warning", WarningAbout(run_)},
            {"clock", Clock()},
            {"film", FilmData(frames_, images_)},
            {"objects", Objects()},
            {"moments", Moments()},
            {"graph", GraphData(context_)},
            {"pieces", Pieces()},
            {"drives", Drives()},
            {"lanes", Lanes()},
            {"log", std::move(log)},
            {"subjects", SubjectIndex(context_, subjects_)}};
  }

 private:
  // ---- heading

  // What the scenario says of itself, for people; empty where it says nothing.
  std::string Story() const {
    const auto& settings = run_.header().settings;
    const auto story = settings.find("story");
    if (story == settings.end()) return "";
    std::string line = story->second;
    std::replace(line.begin(), line.end(), '\n', ' ');
    return Shortened(Printable(line), kLongestStory);
  }

  json Summary() const {
    const auto drives = static_cast<std::int64_t>(summary_.drives.size());
    const auto learned = static_cast<std::int64_t>(summary_.learned.size());
    const auto analogies = static_cast<std::int64_t>(summary_.by_analogy.size());
    std::int64_t failed_goals = 0;
    for (const DriveOutcome& drive : summary_.drives)
      failed_goals += drive.outcome == Outcome::kFailed ? 1 : 0;
    const auto given_up = static_cast<std::int64_t>(summary_.given_up.size());
    const auto item = [](std::string text, const char* filter, bool failed) {
      return json{{"text", std::move(text)}, {"filter", filter}, {"failed", failed}};
    };
    // What says more of the one before.
    const auto more = [&item](std::int64_t count, const char* words, const char* filter) {
      json data = item(std::to_string(count) + words, filter, false);
      data["more"] = true;
      return data;
    };
    json items = json::array();
    if (drives > 0) {
      items.push_back(
          item(std::to_string(summary_.drives_reached) + " of " + Plural(drives, "goal") + " reached", "goal",
               failed_goals > 0));
    }
    items.push_back(item(Plural(learned, "piece") + " of knowledge learned", "learned", false));
    if (analogies > 0) items.push_back(more(analogies, " by analogy", "analogy"));
    if (given_up > 0) items.push_back(more(given_up, " given up", "learned"));
    items.push_back(item(std::to_string(summary_.score.came_true) + " of " +
                             Plural(summary_.score.decided(), "prediction") + " came true",
                         "prediction", summary_.score.failed > 0));
    if (summary_.score.open() > 0) items.push_back(more(summary_.score.open(), " not decided", "prediction"));
    return items;
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
      json change = {{"at", observed.fact.interval.after.us},
                     {"attribute", attribute},
                     {"value", value},
                     {"event", id.value}};
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

  // ---- lanes

  // A lane as columns, one entry a bar; texts are positions in the list of texts.
  class Lane {
   public:
    explicit Lane(std::map<std::string, std::size_t>* texts) : texts_(texts) {}
    void Add(TimeInterval bar, const std::string& text, const std::string& full, std::size_t subject,
             int sign) {
      data_["from"].push_back(bar.after.us);
      data_["to"].push_back(bar.before.us);
      data_["text"].push_back(Number(text));
      data_["full"].push_back(Number(full));
      data_["subject"].push_back(subject);
      data_["sign"].push_back(sign);
    }
    json Take() { return std::move(data_); }

   private:
    std::size_t Number(const std::string& text) {
      return texts_->try_emplace(Shortened(text, kLongestTitle), texts_->size()).first->second;
    }
    std::map<std::string, std::size_t>* texts_;
    json data_ = {{"from", json::array()}, {"to", json::array()},      {"text", json::array()},
                  {"full", json::array()}, {"subject", json::array()}, {"sign", json::array()}};
  };

  // Signs: an Outcome, plus 4 for a teacher's command.
  json Lanes() const {
    std::map<std::string, std::size_t> texts;
    json phases = json::array();
    for (const Phase& phase : summary_.phases)
      phases.push_back(
          {{"from", phase.interval.after.us},
           {"to", phase.interval.before.us},
           {"text", phase.by == Commander::kTeacher ? "Guided experimentation: the teacher commands"
                                                    : "Task solving: the agent commands"}});
    Lane goals(&texts), commands(&texts), predictions(&texts), learned(&texts), analogy(&texts);
    for (const DriveOutcome& drive : summary_.drives)
      if (const auto number = subjects_.Find(drive.goal))
        goals.Add(InWholeFrames(run_, drive.from, drive.until), Printable(drive.title),
                  FactText(knowledge_, drive.target), *number, static_cast<int>(drive.outcome));
    for (const IssuedCommand& command : subjects_.commands())
      commands.Add(InWholeFrames(run_, command.time, command.interval.before),
                   CommandWords(knowledge_, command.command), PayloadText(knowledge_, command.command),
                   *subjects_.Find(command.event),
                   (command.refused.valid() ? static_cast<int>(Outcome::kFailed) : 0) +
                       (command.by == Commander::kTeacher ? 4 : 0));
    const std::map<PredictionId, std::string> targets = ShortTargets(run_, summary_.predictions);
    for (const PredictionRecordOfRun& prediction : summary_.predictions)
      predictions.Add(InWholeFrames(run_, prediction.time, prediction.until),
                      targets.at(prediction.prediction), FactText(knowledge_, prediction.target),
                      *subjects_.Find(prediction.prediction), static_cast<int>(prediction.outcome));
    for (const ModelId id : summary_.learned) {
      const ModelRecord* record = knowledge_.Find(id);
      if (record == nullptr) continue;
      const bool derived = record->origin == Origin::kAnalogy;
      (derived ? analogy : learned)
          .Add({record->created, record->created}, ShortTitle(record->model), TitleOf(knowledge_, id),
               *subjects_.Find(id), 0);
    }
    json text_list = json::array();
    std::vector<std::string> in_order(texts.size());
    for (const auto& [text, number] : texts) in_order[number] = text;
    for (std::string& text : in_order) text_list.push_back(std::move(text));
    return {{"phases", phases},
            {"goals", goals.Take()},
            {"commands", commands.Take()},
            {"predictions", predictions.Take()},
            {"learned", learned.Take()},
            {"analogy", analogy.Take()},
            {"texts", text_list}};
  }

  // What was wanted of the agent, in order, with what it did about it.
  json Drives() const {
    json drives = json::array();
    for (const DriveOutcome& drive : summary_.drives) {
      const auto number = subjects_.Find(drive.goal);
      if (!number) continue;
      const GoalNode& goal = context_.goals.goals[subjects_.list()[*number].position];
      json commands = json::array();
      for (const IssuedCommand& command : goal.commands) commands.push_back(*subjects_.Find(command.event));
      drives.push_back({{"subject", *number},
                        {"title", Shortened(Printable(drive.title), kLongestTitle)},
                        {"from", drive.from.us},
                        {"until", drive.until.us},
                        {"outcome", static_cast<int>(drive.outcome)},
                        {"commands", commands}});
    }
    return drives;
  }

  // What a requirement model is about in a word: the command of its causal model, else its title.
  std::string ShortTitle(const Model& requirement) const {
    const ModelRecord* target = knowledge_.Find(TargetModel(requirement));
    if (target != nullptr && IsCommand(target->model.lhs.payload))
      return CommandWords(knowledge_, target->model.lhs.payload);
    return TitleOf(knowledge_, requirement.id);
  }

  // ---- pieces

  // Pieces of knowledge: requirement models in order of creation, by subject number, and whether it was
  // learned.
  json Pieces() const {
    json pieces = json::array();
    for (const auto& [id, record] : knowledge_.models()) {
      if (!IsRequirement(record.model)) continue;
      pieces.push_back({*subjects_.Find(id), record.origin != Origin::kSeed ? 1 : 0});
    }
    return pieces;
  }

  // Other ids under which the inspector's subjects are known: composite states by their requirement model.
  const ReportContext& context_;
  const SubjectTable& subjects_;
  const Run& run_;
  const KnowledgeBase& knowledge_;
  const EpisodeSummary& summary_;
  const ReportFrames& frames_;
  const std::vector<std::string>& images_;
  const ReportOptions& options_;
};

}  // namespace

Status AddReportData(const Run& run, const ReportFrames& frames, const std::vector<std::string>& images,
                     const ReportOptions& options, ReportBlocks* blocks) {
  const ReportContext context(run);
  const SubjectTable subjects(context);
  auto log = AddEventLog(context, subjects, &blocks->first, &blocks->later);
  if (!log) return log.error();
  if (Status added = AddSubjectDetails(context, subjects, &blocks->first); !added) return added;
  return blocks->first.AddPacked(
      "overview", "report-data", "application/json",
      PageJson(ReportAuthor(context, subjects, frames, images, options).Write(std::move(*log))));
}

std::string ReportTitle(const Run& run) {
  return Shortened(Printable(run.title()), kLongestTitle) + ": episode report";
}

}  // namespace aerascope
