// The thread, the graft and its button while a graft is placed.
#include "scene_painter.h"

#include "osteon/base/turn.h"

namespace osteon {
namespace {

Eigen::Vector4f placing_color(PlacingRod::Is is) {
  if (is == PlacingRod::Is::kThread) return {0.16f, 0.42f, 0.30f, 1.0f};
  if (is == PlacingRod::Is::kGraft) return {0.90f, 0.86f, 0.76f, 1.0f};
  if (is == PlacingRod::Is::kLoop) return {0.86f, 0.88f, 0.92f, 1.0f};
  return {0.62f, 0.65f, 0.69f, 1.0f};
}

}  // namespace

std::vector<ScenePainter::Capsule> ScenePainter::placing_capsules(
    const RenderSnapshot& snapshot) const {
  std::vector<Capsule> out;
  for (const PlacingRod& rod : placing_rods(snapshot.bones))
    out.push_back({rod.a_W, rod.b_W, rod.radius_m});
  return out;
}

void ScenePainter::paint_placing(const RenderSnapshot& snapshot, const Frame& frame) const {
  for (const PlacingRod& rod : placing_rods(snapshot.bones)) {
    const Vec3 along_W = rod.b_W - rod.a_W;
    const double length_m = along_W.norm();
    if (!(length_m > 1e-6) || !is_finite(rod.a_W)) continue;
    const Pose X_WR{rod.a_W, turn_between(Vec3::UnitZ(), along_W)};
    shared_->metal.use();
    shared_->metal.set("u_view_from_model", scaled(frame.X_CW * X_WR, rod.radius_m, length_m));
    shared_->metal.set("u_color", placing_color(rod.is));
    shared_->shaft.draw();
  }
}

}  // namespace osteon
