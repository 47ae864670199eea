#include "scene_reader.h"

#include <cstdio>

#include "osteon/base/file.h"

namespace osteon {
namespace {

std::string short_form(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

std::string from_to(Within within) {
  return "from " + short_form(within.lo) + " to " + short_form(within.hi);
}

const toml::table& no_keys() {
  static const toml::table empty;
  return empty;
}

std::optional<double> number_in(const toml::node* node, Within within) {
  const auto value = node && node->is_number() ? node->value<double>() : std::nullopt;
  if (value && *value >= within.lo && *value <= within.hi) return value;
  return std::nullopt;
}

std::string join(const std::string& table, std::string_view key) {
  return table.empty() ? std::string(key) : table + "." + std::string(key);
}

}  // namespace

void SceneReader::complain(const std::string& what, const Table& in, std::string_view key,
                           std::string todo) {
  if (error_) return;
  const toml::node* node = in.keys->get(key);
  const auto line = (node ? node->source() : in.keys->source()).begin.line;
  error_ = Error{"'" + join(in.name, key) + "' " + what,
                 line > 0 ? file_ + ", line " + std::to_string(line) : file_, std::move(todo)};
}

SceneReader::Table SceneReader::table(const Table& in, std::string_view key) {
  const toml::node* node = in.keys->get(key);
  const std::string name = join(in.name, key);
  if (node && node->is_table()) return {node->as_table(), name};
  complain(node ? "must be a table" : "is missing", in, key);
  return {&no_keys(), name};
}

std::vector<SceneReader::Table> SceneReader::tables(const Table& in, std::string_view key) {
  std::vector<Table> out;
  const toml::node* node = in.keys->get(key);
  if (!node) return out;
  const toml::array* list = node->as_array();
  if (!list) complain("must be a list of tables: [[" + std::string(key) + "]]", in, key);
  for (std::size_t i = 0; list && i < list->size(); ++i) {
    const toml::table* t = (*list)[i].as_table();
    if (!t) complain("must be a list of tables: [[" + std::string(key) + "]]", in, key);
    if (t) out.push_back({t, join(in.name, key) + "[" + std::to_string(i) + "]"});
  }
  return out;
}

void SceneReader::only(const Table& in, std::initializer_list<std::string_view> known) {
  for (const auto& [key, node] : *in.keys) {
    bool found = false;
    for (const std::string_view k : known) found = found || k == key.str();
    if (!found) complain("is not a known key here", in, key.str(), "Remove it");
  }
}

double SceneReader::number(const Table& in, std::string_view key, Within within) {
  const auto value = number_in(in.keys->get(key), within);
  if (!value) complain("must be a number " + from_to(within), in, key);
  return value.value_or(within.lo);
}

double SceneReader::number_or(const Table& in, std::string_view key, Within within,
                              double otherwise) {
  return has(in, key) ? number(in, key, within) : otherwise;
}

int SceneReader::integer(const Table& in, std::string_view key, int lo, int hi) {
  const toml::node* node = in.keys->get(key);
  const auto value = node ? node->value_exact<std::int64_t>() : std::nullopt;
  if (value && *value >= lo && *value <= hi) return static_cast<int>(*value);
  complain("must be a whole number from " + std::to_string(lo) + " to " + std::to_string(hi), in,
           key);
  return lo;
}

bool SceneReader::truth_or(const Table& in, std::string_view key, bool otherwise) {
  const toml::node* node = in.keys->get(key);
  if (!node) return otherwise;
  const auto value = node->value_exact<bool>();
  if (!value) complain("must be true or false", in, key);
  return value.value_or(otherwise);
}

std::string SceneReader::text(const Table& in, std::string_view key) {
  const toml::node* node = in.keys->get(key);
  const auto value = node ? node->value_exact<std::string>() : std::nullopt;
  if (!value || value->empty()) complain("must be a text", in, key);
  return value.value_or("");
}

std::optional<Vec3> SceneReader::three(const toml::node* node, Within within) const {
  const toml::array* list = node ? node->as_array() : nullptr;
  if (!list || list->size() != 3) return std::nullopt;
  Vec3 out;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto value = number_in(list->get(i), within);
    if (!value) return std::nullopt;
    out[static_cast<Eigen::Index>(i)] = *value;
  }
  return out;
}

Vec3 SceneReader::vec3(const Table& in, std::string_view key, Within within) {
  const auto value = three(in.keys->get(key), within);
  if (!value) complain("must be a list of three numbers, each " + from_to(within), in, key);
  return value.value_or(Vec3::Zero());
}

std::vector<Vec3> SceneReader::points(const Table& in, std::string_view key, Within within) {
  std::vector<Vec3> out;
  const toml::node* node = in.keys->get(key);
  const toml::array* list = node ? node->as_array() : nullptr;
  for (std::size_t i = 0; list && i < list->size(); ++i)
    if (const auto point = three(list->get(i), within)) out.push_back(*point);
  if (!list || out.size() != list->size())
    complain("must be a list of points, each of three numbers " + from_to(within), in, key);
  return out;
}

Result<toml::table> parse_scene_toml(std::string_view text, const std::string& name) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& e) {
    return fail(std::string(e.description()),
                name + ", line " + std::to_string(e.source().begin.line), "Fix the TOML there");
  }
}

Result<std::string> read_scene_file(const std::filesystem::path& path) {
  constexpr std::uint64_t kLargestBytes = 1 << 24;
  return read_file(path, kLargestBytes);
}

}  // namespace osteon
