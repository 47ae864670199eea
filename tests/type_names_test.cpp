// Fails where two sources define a type of one name in the same namespace. The linker takes one of
// the two for both, silently, and then only in builds that do not inline: memory is overwritten.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

using Places = std::map<std::string, std::set<std::string>>;

// Types that the text defines at the top level of its named namespaces. Relies on the format: what
// is at the top level starts in the first column, and a namespace's end says so.
void find_types(std::istream& text, const std::string& where, Places& places) {
  static const std::regex opens(R"(^(?:inline )?namespace( [\w:]+)? \{)");
  static const std::regex closes(R"(^\}  // namespace)");
  static const std::regex type(
      R"(^(?:struct|class|union|enum class|enum)(?: alignas\(\w+\))? (\w+)(?:| final)(?:| : .*)(?: \{.*|$))");
  std::vector<std::string> scope;
  for (std::string line; std::getline(text, line);) {
    std::smatch match;
    if (std::regex_search(line, match, opens)) {
      scope.push_back(match[1].matched ? match[1].str() : "");
    } else if (std::regex_search(line, closes)) {
      if (!scope.empty()) scope.pop_back();
    } else if (std::regex_search(line, match, type)) {
      std::string name;
      bool nameless = false;
      for (const std::string& part : scope) {
        nameless = nameless || part.empty();
        name += part + " ";
      }
      if (!nameless) places[name + match[1].str()].insert(where);
    }
  }
}

TEST(TypeNames, TheSearchSeesWhatItShould) {
  std::istringstream text(
      "struct Out {\n};\nnamespace a {\nstruct One {\n};\nclass Two final : public One {\n};\n"
      "struct Three;\nnamespace {\nstruct Four {\n};\n}  // namespace\nstruct Five { int x; };\n"
      "struct One::Inner {\n};\n}  // namespace a\n");
  Places places;
  find_types(text, "x.h", places);
  std::set<std::string> found;
  for (const auto& [name, where] : places) found.insert(name);
  EXPECT_EQ(found, (std::set<std::string>{"Out", " a One", " a Two", " a Five"}));
}

TEST(TypeNames, NoTwoSourcesDefineTheSame) {
  Places places;
  for (const char* root : {"include/osteon", "src"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(OSTEON_SOURCE_DIR) / root)) {
      const fs::path& file = entry.path();
      if (file.extension() != ".h" && file.extension() != ".cpp") continue;
      std::ifstream in(file);
      find_types(in, file.string(), places);
    }
  }
  EXPECT_GT(places.size(), 200u);
  for (const auto& [name, where] : places) {
    std::string all;
    for (const std::string& file : where) all += " " + file;
    EXPECT_EQ(where.size(), 1u) << "type" << name << " is defined in" << all;
  }
}

}  // namespace
