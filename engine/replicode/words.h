// The words of Replicode that both reader and writer must know.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "engine/base/text.h"
#include "engine/kb/model.h"

namespace aerascope {

// Guard operators: as used in knowledge, and OpenAERA's opcode name as its dumps write it.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kArithmeticWords{
    {{"+", "add"}, {"-", "sub"}, {"*", "mul"}, {"/", "div"}}};
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kTestWords{
    {{"=", "equ"}, {"<>", "neq"}, {"<", "lsr"}, {">", "gtr"}, {"<=", "lse"}, {">=", "gte"}}};

// The groups of OpenAERA in whose views models have their activation.
inline constexpr std::string_view kPrimaryGroup = "primary";
inline constexpr std::string_view kSecondaryGroup = "secondary";

// Values with a name of their own; not free for entities and labels.
inline constexpr std::array<std::string_view, 8> kConstantWords{
    "nil", "true", "false", "forever", "GIGASEC", "MAX_TIME", "sampling_period", "now"};

// Structured values and how many elements they have.
inline constexpr std::array<std::pair<std::string_view, std::size_t>, 3> kValueStructs{
    {{"vec2", 2}, {"vec3", 3}, {"ti", 2}}};

// A time as late as this, OpenAERA's GIGASEC, means "for ever".
inline constexpr std::int64_t kGigaSecondUs = 1'000'000'000'000'000;

// More components in one composite state than this have no use, and make its canonical form slow.
inline constexpr std::size_t kMaxComponents = 64;

// Replicode says how often a model was tried and its success rate; how often it was right follows. Evidence
// has at most 9 significant digits, so a rate with a few more gives it exactly.
inline Evidence EvidenceOf(double rate, double total) {
  return {RoundNumber(rate * total), total};
}

}  // namespace aerascope
