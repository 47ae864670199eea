#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"
#include "osteon/mesh/tet_mesh.h"
#include "osteon/tissue/hex_solid.h"
#include "osteon/tissue/rod.h"
#include "osteon/tissue/solid_material.h"

namespace osteon {

enum class TissueModel { kNeoHookean, kLinear, kCorotated, kRod };

/// A rod along a polyline.
struct RodShape {
  std::vector<Vec3> points_m;
  double radius_m = 0.001;
  int segments = 40;
  bool straight_at_rest = false;  ///< else at rest as the points say
};

/// What is solved; one of the three.
struct SolveBody {
  std::optional<HexGrid> grid;
  std::filesystem::path vtk;  ///< as the scene names it; empty: none
  TetMesh tets;               ///< read from `vtk`
  std::optional<RodShape> rod;
};

using HeldAxes = std::array<bool, 3>;

struct FixedBox {
  Aabb box_m;
  HeldAxes axes{true, true, true};
  /// Rods: hold the direction and twist of every segment that it reaches, or of none. Without: of
  /// the segments with both ends in the box.
  std::optional<bool> clamp = std::nullopt;
};
struct MovedBox {
  Aabb box_m;
  HeldAxes axes{true, true, true};
  Vec3 by_m = Vec3::Zero();
  double over_s = 0;
  std::optional<bool> clamp = std::nullopt;  ///< as of FixedBox
  Vec3 turn_rad = Vec3::Zero();  ///< rods: axis times angle, about the middle of the nodes it holds
};
/// A force in all, shared by the masses of the nodes in the box.
struct LoadBox {
  Aabb box_m;
  Vec3 force_n = Vec3::Zero();
  double over_s = 0;
};

/// A cut across a rod, at the node nearest to a place of it at rest.
struct RodCutPlace {
  Vec3 at_m = Vec3::Zero();
  double at_s = 0;
};

/// A body, what holds, moves and loads it, and for how long: the input of `osteon tissue solve`,
/// see docs/tissue.md.
struct SolveScene {
  std::string name;  ///< for errors
  SolveBody body;
  TissueModel model = TissueModel::kNeoHookean;
  SolidMaterial material;
  bool condensed = false;  ///< linear: the static answer, by the surface alone
  std::vector<FixedBox> fixed;
  std::vector<MovedBox> moved;
  std::vector<LoadBox> loads;
  std::vector<RodObstacle> obstacles;  ///< rods only
  std::vector<RodCutPlace> cuts;       ///< rods only
  double friction = 0.3;               ///< of a rod on itself
  Vec3 gravity_m_per_s2 = Vec3::Zero();
  double time_s = 1;
  std::vector<Vec3> probes_m;
};

/// Strict: a key that is missing, unknown, of another type or out of range fails with its name and
/// line. Reads no other file: a mesh stays a name.
Result<SolveScene> parse_solve_scene(std::string_view text, const std::string& name);

/// Reads the file and the mesh that it names (from the scene's folder).
Result<SolveScene> load_solve_scene(const std::filesystem::path& path);

}  // namespace osteon
