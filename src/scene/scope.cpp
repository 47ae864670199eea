#include "osteon/scene/scope.h"

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <system_error>

#include "osteon/base/file.h"

namespace osteon {
namespace {

constexpr double kScopeDegree = std::numbers::pi / 180;
constexpr std::string_view kScopeKeys[] = {"name",      "title",  "diameter_mm", "angle_deg",
                                           "field_deg", "barrel", "source"};

std::string scope_line(const std::string& where, const toml::node& node) {
  return where + ", line " + std::to_string(node.source().begin.line);
}

/// Takes values out of the file's table; keeps the first thing that is wrong.
class ScopeReader {
 public:
  ScopeReader(const toml::table& table, const std::string& where) : table_(table), where_(where) {}

  std::string text(std::string_view key) {
    const auto value = table_[key].value<std::string>();
    if (!value || value->empty()) wrong(key, "is missing or not text");
    return value.value_or("");
  }
  double number(std::string_view key, double least, double most) {
    const auto value = table_[key].value<double>();
    if (!value || !(*value >= least && *value <= most))
      wrong(key,
            "must be a number between " + std::to_string(least) + " and " + std::to_string(most));
    return value.value_or(least);
  }
  void check_keys() {
    for (const auto& [key, node] : table_)
      if (std::find(std::begin(kScopeKeys), std::end(kScopeKeys), key.str()) ==
          std::end(kScopeKeys))
        wrong(key.str(), "is not known");
  }
  const std::optional<Error>& error() const { return error_; }

 private:
  void wrong(std::string_view key, const std::string& what) {
    const toml::node* node = table_.get(key);
    if (!error_)
      error_ = Error{"'" + std::string(key) + "' " + what,
                     node ? scope_line(where_, *node) : where_, ""};
  }

  const toml::table& table_;
  const std::string& where_;
  std::optional<Error> error_;
};

Result<std::filesystem::path> scope_folder() {
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  return *data / "assets" / "scopes";
}

}  // namespace

double field_in_water_rad(const ScopeDef& scope) {
  constexpr double kWater = 1.333;
  return 2 * std::asin(std::sin(0.5 * scope.field_rad) / kWater);
}

Result<ScopeDef> parse_scope(std::string_view text, const std::string& where) {
  toml::table table;
  try {
    table = toml::parse(text);
  } catch (const toml::parse_error& e) {
    return fail(std::string(e.description()),
                where + ", line " + std::to_string(e.source().begin.line));
  }
  ScopeReader reader(table, where);
  ScopeDef scope;
  reader.check_keys();
  scope.name = reader.text("name");
  scope.title = reader.text("title");
  scope.diameter_m = 0.001 * reader.number("diameter_mm", 0.5, 15);
  scope.angle_rad = kScopeDegree * reader.number("angle_deg", 0, 120);
  scope.field_rad = kScopeDegree * reader.number("field_deg", 10, 150);
  scope.barrel = reader.number("barrel", 0.01, 1);
  if (reader.error()) return tl::unexpected(*reader.error());
  return scope;
}

Result<std::vector<std::string>> scope_names() {
  const auto folder = scope_folder();
  if (!folder) return tl::unexpected(folder.error());
  std::vector<std::string> names;
  std::error_code ec;
  for (std::filesystem::directory_iterator it(*folder, ec), end; !ec && it != end; it.increment(ec))
    if (it->path().extension() == ".toml") names.push_back(it->path().stem().string());
  if (ec) return fail("cannot be read (" + ec.message() + ")", folder->string());
  std::sort(names.begin(), names.end());
  return names;
}

Result<ScopeDef> load_scope(const std::string& name) {
  const auto names = scope_names();
  if (!names) return tl::unexpected(names.error());
  if (std::find(names->begin(), names->end(), name) == names->end()) {
    std::string list;
    for (const std::string& known : *names) list += (list.empty() ? "" : ", ") + known;
    return fail("there is no scope '" + name + "'", "assets/scopes", "Choose one of " + list);
  }
  const std::filesystem::path file = *scope_folder() / (name + ".toml");
  constexpr std::uint64_t kLargest = 1 << 16;
  const auto text = read_file(file, kLargest);
  if (!text) return tl::unexpected(text.error());
  return parse_scope(*text, file.string());
}

}  // namespace osteon
