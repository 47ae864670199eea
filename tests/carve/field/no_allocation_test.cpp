// A step of carving takes nothing from the heap, whatever it touches.
#include <gtest/gtest.h>

#include "carve/carve_fixtures.h"
#include "count_allocations.h"

namespace osteon {
namespace {

TEST(CarveNoAllocation, NoStepAllocates) {
  CarvedField field = test::value(CarvedField::make(test::block_field(0.005), {}, 2000));
  for (const CutterKind& kind : cutter_kinds()) {
    const Cutter tool = test::cutter(std::string(kind.name), 2);
    const Pose from = test::pose_along({0, 0.001, 0.004}, {0.6, 0, 0.8});
    const Pose to = test::pose_along({0.001, 0, 0.002}, {0.8, 0, 0.6});
    const auto before = testing::allocations();
    field.cut(tool, from, to);
    EXPECT_EQ(testing::allocations(), before) << kind.name;
  }
  EXPECT_GT(field.block_count(), 10u);
}

}  // namespace
}  // namespace osteon
