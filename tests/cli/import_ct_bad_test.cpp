// What goes wrong with a scan ends with exit code 2, a message that says where, and no case.
#include <fstream>
#include <sstream>

#include "osteon/anatomy/generate.h"
#include "osteon/scene/case_io.h"
#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

class ImportCtBad : public CliTest {
 protected:
  /// A scan of a scaphoid and a lunate.
  void scan() {
    const auto anatomy = generate_anatomy(fs::path(OSTEON_SOURCE_DIR) / "assets/anatomy/wrist.toml",
                                          {.soft_parts = false});
    ASSERT_TRUE(anatomy);
    CaseDef def;
    def.name = "two";
    for (const GeneratedBone& grown : anatomy->bones) {
      if (grown.name != "scaphoid" && grown.name != "lunate") continue;
      BoneDef bone;
      bone.name = grown.name;
      bone.X_WB = grown.X_WB;
      bone.mesh = grown.mesh;
      def.bones.push_back(std::move(bone));
    }
    ASSERT_TRUE(save_case(def, file("two")));
    const Ran ran = run_osteon("scan " + file("two") + " --out " + file("dicom"));
    ASSERT_EQ(ran.exit_code, 0) << ran.output;
  }
  void expect_refused(const std::string& source, const std::string& says) {
    const Ran ran = run_osteon("import ct " + source + " --out " + file("case"));
    EXPECT_EQ(ran.exit_code, 2) << ran.output;
    EXPECT_NE(ran.output.find(says), std::string::npos) << ran.output;
    expect_nothing_written("case");
  }
  void expect_nothing_written(const std::string& name) {
    for (const auto& entry : fs::directory_iterator(dir_))
      EXPECT_NE(entry.path().filename().string().rfind(name, 0), 0u) << entry.path();
  }
};

TEST_F(ImportCtBad, SpoiltSeriesAreRefusedAndNothingIsWritten) {
  expect_refused(file("nothing"), "nothing");
  scan();
  fs::rename(file("dicom/0007.dcm"), file("seventh"));
  expect_refused(file("dicom"), "missing between 0006.dcm and 0008.dcm");
  fs::copy_file(file("seventh"), file("dicom/0007.dcm"));
  fs::resize_file(file("dicom/0007.dcm"), fs::file_size(file("seventh")) / 2);
  expect_refused(file("dicom"), "0007.dcm");
  fs::copy_file(file("seventh"), file("dicom/0007.dcm"), fs::copy_options::overwrite_existing);
  expect_refused(file("dicom") + " --series 9", "no series '9'");
  expect_refused(file("dicom") + " --threshold 9000", "9000 HU");
}

TEST_F(ImportCtBad, ContoursMoveOutlinesWhereTheyAreAskedFor) {
  scan();
  const std::string import = "import ct " + file("dicom") + " --out ";
  const Ran without = run_osteon(import + file("plain"));
  const Ran with = run_osteon(import + file("case") + " --contours 15");
  ASSERT_EQ(with.exit_code, 0) << with.output;
  EXPECT_EQ(without.output.find("contours"), std::string::npos) << without.output;
  EXPECT_NE(with.output.find("contours added"), std::string::npos) << with.output;
  EXPECT_NE(with.output.find("2 bones"), std::string::npos) << with.output;
  EXPECT_EQ(run_osteon("case check " + file("case")).exit_code, 0);
  EXPECT_EQ(run_osteon(import + file("other") + " --contours -1").exit_code, 2);
}

TEST_F(ImportCtBad, AnExistingCaseIsNeverOverwritten) {
  scan();
  fs::create_directories(file("mine"));
  std::ofstream(file("mine/notes.txt")) << "precious";
  const Ran ran = run_osteon("import ct " + file("dicom") + " --out " + file("mine"));
  EXPECT_EQ(ran.exit_code, 2) << ran.output;
  EXPECT_EQ(std::distance(fs::directory_iterator(file("mine")), fs::directory_iterator()), 1);
}

// A file-size limit fails writes as a full disk does (the shell's unit is 1024 bytes).
TEST_F(ImportCtBad, AFullDiskLeavesNothing) {
  scan();
  const std::string tail = " 2>&1";
  for (const std::string& arguments : {"import ct " + file("dicom") + " --out " + file("case"),
                                       "scan " + file("two") + " --out " + file("case")}) {
    const std::string inner = std::string(OSTEON_EXECUTABLE) + " " + arguments + tail;
    const Ran ran = [&] {
      Ran out;
      const std::string command = "bash -c 'trap \"\" XFSZ; ulimit -f 2; exec " + inner + "'";
      std::FILE* pipe = ::popen(command.c_str(), "r");
      char block[4096];
      for (std::size_t got; (got = std::fread(block, 1, sizeof block, pipe)) > 0;)
        out.output.append(block, got);
      const int status = ::pclose(pipe);
      out.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
      return out;
    }();
    EXPECT_EQ(ran.exit_code, 2) << ran.output;
    EXPECT_FALSE(ran.output.empty());
    expect_nothing_written("case");
  }
}

TEST_F(ImportCtBad, CtrlCStopsTheScannerAndLeavesNothing) {
  const std::string command = std::string("timeout --preserve-status -s INT 2 ") +
                              OSTEON_EXECUTABLE + " scan builtin:wrist --spacing 0.2 --slice 0.2" +
                              " --out " + file("case") + " 2>&1";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  ASSERT_TRUE(pipe);
  std::string output;
  char block[4096];
  for (std::size_t got; (got = std::fread(block, 1, sizeof block, pipe)) > 0;)
    output.append(block, got);
  const int status = ::pclose(pipe);
  EXPECT_EQ(WEXITSTATUS(status), 2) << output;
  EXPECT_NE(output.find("stopped"), std::string::npos) << output;
  expect_nothing_written("case");
}

// The series says whose it is; the case does not.
TEST_F(ImportCtBad, ThePatientsNameStaysOutOfTheCase) {
  scan();
  for (const auto& entry : fs::directory_iterator(file("dicom"))) {
    std::stringstream bytes;
    bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    std::string text = bytes.str();
    for (std::size_t at; (at = text.find("VIRTUAL")) != text.npos;) text.replace(at, 7, "DOE^JOE");
    std::ofstream(entry.path(), std::ios::binary) << text;
  }
  const Ran ran = run_osteon("import ct " + file("dicom") + " --out " + file("case") + " --json " +
                             file("found.json"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  EXPECT_EQ(ran.output.find("DOE"), std::string::npos);
  EXPECT_NE(ran.output.find("2 bones"), std::string::npos) << ran.output;
  for (const auto& entry : fs::directory_iterator(file("case"))) {
    std::stringstream bytes;
    bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    EXPECT_EQ(bytes.str().find("DOE"), std::string::npos) << entry.path();
  }
  std::stringstream json;
  json << std::ifstream(file("found.json")).rdbuf();
  EXPECT_EQ(json.str().find("DOE"), std::string::npos);
}

}  // namespace
}  // namespace osteon::testing_cli
