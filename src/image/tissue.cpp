#include "osteon/image/tissue.h"

#include <toml++/toml.h>

#include <cmath>
#include <cstddef>
#include <set>

#include "osteon/base/file.h"

namespace osteon {
namespace {

constexpr std::uint64_t kLimitBytes = 1 << 20;

struct NumberKey {
  const char* key;
  MarkedValue Tissue::*field;
  double lo, hi;
};

constexpr NumberKey kNumbers[] = {
    {"density_kg_per_m3", &Tissue::density_kg_per_m3, 0.1, 25000},
    {"stiffness_n_per_m", &Tissue::stiffness_n_per_m, 0, 1e5},
    {"static_friction", &Tissue::static_friction, 0, 2},
    {"dynamic_friction", &Tissue::dynamic_friction, 0, 2},
    {"cutting_n", &Tissue::cutting_n, 0, 1000},
    {"hu", &Tissue::hu, -1024, 30000},
};

std::string place(const toml::node& node, const std::string& where) {
  return where + ", line " + std::to_string(node.source().begin.line);
}

Result<MarkedValue> read_marked(const toml::table& table, const NumberKey& number,
                                const std::string& where) {
  const std::string key = number.key;
  const toml::node* node = table.get(key);
  if (!node) return fail("'" + key + "' is missing", place(table, where), "Add it");
  const toml::array* pair = node->as_array();
  const auto value = pair && pair->size() == 2 ? (*pair)[0].value<double>() : std::nullopt;
  const auto mark = pair && pair->size() == 2 ? (*pair)[1].value<std::string>() : std::nullopt;
  if (!value || !mark || mark->empty())
    return fail("'" + key + "' must be a number and the mark of its source", place(*node, where),
                "Write " + key + " = [1900, \"K\"]");
  if (!std::isfinite(*value) || *value < number.lo || *value > number.hi)
    return fail("'" + key + "' is out of range", place(*node, where), "Check the number");
  return MarkedValue{*value, *mark};
}

Result<std::array<double, 3>> read_colour(const toml::table& table, const std::string& where) {
  const toml::array* list = table["colour_srgb"].as_array();
  std::array<double, 3> colour{};
  bool good = list && list->size() == 3;
  for (std::size_t i = 0; good && i < 3; ++i) {
    colour[i] = (*list)[i].value<double>().value_or(-1);
    good = colour[i] >= 0 && colour[i] <= 1;
  }
  if (!good)
    return fail("'colour_srgb' must be three numbers from 0 to 1", place(table, where), "Add it");
  return colour;
}

Result<void> refuse_unknown_keys(const toml::table& table, const std::string& where) {
  std::set<std::string> known = {"name", "colour_srgb"};
  for (const NumberKey& number : kNumbers) known.insert(number.key);
  for (const auto& [key, node] : table)
    if (!known.count(std::string(key.str())))
      return fail("'" + std::string(key.str()) + "' is not a key of a tissue", place(node, where),
                  "Remove it or correct its spelling");
  return {};
}

Result<Tissue> read_tissue(const toml::table& table, const std::string& where) {
  Tissue tissue;
  tissue.name = table["name"].value_or(std::string());
  if (tissue.name.empty()) return fail("a tissue has no name", place(table, where), "Add 'name'");
  if (auto known = refuse_unknown_keys(table, where); !known) return tl::unexpected(known.error());
  for (const NumberKey& number : kNumbers) {
    auto value = read_marked(table, number, where);
    if (!value) return tl::unexpected(value.error());
    tissue.*number.field = std::move(*value);
  }
  if (tissue.dynamic_friction.value > tissue.static_friction.value)
    return fail("the dynamic friction is above the static one", place(table, where), "Swap them");
  auto colour = read_colour(table, where);
  if (!colour) return tl::unexpected(colour.error());
  tissue.colour_srgb = *colour;
  return tissue;
}

}  // namespace

const Tissue* TissueTable::find(std::string_view name) const {
  for (const Tissue& tissue : tissues)
    if (tissue.name == name) return &tissue;
  return nullptr;
}

Result<TissueTable> parse_tissue_table(std::string_view text, const std::string& where) {
  TissueTable result;
  try {
    const toml::table root = toml::parse(text);
    const toml::array* list = root["tissue"].as_array();
    if (!list || root.size() != 1)
      return fail("holds something other than [[tissue]] entries", where, "See file-formats.md");
    for (const toml::node& node : *list) {
      if (!node.is_table()) return fail("'tissue' must hold tables", place(node, where));
      auto tissue = read_tissue(*node.as_table(), where);
      if (!tissue) return tl::unexpected(tissue.error());
      if (result.find(tissue->name))
        return fail("'" + tissue->name + "' comes twice", place(node, where), "Remove one");
      result.tissues.push_back(std::move(*tissue));
    }
  } catch (const toml::parse_error& e) {
    return fail("is not TOML: " + std::string(e.description()),
                where + ", line " + std::to_string(e.source().begin.line), "Correct the line");
  }
  return result;
}

Result<TissueTable> load_tissue_table(const std::filesystem::path& file) {
  const auto text = read_file(file, kLimitBytes);
  if (!text) return tl::unexpected(text.error());
  return parse_tissue_table(*text, file.string());
}

Result<TissueTable> load_default_tissues() {
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  return load_tissue_table(*data / "assets/materials/tissue.toml");
}

}  // namespace osteon
