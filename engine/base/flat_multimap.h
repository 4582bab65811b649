// A FlatMultimap keeps values under 64-bit keys, several under one key, in the order they were added.
//
// All of it lies in two arrays, so that making, copying and dropping one costs little: situations are made
// many times a frame. Keys are hashes already. Values are small and trivially copyable.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <type_traits>
#include <vector>

namespace aerascope {

template <class Value>
class FlatMultimap {
  static_assert(std::is_trivially_copyable_v<Value>);
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  struct Entry {
    Value value;
    std::uint32_t next;
  };

 public:
  // The values under one key, in the order they were added.
  class Range {
   public:
    class Iterator {
     public:
      using iterator_category = std::forward_iterator_tag;
      using value_type = Value;
      using difference_type = std::ptrdiff_t;
      using pointer = const Value*;
      using reference = const Value&;

      Iterator() = default;
      Iterator(const std::vector<Entry>* entries, std::uint32_t at) : entries_(entries), at_(at) {}
      const Value& operator*() const { return (*entries_)[at_].value; }
      Iterator& operator++() {
        at_ = (*entries_)[at_].next;
        return *this;
      }
      Iterator operator++(int) {
        Iterator before = *this;
        ++*this;
        return before;
      }
      bool operator==(const Iterator& other) const { return at_ == other.at_; }

     private:
      const std::vector<Entry>* entries_ = nullptr;
      std::uint32_t at_ = kNone;
    };

    Range() = default;
    Range(const std::vector<Entry>* entries, std::uint32_t first, std::uint32_t count)
        : entries_(entries), first_(first), count_(count) {}
    Iterator begin() const { return {entries_, first_}; }
    Iterator end() const { return {entries_, kNone}; }
    std::size_t size() const { return count_; }
    bool empty() const { return count_ == 0; }

   private:
    const std::vector<Entry>* entries_ = nullptr;
    std::uint32_t first_ = kNone;
    std::uint32_t count_ = 0;
  };

  // The range is good until the next change.
  Range Find(std::uint64_t key) const {
    if (heads_.empty()) return {};
    const Head& head = heads_[PlaceOf(key)];
    return head.count == 0 ? Range{} : Range{&entries_, head.first, head.count};
  }

  void Add(std::uint64_t key, Value value) {
    if ((used_ + 1) * 2 > heads_.size()) Grow();
    Head& head = heads_[PlaceOf(key)];
    const auto entry = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back({value, kNone});
    if (head.first == kNone) {
      if (!head.taken) ++used_;
      head = {key, entry, entry, 1, true};
      return;
    }
    entries_[head.last].next = entry;
    head.last = entry;
    ++head.count;
  }

  // Takes the value out of the list under the key, wherever it stands in it; does nothing if it is not there.
  void Remove(std::uint64_t key, const Value& value) {
    if (heads_.empty()) return;
    Head& head = heads_[PlaceOf(key)];
    std::uint32_t before = kNone;
    for (std::uint32_t at = head.first; at != kNone; before = at, at = entries_[at].next) {
      if (!(entries_[at].value == value)) continue;
      (before == kNone ? head.first : entries_[before].next) = entries_[at].next;
      if (head.last == at) head.last = before;
      --head.count;
      return;
    }
  }

 private:
  struct Head {
    std::uint64_t key = 0;
    std::uint32_t first = kNone;
    std::uint32_t last = kNone;
    std::uint32_t count = 0;
    bool taken = false;  // by this key, even if its list is empty by now
  };

  // Where the key's list begins, or would.
  std::size_t PlaceOf(std::uint64_t key) const {
    const std::size_t mask = heads_.size() - 1;
    std::size_t place = static_cast<std::size_t>((key ^ (key >> 29)) * 0x9e3779b97f4a7c15ULL >> 32) & mask;
    while (heads_[place].taken && heads_[place].key != key) place = (place + 1) & mask;
    return place;
  }

  void Grow() {
    std::vector<Head> old = std::move(heads_);
    heads_.assign(old.empty() ? 16 : old.size() * 2, Head{});
    for (const Head& head : old) {
      if (head.taken) heads_[PlaceOf(head.key)] = head;
    }
  }

  std::vector<Head> heads_;  // a power of two of them, at most half taken
  std::vector<Entry> entries_;
  std::size_t used_ = 0;
};

}  // namespace aerascope
