#include "viewer/app/moment.h"

#include <filesystem>

namespace aerascope {

Result<Time> ParseMoment(const std::optional<std::string>& asked, const Run& run) {
  if (!asked) return run.end();
  const std::string& text = *asked;
  if (text.empty())
    return Error{
        "a moment was asked for, but it is empty; write it like 3.2s or 700ms, or leave it out for the end"};
  const auto time = ParseTime(text);
  if (!time) return Error{"'" + text + "' is not a time; write it like 3.2s or 700ms"};
  if (time->us < 0 || *time > run.end()) {
    return Error{"the episode lasts from 0s to " + ToText(run.end()) + "; " + text + " is outside of it"};
  }
  return *time;
}

EpisodeAt SplitEpisodeAt(const std::string& text) {
  const std::size_t at = text.rfind('@');
  // A file whose own name has an @ is meant as it is.
  if (at == std::string::npos || std::filesystem::exists(text)) return {text, std::nullopt};
  return {text.substr(0, at), text.substr(at + 1)};
}

}  // namespace aerascope
