#include "window/controllers/sessions/instrument_tray.h"

#include <gtest/gtest.h>

#include <set>

#include "../../../../graft_bench_case.h"

namespace osteon {
namespace {

TEST(InstrumentTray, WithoutInstrumentsItHoldsTheWristProbe) {
  const InstrumentTray tray;
  ASSERT_EQ(tray.run().tools.size(), 1u);
  EXPECT_EQ(tray.run().names, std::vector<std::string>{"wrist_probe"});
  EXPECT_EQ(tray.next(0, 1), 0u);
  EXPECT_EQ(tray.next(0, -1), 0u);
  EXPECT_EQ(tray.next_size(0), 0u);
  EXPECT_EQ(tray.find(""), 0u);
  EXPECT_FALSE(tray.find("hook_probe"));
}

TEST(InstrumentTray, AnUnknownInstrumentIsNamed) {
  const std::vector<std::string> wanted = {"spoon"};
  const auto tray = InstrumentTray::make("wrist", wanted);
  ASSERT_FALSE(tray);
  EXPECT_NE(tray.error().message().find("spoon"), std::string::npos);
}

TEST(InstrumentTray, PagingMeetsEveryInstrumentOnceAndComesBack) {
  const auto tray = InstrumentTray::make("wrist", {});
  ASSERT_TRUE(tray) << tray.error().message();
  std::set<std::uint32_t> met;
  std::uint32_t place = 0;
  for (std::size_t i = 0; i <= tray->instruments().size(); ++i) {
    EXPECT_TRUE(met.insert(place).second) << tray->title(place);
    EXPECT_EQ(tray->next(tray->next(place, 1), -1), place);
    place = tray->next(place, 1);
  }
  EXPECT_EQ(place, 0u);
  EXPECT_EQ(met.size(), tray->instruments().size() + 1);
}

TEST(InstrumentTray, WhatIsWantedComesInWhateverTheRegion) {
  const std::vector<std::string> wanted = {"cannulated_drill:9", "", "wrist_probe"};
  const auto tray = InstrumentTray::make("wrist", wanted);
  ASSERT_TRUE(tray) << tray.error().message();
  const auto place = tray->find("cannulated_drill:9");
  ASSERT_TRUE(place);
  EXPECT_TRUE(tray->run().names[*place].starts_with("cannulated_drill:9"));
  EXPECT_EQ(tray->run().names.size(), tray->run().tools.size());
}

TEST(InstrumentTray, OfWhatWasNeverTakenTheUsualSizeComesFirst) {
  const auto tray = InstrumentTray::make("knee", {});
  ASSERT_TRUE(tray);
  std::set<std::string> met;
  std::set<std::uint32_t> places;
  std::size_t with_sizes = 0;
  for (const TrayItem& item : tray->items()) {
    EXPECT_TRUE(places.insert(item.place).second);
    // The wrist probe's picture comes first.
    if (item.picture < 1 || !met.insert(item.title).second) continue;
    const Instrument& instrument = tray->instruments()[static_cast<std::size_t>(item.picture - 1)];
    EXPECT_EQ(tray->find(instrument.name), item.place);
    with_sizes += !item.size.empty();
  }
  EXPECT_GT(with_sizes, 3u);
  EXPECT_EQ(places.size(), tray->run().tools.size());
}

TEST(InstrumentTray, AClampsJawsAreDrivenAndABenchIsOfTheKnee) {
  const auto tray = InstrumentTray::make("knee", {});
  ASSERT_TRUE(tray) << tray.error().message();
  const auto clamp = tray->find("clamp"), scalpel = tray->find("scalpel_15");
  ASSERT_TRUE(clamp && scalpel);
  EXPECT_TRUE(tray->run().driven[*clamp].jaws);
  EXPECT_FALSE(tray->run().driven[*scalpel].jaws);
  // The same key turns a screw, and draws by suction.
  for (const char* name : {"interference_screw:9", "shaver", "rf_ablator", "suction"}) {
    const auto place = tray->find(name);
    if (!place) continue;
    EXPECT_TRUE(tray->run().driven[*place].power) << name;
    EXPECT_FALSE(tray->run().driven[*place].jaws) << name;
  }
  EXPECT_TRUE(tray->find("interference_screw:9"));
  EXPECT_FALSE(tray->run().driven[*scalpel].power);
  EXPECT_EQ(region_of(*testing::bench_case()), "knee");
  EXPECT_EQ(region_of(*testing::ring_box()), "wrist");
}

TEST(InstrumentTray, WhatWasTakenLastComesFirst) {
  auto tray = InstrumentTray::make("wrist", {});
  ASSERT_TRUE(tray);
  const std::size_t count = tray->items().size();
  tray->took(2);
  tray->took(1);
  tray->took(2);
  const auto items = tray->items();
  ASSERT_EQ(items.size(), count);
  EXPECT_EQ(items[0].place, 2u);
  EXPECT_EQ(items[1].place, 1u);
  EXPECT_EQ(items[2].place, 0u);
  EXPECT_FALSE(items[0].does.empty());
}

}  // namespace
}  // namespace osteon
