#include "viewer/app/terminal.h"

#include <unistd.h>

#include <cstdio>

#include "engine/base/text.h"

namespace aerascope {

int Fail(std::string_view message) {
  std::fprintf(stderr, "aerascope: %s\n", Printable(message).c_str());
  return 2;
}

int Fail(const Error& error) {
  return Fail(error.message);
}

void NoteIncomplete(const std::string& path, bool complete, std::size_t events) {
  if (complete) return;
  std::fprintf(stderr, "%s is incomplete: the run was cut short, the last event is #%zu\n",
               Printable(path).c_str(), events);
}

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  Clear();
}

void ProgressLine::Clear() {
  if (shown_) std::fputs("\r\x1b[K", stderr);
  shown_ = false;
}

void ProgressLine::Show(const std::string& text) {
  if (!terminal_) return;
  Clear();
  std::fputs(Printable(text).substr(0, 110).c_str(), stderr);
  std::fflush(stderr);
  shown_ = true;
}

void ProgressLine::Keep(const std::string& text) {
  Clear();
  std::fprintf(stderr, "%s\n", Printable(text).c_str());
}

}  // namespace aerascope
