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

TEST_F(CaseBrowserTest, SlicesAreToldByTheirStartWhereTheirNamesDoNotTell) {
  std::string start(200, ' ');
  start.replace(128, 4, "DICM");
  fs::create_directories(home / "no ending");
  fs::create_directories(home / "counted");
  fs::create_directories(home / "upper");
  for (const char* name : {"no ending/IM0001", "no ending/IM0002", "counted/a.1", "counted/a.2",
                           "upper/1.DCM", "upper/2.DCM", "LUNATE.NRRD"})
    std::ofstream(home / name) << start;
  const auto kind = [&](const char* name) { return kind_of((home / name).string()); };
  EXPECT_EQ(kind("no ending"), OpenKind::kScan);
  EXPECT_EQ(kind("no ending/IM0001"), OpenKind::kScan);
  EXPECT_EQ(kind("counted"), OpenKind::kScan);
  EXPECT_EQ(kind("upper"), OpenKind::kScan);
  EXPECT_EQ(kind("upper/1.DCM"), OpenKind::kScan);
  EXPECT_EQ(kind("LUNATE.NRRD"), OpenKind::kScan);
  std::ofstream(home / "no ending/IM0001") << "something else";
  std::ofstream(home / "no ending/IM0002") << "something else";
  EXPECT_EQ(kind("no ending"), OpenKind::kFolder);
  EXPECT_EQ(kind("no ending/IM0001"), OpenKind::kNothing);
}

// A closed tetrahedron of 20 mm, in millimetres.
void write_bone(const fs::path& file) {
  std::ofstream(file) << "v 0 0 0\nv 20 0 0\nv 0 20 0\nv 0 0 20\n"
                         "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
}

TEST_F(CaseBrowserTest, SeveralMeshesMakeOneCaseAndTheOthersOfTheirFolderStayOut) {
  fs::create_directories(home / "three");
  for (const char* name : {"three/lunate.obj", "three/capitate.obj", "three/hamate.obj"})
    write_bone(home / name);
  CaseBrowser browser(home);
  browser.import({home / "three/lunate.obj", home / "three/hamate.obj"});
  Result<std::string> made = std::string();
  while (browser.model().importing) made = browser.take_imported();
  ASSERT_TRUE(made) << made.error().message();
  EXPECT_TRUE(fs::path(*made).filename().string().starts_with("three")) << *made;
  std::ifstream in(fs::path(*made) / "case.toml");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(text.find("lunate"), std::string::npos) << text;
  EXPECT_NE(text.find("hamate"), std::string::npos) << text;
  EXPECT_EQ(text.find("capitate"), std::string::npos) << text;
}

TEST_F(CaseBrowserTest, MeshesInTheWrongUnitSayWhichSwitchOfTheWindowHelps) {
  fs::create_directories(home / "wrong unit");
  write_bone(home / "wrong unit/lunate.obj");
  CaseBrowser browser(home);
  browser.set_in_millimetres(false);
  browser.import({home / "wrong unit"});
  Result<std::string> made = std::string();
  while (browser.model().importing) made = browser.take_imported();
  ASSERT_FALSE(made);
  const std::string why = made.error().message();
  EXPECT_NE(why.find("millimetres\" on under Open"), std::string::npos) << why;
  EXPECT_EQ(why.find("--unit"), std::string::npos) << why;
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
  browser.toggle({(home / "cases/patient").string()});
  const std::vector<OpenEntry> known = browser.model().known;
  EXPECT_EQ(std::count_if(known.begin(), known.end(),
                          [](const OpenEntry& entry) { return entry.label == "patient"; }),
            1)
      << "saved and opened recently";
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
  browser.import({home / "meshes"});
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
