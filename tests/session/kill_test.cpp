// A session that is killed while it records leaves a file that replays to its end.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "osteon/base/random.h"
#include "session_fixtures.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;
using testing::command_at;
using testing::hand_at;
using testing::moving_bones;
using testing::two_box_case;

// Runs in a child: one byte through the pipe for each tick that was taken. Never ends by itself.
[[noreturn]] void record_until_killed(const std::shared_ptr<const Case>& the_case,
                                      const fs::path& file, int pipe_end) {
  auto writer =
      RecordingWriter::create(file, recording_header(*the_case, moving_bones(), "test", "0"));
  if (!writer) _exit(2);
  Session session(the_case, moving_bones());
  for (std::uint64_t n = 1; n <= 20000; ++n) {
    (void)session.tick(hand_at(n % 3000), command_at(n));
    if (!writer->add(session.last_tick_record())) _exit(3);
    if (session.last_steps() > 0 && !writer->add(session.last_step_record())) _exit(3);
    if (write(pipe_end, "t", 1) != 1) _exit(3);
  }
  for (;;) pause();
}

// Kills a recording session after at least `ticks` ticks; returns how many it had taken.
std::uint64_t kill_after(const std::shared_ptr<const Case>& the_case, const fs::path& file,
                         std::uint64_t ticks) {
  int ends[2];
  if (pipe(ends) != 0) return 0;
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    record_until_killed(the_case, file, ends[1]);
  }
  close(ends[1]);
  std::uint64_t taken = 0;
  char byte = 0;
  while (taken < ticks && read(ends[0], &byte, 1) == 1) ++taken;
  kill(child, SIGKILL);
  while (read(ends[0], &byte, 1) == 1) ++taken;
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  return taken;
}

TEST(Kill, LeavesARecordingThatReplaysToItsEnd) {
  const auto the_case = two_box_case();
  const fs::path folder =
      fs::path(::testing::TempDir()) / ("osteon_kill_" + std::to_string(getpid()));
  fs::create_directories(folder);
  Random random(99);
  for (int i = 0; i < 20; ++i) {
    const fs::path file = folder / (std::to_string(i) + ".osr");
    const std::uint64_t taken =
        kill_after(the_case, file, static_cast<std::uint64_t>(random.uniform(1, 3000)));
    const auto recording = load_recording(file);
    ASSERT_TRUE(recording) << recording.error().message();
    EXPECT_GE(recording->ticks.size() + 500, taken);
    const auto outcome = replay(*recording, the_case);
    ASSERT_TRUE(outcome) << outcome.error().message();
    EXPECT_TRUE(outcome->identical) << "tick " << outcome->first_different_tick;
    EXPECT_EQ(outcome->ticks, recording->ticks.size());
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace osteon
