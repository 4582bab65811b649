// Terms as bytes for another thread: exact, made in some ten nanoseconds where the same term went before, and
// sharing nothing with the term they were made from.
//
// Both ends remember the terms that went last, in numbered slots, and fill these alike: a term that is still
// in its slot is two bytes, another one is told with its slot, whatever it pushed out. So the two belong
// together: an unpacker reads what one packer wrote, all of it, in order. The bytes are for this process only
// and are never stored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/kb/term.h"

namespace aerascope {

// Bytes that grow at the end.
class PackedBytes {
 public:
  std::size_t size() const { return size_; }
  const char* data() const { return bytes_.get(); }
  void clear() { size_ = 0; }
  // Room for so many bytes, its memory touched already, so that whoever fills it first does not wait for
  // that.
  void Prepare(std::size_t count);
  void swap(PackedBytes& other) noexcept {
    bytes_.swap(other.bytes_);
    std::swap(size_, other.size_);
    std::swap(room_, other.room_);
  }

  // Asks for the memory that what comes next will be put into: another thread read there before, and to get
  // it back takes longer than to fill it.
  void Expect() const {
    constexpr std::size_t kLine = 64;
    for (std::size_t ahead = 2 * kLine; ahead <= 6 * kLine && size_ + ahead < room_; ahead += kLine) {
      __builtin_prefetch(bytes_.get() + size_ + ahead, 1);
    }
  }

  // A number, a boolean or an enum as it lies in memory.
  template <class T>
  void Put(T value) {
    static_assert(std::is_trivially_copyable_v<T>);
    PutBytes(&value, sizeof value);
  }
  void PutBytes(const void* bytes, std::size_t count) {
    if (room_ - size_ < count) Grow(count);
    if (count > 0) std::memcpy(bytes_.get() + size_, bytes, count);
    size_ += count;
  }
  void PutText(std::string_view text) {
    Put(static_cast<std::uint32_t>(text.size()));
    PutBytes(text.data(), text.size());
  }

 private:
  void Grow(std::size_t count);

  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
  std::size_t room_ = 0;
};

// Reads PackedBytes from the beginning; asking for more than there is, or for something else, is a mistake of
// ours.
class PackedReader {
 public:
  explicit PackedReader(const PackedBytes& bytes) : at_(bytes.data()), end_(bytes.data() + bytes.size()) {}

  bool at_end() const { return at_ == end_; }
  template <class T>
  T Get() {
    T value;
    std::memcpy(&value, Skip(sizeof value), sizeof value);
    return value;
  }
  std::string_view GetText() {
    const auto size = Get<std::uint32_t>();
    return {Skip(size), size};
  }
  const char* Skip(std::size_t count);

 private:
  const char* at_;
  const char* end_;
};

class TermPacker {
 public:
  TermPacker();
  void Pack(const Term& term, PackedBytes* to);

 private:
  void PackWhole(const Term& term, std::size_t slot, PackedBytes* to);

  std::vector<std::uint64_t> slots_;  // serial numbers of the terms there
};

// Makes the terms in the space its thread is in.
class TermUnpacker {
 public:
  TermUnpacker();
  Term Unpack(PackedReader* from);

 private:
  std::vector<Term> slots_;
};

}  // namespace aerascope
