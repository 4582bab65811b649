// Events handed over to another thread as bytes: what comes out is what went in, and nothing is shared.
#include "engine/event/event_packing.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <string>
#include <thread>
#include <vector>

#include "tests/engine/kb/build_terms.h"
#include "tests/support/any_event.h"
#include "tests/support/law.h"

namespace aerascope {
namespace {

Event Observed(std::int64_t id, const Term& payload) {
  Event event;
  event.id = {id};
  event.body = FactObserved{{id}, {true, payload, {Time{0}, Time{100}}, 1}, FactSource::kSensor};
  return event;
}

// Own: the bytes of a stream, cut into batches anywhere, give the stream again; every kind and field.
TEST(PackedEvents, GiveTheSameEventsInTheSpaceOfTheReader) {
  EXPECT_TRUE(Holds(400, [](std::uint64_t number) {
    AnyEvents any(number);
    std::vector<std::string> expected;
    std::vector<PackedBytes> batches(1);
    {
      EventPacker packer;
      std::vector<Event> earlier;
      for (std::int64_t id = 1; id <= 60; ++id) {
        // What comes again is told by its slot.
        Event event =
            !earlier.empty() && any.Chance()
                ? earlier[static_cast<std::size_t>(any.Below(static_cast<std::int64_t>(earlier.size())))]
                : any.AnyEvent(id);
        packer.Pack(event, &batches.back());
        expected.push_back(EncodeForDigest(event));
        earlier.push_back(std::move(event));
        if (any.Below(10) == 0) batches.emplace_back();
      }
    }
    std::vector<std::string> found;
    TermSpace space;
    std::thread reader([&] {
      const TermSpace::Scope in_space(space);
      EventUnpacker unpacker;
      for (const PackedBytes& batch : batches) {
        for (PackedReader bytes(batch); !bytes.at_end();)
          found.push_back(EncodeForDigest(unpacker.Unpack(&bytes)));
      }
    });
    reader.join();
    RC_ASSERT(found == expected);
    RC_ASSERT(space.CountNodes() == 0u);
  }));
}

// Own: more different terms than there are slots, then the first ones again; terms inside of terms push each
// other out meanwhile.
TEST(PackedEvents, GiveTheSameTermsWhenTheSlotsAreLongFull) {
  // Given twice as many different payloads as any slots, each with a part of its own
  constexpr int kPayloads = 5000;
  const auto payload = [](int i) { return MakeValue(E("h"), O("position"), Term::Set({N(i), N(i + 0.5)})); };
  EventPacker packer;
  EventUnpacker unpacker;
  PackedBytes bytes;
  // When they are packed, twice over
  for (int i = 0; i < 2 * kPayloads; ++i) packer.Pack(Observed(i + 1, payload(i % kPayloads)), &bytes);
  // Then each comes out as it was
  PackedReader reader(bytes);
  for (int i = 0; i < 2 * kPayloads; ++i) {
    const Event event = unpacker.Unpack(&reader);
    ASSERT_EQ(std::get<FactObserved>(event.body).fact.payload, payload(i % kPayloads));
  }
  EXPECT_TRUE(reader.at_end());
}

// Own: what is handed over does not keep the packer's terms alive.
TEST(PackedEvents, KeepNoTermOfThePacker) {
  const std::size_t before = Term::CountNodes();
  EventPacker packer;
  PackedBytes bytes;
  packer.Pack(Observed(1, MakeValue(E("one that is nowhere else"), O("position"), N(0.125))), &bytes);
  EXPECT_EQ(Term::CountNodes(), before);
}

// Own: a term freed and another one made in its memory are not taken for each other.
TEST(PackedEvents, TellANewTermFromAnEarlierOneInTheSamePlace) {
  EventPacker packer;
  EventUnpacker unpacker;
  PackedBytes bytes;
  constexpr int kTerms = 20'000;
  // Each term is gone before the next is made, so memory comes back at once.
  for (int i = 0; i < kTerms; ++i) packer.Pack(Observed(i + 1, N(i)), &bytes);
  PackedReader reader(bytes);
  for (int i = 0; i < kTerms; ++i) {
    ASSERT_EQ(std::get<FactObserved>(unpacker.Unpack(&reader).body).fact.payload, N(i));
  }
}

}  // namespace
}  // namespace aerascope
