#include <toml++/toml.h>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>

#include "osteon/base/file.h"
#include "osteon/carve/thrust.h"

namespace osteon {
namespace {

/// Reads numbers with marks and remembers the first thing that is wrong.
class TableReader {
 public:
  explicit TableReader(std::string where) : where_(std::move(where)) {}

  double number(const toml::table& from, const std::string& key, double lo, double hi) {
    const toml::array* pair = from[key].as_array();
    if (!pair || pair->size() != 2 || !pair->get(0)->is_number() || !pair->get(1)->is_string()) {
      wrong("'" + key + "' must be [number, \"mark\"]", from);
      return lo;
    }
    const double value = *pair->get(0)->value<double>();
    if (!(value >= lo && value <= hi)) wrong("'" + key + "' is out of range", from);
    return value;
  }

  void allow_only(const toml::table& from, std::initializer_list<std::string_view> keys) {
    for (const auto& [key, value] : from) {
      bool known = false;
      for (const std::string_view k : keys) known = known || k == key.str();
      if (!known) wrong("there is no key '" + std::string(key.str()) + "'", from);
    }
  }

  const toml::table& part(const toml::table& from, const std::string& key) {
    static const toml::table none;
    const toml::table* found = from[key].as_table();
    if (!found) wrong("'[" + key + "]' is missing", from);
    return found ? *found : none;
  }

  void wrong(const std::string& what, const toml::node& at) {
    if (error_.what.empty())
      error_ = {what, where_ + ":" + std::to_string(at.source().begin.line), "See docs/tunnels.md"};
  }
  const Error& error() const { return error_; }

 private:
  std::string where_;
  Error error_;
};

constexpr double kMost = std::numeric_limits<double>::max();

DrillMaterial read_material(TableReader& reader, const toml::table& from) {
  reader.allow_only(from, {"name", "thrust_n", "specific_energy_j_per_m3", "edge_share"});
  DrillMaterial m;
  m.name = from["name"].value_or(std::string());
  if (m.name.empty()) reader.wrong("a material has no name", from);
  m.thrust_n = reader.number(from, "thrust_n", 1e-6, 1e4);
  m.specific_energy_j_per_m3 = reader.number(from, "specific_energy_j_per_m3", 0, kMost);
  m.edge_share = reader.number(from, "edge_share", 0, 0.99);
  return m;
}

void read_tools(TableReader& reader, const toml::table& root, DrillTable& table) {
  const toml::table& usual = reader.part(root, "usual");
  reader.allow_only(usual, {"diameter_m", "speed_rev_per_s", "feed_m_per_rev"});
  table.usual_diameter_m = reader.number(usual, "diameter_m", 1e-5, 0.1);
  table.usual_speed_rev_per_s = reader.number(usual, "speed_rev_per_s", 1e-3, 1e5);
  table.usual_feed_m_per_rev = reader.number(usual, "feed_m_per_rev", 1e-9, 0.1);
  const toml::table& drill = reader.part(root, "drill");
  reader.allow_only(drill, {"largest_feed_m_per_rev", "skive_angle_deg", "start_depth_m", "rubbing",
                            "blunt_factor"});
  table.largest_feed_m_per_rev = reader.number(drill, "largest_feed_m_per_rev", 1e-9, 0.1);
  table.skive_angle_rad = reader.number(drill, "skive_angle_deg", 0, 90) * M_PI / 180;
  table.start_depth_m = reader.number(drill, "start_depth_m", 0, 0.1);
  table.rubbing = reader.number(drill, "rubbing", 0, 10);
  table.blunt_factor = reader.number(drill, "blunt_factor", 1, 1e3);
  const toml::table& reamer = reader.part(root, "reamer");
  reader.allow_only(
      reamer, {"teeth", "chatter_depth_m", "chatter_gain", "chatter_most_m", "chatter_most_n"});
  table.reamer_teeth = reader.number(reamer, "teeth", 1, 100);
  table.chatter_depth_m = reader.number(reamer, "chatter_depth_m", 0, 0.1);
  table.chatter_gain = reader.number(reamer, "chatter_gain", 0, 10);
  table.chatter_most_m = reader.number(reamer, "chatter_most_m", 0, 0.01);
  table.chatter_most_n = reader.number(reamer, "chatter_most_n", 0, 10);
}

void read_heat(TableReader& reader, const toml::table& root, DrillTable& table) {
  const toml::table& from = reader.part(root, "heat");
  reader.allow_only(
      from, {"conductivity_w_per_m_k", "density_kg_per_m3", "heat_capacity_j_per_kg_k", "body_c",
             "chips_share", "rubbing_share", "outrun_m_per_s", "water_c", "water_w_per_m2_k",
             "necrosis_a_c", "necrosis_a_s", "necrosis_b_c", "necrosis_b_s"});
  HeatMaterial& m = table.heat;
  m.conductivity_w_per_m_k = reader.number(from, "conductivity_w_per_m_k", 1e-3, 1e3);
  m.density_kg_per_m3 = reader.number(from, "density_kg_per_m3", 1, 1e5);
  m.heat_capacity_j_per_kg_k = reader.number(from, "heat_capacity_j_per_kg_k", 1, 1e5);
  m.body_c = reader.number(from, "body_c", 0, 45);
  table.chips_heat_share = reader.number(from, "chips_share", 0, 1);
  table.rubbing_heat_share = reader.number(from, "rubbing_share", 0, 1);
  table.outrun_m_per_s = reader.number(from, "outrun_m_per_s", 1e-9, 1);
  table.water.water_c = reader.number(from, "water_c", 0, 100);
  table.water.transfer_w_per_m2_k = reader.number(from, "water_w_per_m2_k", 0, 1e6);
  m.necrosis[0] = {reader.number(from, "necrosis_a_c", 38, 200),
                   reader.number(from, "necrosis_a_s", 0, 1e6)};
  m.necrosis[1] = {reader.number(from, "necrosis_b_c", 38, 200),
                   reader.number(from, "necrosis_b_s", 0, 1e6)};
}

}  // namespace

Result<DrillTable> parse_drill_table(std::string_view text, const std::string& where) {
  toml::table root;
  try {
    root = toml::parse(text, where);
  } catch (const toml::parse_error& e) {
    return fail(std::string(e.description()), where + ":" + std::to_string(e.source().begin.line),
                "Fix the file");
  }
  TableReader reader(where);
  reader.allow_only(root, {"usual", "material", "drill", "heat", "reamer"});
  DrillTable table;
  read_tools(reader, root, table);
  read_heat(reader, root, table);
  if (const toml::array* materials = root["material"].as_array())
    for (const toml::node& node : *materials) {
      if (const toml::table* from = node.as_table())
        table.materials.push_back(read_material(reader, *from));
      else
        reader.wrong("'material' must be a list of tables", node);
    }
  if (table.materials.empty()) reader.wrong("there is no material", root);
  if (!reader.error().what.empty()) return tl::unexpected(reader.error());
  return table;
}

Result<DrillTable> load_drill_table(const std::filesystem::path& file) {
  const auto text = read_file(file, 1 << 20);
  if (!text) return tl::unexpected(text.error());
  return parse_drill_table(*text, file.string());
}

}  // namespace osteon
