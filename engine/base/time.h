// Engine time: whole microseconds since the start of the episode, and half-open intervals of it.
//
// The clock is virtual (semantics 7.1): reasoning takes no time, frames are a fixed sampling period apart.
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace aerascope {

struct Duration {
  std::int64_t us = 0;
  constexpr auto operator<=>(const Duration&) const = default;
};

struct Time {
  std::int64_t us = 0;
  constexpr auto operator<=>(const Time&) const = default;
};

constexpr Time operator+(Time t, Duration d) {
  return {t.us + d.us};
}
constexpr Time operator-(Time t, Duration d) {
  return {t.us - d.us};
}
constexpr Duration operator-(Time a, Time b) {
  return {a.us - b.us};
}
constexpr Duration operator+(Duration a, Duration b) {
  return {a.us + b.us};
}
constexpr Duration operator-(Duration a, Duration b) {
  return {a.us - b.us};
}
constexpr Duration operator*(Duration d, std::int64_t n) {
  return {d.us * n};
}

constexpr Duration Milliseconds(std::int64_t ms) {
  return {ms * 1000};
}
constexpr Duration Seconds(std::int64_t s) {
  return {s * 1'000'000};
}

// The end of everything that never expires. Far enough from the limit that adding to it does not overflow.
inline constexpr Time kForever{std::numeric_limits<std::int64_t>::max() / 4};

// Two times closer than this are the same instant (semantics 1.5; strictly less).
inline constexpr Duration kTimeTolerance{10'000};

constexpr bool Synchronous(Time a, Time b) {
  const std::int64_t difference = a.us - b.us;
  return (difference < 0 ? -difference : difference) < kTimeTolerance.us;
}

// [after, before): contains `after`, does not contain `before`. Empty when before <= after.
struct TimeInterval {
  Time after;
  Time before;

  constexpr bool operator==(const TimeInterval&) const = default;
  constexpr bool Contains(Time t) const { return after <= t && t < before; }
  constexpr bool Includes(TimeInterval inner) const { return after <= inner.after && before >= inner.before; }
  constexpr bool Overlaps(TimeInterval other) const { return after < other.before && before > other.after; }
};

// The common part of two intervals, or nothing if they only touch or do not meet. A zero-length interval
// strictly inside the other gives itself (semantics 1.6).
constexpr std::optional<TimeInterval> Intersection(TimeInterval a, TimeInterval b) {
  if (!a.Overlaps(b)) return std::nullopt;
  return TimeInterval{std::max(a.after, b.after), std::min(a.before, b.before)};
}

inline constexpr TimeInterval kAlways{{0}, kForever};

// Seconds with as many decimals as needed: "3.2s", "0.76s"; "forever" for kForever.
std::string ToText(Time time);
std::string ToText(Duration duration);
std::string ToText(TimeInterval interval);  // "[0.7s, 0.8s)"

// Reads what ToText writes, and also "700ms" and "3" (seconds). Nothing on anything else, or beyond 10^9 s.
std::optional<Time> ParseTime(std::string_view text);
std::optional<Duration> ParseDuration(std::string_view text);

}  // namespace aerascope
