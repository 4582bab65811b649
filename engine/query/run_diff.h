// What went into two runs differently, where their stories part, and how each ended: often the reason for a
// difference of what was learned.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/query/goal_tree.h"
#include "engine/query/line_diff.h"
#include "engine/query/run.h"

namespace aerascope {

// A run up to a moment.
struct RunUpTo {
  const Run& run;
  Time at = kForever;
};

struct SettingDifference {
  std::string name;                 // "seed", "parameter analogy_mode"
  std::optional<std::string> left;  // none where that run has no such setting
  std::optional<std::string> right;
};

// A file of the scenario.
struct FileDifference {
  std::string name;
  bool left = false;  // whether that run has it
  bool right = false;
  LineDifference lines;  // empty for files that are no text, or that only one run has
};

// A step of a run's story that counts here: a command, a piece of knowledge, what became of it or of a drive.
struct StoryStep {
  EventId event;
  Time time;
  std::string sentence;
};
// The first step that differs; none on a side whose story ended before.
struct PartingOfRuns {
  std::size_t common = 0;  // steps before it
  std::optional<StoryStep> left;
  std::optional<StoryStep> right;
};

struct DriveEnding {
  Outcome outcome = Outcome::kOpen;
  Time until;  // of a decided one: when
  bool operator==(const DriveEnding&) const = default;
};
// A drive of either run; the second with a title is matched with the second of the other run.
struct DriveDifference {
  std::string title;
  std::optional<DriveEnding> left;
  std::optional<DriveEnding> right;
};

struct RunDiff {
  std::vector<SettingDifference> settings;  // of the start, then by name
  std::vector<FileDifference> files;        // by name
  std::optional<PartingOfRuns> parting;
  std::vector<DriveDifference> drives;  // all, in the order of the left run, then the right one's own

  // Something went in differently.
  bool differs() const { return !settings.empty() || !files.empty(); }
};

RunDiff DiffRuns(const RunUpTo& left, const RunUpTo& right);

// "reached at 9 s", "missed at 12 s", "open", "not set": of a drive on one side.
std::string EndingText(const std::optional<DriveEnding>& ending);
// What differs, a sentence each: settings, files (without their lines), the parting, drives that ended
// differently.
std::vector<std::string> SentencesOf(const RunDiff& difference, const std::string& left_name,
                                     const std::string& right_name);

}  // namespace aerascope
