#include "cases/all_cores.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace osteon {
namespace {

TEST(AllCores, NoTasksAreDoneAtOnce) {
  bool asked = false;
  run_on_all_cores(
      0, [&](std::size_t) { asked = true; }, [&](double) { asked = true; });
  EXPECT_FALSE(asked);
}

TEST(AllCores, EveryTaskRunsOnceAndProgressRises) {
  std::vector<std::atomic<int>> ran(500);
  double last = 0;
  run_on_all_cores(
      ran.size(), [&](std::size_t i) { ++ran[i]; },
      [&](double share) {
        EXPECT_GE(share, last);
        EXPECT_LE(share, 1);
        last = share;
      });
  for (const auto& times : ran) EXPECT_EQ(times, 1);
}

// Far more tasks than anyone could wait for.
TEST(AllCores, ProgressMayStopIt) {
  struct Stop {};
  constexpr std::size_t kTasks = 1'000'000'000'000;
  std::atomic<std::size_t> ran{0};
  EXPECT_THROW(run_on_all_cores(
                   kTasks, [&](std::size_t) { ++ran; }, [](double) { throw Stop{}; }),
               Stop);
  EXPECT_LT(ran, kTasks);
}

}  // namespace
}  // namespace osteon
