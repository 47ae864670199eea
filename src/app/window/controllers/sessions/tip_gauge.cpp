#include "window/controllers/sessions/tip_gauge.h"

#include <limits>

namespace osteon {
namespace {

double distance_to_box(const Aabb& box, const Vec3& p) {
  return (box.lo - p).cwiseMax(p - box.hi).cwiseMax(Vec3::Zero()).norm();
}

bool is_drawn(const ViewState& view, std::size_t bone) {
  return bone >= view.bones.size() || view.bones[bone].visible;
}

}  // namespace

Result<TipGauge::Surfaces> TipGauge::make(const Case& the_case, const Progress& progress) {
  Surfaces out;
  for (const Bone& bone : the_case.bones) {
    if (progress && !progress("Measuring the bones", 0)) return fail("stopped");
    Aabb box;
    for (const Vec3& p : bone.mesh.vertices) box.include(p);
    out.push_back({MeshDistance(bone.mesh), box, 0});
  }
  return out;
}

void TipGauge::begin(std::shared_ptr<const Case> the_case) {
  surfaces_.clear();
  job_ = std::make_unique<SideJob<Surfaces>>(
      [the_case](const Progress& progress) { return make(*the_case, progress); });
}

// A bone whose box is farther away than the nearest surface so far is not asked.
std::optional<TipGauge::Nearest> TipGauge::nearest(const RenderSnapshot& snapshot,
                                                   const ViewState& view) {
  if (job_ && job_->done()) {
    if (auto made = job_->take()) surfaces_ = std::move(*made);
    job_.reset();
  }
  const Vec3& tip_W = snapshot.tool.X_WP.p;
  std::optional<Nearest> best;
  double least = std::numeric_limits<double>::infinity();
  if (!is_finite(tip_W)) return best;
  for (std::size_t k = 0; k < surfaces_.size() && k < snapshot.bones.count; ++k) {
    BoneSurface& bone = surfaces_[k];
    if (!is_drawn(view, k) || bone.box_B.empty()) continue;
    const Pose& X_WB = snapshot.bones.bones[k].X_WB;
    const Vec3 tip_B = X_WB.inverse() * tip_W;
    if (distance_to_box(bone.box_B, tip_B) > std::abs(least)) continue;
    const ClosestPoint found = bone.distance.closest(tip_B, bone.guess);
    bone.guess = found.triangle;
    if (found.signed_distance >= least) continue;
    least = found.signed_distance;
    best = Nearest{BoneId{static_cast<std::uint32_t>(k)}, X_WB * found.point, least};
  }
  return best;
}

}  // namespace osteon
