#include "engine/kb/term_packing.h"

#include <algorithm>
#include <cassert>

namespace aerascope {
namespace {

// Enough for what a reasoner speaks of in some frames; the packer's slots stay in the nearest caches.
constexpr std::size_t kSlots = 2048;
constexpr std::uint16_t kWhole = 0xFFFF;  // no slot: a whole term follows
static_assert(kSlots < kWhole);
constexpr std::uint64_t kNoSerial = ~std::uint64_t{0};
constexpr std::size_t kLeastRoom = 4096;

// What a term of a kind is told by, beside its kind. Bytes that are not handed over cost nothing.
enum class ToldBy { kNothing, kInteger, kNumber, kText, kItems, kTextAndItems };
constexpr ToldBy HowToTell(TermKind kind) {
  switch (kind) {
    case TermKind::kNil:
    case TermKind::kWildcard:
      return ToldBy::kNothing;
    case TermKind::kEntity:
    case TermKind::kOntology:
    case TermKind::kString:
      return ToldBy::kText;
    case TermKind::kNumber:
      return ToldBy::kNumber;
    case TermKind::kTime:
    case TermKind::kDuration:
    case TermKind::kBool:
    case TermKind::kVariable:
    case TermKind::kCompositeState:
    case TermKind::kModel:
      return ToldBy::kInteger;
    case TermKind::kSet:
      return ToldBy::kItems;
    case TermKind::kStruct:
      return ToldBy::kTextAndItems;
  }
  return ToldBy::kNothing;
}
constexpr bool HasText(ToldBy told) {
  return told == ToldBy::kText || told == ToldBy::kTextAndItems;
}
constexpr bool HasItems(ToldBy told) {
  return told == ToldBy::kItems || told == ToldBy::kTextAndItems;
}

}  // namespace

void PackedBytes::Grow(std::size_t count) {
  room_ = std::max({kLeastRoom, 2 * room_, size_ + count});
  std::unique_ptr<char[]> wider(new char[room_]);
  if (size_ > 0) std::memcpy(wider.get(), bytes_.get(), size_);
  bytes_ = std::move(wider);
}

void PackedBytes::Prepare(std::size_t count) {
  if (room_ >= count) return;
  Grow(count - size_);
  std::memset(bytes_.get() + size_, 0, room_ - size_);
}

const char* PackedReader::Skip(std::size_t count) {
  assert(static_cast<std::size_t>(end_ - at_) >= count && "a packer and its unpacker read alike");
  return std::exchange(at_, at_ + count);
}

TermPacker::TermPacker() : slots_(kSlots, kNoSerial) {}

void TermPacker::Pack(const Term& term, PackedBytes* to) {
  const std::size_t slot = term.node_->hash % kSlots;
  if (slots_[slot] == term.node_->serial) {
    to->Put(static_cast<std::uint16_t>(slot));
  } else {
    PackWhole(term, slot, to);
  }
}

void TermPacker::PackWhole(const Term& term, std::size_t slot, PackedBytes* to) {
  const Term::Node& node = *term.node_;
  to->Put(kWhole);
  to->Put(static_cast<std::uint16_t>(slot));
  to->Put(node.kind);
  const ToldBy told = HowToTell(node.kind);
  if (told == ToldBy::kInteger) to->Put(node.integer);
  if (told == ToldBy::kNumber) to->Put(node.number);
  if (HasText(told)) to->PutText(node.text);
  if (HasItems(told)) to->Put(node.size);
  // Parts may push each other out; the unpacker has them in hand by then.
  for (const Term& item : term.items()) Pack(item, to);
  slots_[slot] = node.serial;
}

TermUnpacker::TermUnpacker() : slots_(kSlots) {}

Term TermUnpacker::Unpack(PackedReader* from) {
  if (const auto slot = from->Get<std::uint16_t>(); slot != kWhole) return slots_[slot];
  const auto slot = from->Get<std::uint16_t>();
  const auto kind = from->Get<TermKind>();
  const ToldBy told = HowToTell(kind);
  const auto integer = told == ToldBy::kInteger ? from->Get<std::int64_t>() : 0;
  const auto number = told == ToldBy::kNumber ? from->Get<double>() : 0;
  const std::string_view text = HasText(told) ? from->GetText() : std::string_view();
  const auto size = HasItems(told) ? from->Get<std::uint32_t>() : 0;
  constexpr std::size_t kFew = 8;
  Term few[kFew];
  std::vector<Term> many(size > kFew ? size : 0);
  Term* const items = size > kFew ? many.data() : few;
  for (std::uint32_t i = 0; i < size; ++i) items[i] = Unpack(from);
  if (kind == TermKind::kNil) {
    slots_[slot] = Term::Nil();
  } else if (kind == TermKind::kVariable) {
    slots_[slot] = Term::Variable(static_cast<int>(integer));
  } else if (kind == TermKind::kWildcard) {
    slots_[slot] = Term::Wildcard();
  } else {
    slots_[slot] = Term::Make({kind, integer, number, text, {items, size}});
  }
  return slots_[slot];
}

}  // namespace aerascope
