// What physics tells a hand of carved bone when there is no room on the way.
#include "felt_cuts.h"

#include <gtest/gtest.h>

#include "drilling.h"

namespace osteon {
namespace {

const CarvingSetup& setup() {
  static const testing::Drilling with;
  return *with.setup;
}

// The hand's copy of block 7 with that value everywhere, from that step on.
CarvePatch patch_at(std::uint64_t step, std::int16_t um) {
  CarvePatch patch;
  patch.step = step;
  patch.block = 7;
  patch.cut.fill(um);
  return patch;
}

CarvePatch event_at(std::uint64_t step) {
  CarvePatch patch;
  patch.step = step;
  patch.kind = CarvePatch::Kind::kEvent;
  patch.event.kind = EventKind{200};
  return patch;
}

TEST(FeltCuts, WhatHasNoRoomIsToldLaterInItsOrder) {
  FeltCuts felt(setup(), 3);
  for (std::uint64_t step = 1; step <= 10; ++step) felt.tell(event_at(step));
  EXPECT_TRUE(felt.behind());
  EventList events;
  std::uint64_t told = 0;
  for (int round = 0; round < 10; ++round) {
    events.clear();
    felt.take_until(10, 42, events);
    told += events.all().size();
    felt.send_late();
  }
  EXPECT_FALSE(felt.behind());
  EXPECT_EQ(told, 10u);
}

TEST(FeltCuts, OneThreadMissesNothingHoweverNarrowTheChannel) {
  FeltCuts felt(setup(), 2);
  for (std::uint64_t step = 1; step <= 20; ++step) felt.tell(event_at(step));
  felt.tell(patch_at(21, -500));
  felt.catch_up();
  EXPECT_FALSE(felt.behind());
  EventList events;
  felt.take_until(12, 42, events);  // later steps stay where they are
  EXPECT_EQ(events.all().size(), 12u);
  EXPECT_EQ(felt.by_bone()[0]->used(), 0u);
  felt.tell(event_at(22));
  felt.tell(event_at(23));
  felt.tell(event_at(24));
  felt.catch_up();
  events.clear();
  felt.take_until(30, 43, events);
  EXPECT_EQ(events.all().size(), 11u);
  EXPECT_EQ(felt.by_bone()[0]->used(), 1u);
}

// A whole bone that comes back, with a second of drilling besides, has room.
TEST(FeltCuts, ABoneThatComesBackHasRoom) {
  EXPECT_GE(channel_places(setup()), setup().most_blocks + 4096);
}

}  // namespace
}  // namespace osteon
