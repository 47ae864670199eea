// Each kind of bad input ends with exit code 2 and a message that names the file and what to do.
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

void write(const std::string& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

const std::string kPathHeader = "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button\n";

class BadInput : public CliTest {
 protected:
  // Exit code 2, the file's name, and one of the words that say what is wrong.
  void expect_refused(const std::string& arguments, const std::string& names) {
    const Ran ran = run_osteon(arguments);
    EXPECT_EQ(ran.exit_code, 2) << arguments << "\n" << ran.output;
    EXPECT_NE(ran.output.find(names), std::string::npos) << arguments << "\n" << ran.output;
  }
};

TEST_F(BadInput, NoCommandAndUnknownOptions) {
  expect_refused("", "subcommand");
  expect_refused("simulate", "--path");
  expect_refused("simulate --no-such-option", "--");
  expect_refused("fly", "fly");
}

TEST_F(BadInput, UnknownWordsAreNamedWithTheNearestOne) {
  expect_refused("simulate --stifness 300", "Did you mean --stiffness?");
  expect_refused("case chek builtin:wrist", "Did you mean check?");
}

// No option takes what is no number for one, whatever range it has.
TEST_F(BadInput, NumbersThatAreNone) {
  const std::string path =
      " --path " + std::string(OSTEON_SOURCE_DIR) + "/assets/paths/wrist_tap.csv ";
  for (const char* option : {"--stiffness", "--hand-mass", "--friction", "--max-force"})
    for (const char* bad : {" nan", "=-inf", " -1"})
      expect_refused("simulate" + path + option + bad, option);
  expect_refused("path survey --out " + file("p.csv") + " --force nan", "--force");
  expect_refused("import ct " + file("s") + " --out " + file("c") + " --threshold nan",
                 "--threshold");
  expect_refused("simulate" + path + "--seed -1", "--seed");
  expect_refused("anatomy make wrist --out " + file("c") + " --set lunate_tilt=nan", "NUMBER");
  const Ran ran = run_osteon("window --at -1");
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_LT(ran.output.size(), 200u) << ran.output;
}

TEST_F(BadInput, AFullDeviceStaysADevice) {
  expect_refused("stability --cells 2 --out /dev/full", "No space left");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(BadInput, AMissingExpectationIsSaidBeforeTheRun) {
  const std::string path = std::string(OSTEON_SOURCE_DIR) + "/assets/paths/wrist_tap.csv";
  const Ran ran =
      run_osteon("replay " + path + " --case " + file("no_case") + " --expect " + file("no.json"));
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.output.find("no.json"), std::string::npos) << ran.output;
}

TEST_F(BadInput, QuietSaysErrorsAlone) {
  const std::string out = file("s.svg");
  EXPECT_EQ(run_osteon("stability --cells 2 --quiet --out " + out).output, "");
  EXPECT_TRUE(fs::exists(out));
  EXPECT_NE(run_osteon("--quiet case check " + file("no_case")).output.find("no_case"),
            std::string::npos);
}

TEST_F(BadInput, ARecordingAloneIsReplayedSeveralTimesAndItsTicksWorkIsTold) {
  const std::string path = std::string(OSTEON_SOURCE_DIR) + "/assets/paths/wrist_tap.csv";
  expect_refused("replay --runs 0 " + path, "--runs");
  expect_refused("replay --runs 2 " + path, "several times");
  ASSERT_EQ(run_osteon("simulate --path " + path + " --record " + file("r.osr")).exit_code, 0);
  const Ran once = run_osteon("replay " + file("r.osr"));
  EXPECT_EQ(once.output.find("work of a tick"), std::string::npos) << once.output;
  const Ran twice = run_osteon("replay --runs 2 " + file("r.osr"));
  EXPECT_EQ(twice.exit_code, 0) << twice.output;
  EXPECT_NE(twice.output.find("fastest of 2 runs"), std::string::npos) << twice.output;
  EXPECT_NE(twice.output.find("identical"), std::string::npos) << twice.output;
}

TEST_F(BadInput, AWayIsKeptBesideARecording) {
  expect_refused("run fast_telescoping --no-store --way " + file("x.way"), "Add --record");
  EXPECT_FALSE(std::filesystem::exists(file("x.way")));
  const std::string run = "run fast_telescoping --no-store --way " + file("x.way") + " --record ";
  EXPECT_EQ(run_osteon(run + file("x.osr")).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(file("x.way")));
}

TEST_F(BadInput, MissingFilesAreNamed) {
  expect_refused("replay " + file("no.osr"), "no.osr");
  expect_refused("replay " + file("no.csv"), "no.csv");
  expect_refused("simulate --path " + file("no.csv"), "no.csv");
  expect_refused("case info " + file("no_case"), "no_case");
  expect_refused("hull " + file("no.stl"), "no.stl");
  expect_refused("import mesh " + file("no_folder") + " --unit m --out " + file("c"), "no_folder");
  expect_refused("case info builtin:elbow", "elbow");
}

TEST_F(BadInput, BrokenPathsNameTheLine) {
  const std::vector<std::pair<std::string, std::string>> bad = {
      {"", "the first line must be"},
      {"x,y,z\n1,2,3\n", "1"},
      {kPathHeader + "0,0,0,0,1,0,0,0,0\n0,0,0,0,1,0,0,0,0\n", "3"},
      {kPathHeader + "0,0,0,nan,1,0,0,0,0\n", "2"},
      {kPathHeader + "0,0,0,0,0,0,0,0,0\n", "2"},
      {kPathHeader + "0,0,0,abc,1,0,0,0,0\n", "2"},
      {kPathHeader + "0,0,0,0,1,0,0\n", "2"},
  };
  for (const auto& [text, says] : bad) {
    write(file("p.csv"), text);
    expect_refused("simulate --path " + file("p.csv"), says);
  }
}

TEST_F(BadInput, ARecordingThatIsNone) {
  write(file("a.osr"), "");
  expect_refused("replay " + file("a.osr"), "a.osr");
  write(file("b.osr"), std::string(10000, 'x'));
  expect_refused("replay " + file("b.osr"), "b.osr");
}

TEST_F(BadInput, ATruncatedRecordingIsRefusedOrReplayedNeverACrash) {
  const std::string path = std::string(OSTEON_SOURCE_DIR) + "/assets/paths/wrist_tap.csv";
  ASSERT_EQ(run_osteon("simulate --path " + path + " --record " + file("r.osr")).exit_code, 0);
  const auto whole = fs::file_size(file("r.osr"));
  const auto cut_to = [&](double share) {
    fs::copy_file(file("r.osr"), file("cut.osr"), fs::copy_options::overwrite_existing);
    fs::resize_file(file("cut.osr"),
                    static_cast<std::uintmax_t>(share * static_cast<double>(whole)));
  };
  // Too little for its header.
  cut_to(0.02);
  expect_refused("replay " + file("cut.osr"), "cut.osr");
  // What is there is replayed, and is not taken for all of it.
  for (const double share : {0.3, 0.6, 0.95}) {
    cut_to(share);
    const Ran ran = run_osteon("replay " + file("cut.osr"));
    EXPECT_EQ(ran.exit_code, 3) << share << "\n" << ran.output;
    EXPECT_NE(ran.output.find("incomplete"), std::string::npos) << share << "\n" << ran.output;
    EXPECT_EQ(ran.output.find("identical"), std::string::npos) << share << "\n" << ran.output;
  }
  EXPECT_EQ(run_osteon("replay --allow-incomplete " + file("cut.osr")).exit_code, 0);
}

TEST_F(BadInput, ARecordingIsNeverOverwritten) {
  const std::string path = std::string(OSTEON_SOURCE_DIR) + "/assets/paths/wrist_tap.csv";
  write(file("mine.osr"), "precious");
  expect_refused("simulate --path " + path + " --record " + file("mine.osr"), "mine.osr");
  EXPECT_EQ(fs::file_size(file("mine.osr")), 8u);
}

TEST_F(BadInput, AFullDiskIsSaidAndKeepsWhatWasRecorded) {
  const std::string path = std::string(OSTEON_SOURCE_DIR) + "/assets/paths/wrist_survey.csv";
  // A file-size limit fails writes as a full disk does (the shell's unit is 1024 bytes).
  const std::string inner = std::string(OSTEON_EXECUTABLE) + " simulate --path " + path +
                            " --record " + file("full.osr") + " 2>&1";
  const std::string command = "bash -c 'trap \"\" XFSZ; ulimit -f 1200; exec " + inner + "'";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  ASSERT_TRUE(pipe);
  std::string output;
  char block[4096];
  for (std::size_t got; (got = std::fread(block, 1, sizeof block, pipe)) > 0;)
    output.append(block, got);
  const int status = ::pclose(pipe);
  EXPECT_EQ(WEXITSTATUS(status), 2) << output;
  EXPECT_NE(output.find("full.osr"), std::string::npos) << output;
  const Ran replayed = run_osteon("replay " + file("full.osr"));
  EXPECT_EQ(replayed.exit_code, 3) << replayed.output;
  EXPECT_NE(replayed.output.find("agrees"), std::string::npos) << replayed.output;
  EXPECT_NE(replayed.output.find("incomplete"), std::string::npos) << replayed.output;
  EXPECT_EQ(run_osteon("replay --allow-incomplete " + file("full.osr")).exit_code, 0);
}

TEST_F(BadInput, BrokenMeshesAreNamed) {
  fs::create_directories(file("meshes"));
  write(file("meshes/bone.stl"), "solid nothing\nendsolid nothing\n");
  expect_refused("import mesh " + file("meshes") + " --unit m --out " + file("c"), "bone");
  EXPECT_FALSE(fs::exists(file("c"))) << "a half-written case was left";
  write(file("meshes/bone.stl"), std::string(90, '\0'));
  expect_refused("import mesh " + file("meshes") + " --unit m --out " + file("c"), "bone");
}

TEST_F(BadInput, AMalformedExpectationIsAnError) {
  const std::string path = std::string(OSTEON_SOURCE_DIR) + "/assets/paths/wrist_tap.csv";
  write(file("e.json"), "{ not json");
  expect_refused("replay " + path + " --expect " + file("e.json"), "e.json");
}

}  // namespace
}  // namespace osteon::testing_cli
