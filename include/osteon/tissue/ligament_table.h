#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"

namespace osteon {

/// Places in the table are those of the built-in right knee stretched out, metres, its frame.

/// Fibres of a ligament that get tight together.
struct LigamentBundle {
  std::string name;                ///< "anteromedial"
  std::vector<Vec3> femur, tibia;  ///< ends of each fibre, see LigamentRow
  double stiffness_n = 0;          ///< of all its fibres, for a strain of 1
  double taut_deg = 0;             ///< bend at which its fibres have `strain`
  double strain = 0;
  double most_strain = 1;  ///< beyond which no fibre is stretched by bending the joint alone
};

struct LigamentRow {
  std::string name;  ///< "acl"
  /// Soft part of the case whose ends the fibres' ends are counted from; empty: they are places,
  /// and each is laid on the bone.
  std::string part;
  bool over_tibia = false;  ///< the band lies over the tibia's rim
  /// Of a table of what is felt: the bone that the band lies on from its bend on; empty: none.
  std::string over_bone;
  double failure_n = 1e9;  ///< tension at which it tears; not given: never
  std::vector<LigamentBundle> bundles;
};

/// What a finding leaves of a ligament.
struct TornRow {
  std::string finding, grade;  ///< no grade: any
  std::string ligament;
  double left = 0;               ///< share of its fibres' stiffness
  std::optional<double> strain;  ///< of its fibres at rest then; none: as without the finding
};

/// A disc between two bones as an elastic solid whose fibres run from one to the other under
/// tension.
struct DiscRow {
  std::string part;  ///< soft part of the case; empty: the table has none
  double young_pa = 0, tension_pa = 0;
};

/// A test by hand: a bend and the load on top of the seating force.
struct LaxityTestRow {
  std::string name;
  double flexion_deg = 0;
  double anterior_n = 0, varus_nm = 0, internal_nm = 0;
};

struct GraftRow {
  std::string ligament;  ///< in whose place it stands
  double diameter_m = 0;
  double young_pa = 0;          ///< of the bundle of tendons
  double fixation_n_per_m = 0;  ///< button, loop and screw together
  double tension_n = 0;         ///< it is pulled with while it is fixed
  double flexion_deg = 0;       ///< and the knee's bend then
  double kept = 1;              ///< share of the tension that is left after cycling
};

struct LigamentTable {
  double width_m = 0;  ///< between the epicondyles of the knee that the places are of
  double toe_strain = 0;
  double cartilage_young_pa = 0, cartilage_poisson = 0;
  double seating_n = 0;  ///< presses the tibia on the femur in every test
  double surround_n_per_m = 0, across_n_per_m = 0, surround_nm_per_rad = 0;
  std::vector<LigamentRow> ligaments;
  std::vector<TornRow> torn;
  std::vector<LaxityTestRow> tests;
  GraftRow graft;
  DiscRow disc;
};

/// Reads assets/tissue/knee_ligaments.toml or one like it; strict, errors name key and line.
Result<LigamentTable> load_ligament_table(const std::filesystem::path& file);

/// Reads assets/tissue/wrist_ligaments.toml or one like it, of a joint whose laxity is not worked
/// out: what is felt of its ligaments and its disc alone. Everything else is left as it is.
Result<LigamentTable> load_felt_table(const std::filesystem::path& file);

}  // namespace osteon
