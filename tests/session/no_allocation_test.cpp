// Counts what the haptic tick takes from the heap: nothing.
#include <gtest/gtest.h>

#include "count_allocations.h"
#include "drilling.h"
#include "osteon/carve/removed.h"
#include "session_fixtures.h"

namespace osteon {
namespace {

using testing::allocations;

TEST(NoAllocation, InAHapticTickAndItsRecord) {
  Session session(testing::two_box_case(), testing::moving_bones());
  for (std::uint64_t n = 1; n <= 3000; ++n) {
    const ToolInput input = testing::hand_at(n);
    const Command command = testing::command_at(n);
    const std::uint64_t before = allocations();
    const ToolState& tool = session.haptic_tick(input, session.bones(), command);
    ASSERT_EQ(allocations(), before) << n;
    (void)session.physics_step(tool, command);
  }
}

TEST(NoAllocation, InAReportWithinItsReservedTime) {
  const auto the_case = testing::two_box_case();
  Session session(the_case, {});
  ReportBuilder builder(*the_case);
  for (std::uint64_t n = 1; n <= 3000; ++n) {
    const ToolState& tool = session.haptic_tick(testing::hand_at(n), session.bones());
    const std::uint64_t before = allocations();
    builder.add(tool);
    ASSERT_EQ(allocations(), before) << n;
  }
}

// Neither the hand's tick nor the step that removes bone, while another thread draws: with a drill,
// with a burr.
TEST(NoAllocation, WhileBoneIsCarved) {
  for (const char* instrument : {"drill:3.2", "microdrill:3"}) {
    const testing::Drilling with(instrument);
    Session session = with.session();
    CutsPatch patch;
    for (std::uint64_t n = 1; n <= 3000; ++n) {
      HandInput hand = testing::down_at(n, 1);
      if (with.setup->tray[0]->way == CarvingTool::Way::kBurr) hand.input.X_WD.p.z() += 0.0015;
      const std::uint64_t before = allocations();
      const ToolState& tool = session.haptic_tick(hand.input, session.bones(), hand.command);
      ASSERT_EQ(allocations(), before) << n;
      if (n % 2 == 0) (void)session.physics_step(tool);
      ASSERT_EQ(allocations(), before) << n;
      while (n % 17 == 0 && session.cuts_feed()->take(patch)) {
      }
    }
    EXPECT_GT(1e9 * total(removed_volume(*session.carving()->field(0))), 1) << instrument;
  }
}

}  // namespace
}  // namespace osteon
