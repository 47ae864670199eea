// A session killed at any moment leaves a recording that opens and replays to its end.
#include <fcntl.h>
#include <signal.h>

#include <fstream>
#include <vector>

#include "osteon/base/random.h"
#include "osteon/record/recording.h"
#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

std::uintmax_t size_of(const fs::path& p) {
  std::error_code ec;
  const auto size = fs::file_size(p, ec);
  return ec ? 0 : size;
}

// Bytes that the recorder has put on disk so far: the database and its log.
std::uintmax_t recorded_bytes(const std::string& file) {
  return size_of(file) + size_of(file + "-wal");
}

// Where a recording comes from: small, so that loading it is not what the test waits for.
struct Source {
  std::string case_folder, path_csv;
};

void write_block(const fs::path& file, double x_mm) {
  std::ofstream out(file);
  for (int i = 0; i < 8; ++i)
    out << "v " << x_mm + 20 * (i & 1) << ' ' << 20 * (i >> 1 & 1) << ' ' << 10 * (i >> 2) << '\n';
  out << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

Source make_source(const fs::path& folder) {
  fs::create_directories(folder / "meshes");
  write_block(folder / "meshes" / "lunate.obj", 0);
  write_block(folder / "meshes" / "capitate.obj", 25);
  const Source source{(folder / "case").string(), (folder / "survey.csv").string()};
  const Ran imported = run_osteon("import mesh " + (folder / "meshes").string() +
                                  " --unit mm --out " + source.case_folder);
  EXPECT_EQ(imported.exit_code, 0) << imported.output;
  const Ran surveyed =
      run_osteon("path survey --case " + source.case_folder + " --out " + source.path_csv);
  EXPECT_EQ(surveyed.exit_code, 0) << surveyed.output;
  return source;
}

pid_t start_recording(const Source& source, const std::string& file) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  const int null = ::open("/dev/null", O_WRONLY);
  ::dup2(null, 1);
  ::dup2(null, 2);
  ::execl(OSTEON_EXECUTABLE, OSTEON_EXECUTABLE, "simulate", "--case", source.case_folder.c_str(),
          "--path", source.path_csv.c_str(), "--free-bones", "--record", file.c_str(), nullptr);
  ::_exit(127);
}

// Kills the recorder once it has written `bytes`; false when it ended before.
bool kill_at(pid_t child, const std::string& file, std::uintmax_t bytes) {
  for (;;) {
    int status = 0;
    if (::waitpid(child, &status, WNOHANG) == child) return false;
    if (recorded_bytes(file) < bytes) continue;
    ::kill(child, SIGKILL);
    ::waitpid(child, &status, 0);
    return WIFSIGNALED(status);
  }
}

// What was saved agrees to the bit, and the command says whether that is all that was done. Whether
// the recording breaks off; one that was cut before its first chunk was saved holds no tick.
bool replays_as_far_as_saved(const std::string& recording) {
  const Ran replayed = run_osteon("replay " + recording);
  const bool empty = replayed.output.find("holds no ticks") != std::string::npos;
  const bool whole = replayed.output.find("incomplete") == std::string::npos && !empty;
  EXPECT_EQ(replayed.exit_code, whole ? 0 : 3) << replayed.output;
  EXPECT_NE(replayed.output.find(empty ? "nothing was replayed" : "agrees"), std::string::npos)
      << replayed.output;
  EXPECT_EQ(run_osteon("replay --allow-incomplete " + recording).exit_code, empty ? 3 : 0);
  return !whole;
}

TEST_F(CliTest, TwentyKillsLeaveTwentyRecordingsThatReplay) {
  const Source source = make_source(dir_);
  const Ran whole = run_osteon("simulate --case " + source.case_folder + " --path " +
                               source.path_csv + " --free-bones --record " + file("whole.osr"));
  ASSERT_EQ(whole.exit_code, 0) << whole.output;
  const std::uintmax_t all = size_of(file("whole.osr"));
  Random random(20);
  int broken_off = 0;
  for (int i = 0; i < 20; ++i) {
    const std::string recording = file("cut" + std::to_string(i) + ".osr");
    const auto bytes =
        static_cast<std::uintmax_t>(random.uniform(0.01, 0.9) * static_cast<double>(all));
    const bool killed = kill_at(start_recording(source, recording), recording, bytes);
    const bool broke_off = replays_as_far_as_saved(recording);
    ASSERT_FALSE(HasFailure()) << "kill " << i << " at " << bytes << " bytes";
    EXPECT_TRUE(killed || !broke_off) << "a recording that was not cut is not whole";
    broken_off += broke_off ? 1 : 0;
  }
  EXPECT_GE(broken_off, 15) << "most sessions ended before they could be killed: the test shows "
                               "little";
}

// The recorder is faster than a machine that is busy elsewhere: a run that was whole before it
// could be killed replays whole.
TEST_F(CliTest, AKillInTheFirstMomentLeavesNoBrokenRecording) {
  const Source source = make_source(dir_);
  int broken_off = 0;
  for (int i = 0; i < 8; ++i) {
    const std::string recording = file("first" + std::to_string(i) + ".osr");
    const bool killed = kill_at(start_recording(source, recording), recording, 1);
    ASSERT_TRUE(fs::exists(recording));
    const bool broke_off = replays_as_far_as_saved(recording);
    ASSERT_FALSE(HasFailure()) << "kill " << i;
    EXPECT_TRUE(killed || !broke_off) << "a recording that was not cut is not whole";
    EXPECT_EQ(run_osteon("record info " + recording).exit_code, 0);
    broken_off += broke_off ? 1 : 0;
  }
  EXPECT_GE(broken_off, 3) << "most sessions ended before they could be killed: the test shows "
                              "little";
}

}  // namespace
}  // namespace osteon::testing_cli
