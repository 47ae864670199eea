#include "commands/pictures/windows_in_turn.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

WindowOrder with_case(const char* spec) {
  WindowOrder order;
  order.case_spec = spec;
  return order;
}

TEST(WindowsInTurn, WithoutACaseBeforeAndNoneSavedThereIsNoNext) {
  EXPECT_FALSE(turn_after_segmentation({}, with_case("")));
}

TEST(WindowsInTurn, TheCaseThatWasOpenComesBack) {
  const auto next = turn_after_segmentation({}, with_case("builtin:knee"));
  ASSERT_TRUE(next);
  EXPECT_EQ(std::get<WindowOrder>(*next).case_spec, "builtin:knee");
}

TEST(WindowsInTurn, TheSavedCaseGoesBeforeTheOneThatWasOpen) {
  for (const char* before : {"", "builtin:knee"}) {
    WindowOrder order = with_case(before);
    order.width = 800;
    const auto next = turn_after_segmentation("/cases/hand", order);
    ASSERT_TRUE(next);
    EXPECT_EQ(std::get<WindowOrder>(*next).case_spec, "/cases/hand");
    EXPECT_EQ(std::get<WindowOrder>(*next).width, 800);
  }
}

}  // namespace
}  // namespace osteon
