#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "osteon/base/file.h"
#include "record_fixtures.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;
using testing::add_tick;
using testing::expect_prefix;
using testing::header;
using testing::TempFolder;
using testing::write_recording;

TEST(RecordingWriter, RefusesToOverwrite) {
  TempFolder folder;
  const fs::path file = folder / "r.osr";
  std::ofstream(file) << "mine";
  const auto writer = RecordingWriter::create(file, header());
  ASSERT_FALSE(writer);
  EXPECT_NE(writer.error().message().find("r.osr"), std::string::npos);
  EXPECT_EQ(*read_file(file), "mine");
}

TEST(RecordingWriter, SaysWhenTheFolderIsMissing) {
  TempFolder folder;
  const auto writer = RecordingWriter::create(folder / "none" / "r.osr", header());
  ASSERT_FALSE(writer);
  EXPECT_FALSE(writer.error().todo.empty());
}

TEST(RecordingWriter, AnEmptyRecordingIsWhole) {
  TempFolder folder;
  write_recording(folder / "r.osr", 0);
  const auto loaded = load_recording(folder / "r.osr");
  ASSERT_TRUE(loaded) << loaded.error().message();
  EXPECT_TRUE(loaded->complete);
  EXPECT_TRUE(loaded->ticks.empty());
}

TEST(RecordingWriter, EverythingComesBack) {
  TempFolder folder;
  for (const std::uint64_t ticks : {1, 249, 250, 251, 1000, 1777}) {
    const fs::path file = folder / (std::to_string(ticks) + ".osr").c_str();
    write_recording(file, ticks);
    const auto loaded = load_recording(file);
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_TRUE(loaded->complete);
    EXPECT_EQ(loaded->ticks.size(), ticks);
    EXPECT_EQ(loaded->steps.size(), ticks / 2);
    expect_prefix(*loaded);
    EXPECT_EQ(loaded->header.case_name, header().case_name);
    EXPECT_EQ(loaded->header.case_source, header().case_source);
    EXPECT_EQ(loaded->header.case_hash, header().case_hash);
    EXPECT_EQ(loaded->header.seed, header().seed);
    EXPECT_EQ(loaded->header.settings_json, header().settings_json);
    EXPECT_EQ(loaded->header.osteon_version, header().osteon_version);
    EXPECT_EQ(loaded->header.tray_hash, header().tray_hash);
    EXPECT_EQ(loaded->header.portals_hash, header().portals_hash);
    EXPECT_EQ(loaded->header.names_json, header().names_json);
  }
}

TEST(RecordingWriter, AFinishedRecordingIsOneFile) {
  TempFolder folder;
  write_recording(folder / "r.osr", 600);
  int files = 0;
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    EXPECT_EQ(entry.path().filename(), "r.osr");
    ++files;
  }
  EXPECT_EQ(files, 1);
}

TEST(RecordingWriter, AnOddFileNameIsJustAName) {
  TempFolder folder;
  for (const char* name : {"file:x?mode=memory", ":memory:", "sp ace %20 \xc3\xa9.osr"}) {
    write_recording(folder / name, 10);
    const auto loaded = load_recording(folder / name);
    ASSERT_TRUE(loaded) << name << ": " << loaded.error().message();
    EXPECT_EQ(loaded->ticks.size(), 10u);
  }
}

TEST(RecordingWriter, WithoutFinishThePendingTicksAreKept) {
  TempFolder folder;
  write_recording(folder / "r.osr", 321, false);
  const auto loaded = load_recording(folder / "r.osr");
  ASSERT_TRUE(loaded) << loaded.error().message();
  EXPECT_FALSE(loaded->complete);
  EXPECT_EQ(loaded->ticks.size(), 321u);
  expect_prefix(*loaded);
}

TEST(RecordingWriter, AGapIsRefusedOnceAndForAll) {
  TempFolder folder;
  auto writer = RecordingWriter::create(folder / "r.osr", header());
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->add(testing::tick_record(1)));
  EXPECT_FALSE(writer->add(testing::tick_record(3)));
  EXPECT_FALSE(writer->add(testing::tick_record(2)));
  EXPECT_FALSE(writer->finish());
}

TEST(RecordingWriter, NothingIsAddedAfterFinish) {
  TempFolder folder;
  auto writer = RecordingWriter::create(folder / "r.osr", header());
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->finish());
  EXPECT_TRUE(writer->finish());
  EXPECT_FALSE(writer->add(testing::tick_record(1)));
}

TEST(RecordingWriter, SaysWhenItsFileHasGone) {
  TempFolder folder;
  auto writer = RecordingWriter::create(folder / "r.osr", header());
  ASSERT_TRUE(writer);
  fs::remove(folder / "r.osr");
  Result<void> done;
  for (std::uint64_t n = 1; n <= 250 && done; ++n) done = add_tick(*writer, n);
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().what.find("deleted"), std::string::npos);
}

TEST(RecordingWriter, MayBeMoved) {
  TempFolder folder;
  auto first = RecordingWriter::create(folder / "a.osr", header());
  auto second = RecordingWriter::create(folder / "b.osr", header());
  ASSERT_TRUE(first && second);
  for (std::uint64_t n = 1; n <= 300; ++n) ASSERT_TRUE(add_tick(*first, n));
  *second = std::move(*first);
  for (std::uint64_t n = 301; n <= 400; ++n) ASSERT_TRUE(add_tick(*second, n));
  ASSERT_TRUE(second->finish());
  const auto loaded = load_recording(folder / "a.osr");
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->ticks.size(), 400u);
}

