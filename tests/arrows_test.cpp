// Fails on an include that docs/architecture.md's table of modules does not allow.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace fs = std::filesystem;

namespace {

using Arrows = std::map<std::string, std::set<std::string>>;

const Arrows& allowed() {
  static const Arrows table = {
      {"base", {}},
      {"image", {"base"}},
      {"mesh", {"base", "image"}},
      {"anatomy", {"base", "image", "mesh"}},
      {"hull", {"base", "mesh"}},
      {"collide", {"base", "mesh", "hull"}},
      {"scene", {"base", "image", "mesh", "hull", "collide"}},
      {"device", {"base"}},
      {"tissue", {"base", "mesh", "collide"}},
      {"carve", {"base", "mesh", "collide"}},
      {"xray", {"base", "image", "mesh", "collide", "scene"}},
      {"media", {"base"}},
      {"haptic", {"base", "hull", "collide", "scene"}},
      {"physics", {"base", "mesh", "hull", "collide", "scene", "tissue", "carve"}},
      {"render", {"base", "mesh", "scene"}},
      {"procedure", {"base", "scene"}},
      {"record", {"base", "scene"}},
      {"surgeon", {"base", "mesh", "collide", "scene", "procedure"}},
      {"results", {"base", "scene", "procedure"}},
      {"session", {"base", "scene", "haptic", "physics", "procedure", "record"}},
  };
  return table;
}

// Modules that `file` includes by <module>/ path.
std::set<std::string> included_modules(const fs::path& file) {
  static const std::regex pattern(R"re(^\s*#\s*include\s*"osteon/([a-z_]+)/)re");
  std::set<std::string> found;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (std::regex_search(line, match, pattern)) found.insert(match[1]);
  }
  return found;
}

bool is_source(const fs::path& p) { return p.extension() == ".h" || p.extension() == ".cpp"; }

TEST(Arrows, EveryIncludeFollowsTheTable) {
  int files = 0;
  for (const char* root : {"include/osteon", "src"}) {
    const fs::path top = fs::path(OSTEON_SOURCE_DIR) / root;
    for (const auto& entry : fs::recursive_directory_iterator(top)) {
      if (!entry.is_regular_file() || !is_source(entry.path())) continue;
      const std::string module = fs::relative(entry.path(), top).begin()->string();
      if (module == "app") continue;
      ++files;
      ASSERT_TRUE(allowed().count(module)) << entry.path() << ": module not in the table";
      for (const std::string& target : included_modules(entry.path())) {
        if (target == module) continue;
        EXPECT_TRUE(allowed().at(module).count(target))
            << entry.path() << " includes " << target << ", which " << module << " may not";
      }
    }
  }
  EXPECT_GT(files, 20);
}

// The rooms of app, each with those whose headers it may include. Window and segmentation never
// meet.
const Arrows& rooms() {
  static const Arrows table = {
      {"loops", {}},
      {"cases", {}},
      {"checkup", {"loops"}},
      {"water", {}},
      {"runs", {"cases", "loops", "water"}},
      {"ui", {"cases", "loops", "runs"}},
      {"exercises", {"cases", "loops", "runs", "water"}},
      {"window", {"cases", "checkup", "exercises", "loops", "runs", "ui", "water"}},
      {"segment", {"cases", "loops", "ui"}},
      {"commands", {"cases", "checkup", "exercises", "loops", "runs", "water"}},
  };
  return table;
}

// The commands that open a window.
bool opens_a_window(const fs::path& file) {
  static const std::set<std::string> names = {"cmd_window", "cmd_segment", "windows_in_turn"};
  return names.count(file.stem().string()) > 0;
}

// Room and first folder of each include of app's own.
std::set<std::string> included_rooms(const fs::path& file) {
  static const std::regex pattern(R"re(^\s*#\s*include\s*"([a-z]+)/)re");
  std::set<std::string> found;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (std::regex_search(line, match, pattern) && match[1] != "osteon") found.insert(match[1]);
  }
  return found;
}

TEST(Arrows, RoomsOfTheProgramFollowTheirTable) {
  int files = 0;
  const fs::path top = fs::path(OSTEON_SOURCE_DIR) / "src/app";
  for (const auto& entry : fs::recursive_directory_iterator(top)) {
    if (!entry.is_regular_file() || !is_source(entry.path())) continue;
    if (entry.path().parent_path() == top) continue;  // main.cpp and the command line wire it up
    const std::string room = fs::relative(entry.path(), top).begin()->string();
    ++files;
    ASSERT_TRUE(rooms().count(room)) << entry.path() << ": room not in the table";
    if (room == "commands" && opens_a_window(entry.path())) continue;
    for (const std::string& target : included_rooms(entry.path()))
      EXPECT_TRUE(target == room || rooms().at(room).count(target))
          << entry.path() << " includes " << target << ", which " << room << " may not";
  }
  EXPECT_GT(files, 150);
}

// The page's table of rooms, one text for each module: "| mesh | io | ... |" and the rows below it
// that leave the module out.
std::map<std::string, std::string> rooms_of_page() {
  std::ifstream in(fs::path(OSTEON_SOURCE_DIR) / "docs/architecture.md");
  std::map<std::string, std::string> rooms;
  std::string module;
  bool within = false;
  static const std::regex row(R"re(^\|([^|]*)\|(.*)$)re");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("## ")) within = line == "## Rooms";
    std::smatch match;
    if (!within || !std::regex_match(line, match, row)) continue;
    const std::string first = std::regex_replace(match[1].str(), std::regex("\\s+"), "");
    if (!first.empty()) module = first;
    rooms[module] += match[2].str() + "\n";
  }
  return rooms;
}

bool names_word(const std::string& text, const std::string& word) {
  return std::regex_search(text, std::regex("\\b" + word + "\\b"));
}

// Who looks for a file finds its folder on the page: no folder of sources is left out.
TEST(Arrows, EveryFolderOfSourcesIsOnThePageOfTheArchitecture) {
  const auto rooms = rooms_of_page();
  const fs::path top = fs::path(OSTEON_SOURCE_DIR) / "src";
  int found = 0;
  for (const auto& entry : fs::recursive_directory_iterator(top)) {
    if (!entry.is_regular_file() || !is_source(entry.path())) continue;
    const fs::path folder = fs::relative(entry.path(), top).parent_path();
    auto part = folder.begin();
    if (part == folder.end()) continue;
    const std::string module = part->string();
    EXPECT_TRUE(module == "app" || allowed().contains(module)) << module;
    for (++part; part != folder.end(); ++part) {
      const auto page = rooms.find(module);
      ASSERT_NE(page, rooms.end()) << folder << ": docs/architecture.md names no rooms of it";
      EXPECT_TRUE(names_word(page->second, part->string())) << folder;
      ++found;
    }
  }
  EXPECT_GT(found, 100);
}

TEST(Arrows, ThreadsAppearInAppAndBaseOnly) {
  static const std::regex pattern(R"(std::j?thread\b|#include <thread>)");
  for (const char* root : {"include/osteon", "src"}) {
    const fs::path top = fs::path(OSTEON_SOURCE_DIR) / root;
    for (const auto& entry : fs::recursive_directory_iterator(top)) {
      if (!entry.is_regular_file() || !is_source(entry.path())) continue;
      const std::string module = fs::relative(entry.path(), top).begin()->string();
      if (module == "app" || module == "base") continue;
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);)
        EXPECT_FALSE(std::regex_search(line, pattern)) << entry.path() << ": " << line;
    }
  }
}

}  // namespace
