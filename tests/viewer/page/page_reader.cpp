#include "tests/viewer/page/page_reader.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <map>

namespace aerascope {
namespace {

std::string FromBase64(std::string_view text) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos) continue;
    group = group << 6 | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(group >> bits & 0xff);
  }
  return bytes;
}

}  // namespace

std::string Gunzip(std::string_view packed) {
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string text;
  int status = Z_OK;
  while (status == Z_OK) {
    char piece[65536];
    stream.next_out = reinterpret_cast<Bytef*>(piece);
    stream.avail_out = sizeof piece;
    status = inflate(&stream, Z_NO_FLUSH);
    text.append(piece, sizeof piece - stream.avail_out);
  }
  EXPECT_EQ(status, Z_STREAM_END);
  inflateEnd(&stream);
  return text;
}

std::string BlockOf(const std::string& html, const std::string& id) {
  const std::size_t start = html.find(" id=\"" + id + "\"");
  if (start == std::string::npos) return {};
  const std::size_t inside = html.find('>', start) + 1;
  const std::string bytes =
      FromBase64(std::string_view(html).substr(inside, html.find("</script>", inside) - inside));
  const bool packed = html.substr(start, inside - start).find("data-packed") != std::string::npos;
  return packed ? Gunzip(bytes) : bytes;
}

std::uint64_t ColumnReader::Unsigned() {
  std::uint64_t value = 0;
  for (int shift = 0;; shift += 7) {
    const std::uint8_t byte = Byte();
    value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
    if (byte < 0x80) return value;
  }
}

std::int64_t ColumnReader::Signed() {
  const std::uint64_t value = Unsigned();
  return value & 1 ? -static_cast<std::int64_t>(value >> 1) - 1 : static_cast<std::int64_t>(value >> 1);
}

std::string ColumnReader::Take(std::size_t count) {
  at_ += count;
  return bytes_.substr(at_ - count, count);
}

TextColumnReader::TextColumnReader(std::string bytes) : columns_(std::move(bytes)) {
  const std::string forms = columns_.Take(columns_.Unsigned());
  std::vector<std::string> words(1);
  for (const char c : forms) {
    if (c == '\n') {
      forms_.push_back(std::exchange(words, {""}));
    } else if (c == '\x01') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
}

std::vector<std::optional<std::string>> TextColumnReader::Next(const std::vector<std::int64_t>& rows) {
  std::vector<std::optional<std::string>> texts(rows.size());
  std::vector<std::size_t> order;                         // forms, as they come
  std::map<std::size_t, std::vector<std::size_t>> where;  // form -> rows
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t form = columns_.Unsigned();
    if (form == 0) continue;
    if (where[form].empty()) order.push_back(form);
    where[form].push_back(i);
    texts[i] = forms_.at(form - 1).at(0);
  }
  for (const std::size_t form : order) {
    for (std::size_t place = 1; place < forms_[form - 1].size(); ++place) {
      const std::uint64_t how = columns_.Unsigned();
      std::int64_t before = 0;
      for (const std::size_t i : where[form]) {
        before = columns_.Signed() + (how & 1 ? rows[i] : before);
        std::string digits = std::to_string(std::abs(before));
        if (const std::size_t decimals = how >> 1; decimals > 0) {
          if (digits.size() <= decimals) digits.insert(0, decimals + 1 - digits.size(), '0');
          digits.insert(digits.size() - decimals, ".");
          digits.erase(digits.find_last_not_of('0') + 1);
          if (digits.back() == '.') digits.pop_back();
        }
        *texts[i] += (before < 0 ? "-" : "") + digits + forms_[form - 1][place];
      }
    }
  }
  return texts;
}

}  // namespace aerascope
