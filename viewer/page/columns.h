// Columns of whole numbers as bytes, for tables that are too long for JSON: each number takes as few bytes as
// it needs. The page's columns.js reads them back.
#pragma once

#include <cstdint>
#include <string>

namespace aerascope {

class ColumnWriter {
 public:
  void Byte(std::uint8_t value) { bytes_ += static_cast<char>(value); }

  // Seven bits a byte, lowest first; the top bit says that more follow.
  void Unsigned(std::uint64_t value) {
    while (value >= 0x80) {
      Byte(static_cast<std::uint8_t>(value | 0x80));
      value >>= 7;
    }
    Byte(static_cast<std::uint8_t>(value));
  }

  // Small ones of either sign stay short: 0, -1, 1, -2 ... become 0, 1, 2, 3 ...
  void Signed(std::int64_t value) {
    const auto bits = static_cast<std::uint64_t>(value);
    Unsigned(value < 0 ? ~(bits << 1) : bits << 1);
  }

  void Append(const ColumnWriter& other) { bytes_ += other.bytes_; }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace aerascope
