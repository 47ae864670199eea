#include "pieces/piece_surroundings.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "osteon/carve/carved_field.h"
#include "osteon/carve/grid_nodes.h"

namespace osteon {
namespace {

constexpr double kPieceJawsShut = 0.15;  // of their way: open ones push nothing
constexpr double kRounding_m = 1e-9;     // above that of a place in World

double level_m(const CarvedField& field, const GridNode& at) {
  const double height = field.height_m(at.block, at.node);
  const std::int16_t* cuts = field.cuts(at.block);
  return cuts ? std::max(height, -1e-6 * cuts[at.node]) : height;
}

std::optional<double> level_at(const CarvedField& field, const Vec3& p_B) {
  const auto nodes = nodes_about(field.grid(), p_B);
  if (!nodes) return std::nullopt;
  double sum = 0;
  for (const auto& [at, share] : *nodes) sum += share * level_m(field, at);
  return sum;
}

PiecePush push_of_rod(const Capsule& rod, const Vec3& p) {
  const Vec3 along = rod.p1 - rod.p0;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - rod.p0).dot(along) / length2, 0.0, 1.0) : 0;
  const Vec3 from = p - (rod.p0 + t * along);
  const double away = from.norm();
  return {rod.radius - away, away > 1e-12 ? Vec3(from / away) : Vec3::UnitX()};
}

// Inside the nearest side counts, outside it lies in nothing.
PiecePush push_of_box(const Primitive& box, const Vec3& p_T) {
  const Vec3 p = box.X_TB.inverse() * p_T;
  Eigen::Index side = 0;
  const double over = (p.cwiseAbs() - box.half).maxCoeff(&side);
  const Vec3 out = p[side] < 0 ? Vec3(-Vec3::Unit(side)) : Vec3(Vec3::Unit(side));
  return {-over, box.X_TB.rotate(out)};
}

PiecePush push_of_hull(const PieceObstacle::Part& part, const Vec3& p_B) {
  PiecePush out{1e300, Vec3::UnitZ()};
  for (const Plane& plane : part.planes_B) {
    const double depth = -plane.signed_distance(p_B);
    if (depth < out.depth_m) out = {depth, plane.n};
    if (depth <= 0) return {};
  }
  return part.planes_B.empty() ? PiecePush{} : out;
}

Aabb box_of(const BlockGrid& grid) {
  Aabb box;
  box.include(grid.lo);
  for (Eigen::Index k = 0; k < 3; ++k)
    box.hi[k] =
        grid.lo[k] + grid.cell_m * BlockGrid::kSide * grid.blocks[static_cast<std::size_t>(k)];
  return box;
}

bool is_lifted(const PieceTool& tool, std::size_t part, double jaw) {
  return tool.jaws && jaw > kPieceJawsShut && part < 64 && (tool.jaws->jaws >> part & 1) != 0;
}

}  // namespace

bool in_box(const Aabb& box, const Vec3& p) {
  return (p.array() >= box.lo.array()).all() && (p.array() <= box.hi.array()).all();
}

PiecePush push_of(const PieceObstacle& bone, const Vec3& p_B) {
  PiecePush out;
  if (!in_box(bone.box_B, p_B)) return out;
  for (const PieceObstacle::Part& part : bone.parts) {
    if (!in_box(part.box_B, p_B)) continue;
    const PiecePush push = push_of_hull(part, p_B);
    if (push.depth_m > out.depth_m) out = push;
  }
  return out;
}

PiecePush push_of(const Primitive& part, const Vec3& p_T) {
  return part.kind == Primitive::Kind::kRod ? push_of_rod(part.rod, p_T) : push_of_box(part, p_T);
}

PiecePush push_of(const CarvedField& field, const Vec3& p_B) {
  // No node beside one of an outer block lies in the bone.
  const auto nearest = nearest_node(field.grid(), p_B);
  if (!nearest || field.bone().place(nearest->block) == UncutField::Place::kOutside) return {};
  const auto level = level_at(field, p_B);
  if (!level || !(*level < 0)) return {};
  const double step = 0.5 * field.grid().cell_m;
  Vec3 slope = Vec3::Zero();
  for (int a = 0; a < 3; ++a) {
    const auto up = level_at(field, p_B + step * Vec3::Unit(a));
    const auto down = level_at(field, p_B - step * Vec3::Unit(a));
    if (up && down) slope[a] = *up - *down;
  }
  const double norm = slope.norm();
  return {-*level, norm > 1e-12 ? Vec3(slope / norm) : Vec3::UnitZ()};
}

