#include "engine/query/run_diff.h"

#include <algorithm>
#include <map>

#include "engine/base/text.h"
#include "engine/kb/term_codec.h"
#include "engine/query/describe.h"
#include "engine/query/episode_summary.h"
#include "engine/query/words.h"

namespace aerascope {
namespace {

constexpr std::size_t kMostLines = 80;
constexpr std::size_t kLongestText = 1'000'000;  // of a file that is compared line by line

// ---- settings

using Settings = std::vector<std::pair<std::string, std::string>>;

// Those of the start in their order, then parameters and settings by name.
Settings SettingsOf(const Run& run) {
  const EpisodeStarted& started = run.started();
  Settings settings = {{"scenario", started.scenario},
                       {"world", started.world},
                       {"seed", std::to_string(started.seed)},
                       {"sampling period", ToText(Duration{started.sampling_period_us})},
                       {"program version", run.header().program_version}};
  std::map<std::string, std::string> more;
  for (const Parameter& parameter : started.parameters) more["parameter " + parameter.name] = parameter.value;
  for (const auto& [name, value] : run.header().settings) {
    // Said by the start, or in the scenario's own file.
    if (name == "title" || name == "world.kind" || name == "story") continue;
    more["setting " + name] = value;
  }
  for (const auto& [name, value] : more) settings.emplace_back(name, value);
  return settings;
}

std::optional<std::string> ValueIn(const Settings& settings, const std::string& name) {
  const auto it = std::find_if(settings.begin(), settings.end(),
                               [&](const auto& setting) { return setting.first == name; });
  if (it == settings.end()) return std::nullopt;
  return it->second;
}

std::vector<SettingDifference> DifferingSettings(const Run& left, const Run& right) {
  const Settings a = SettingsOf(left);
  const Settings b = SettingsOf(right);
  std::vector<std::string> names;
  for (const auto& [name, value] : a) names.push_back(name);
  for (const auto& [name, value] : b)
    if (!ValueIn(a, name)) names.push_back(name);
  // The first ones are of the start and in both; the rest is by name, whichever side it is from.
  constexpr std::ptrdiff_t kOfTheStart = 5;
  std::sort(names.begin() + kOfTheStart, names.end());
  std::vector<SettingDifference> differences;
  for (const std::string& name : names) {
    std::optional<std::string> here = ValueIn(a, name);
    std::optional<std::string> there = ValueIn(b, name);
    // Where it is the world's seed, that says it already.
    if (name == "setting random_seed" && here == ValueIn(a, "seed") && there == ValueIn(b, "seed")) continue;
    if (here != there) differences.push_back({name, std::move(here), std::move(there)});
  }
  return differences;
}

// ---- files

std::vector<FileDifference> DifferingFiles(const Run& left, const Run& right) {
  std::map<std::string, std::pair<const NamedFile*, const NamedFile*>> files;
  for (const NamedFile& file : left.header().files) files[file.name].first = &file;
  for (const NamedFile& file : right.header().files) files[file.name].second = &file;
  std::vector<FileDifference> differences;
  for (const auto& [name, pair] : files) {
    const auto& [a, b] = pair;
    if (a && b && a->bytes == b->bytes) continue;
    FileDifference difference{name, a != nullptr, b != nullptr, {}};
    const auto is_text = [](const NamedFile& file) {
      return file.bytes.size() <= kLongestText && file.bytes.find('\0') == std::string::npos;
    };
    if (a && b && is_text(*a) && is_text(*b))
      difference.lines = DifferingLines(a->bytes, b->bytes, kMostLines);
    differences.push_back(std::move(difference));
  }
  return differences;
}

// ---- where the stories part

// One run's steps, each under a text that does not depend on the run's numbers.
class Story {
 public:
  explicit Story(const RunUpTo& side) : run_(side.run), at_(side.at) {
    for (const EventId id : run_.OfKind<DriveInjected>()) {
      const auto* drive = run_.FindBody<DriveInjected>(id);
      drives_[drive->goal] = drive->title;
    }
  }

