#include "osteon/procedure/ring_watch.h"

#include <gtest/gtest.h>

#include "osteon/procedure/judge.h"
#include "osteon/procedure/scope_watch.h"
#include "ring_box.h"

namespace osteon {
namespace {

using testing::kRingLies_m;
using testing::ring_box;

struct RingShow {
  RingShow() : box(ring_box()), bones(rest_snapshot(*box)), watch(*box, 0.001) {
    const std::string text =
        "format = 1\nname = \"w\"\ntitle = \"W\"\ntext = \"W\"\nversion = 1\nanatomy = \"wrist\"\n"
        "[[stages]]\nname = \"s\"\ntitle = \"S\"\ninstruction = \"I\"\n[[stages.goals]]\n"
        "rule = \"ringed\"\nmarks = [\"top_2\"]\n"
        "[[errors]]\nname = \"e\"\ntitle = \"E\"\nseverity = \"major\"\nconsequence = \"c\"\n"
        "source = \"D\"\nrule = \"ring_dropped\"\n";
    auto scenario = parse_scenario(text, "w.toml");
    EXPECT_TRUE(scenario) << scenario.error().message();
    plan = *plan_scenario(*scenario, *box);
    state = begin_scenario(plan);
  }
  // The first ring is there for so long.
  void stay(const Vec3& p_W, double seconds) {
    bones.bones[5].X_WB.p = p_W;
    const auto until = tool.tick + static_cast<std::uint64_t>(seconds * 1000);
    while (tool.tick < until) {
      ++tool.tick;
      const ToolState* const tools[] = {&tool};
      std::vector<Event> fresh;
      watch.add(tools, bones, fresh);
      for (const Event& event : fresh) {
        events.push_back(event);
        judge(plan, event, 0.001, state);
      }
    }
  }
  std::shared_ptr<const Case> box;
  BoneSnapshot bones;
  RingWatch watch;
  ScenarioPlan plan;
  ScenarioState state;
  ToolState tool;
  std::vector<Event> events;
};

TEST(RingWatch, SaysNothingOfRingsThatLieAndOfACaseWithout) {
  RingShow show;
  show.stay({0, 0, kRingLies_m}, 1);
  show.stay({0.0005, 0, kRingLies_m}, 1);  // the play in the hole
  EXPECT_TRUE(show.events.empty());
  Case none;
  RingWatch watch(none, 0.001);
  const ToolState* const tools[] = {&show.tool};
  watch.add(tools, show.bones, show.events);
  watch.add({}, show.bones, show.events);
  EXPECT_TRUE(show.events.empty());
}

TEST(RingWatch, TellsWhatIsTakenAndWhereItIsLeft) {
  RingShow show;
  show.stay({0, 0, 0.02}, 0.5);  // held still in the air: left nowhere
  ASSERT_EQ(show.events.size(), 1u);
  EXPECT_EQ(show.events[0].values[0], 0);
  EXPECT_EQ(show.events[0].subject, 5u);
  EXPECT_NEAR(show.events[0].p_W.z(), kRingLies_m, 1e-9);
  EXPECT_FALSE(show.state.over);
  show.stay({0.03, 0, kRingLies_m}, 0.09);
  EXPECT_EQ(show.events.size(), 1u);  // not long enough
  show.stay({0.03, 0, kRingLies_m}, 0.5);
  ASSERT_EQ(show.events.size(), 2u);
  EXPECT_EQ(show.events[1].values[0], 1);
  EXPECT_TRUE(show.state.over);
  EXPECT_TRUE(show.state.errors.empty());
}

TEST(RingWatch, ARingBesideThePegsIsAnErrorAndOneBackOnItsOwnPegIsNoProgress) {
  RingShow show;
  show.stay({0.015, 0, 0.02}, 0.2);
  show.stay({0.015, 0, 0.001}, 0.5);
  ASSERT_EQ(show.state.errors.size(), 1u);
  EXPECT_FALSE(show.state.over);
  show.stay({0.015, 0, 0.02}, 0.2);
  show.stay({0, 0, kRingLies_m}, 0.5);
  EXPECT_EQ(show.state.errors.size(), 1u);
  EXPECT_FALSE(show.state.over);
}

TEST(RingWatch, ARingHidesNothingAndAPegDoes) {
  const RingShow show;
  const Vec3 eye(-0.05, 0, 0.02);
  EXPECT_FALSE(is_hidden(*show.box, show.bones, eye, Vec3(0.06, 0, 0.0005) + Vec3(0, 0.0055, 0)));
  EXPECT_TRUE(is_hidden(*show.box, show.bones, Vec3(-0.05, 0, 0.008), Vec3(0.06, 0, 0.008)));
}

}  // namespace
}  // namespace osteon