void PieceSurroundings::add_push(std::size_t b, const Vec3& p_B, PiecePush& out) const {
  const CarvedField* const field = carved_at(b);
  const PiecePush push = field ? push_of(*field, p_B) : push_of(setup.bones[b], p_B);
  if (push.depth_m > out.depth_m) out = {push.depth_m, bones.bones[b].X_WB.rotate(push.out_W)};
}

PiecePush PieceSurroundings::in_bone(const Vec3& p_W) const {
  PiecePush out;
  for (std::size_t b = 0; b < setup.bones.size() && b < bones.count; ++b)
    if (const Pose& X_WB = bones.bones[b].X_WB; is_finite(X_WB))
      add_push(b, X_WB.inverse() * p_W, out);
  return out;
}

PieceNeighbours::PieceNeighbours(const PieceSurroundings& around, const Vec3& center_W,
                                 double radius_m)
    : around_(around),
      center_W_(center_W),
      square_(radius_m * radius_m),
      tools_(around.tool_near(center_W, radius_m + kRounding_m)),
      softs_(around.softs && around.softs->may_meet(center_W, radius_m + kRounding_m)) {
  for (std::size_t b = 0; b < around.setup.bones.size() && b < around.bones.count; ++b) {
    const Pose& X_WB = around.bones.bones[b].X_WB;
    if (!is_finite(X_WB)) continue;
    const Pose X_BW = X_WB.inverse();
    const CarvedField* const field = around.carved_at(b);
    const Aabb box_B = field ? box_of(field->grid()) : around.setup.bones[b].box_B;
    if (in_box(box_B.grown(kRounding_m + radius_m), X_BW * center_W)) near_[count_++] = {b, X_BW};
  }
}

PiecePush PieceNeighbours::in_bone(const Vec3& p_W) const {
  if (!is_inside(p_W)) return around_.in_bone(p_W);
  PiecePush out;
  for (std::size_t i = 0; i < count_; ++i)
    around_.add_push(near_[i].bone, near_[i].X_BW * p_W, out);
  return out;
}

PiecePush PieceNeighbours::in_soft(const Vec3& p_W) const {
  return softs_ || !is_inside(p_W) ? around_.in_soft(p_W) : PiecePush{};
}

PiecePush PieceNeighbours::in_tool(const Vec3& p_W) const {
  return tools_ || !is_inside(p_W) ? around_.in_tool(p_W) : PiecePush{};
}

PiecePush PieceSurroundings::in_tool(const Vec3& p_W) const {
  PiecePush out;
  for (const ToolState* const tool : tools) {
    if (tool->epoch != bones.epoch || tool->instrument >= setup.tray.size()) continue;
    if (!is_finite(tool->X_WP)) continue;
    const PieceTool& with = setup.tray[tool->instrument];
    const Vec3 p_T = tool->X_WP.inverse() * p_W;
    for (std::size_t i = 0; i < with.parts.size(); ++i) {
      if (is_lifted(with, i, tool->jaw)) continue;
      const Primitive& part = with.parts[i];
      if ((p_T - part.middle).norm() > part.radius) continue;
      const PiecePush push = osteon::push_of(part, p_T);
      if (push.depth_m > out.depth_m) out = {push.depth_m, tool->X_WP.rotate(push.out_W)};
    }
  }
  return out;
}

bool PieceSurroundings::in_tissue(const Vec3& p_W) const { return in_box(setup.limb_W, p_W); }

bool PieceSurroundings::tool_near(const Vec3& center_W, double radius_m) const {
  for (const ToolState* const tool : tools) {
    if (tool->epoch != bones.epoch || tool->instrument >= setup.tray.size()) continue;
    if (!is_finite(tool->X_WP)) continue;
    const Vec3 center_T = tool->X_WP.inverse() * center_W;
    for (const Primitive& part : setup.tray[tool->instrument].parts)
      if ((center_T - part.middle).norm() < part.radius + radius_m) return true;
  }
  return false;
}

}  // namespace osteon
