// The two halves of a session in two real threads. What they interleave is not the same twice; that
// the replay repeats it is.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "osteon/base/latest_value.h"
#include "session_fixtures.h"

namespace osteon {
namespace {

using testing::command_at;
using testing::hand_at;
using testing::moving_bones;
using testing::two_box_case;

struct Exchange {
  LatestValue<ToolState> tools;
  LatestValue<BoneSnapshot> bones;
  std::atomic<bool> done{false};
};

void run_haptic(Session& session, Exchange& exchange, std::uint64_t ticks,
                std::vector<TickRecord>& records) {
  for (std::uint64_t n = 1; n <= ticks; ++n) {
    exchange.tools.publish(session.haptic_tick(hand_at(n), exchange.bones.read(), command_at(n)));
    records.push_back(session.last_tick_record());
  }
  exchange.done.store(true, std::memory_order_release);
}

void run_physics(Session& session, Exchange& exchange, std::vector<StepRecord>& records) {
  // Bounded: on a machine that runs this thread alone for long, the records would fill the memory.
  constexpr std::size_t kMost = 200000;
  while (!exchange.done.load(std::memory_order_acquire) && records.size() < kMost) {
    const ToolState& tool = exchange.tools.read();
    exchange.bones.publish(session.physics_step(tool, command_at(records.size() + 1)));
    records.push_back(session.last_step_record());
  }
}

TEST(TwoThreads, AreRepeatedByAReplay) {
  const auto the_case = two_box_case();
  Session session(the_case, moving_bones());
  Exchange exchange;
  exchange.bones.publish(session.bones());
  Recording recording;
  recording.header = recording_header(*the_case, moving_bones(), "test", "0");
  std::thread physics([&] { run_physics(session, exchange, recording.steps); });
  std::thread haptic([&] { run_haptic(session, exchange, 3000, recording.ticks); });
  haptic.join();
  physics.join();
  ASSERT_EQ(recording.ticks.size(), 3000u);
  const auto outcome = replay(recording, the_case);
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_TRUE(outcome->identical) << "tick " << outcome->first_different_tick;
  EXPECT_EQ(outcome->report.state_hash, session.state_hash());
}

}  // namespace
}  // namespace osteon
