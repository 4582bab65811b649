// What the program says to a person: errors, and progress that is one moving line on a terminal and plain
// lines elsewhere. Results go to standard output, everything here to standard error.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace aerascope {

// "aerascope: <sentence>" on standard error; returns the exit status for trouble.
int Fail(const Error& error);
int Fail(std::string_view message);

// Says on standard error that an episode was cut short, if it was.
void NoteIncomplete(const std::string& path, bool complete, std::size_t events);

// Progress of one activity. On a terminal the line is overwritten; elsewhere a line is printed only when its
// text is marked worth keeping.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void Show(const std::string& text);  // passing: only seen on a terminal
  void Keep(const std::string& text);  // stays: a line of its own everywhere

 private:
  void Clear();
  bool terminal_;
  bool shown_ = false;
};

}  // namespace aerascope
