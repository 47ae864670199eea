// The thread, the graft and its button while a graft is placed, and what lies at a bench where one
// is made.
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

// A tendon in the thigh shows through the skin.
Eigen::Vector4f bench_color(BenchRod::Is is) {
  using Is = BenchRod::Is;
  if (is == Is::kTendon) return {0.93f, 0.90f, 0.84f, 1.0f};
  if (is == Is::kUnderSkin) return {0.66f, 0.46f, 0.40f, 1.0f};
  if (is == Is::kFascia) return {0.84f, 0.80f, 0.78f, 1.0f};
  if (is == Is::kSlit) return {0.42f, 0.13f, 0.12f, 1.0f};
  if (is == Is::kMark) return {0.24f, 0.20f, 0.52f, 1.0f};
  if (is == Is::kMuscle) return {0.58f, 0.20f, 0.18f, 1.0f};
  if (is == Is::kBand) return {0.72f, 0.42f, 0.36f, 1.0f};
  if (is == Is::kThread) return placing_color(PlacingRod::Is::kThread);
  if (is == Is::kLoop) return placing_color(PlacingRod::Is::kLoop);
  return placing_color(PlacingRod::Is::kButton);
}

}  // namespace

std::vector<BenchRod> ScenePainter::rods_at_bench(const RenderSnapshot& snapshot) const {
  return shared_->bench ? bench_rods(*shared_->bench, snapshot.bones) : std::vector<BenchRod>();
}

std::vector<ScenePainter::Capsule> ScenePainter::bench_capsules(
    const RenderSnapshot& snapshot) const {
  std::vector<Capsule> out;
  for (const BenchRod& rod : rods_at_bench(snapshot))
    out.push_back({rod.a_W, rod.b_W, rod.radius_m});
  return out;
}

std::vector<ScenePainter::Capsule> ScenePainter::placing_capsules(
    const RenderSnapshot& snapshot) const {
  std::vector<Capsule> out;
  for (const PlacingRod& rod : placing_rods(snapshot.bones))
    out.push_back({rod.a_W, rod.b_W, rod.radius_m});
  return out;
}

void ScenePainter::paint_rod(const Capsule& rod, const Eigen::Vector4f& color,
                             const Frame& frame) const {
  const Vec3 along_W = rod.b - rod.a;
  const double length_m = along_W.norm();
  if (!(length_m > 1e-6) || !is_finite(rod.a)) return;
  const Pose X_WR{rod.a, turn_between(Vec3::UnitZ(), along_W)};
  shared_->metal.set("u_view_from_model", scaled(frame.X_CW * X_WR, rod.radius_m, length_m));
  shared_->metal.set("u_color", color);
  shared_->shaft.draw();
}

void ScenePainter::paint_placing(const RenderSnapshot& snapshot, const Frame& frame) const {
  shared_->metal.use();
  for (const PlacingRod& rod : placing_rods(snapshot.bones))
    paint_rod({rod.a_W, rod.b_W, rod.radius_m}, placing_color(rod.is), frame);
  for (const BenchRod& rod : rods_at_bench(snapshot))
    paint_rod({rod.a_W, rod.b_W, rod.radius_m}, bench_color(rod.is), frame);
}

}  // namespace osteon
