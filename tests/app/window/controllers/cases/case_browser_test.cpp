#include "window/controllers/cases/case_browser.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace osteon {
namespace {

namespace fs = std::filesystem;

class CaseBrowserTest : public ::testing::Test {
 protected:
  CaseBrowserTest() {
    fs::create_directories(home / "cases/patient");
    fs::create_directories(home / "recordings");
    fs::create_directories(home / "meshes");
    fs::create_directories(home / "slices");
    for (const char* name : {"cases/patient/case.toml", "recordings/run.osr", "meshes/lunate.stl",
                             "slices/1.dcm", "slices/2.dcm", "scan.nrrd", "notes.txt"})
      std::ofstream(home / name) << "x";
  }
  ~CaseBrowserTest() override { fs::remove_all(home); }
  static const OpenEntry* find(const std::vector<OpenEntry>& entries, const std::string& label) {
    const auto at = std::find_if(entries.begin(), entries.end(),
                                 [&](const OpenEntry& e) { return e.label == label; });
    return at == entries.end() ? nullptr : &*at;
  }
  fs::path home = fs::temp_directory_path() / ("osteon_browser_" + std::to_string(::getpid()));
};

TEST_F(CaseBrowserTest, EveryThingIsToldByWhatItIs) {
  const auto kind = [&](const char* name) { return kind_of((home / name).string()); };
  EXPECT_EQ(kind_of("builtin:knee"), OpenKind::kCase);
  EXPECT_EQ(kind("cases/patient"), OpenKind::kCase);
  EXPECT_EQ(kind("cases/patient/case.toml"), OpenKind::kCase);
  EXPECT_EQ(kind("recordings/run.osr"), OpenKind::kRecording);
  EXPECT_EQ(kind("meshes"), OpenKind::kMeshes);
  EXPECT_EQ(kind("meshes/lunate.stl"), OpenKind::kMeshes);
  EXPECT_EQ(kind("slices"), OpenKind::kScan);
  EXPECT_EQ(kind("scan.nrrd"), OpenKind::kScan);
  EXPECT_EQ(kind("cases"), OpenKind::kFolder);
  EXPECT_EQ(kind("notes.txt"), OpenKind::kNothing);
  EXPECT_EQ(kind("not there"), OpenKind::kNothing);
  EXPECT_EQ(kind_of(""), OpenKind::kNothing);
}

TEST_F(CaseBrowserTest, OpenedItListsWhatIsBuiltInLatelyOpenedAndSaved) {
  CaseBrowser browser(home);
  EXPECT_FALSE(browser.is_open());
  browser.toggle({(home / "meshes/lunate.stl").string(), (home / "gone").string()});
  ASSERT_TRUE(browser.is_open());
  const BrowserModel model = browser.model();
  for (const char* label : {"Wrist", "Knee", "lunate.stl", "patient", "run.osr"})
    EXPECT_TRUE(find(model.known, label)) << label;
  EXPECT_FALSE(find(model.known, "gone"));
  browser.toggle({});
  EXPECT_FALSE(browser.is_open());
}

TEST_F(CaseBrowserTest, AFolderShowsFoldersFirstAndOnlyWhatCanBeOpened) {
  CaseBrowser browser(home);
  browser.look_into(home);
  const BrowserModel model = browser.model();
  EXPECT_TRUE(model.problem.empty());
  ASSERT_TRUE(find(model.files, "cases"));
  EXPECT_EQ(model.files.front().kind, OpenKind::kFolder);
  EXPECT_TRUE(find(model.files, "scan.nrrd"));
  EXPECT_FALSE(find(model.files, "notes.txt"));
  browser.look_into(home / "not there");
  EXPECT_FALSE(browser.model().problem.empty());
  EXPECT_TRUE(browser.model().files.empty());
}

TEST_F(CaseBrowserTest, AMeshThatCannotBeReadIsAnErrorAndLeavesNoCase) {
  CaseBrowser browser(home);
  browser.import(home / "meshes");
  EXPECT_TRUE(browser.model().importing);
  Result<std::string> made = std::string();
  while (browser.model().importing) made = browser.take_imported();
  ASSERT_FALSE(made);
  EXPECT_FALSE(made.error().message().empty());
  EXPECT_EQ(std::distance(fs::directory_iterator(home / "cases"), fs::directory_iterator()), 1);
}

TEST(Recent, TheLastComesFirstOnceAndTheListStaysShort) {
  std::vector<std::string> recent;
  for (int i = 0; i < 20; ++i) recent = with_recent(recent, "case " + std::to_string(i));
  EXPECT_EQ(recent.size(), 12u);
  recent = with_recent(recent, "case 15");
  EXPECT_EQ(recent.size(), 12u);
  EXPECT_EQ(recent[0], "case 15");
  EXPECT_EQ(recent[1], "case 19");
  EXPECT_EQ(std::count(recent.begin(), recent.end(), "case 15"), 1);
}

}  // namespace
}  // namespace osteon