  // To the next step; false at the end.
  bool Next() {
    for (; next_ < run_.events().size(); ++next_) {
      const Event& event = run_.events()[next_];
      if (event.time > at_) break;
      if (event.simulation.valid()) continue;
      key_ = std::visit([&](const auto& body) { return KeyOf(body); }, event.body);
      if (key_.empty()) continue;
      key_ += " in frame " + std::to_string(event.frame);
      event_ = &event;
      ++next_;
      return true;
    }
    event_ = nullptr;
    key_.clear();
    return false;
  }
  const std::string& key() const { return key_; }
  std::optional<StoryStep> Step() const {
    if (!event_) return std::nullopt;
    return StoryStep{event_->id, event_->time, SentenceOf(run_, *event_)};
  }

 private:
  static std::string FunctionOf(const Term& command) {
    return IsCommand(command) ? Encode(command[0]) : Encode(command);
  }
  std::string ContentOf(ModelId id) const {
    const ModelRecord* record = run_.final_knowledge().Find(id);
    return record ? ToText(record->canonical.hash) : "?";
  }
  std::string DriveText(GoalId goal) const {
    const auto drive = drives_.find(goal);
    return drive == drives_.end() ? "" : drive->second;
  }

  std::string KeyOf(const CommandIssued& e) const {
    return "command " + FunctionOf(e.command) + " by " + std::string(EnumName(e.by));
  }
  std::string KeyOf(const CommandRefused& e) const { return "refused " + FunctionOf(e.command); }
  std::string KeyOf(const ModelCreated& e) const { return "model " + ContentOf(e.model.id); }
  std::string KeyOf(const ModelStateChanged& e) const {
    return "state " + ContentOf(e.model) + " " + std::string(EnumName(e.after));
  }
  std::string KeyOf(const EvidenceUpdated& e) const {
    return "evidence " + ContentOf(e.model) + (e.success ? " for" : " against");
  }
  std::string KeyOf(const DriveInjected& e) const { return "drive " + e.title; }
  std::string KeyOf(const GoalAchieved& e) const {
    return drives_.contains(e.goal) ? "reached " + DriveText(e.goal) : "";
  }
  std::string KeyOf(const GoalFailed& e) const {
    return drives_.contains(e.goal) ? "failed " + DriveText(e.goal) : "";
  }
  template <class Other>
  std::string KeyOf(const Other&) const {
    return "";
  }

