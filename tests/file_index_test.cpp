// Fails where docs/architecture.md's list of files does not say what is there.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>

namespace fs = std::filesystem;

namespace {

using Names = std::set<std::string>;
using Index = std::map<std::string, Names>;  // by folder

const fs::path kRoot = OSTEON_SOURCE_DIR;

bool is_source(const fs::path& p) { return p.extension() == ".h" || p.extension() == ".cpp"; }

// Of each folder under `top`: names of sources and headers without their endings.
Index sources_under(const std::string& top) {
  Index found;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / top))
    if (entry.is_regular_file() && is_source(entry.path()))
      found[fs::relative(entry.path().parent_path(), kRoot).string()].insert(
          entry.path().stem().string());
  return found;
}

bool is_below(const std::string& folder, const std::string& top) {
  return folder == top || folder.rfind(top + "/", 0) == 0;
}

Index expected() {
  const Index sources = sources_under("src");
  Index out = sources;
  for (const auto& [folder, names] : sources_under("include/osteon")) {
    const std::string module = "src" + folder.substr(std::string("include/osteon").size());
    for (const std::string& name : names) {
      bool known = false;
      for (const auto& [where, there] : sources)
        known = known || (is_below(where, module) && there.count(name) > 0);
      if (!known) out[folder].insert(name);
    }
  }
  for (const auto& [folder, names] : sources_under("tests"))
    for (const std::string& name : names) {
      const std::size_t end = name.rfind("_test");
      const bool is_test = end != std::string::npos && end + 5 == name.size();
      const auto beside = sources.find("src" + folder.substr(std::string("tests").size()));
      if (beside == sources.end() ||
          beside->second.count(is_test ? name.substr(0, end) : name) == 0)
        out[folder].insert(name);
    }
  return out;
}

std::string row(const std::string& folder, const Names& names) {
  std::string out = "| " + folder + " | ";
  for (const std::string& name : names) out += (name == *names.begin() ? "" : ", ") + name;
  return out + " |";
}

TEST(FileIndex, TheArchitecturePageNamesEveryFile) {
  std::ifstream page(kRoot / "docs/architecture.md");
  std::map<std::string, std::string> rows;
  bool here = false;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("## ", 0) == 0) here = line == "## Every file";
    if (!here || line.rfind("| ", 0) != 0) continue;
    const std::string folder = line.substr(2, line.find(" |", 2) - 2);
    if (folder != "Folder") rows[folder] = line;
  }
  ASSERT_FALSE(rows.empty());
  for (const auto& [folder, names] : expected()) {
    EXPECT_EQ(rows[folder], row(folder, names));
    rows.erase(folder);
  }
  for (const auto& [folder, line] : rows) ADD_FAILURE() << "no such files: " << line;
}

}  // namespace
