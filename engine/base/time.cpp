#include "engine/base/time.h"

#include <charconv>
#include <cmath>

namespace aerascope {
namespace {

std::string SecondsText(std::int64_t us) {
  std::string sign = us < 0 ? "-" : "";
  const std::uint64_t magnitude =
      us < 0 ? 0 - static_cast<std::uint64_t>(us) : static_cast<std::uint64_t>(us);
  std::string text = sign + std::to_string(magnitude / 1'000'000);
  std::uint64_t fraction = magnitude % 1'000'000;
  if (fraction != 0) {
    std::string digits = std::to_string(fraction);
    digits.insert(0, 6 - digits.size(), '0');
    while (digits.back() == '0') digits.pop_back();
    text += "." + digits;
  }
  return text + "s";
}

std::optional<std::int64_t> ParseMicroseconds(std::string_view text) {
  double scale = 1e6;
  if (text.ends_with("ms")) {
    scale = 1e3;
    text.remove_suffix(2);
  } else if (text.ends_with("us")) {
    scale = 1;
    text.remove_suffix(2);
  } else if (text.ends_with("s")) {
    text.remove_suffix(1);
  }
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) return std::nullopt;
  if (!std::isfinite(value) || std::abs(value * scale) > 1e15) return std::nullopt;
  return std::llround(value * scale);
}

}  // namespace

std::string ToText(Time time) {
  return time >= kForever ? "forever" : SecondsText(time.us);
}

std::string ToText(Duration duration) {
  return SecondsText(duration.us);
}

std::string ToText(TimeInterval interval) {
  return "[" + ToText(interval.after) + ", " + ToText(interval.before) + ")";
}

std::optional<Time> ParseTime(std::string_view text) {
  if (text == "forever") return kForever;
  const auto us = ParseMicroseconds(text);
  if (!us) return std::nullopt;
  return Time{*us};
}

std::optional<Duration> ParseDuration(std::string_view text) {
  const auto us = ParseMicroseconds(text);
  if (!us) return std::nullopt;
  return Duration{*us};
}

}  // namespace aerascope
