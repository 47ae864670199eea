// A session that is killed while it records leaves a file that replays to its end.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "osteon/base/random.h"
#include "session_fixtures.h"
#include "two_hands.h"

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

// Adds what both hands and physics did in a tick, and the state of each half second.
Result<void> add_both(RecordingWriter& writer, const Session& session, std::uint64_t n) {
  if (session.last_steps() > 0)
    if (auto done = writer.add(session.last_step_record()); !done) return done;
  for (std::size_t h = 0; h < 2; ++h) {
    if (auto done = writer.add(session.last_tick_record(h), h); !done) return done;
    for (const Event& event : session.last_events(h))
      if (auto done = writer.add(event); !done) return done;
  }
  if (n % 500 != 0) return {};
  return writer.add(StoredState{{n, n, 0, 0}, session.bones().step, to_bytes(session.save())});
}

// Two hands with restore points, exchanges and changes of power.
[[noreturn]] void record_two_until_killed(const std::shared_ptr<const Case>& the_case,
                                          const fs::path& file, int pipe_end) {
  const SessionSettings settings = testing::with_three_probes();
  auto writer = RecordingWriter::create(
      file, recording_header(*the_case, settings, "test", "0", testing::three_probes()));
  if (!writer) _exit(2);
  Session session(the_case, settings, testing::three_probes());
  testing::HandsAtRandom hands(4);
  for (std::uint64_t n = 1; n <= 20000; ++n) {
    (void)session.tick(hands.at(n));
    if (!add_both(*writer, session, n)) _exit(3);
    if (write(pipe_end, "t", 1) != 1) _exit(3);
  }
  for (;;) pause();
}

using Recorder = void (*)(const std::shared_ptr<const Case>&, const fs::path&, int pipe_end);

// Kills a recording session after at least `ticks` ticks; returns how many it had taken.
std::uint64_t kill_after(Recorder record, const std::shared_ptr<const Case>& the_case,
                         const fs::path& file, std::uint64_t ticks) {
  int ends[2];
  if (pipe(ends) != 0) return 0;
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    record(the_case, file, ends[1]);
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
    const std::uint64_t taken = kill_after(record_until_killed, the_case, file,
                                           static_cast<std::uint64_t>(random.uniform(1, 3000)));
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

TEST(Kill, OfTwoHandsWithRestorePointsAndExchangesLosesHalfASecondAtMost) {
  const auto the_case = two_box_case();
  const fs::path folder =
      fs::path(::testing::TempDir()) / ("osteon_kill_two_" + std::to_string(getpid()));
  fs::create_directories(folder);
  Random random(7);
  std::size_t restored = 0, taken_up = 0;
  for (int i = 0; i < 20; ++i) {
    const fs::path file = folder / (std::to_string(i) + ".osr");
    const std::uint64_t taken = kill_after(record_two_until_killed, the_case, file,
                                           static_cast<std::uint64_t>(random.uniform(1, 3000)));
    auto recording = RecordingReader::open(file);
    ASSERT_TRUE(recording) << recording.error().message();
    EXPECT_FALSE(recording->complete());
    EXPECT_GE(recording->ticks(0) + 500, taken);
    const auto loaded = load_recording(file);
    ASSERT_TRUE(loaded) << loaded.error().message();
    for (const Event& event : loaded->events) {
      restored += event.kind == EventKind::kRestored ? 1 : 0;
      taken_up += event.kind == EventKind::kInstrumentTaken ? 1 : 0;
    }
    ReplayOptions options;
    options.tray = testing::three_probes();
    const auto whole = replay(*recording, the_case, options);
    ASSERT_TRUE(whole) << whole.error().message();
    EXPECT_TRUE(whole->identical) << whole->first_different_hand << " "
                                  << whole->first_different_tick;
    EXPECT_FALSE(whole->complete);
    EXPECT_GE(whole->ticks + 500, taken);
    options.from_s = 0.001 * static_cast<double>(whole->ticks);
    const auto end = replay(*recording, the_case, options);
    ASSERT_TRUE(end) << end.error().message();
    EXPECT_TRUE(end->identical);
    EXPECT_EQ(end->state_hash, whole->state_hash);
  }
  EXPECT_GT(restored, 20u);
  EXPECT_GT(taken_up, 20u);
  fs::remove_all(folder);
}

// Ten seconds of two hands' random work: states of every half second are in it too.
TEST(Recording, OfTwoHandsTakesAtMost60KilobytesASecondAndHand) {
  constexpr std::uint64_t kTicks = 10000;
  const auto the_case = two_box_case();
  const fs::path file =
      fs::path(::testing::TempDir()) / ("osteon_size_" + std::to_string(getpid()) + ".osr");
  fs::remove(file);
  const SessionSettings settings = testing::with_three_probes();
  {
    auto writer = RecordingWriter::create(
        file, recording_header(*the_case, settings, "test", "0", testing::three_probes()));
    ASSERT_TRUE(writer) << writer.error().message();
    Session session(the_case, settings, testing::three_probes());
    testing::HandsAtRandom hands(9);
    for (std::uint64_t n = 1; n <= kTicks; ++n) {
      (void)session.tick(hands.at(n));
      ASSERT_TRUE(add_both(*writer, session, n));
    }
    ASSERT_TRUE(writer->finish());
  }
  const auto recording = RecordingReader::open(file);
  ASSERT_TRUE(recording);
  const double seconds = 0.001 * kTicks;
  EXPECT_LT(static_cast<double>(recording->bytes()) / seconds / 2, 60e3);
  const double of_file = static_cast<double>(fs::file_size(file)) / seconds / 2;
  std::printf("%.0f bytes a second and hand in chunks, %.0f in the file\n",
              static_cast<double>(recording->bytes()) / seconds / 2, of_file);
  EXPECT_LT(of_file, 60e3);
  fs::remove(file);
}

}  // namespace
}  // namespace osteon
