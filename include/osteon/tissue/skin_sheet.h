#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

using SheetPoint = Eigen::Vector2d;  ///< in the plane of the sheet at rest, m

/// Skin on its fat: a membrane under tension, held by springs across it and along it.
struct SheetMaterial {
  double stretch_n_per_m = 1000;       ///< Young's modulus times thickness
  double poisson = 0.45;               ///< plane stress
  double tension_n_per_m = 80;         ///< of the whole sheet at rest, the same in all directions
  double foundation_n_per_m3 = 2.4e6;  ///< pressure of the fat for each metre of a slight dent
  double fat_m = 0.012;                ///< a dent comes near it, never so deep: the fat stiffens
  double tether_n_per_m3 = 1e5;        ///< the same for skin that slides on its fat
  double thickness_m = 0.002;          ///< a cut less deep opens nothing
  double friction = 0.3;               ///< of a shaft in a hole
  double pierce_pa = 1.27e6;           ///< mean pressure under a tip that breaks it
  double fat_pierce_pa = 1e5;          ///< the same of the fat
};

/// An edge of the sheet between the vertices a < b. On the rim it has one triangle.
struct SheetEdge {
  std::uint32_t a = 0, b = 0;
  std::array<std::uint32_t, 2> triangle{};
  std::uint32_t triangles = 0;
};

/// The sheet as it was before any cut: a rectangle of nearly equilateral triangles about the
/// origin, its rim held. Never changes.
class SkinSheet {
 public:
  /// `width_m` along x and `height_m` along y, with triangles of sides near `edge_m`. Fails on
  /// sizes that are no numbers, fewer than 4 or more than 400 triangles along a side, and on a
  /// material that has no balance.
  static Result<SkinSheet> make(double width_m, double height_m, double edge_m,
                                const SheetMaterial& material);

  const SheetMaterial& material() const { return material_; }
  double edge_m() const { return edge_m_; }
  bool is_on(const SheetPoint& p) const {
    return std::abs(p.x()) <= 0.5 * width_m_ && std::abs(p.y()) <= 0.5 * height_m_;
  }
  std::span<const SheetPoint> points() const { return points_; }
  std::span<const Triangle> triangles() const { return triangles_; }
  std::span<const SheetEdge> edges() const { return edges_; }
  bool is_rim(std::uint32_t vertex) const { return rim_[vertex]; }
  std::span<const std::uint32_t> edges_at(std::uint32_t vertex) const;
  std::span<const std::uint32_t> triangles_at(std::uint32_t vertex) const;

 private:
  SheetMaterial material_;
  double width_m_ = 0, height_m_ = 0, edge_m_ = 0;
  std::vector<SheetPoint> points_;
  std::vector<Triangle> triangles_;
  std::vector<SheetEdge> edges_;
  std::vector<bool> rim_;
  std::vector<std::uint32_t> edge_first_, edge_list_, triangle_first_, triangle_list_;
};

/// All that cuts change: a value. The blade is in it, so that a stroke can go on.
struct SheetCuts {
  std::vector<SheetPoint> points;  ///< of the sheet's vertices: cuts draw them onto the stroke
  std::vector<double> depth_m;     ///< of each edge; 0: whole
  bool blade_in = false;
  std::uint32_t blade_at = 0;  ///< vertex that the stroke has reached
};

SheetCuts whole_sheet(const SkinSheet& sheet);
/// Sets the blade in: the nearest vertex that may move is drawn under it. Off the sheet, nothing
/// happens.
void begin_stroke(const SkinSheet& sheet, SheetCuts& cuts, const SheetPoint& p);
/// Cuts on from where the stroke has come, towards `p`, so deep, by whole edges: it stays behind
/// the blade by an edge at most. A blade that comes off the sheet is out. Returns the length that
/// is open now and was not before, m.
double go_on(const SkinSheet& sheet, SheetCuts& cuts, const SheetPoint& p, double depth_m);
/// Takes the blade out at `p`: what is left of the stroke is cut, if it is half an edge or more.
double end_stroke(const SkinSheet& sheet, SheetCuts& cuts, const SheetPoint& p, double depth_m);

/// Length of the open slit that a round tip at `p` is over, m: of all edges that hang together with
/// the nearest open one; 0 where none is within the tip.
double slit_under(const SkinSheet& sheet, const SheetCuts& cuts, const SheetPoint& p,
                  double radius_m);

/// A side of a cut edge: the groove's wall hangs on it.
struct SheetWall {
  std::uint32_t from = 0, to = 0;            ///< copies, as their triangle goes round
  std::uint32_t from_base = 0, to_base = 0;  ///< the vertices of the sheet that they are copies of
};

/// The sheet with the vertices of its cuts duplicated: one copy for each part of the fan of
/// triangles about a vertex that open edges leave connected. So it is a manifold whatever is cut.
struct SplitSheet {
  std::vector<Triangle> triangles;    ///< of copies; in the order of the sheet's
  std::vector<std::uint32_t> vertex;  ///< of each copy
  std::vector<SheetPoint> point;      ///< of each copy
  std::vector<std::uint32_t> copies;  ///< of each vertex
  std::vector<SheetWall> walls;
  std::vector<double> groove_m;  ///< of each vertex: how deep the groove is there; 0 at its ends
};
SplitSheet split(const SkinSheet& sheet, const SheetCuts& cuts);

/// The surface as it looks, z up: the skin's triangles first, as many as the sheet has, then those
/// of the groove. `ways` and `down` of each copy as SheetBalance gives them, or empty. With its rim
/// the one boundary it is a manifold.
TriMesh sheet_surface(const SplitSheet& split, std::span<const SheetPoint> ways,
                      std::span<const double> down);

/// Volume of the groove under the sheet's own plane, m3: of `surface` made without dents.
double groove_volume(const SplitSheet& split, const TriMesh& surface);
/// Widest distance between two lips, m.
double widest(const SplitSheet& split, std::span<const SheetPoint> ways);
/// Area of the sheet's triangles at rest, m2: no cut changes it.
double sheet_area(const SplitSheet& split);
/// Area between the lips, m2: that of the sheet's rim less that of its triangles as they are.
double open_area(const SplitSheet& split, std::span<const SheetPoint> ways);

}  // namespace osteon
