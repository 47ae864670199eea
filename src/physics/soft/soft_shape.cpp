#include "osteon/physics/soft_shape.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

std::vector<SolidPushes::One> pushes_on(std::size_t solid, const SolidPushes& pushes) {
  std::vector<SolidPushes::One> out;
  for (std::uint32_t i = 0; i < pushes.count; ++i)
    if (pushes.all[i].solid == solid) out.push_back(pushes.all[i]);
  return out;
}

// Beyond that a push looks like another one. Where none was, or none is left, is always seen.
constexpr double kStill_n = 0.005, kStill_m = 1e-4, kStill_turn = 1e-3;

bool looks_still(const SolidPushes::One& a, const SolidPushes::One& b) {
  return std::abs(a.force_n - b.force_n) < kStill_n && (a.p_B - b.p_B).norm() < kStill_m &&
         (a.nhat_B - b.nhat_B).norm() < kStill_turn;
}

}  // namespace

SoftShapes::SoftShapes(const Case& the_case, std::shared_ptr<const SoftSetup> setup)
    : setup_(std::move(setup)) {
  if (!setup_) return;
  for (const SoftSolid& solid : setup_->solids) {
    Shape shape{the_case.softs[solid.soft].mesh_W, the_case.bone(solid.bone).X_WB, {}, {}};
    const Pose X_BW = shape.X_WB.inverse();
    for (const Vec3& p : shape.mesh_W.vertices)
      shape.patches.push_back(solid.body->patch_at(X_BW * p));
    shapes_.push_back(std::move(shape));
  }
}

std::vector<Vec3> SoftShapes::moved(std::size_t solid,
                                    std::span<const SolidPushes::One> pushes) const {
  const PressedSolid& body = *setup_->solids[solid].body;
  std::vector<SolidPush> here;
  for (const SolidPushes::One& one : pushes)
    here.push_back(body.push_at(one.p_B, one.nhat_B, one.force_n));
  return body.moved(here);
}

std::vector<SoftShapes::Changed> SoftShapes::changes(const SolidPushes& pushes) {
  std::vector<Changed> out;
  for (std::size_t s = 0; s < shapes_.size(); ++s) {
    Shape& shape = shapes_[s];
    std::vector<SolidPushes::One> now = pushes_on(s, pushes);
    if (std::equal(now.begin(), now.end(), shape.shown.begin(), shape.shown.end(), looks_still))
      continue;
    const std::vector<Vec3> nodes = moved(s, now);
    shape.shown = std::move(now);
    Changed changed{setup_->solids[s].soft, shape.mesh_W};
    for (std::size_t v = 0; v < shape.patches.size(); ++v)
      changed.mesh_W.vertices[v] +=
          shape.X_WB.rotate(PressedSolid::moved_at(shape.patches[v], nodes));
    out.push_back(std::move(changed));
  }
  return out;
}

}  // namespace osteon
