#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"

namespace osteon {

/// A number with the mark of its source: "K" general knowledge, "D" our own default, "[64]" an
/// entry of docs/file-formats.md.
struct MarkedValue {
  double value = 0;
  std::string mark;
};

struct Tissue {
  std::string name;  ///< "cortical_bone"
  MarkedValue density_kg_per_m3;
  MarkedValue stiffness_n_per_m;  ///< at the hand, not a modulus
  MarkedValue static_friction;    ///< not below the dynamic one
  MarkedValue dynamic_friction;
  MarkedValue cutting_n;  ///< force at which a drill, blade or trocar advances
  MarkedValue hu;         ///< CT number of the pure tissue, Hounsfield units
  std::array<double, 3> colour_srgb = {1, 1, 1};
};

struct TissueTable {
  std::vector<Tissue> tissues;
  /// Null when no tissue has this name.
  const Tissue* find(std::string_view name) const;
};

/// Reads the text of a tissue table (docs/file-formats.md). Strict: an unknown or missing key, a
/// number out of range, a missing mark and a name that repeats are errors, which name the line.
Result<TissueTable> parse_tissue_table(std::string_view text, const std::string& where);
Result<TissueTable> load_tissue_table(const std::filesystem::path& file);
/// assets/materials/tissue.toml.
Result<TissueTable> load_default_tissues();

}  // namespace osteon
