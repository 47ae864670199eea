#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/tissue/sheet_balance.h"
#include "osteon/tissue/sheet_pierce.h"

namespace osteon {

struct SkinStroke {
  std::vector<SheetPoint> points;
  double depth_m = 0;
};
struct SkinPress {
  SheetDisc disc;
  double force_n = 0;
};
/// A round tool that goes straight in and out again.
struct SkinThrust {
  SheetDisc disc;
  double depth_m = 0, speed_m_per_s = 0.02;
};

/// Where on a case's skin the piece lies.
struct SkinPlace {
  std::string the_case;  ///< as --case takes it
  std::string landmark;  ///< empty: `near_W`
  Vec3 near_W = Vec3::Zero();
  double turn_rad = 0;  ///< of the sheet about the way out of the skin
};

/// A piece of skin and what is done to it: first it is cut, then pressed, each press by itself,
/// then pierced.
struct SkinScene {
  std::string name;
  double width_m = 0, height_m = 0, edge_m = 0;
  SheetMaterial material;
  std::optional<SkinPlace> place;  ///< none: it lies by itself
  std::vector<SkinStroke> cuts;
  std::vector<SkinPress> presses;
  std::vector<SkinThrust> pierces;
};

/// Fails on a key that is missing, unknown or out of range, and says which, in what line.
Result<SkinScene> parse_skin_scene(std::string_view text, const std::string& name);
Result<SkinScene> load_skin_scene(const std::filesystem::path& path);

struct SkinCutResult {
  double stroke_m = 0, opened_m = 0;
  double off_m = 0;  ///< greatest distance of the groove from the stroke
};
struct SkinPressResult {
  SkinPress press;
  double dent_m = 0;
  double stiffness_n_per_m = 0;  ///< of a slight push there
};
struct SkinPierceResult {
  SkinThrust thrust;
  PierceLaw law;
  bool pierced = false;
  double peak_n = 0, peak_depth_m = 0;
  double deepest_n = 0;  ///< where it is deepest
  double pull_n = 0;     ///< most that holds it back on its way out
  struct Point {
    double time_s = 0, depth_m = 0, force_n = 0;
  };
  std::vector<Point> curve;
};
struct SkinResult {
  std::vector<SkinCutResult> cuts;
  std::vector<SkinPressResult> presses;
  std::vector<SkinPierceResult> pierces;
  std::size_t vertices = 0, triangles = 0, groove_triangles = 0;
  double opening_m2 = 0, widest_m = 0, groove_m3 = 0;
  TriMesh surface;  ///< at the end; with the last press' dent. Its last triangles are the groove's
};

Result<SkinResult> run_skin(const SkinScene& scene);

/// As a VTK file (legacy, ASCII, mm): cells have `part`, 0 skin and 1 groove.
std::string skin_vtk(const SkinResult& result);

}  // namespace osteon
