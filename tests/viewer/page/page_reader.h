// Reads back the blocks of a report's page, as its script does.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace aerascope {

// What Gzip packed.
std::string Gunzip(std::string_view packed);

// The bytes of the block with this id; empty if the page has none.
std::string BlockOf(const std::string& html, const std::string& id);

// Numbers as ColumnWriter packs them.
class ColumnReader {
 public:
  explicit ColumnReader(std::string bytes) : bytes_(std::move(bytes)) {}
  std::uint8_t Byte() { return static_cast<std::uint8_t>(bytes_.at(at_++)); }
  std::uint64_t Unsigned();
  std::int64_t Signed();
  std::string Take(std::size_t count);
  bool AtEnd() const { return at_ == bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

// Texts as TextColumns packs them.
class TextColumnReader {
 public:
  explicit TextColumnReader(std::string bytes);
  // The next column; `rows`: the own number of each row.
  std::vector<std::optional<std::string>> Next(const std::vector<std::int64_t>& rows);
  bool AtEnd() const { return columns_.AtEnd(); }

 private:
  ColumnReader columns_;
  std::vector<std::vector<std::string>> forms_;  // the words between the numbers
};

}  // namespace aerascope