  const Run& run_;
  const Time at_;
  std::map<GoalId, std::string> drives_;
  std::size_t next_ = 0;
  const Event* event_ = nullptr;
  std::string key_;
};

std::optional<PartingOfRuns> PartingOf(const RunUpTo& left, const RunUpTo& right) {
  Story a(left);
  Story b(right);
  for (std::size_t common = 0;; ++common) {
    const bool more_left = a.Next();
    const bool more_right = b.Next();
    if (!more_left && !more_right) return std::nullopt;
    if (a.key() != b.key()) return PartingOfRuns{common, a.Step(), b.Step()};
  }
}

// ---- drives

using Endings = std::vector<std::pair<std::pair<std::string, int>, DriveEnding>>;

// By title and which one with that title.
Endings EndingsOf(const RunUpTo& side) {
  Endings endings;
  std::map<std::string, int> seen;
  for (const DriveOutcome& drive : Summarise(side.run).drives) {
    if (drive.from > side.at) continue;
    const bool open = drive.outcome == Outcome::kOpen || drive.until > side.at;
    endings.push_back(
        {{drive.title, seen[drive.title]++}, open ? DriveEnding{} : DriveEnding{drive.outcome, drive.until}});
  }
  return endings;
}

std::vector<DriveDifference> DrivesOf(const RunUpTo& left, const RunUpTo& right) {
  const Endings a = EndingsOf(left);
  const Endings b = EndingsOf(right);
  const std::map<std::pair<std::string, int>, DriveEnding> in_a(a.begin(), a.end());
  const std::map<std::pair<std::string, int>, DriveEnding> in_b(b.begin(), b.end());
  std::vector<DriveDifference> drives;
  for (const auto& [key, ending] : a) {
    const auto other = in_b.find(key);
    drives.push_back(
        {key.first, ending, other == in_b.end() ? std::nullopt : std::optional<DriveEnding>(other->second)});
  }
  for (const auto& [key, ending] : b)
    if (!in_a.contains(key)) drives.push_back({key.first, std::nullopt, ending});
  return drives;
}

// ---- in words

std::string SentenceOf(const SettingDifference& setting, const std::string& left, const std::string& right) {
  const std::string name = Printable(setting.name);
  if (!setting.right) return "Only " + left + " has a " + name + ": " + Printable(*setting.left) + ".";
  if (!setting.left) return "Only " + right + " has a " + name + ": " + Printable(*setting.right) + ".";
  return "The " + name + " is " + Printable(*setting.left) + " in " + left + " and " +
         Printable(*setting.right) + " in " + right + ".";
}

std::string SentenceOf(const FileDifference& file) {
  const std::string name = Printable(file.name);
  const std::size_t lines = file.lines.lines.size() + file.lines.hidden;
  if (lines == 0) return "The file " + name + " is another one.";
  return "The file " + name + " differs in " + std::to_string(lines) + (lines == 1 ? " line." : " lines.");
}

// The files that one run has alone, in one sentence: a world with meshes has many.
std::string AloneSentence(const std::vector<std::string>& names, const std::string& side) {
  constexpr std::size_t kNamed = 3;
  if (names.size() == 1) return "Only " + side + " has the file " + names.front() + ".";
  std::vector<std::string> shown = names;
  if (names.size() > kNamed + 1) {
    shown.resize(kNamed);
    shown.push_back(std::to_string(names.size() - kNamed) + " more");
  }
  return "Only " + side + " has the files " + InWords(shown) + ".";
}

std::string SentenceOf(const PartingOfRuns& parting, const std::string& left, const std::string& right) {
  const auto step = [](const std::optional<StoryStep>& side, const std::string& name) {
    if (!side) return name + " has no further step";
    return name + " has " + IdText(side->event) + " at " + SecondsText(side->time) + ", " + side->sentence;
  };
  std::string text = "The stories part after " + std::to_string(parting.common) +
                     (parting.common == 1 ? " common step: " : " common steps: ");
  text += step(parting.left, left) + (parting.left ? " " : "; ") + step(parting.right, right);
  return parting.right ? text : text + ".";
}

}  // namespace

std::string EndingText(const std::optional<DriveEnding>& ending) {
  if (!ending) return "not set";
  switch (ending->outcome) {
    case Outcome::kOpen:
      return "open";
    case Outcome::kReached:
      return "reached at " + SecondsText(ending->until);
    case Outcome::kFailed:
      return "missed at " + SecondsText(ending->until);
  }
  return {};
}

std::vector<std::string> SentencesOf(const RunDiff& difference, const std::string& left_name,
                                     const std::string& right_name) {
  std::vector<std::string> sentences;
  for (const SettingDifference& setting : difference.settings)
    sentences.push_back(SentenceOf(setting, left_name, right_name));
  std::vector<std::string> left_alone;
  std::vector<std::string> right_alone;
  for (const FileDifference& file : difference.files) {
    if (file.left && file.right)
      sentences.push_back(SentenceOf(file));
    else
      (file.left ? left_alone : right_alone).push_back(Printable(file.name));
  }
  if (!left_alone.empty()) sentences.push_back(AloneSentence(left_alone, left_name));
  if (!right_alone.empty()) sentences.push_back(AloneSentence(right_alone, right_name));
  if (difference.parting) sentences.push_back(SentenceOf(*difference.parting, left_name, right_name));
  for (const DriveDifference& drive : difference.drives) {
    if (drive.left == drive.right) continue;
    sentences.push_back("Drive \"" + Printable(drive.title) + "\": " + EndingText(drive.left) + " in " +
                        left_name + ", " + EndingText(drive.right) + " in " + right_name + ".");
  }
  return sentences;
}

RunDiff DiffRuns(const RunUpTo& left, const RunUpTo& right) {
  return {DifferingSettings(left.run, right.run), DifferingFiles(left.run, right.run), PartingOf(left, right),
          DrivesOf(left, right)};
}

}  // namespace aerascope