// Runs in a child: writes until the limit on file size stops it, and exits 0 when the failure was
// reported as it should be.
[[noreturn]] void fill_the_disk(const fs::path& file) {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{300 << 10, 300 << 10};
  setrlimit(RLIMIT_FSIZE, &limit);
  auto writer = RecordingWriter::create(file, header());
  if (!writer) _exit(2);
  for (std::uint64_t n = 1; n <= 100000; ++n) {
    const auto done = add_tick(*writer, n);
    if (done) continue;
    const bool clear = !done.error().what.empty() && !done.error().todo.empty() &&
                       done.error().where == file.string();
    const bool stays = !add_tick(*writer, n + 1) && !writer->finish();
    _exit(clear && stays && n > 250 ? 0 : 3);
  }
  _exit(4);
}

TEST(RecordingWriter, AFullDiskEndsTheRecordingButKeepsIt) {
  TempFolder folder;
  const fs::path file = folder / "r.osr";
  const pid_t child = fork();
  if (child == 0) fill_the_disk(file);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  ASSERT_EQ(WEXITSTATUS(status), 0);
  const auto loaded = load_recording(file);
  ASSERT_TRUE(loaded) << loaded.error().message();
  EXPECT_FALSE(loaded->complete);
  EXPECT_GE(loaded->ticks.size(), 250u);
  EXPECT_EQ(loaded->ticks.size() % 250, 0u);
  expect_prefix(*loaded);
}

// Runs in a child: after each tick that `add` has taken, one byte through the pipe. Never ends by
// itself.
[[noreturn]] void write_until_killed(const fs::path& file, int pipe_end) {
  auto writer = RecordingWriter::create(file, header());
  if (!writer) _exit(2);
  for (std::uint64_t n = 1; n <= 200000; ++n)
    if (!add_tick(*writer, n) || write(pipe_end, "t", 1) != 1) _exit(3);
  for (;;) pause();
}

// Starts a writer and kills it after at least `ticks` were taken; returns how many it had reported.
std::uint64_t kill_after(const fs::path& file, std::uint64_t ticks) {
  int ends[2];
  if (pipe(ends) != 0) return 0;
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    write_until_killed(file, ends[1]);
  }
  close(ends[1]);
  std::uint64_t taken = 0;
  char bytes[256];
  ssize_t got = 0;
  while (taken < ticks &&
         (got = read(ends[0], bytes, std::min<std::uint64_t>(sizeof bytes, ticks - taken))) > 0)
    taken += static_cast<std::uint64_t>(got);
  kill(child, SIGKILL);
  while ((got = read(ends[0], bytes, sizeof bytes)) > 0) taken += static_cast<std::uint64_t>(got);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  return taken;
}

TEST(RecordingWriter, AKillAtAnyMomentCostsAtMostHalfASecond) {
  TempFolder folder;
  Random random(2024);
  for (int i = 0; i < 20; ++i) {
    const fs::path file = folder / ("kill" + std::to_string(i) + ".osr").c_str();
    const auto wanted = static_cast<std::uint64_t>(random.uniform(1, 6000));
    const std::uint64_t taken = kill_after(file, wanted);
    ASSERT_GE(taken, wanted);
    const auto loaded = load_recording(file);
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_FALSE(loaded->complete);
    EXPECT_GE(loaded->ticks.size() + 500, taken);
    expect_prefix(*loaded);
    // The same once more: loading has not harmed it.
    const auto again = load_recording(file);
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(again->ticks.size(), loaded->ticks.size());
  }
}

// Runs in a child: as a user who may only read, loads and exits 0 when all is as it should be.
[[noreturn]] void load_as_reader(const fs::path& file, std::uint64_t taken) {
  constexpr uid_t kNobody = 65534;
  if (geteuid() == 0 && (setgid(kNobody) != 0 || setuid(kNobody) != 0)) _exit(2);
  const auto loaded = load_recording(file);
  if (!loaded) {
    std::fprintf(stderr, "%s\n", loaded.error().message().c_str());
    _exit(3);
  }
  expect_prefix(*loaded);
  _exit(loaded->ticks.size() + 500 >= taken && !::testing::Test::HasFailure() ? 0 : 4);
}

TEST(RecordingWriter, AKilledRecordingOpensWhereNothingMayBeWritten) {
  TempFolder folder;
  const fs::path file = folder / "r.osr";
  const std::uint64_t taken = kill_after(file, 1000);
  // Once as the kill left it, once with the log's index lost, as in a copy.
  for (const bool with_index : {true, false}) {
    if (!with_index) fs::remove(file.string() + "-shm");
    for (const auto& entry : fs::directory_iterator(folder.path()))
      fs::permissions(entry.path(), fs::perms(0444));
    fs::permissions(folder.path(), fs::perms(0555));
    const pid_t child = fork();
    if (child == 0) load_as_reader(file, taken);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
    fs::permissions(folder.path(), fs::perms(0755));
  }
}

}  // namespace
}  // namespace osteon
