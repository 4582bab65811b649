// A 128-bit content hash (XXH3), stable across machines and releases; identifies knowledge and event streams.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace aerascope {

struct Hash128 {
  std::uint64_t high = 0;
  std::uint64_t low = 0;
  auto operator<=>(const Hash128&) const = default;
};

Hash128 HashOf(std::string_view bytes);

// 32 lower-case hexadecimal digits.
std::string ToText(Hash128 hash);

// The hash of a stream that arrives in pieces; equal to HashOf of the pieces joined.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(Hasher&&) noexcept;
  Hasher& operator=(Hasher&&) noexcept;
  void Add(std::string_view bytes);
  Hash128 Digest() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace aerascope
