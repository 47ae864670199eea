// Fails where two sources define a type of one name in the same namespace. The linker takes one of
// the two for both, silently, and then only in builds that do not inline: memory is overwritten.
// Fails too where two sources of a module hide the same name in unnamed namespaces: they compile
// only as long as a joined build does not put both into one batch.
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

// A line in the first column of a namespace: the namespace's name, and whether it is unnamed.
struct Line {
  std::string scope;
  bool nameless = false;
  std::string text;
};

// All that stands at the top level of namespaces. Relies on the format: what is at the top level
// starts in the first column, and a namespace's end says so.
std::vector<Line> top_lines(std::istream& text) {
  static const std::regex opens(R"(^(?:inline )?namespace( [\w:]+)? \{)");
  static const std::regex closes(R"(^\}  // namespace)");
  std::vector<std::string> scope;
  std::vector<Line> lines;
  for (std::string line; std::getline(text, line);) {
    std::smatch match;
    const bool goes_on =
        !lines.empty() && lines.back().text.find_first_of("{;") == std::string::npos;
    if (std::regex_search(line, match, opens)) {
      scope.push_back(match[1].matched ? match[1].str() : "");
    } else if (std::regex_search(line, closes)) {
      if (!scope.empty()) scope.pop_back();
    } else if (!line.empty() && line[0] != ' ' && line[0] != '/') {
      Line found{"", false, line};
      for (const std::string& part : scope) {
        found.nameless = found.nameless || part.empty();
        found.scope += part + " ";
      }
      lines.push_back(found);
    } else if (goes_on && line.starts_with("    ")) {
      lines.back().text += " " + line.substr(line.find_first_not_of(' '));
    }
  }
  return lines;
}

const std::regex& a_type() {
  static const std::regex type(
      R"(^(?:struct|class|union|enum class|enum)(?: alignas\(\w+\))? (\w+)(?:| final)(?:| : .*)(?: \{.*|$))");
  return type;
}

void find_types(std::istream& text, const std::string& where, Places& places) {
  for (const Line& line : top_lines(text)) {
    std::smatch match;
    if (!line.nameless && std::regex_search(line.text, match, a_type()))
      places[line.scope + match[1].str()].insert(where);
  }
}

// Types and constants of unnamed namespaces by their names, functions with their parameters too.
// A name that only stands for a type may be given twice, for the same one: of it the type is kept.
void find_hidden(std::istream& text, const std::string& where, Places& places) {
  static const std::regex constant(R"(\b(k[A-Z]\w*)(?:\[[^\]]*\])*(?: = |\{))");
  static const std::regex function(R"(^[\w:<>,&* ]*[ &*>](\w+\([^{}]*\))(?: const)? (?:\{|:))");
  static const std::regex alias(R"(^using (\w+) = (.*);)");
  for (const Line& line : top_lines(text)) {
    if (!line.nameless) continue;
    std::smatch match;
    if (std::regex_search(line.text, match, a_type()) ||
        std::regex_search(line.text, match, function)) {
      places[line.scope + match[1].str()].insert(where);
    } else if (std::regex_search(line.text, match, alias)) {
      places[line.scope + match[1].str() + " ="].insert(match[2].str());
    } else if (line.text.starts_with("const")) {
      for (std::sregex_iterator i(line.text.begin(), line.text.end(), constant), end; i != end; ++i)
        places[line.scope + (*i)[1].str()].insert(where);
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

// The files of a folder of the sources, and below it.
std::vector<fs::path> sources_in(const fs::path& top) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(OSTEON_SOURCE_DIR) / top))
    if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp")
      files.push_back(entry.path());
  return files;
}

std::string all_of(const std::set<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += " " + name;
  return all;
}

TEST(TypeNames, NoTwoSourcesDefineTheSame) {
  Places places;
  for (const char* root : {"include/osteon", "src"}) {
    for (const fs::path& file : sources_in(root)) {
      std::ifstream in(file);
      find_types(in, file.string(), places);
    }
  }
  EXPECT_GT(places.size(), 200u);
  for (const auto& [name, where] : places)
    EXPECT_EQ(where.size(), 1u) << "type" << name << " is defined in" << all_of(where);
}

TEST(HiddenNames, TheSearchSeesWhatItShould) {
  std::istringstream text(
      "namespace a {\nconstexpr int kSeen = 1;\nnamespace {\nstruct One {\n};\nusing Two = One;\n"
      "constexpr double kTwo = 2, kThree = kTwo,\n    kFour{4};\n"
      "const Table& five(int x,\n             int y) {\n    kNone = x;\n}\n"
      "int six(int x) { return x; }\n}  // namespace\nint seven() { return 7; }\n}  // namespace "
      "a\n");
  Places places;
  find_hidden(text, "x.cpp", places);
  std::set<std::string> found;
  for (const auto& [name, where] : places) found.insert(name);
  EXPECT_EQ(found,
            (std::set<std::string>{" a  One", " a  Two =", " a  kTwo", " a  kThree", " a  kFour",
                                   " a  five(int x, int y)", " a  six(int x)"}));
}

// Of a module, and of each folder of app, which joins its sources by folders.
std::string joined_with(const fs::path& file) {
  const fs::path inner = fs::relative(file, fs::path(OSTEON_SOURCE_DIR) / "src");
  const std::string module = inner.begin()->string();
  return module == "app" ? inner.parent_path().string() : module;
}

TEST(HiddenNames, NoTwoSourcesOfAModuleHideTheSame) {
  std::map<std::string, Places> modules;
  for (const fs::path& file : sources_in("src")) {
    if (file.extension() != ".cpp") continue;
    std::ifstream in(file);
    find_hidden(in, file.string(), modules[joined_with(file)]);
  }
  std::size_t names = 0;
  for (const auto& [module, places] : modules) {
    names += places.size();
    for (const auto& [name, where] : places)
      EXPECT_EQ(where.size(), 1u) << name << " means or is hidden in" << all_of(where);
  }
  EXPECT_GT(names, 4000u);
}

}  // namespace
