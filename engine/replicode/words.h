// The words of Replicode that both reader and writer must know.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace aerascope {

// Guard operators: as used in knowledge, and OpenAERA's opcode name as its dumps write it.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kArithmeticWords{
    {{"+", "add"}, {"-", "sub"}, {"*", "mul"}, {"/", "div"}}};
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kTestWords{
    {{"=", "equ"}, {"<>", "neq"}, {"<", "lsr"}, {">", "gtr"}, {"<=", "lse"}, {">=", "gte"}}};

// Values with a name of their own; not free for entities and labels.
inline constexpr std::array<std::string_view, 8> kConstantWords{
    "nil", "true", "false", "forever", "GIGASEC", "MAX_TIME", "sampling_period", "now"};

// Structured values and how many elements they have.
inline constexpr std::array<std::pair<std::string_view, std::size_t>, 3> kValueStructs{
    {{"vec2", 2}, {"vec3", 3}, {"ti", 2}}};

// More components in one composite state than this have no use, and make its canonical form slow.
inline constexpr std::size_t kMaxComponents = 64;

}  // namespace aerascope
