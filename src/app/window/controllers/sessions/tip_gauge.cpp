#include "window/controllers/sessions/tip_gauge.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace osteon {
namespace {

constexpr double kIntoSkin_m = 0.002;  // a blade's tip is still at the skin so deep
constexpr int kSkinCells = 24;         // along each side of a patch

double distance_to_box(const Aabb& box, const Vec3& p) {
  return (box.lo - p).cwiseMax(p - box.hi).cwiseMax(Vec3::Zero()).norm();
}

Aabb box_around(const TriMesh& mesh) {
  Aabb box;
  for (const Vec3& p : mesh.vertices) box.include(p);
  return box;
}

template <class T>
void take_from(std::unique_ptr<SideJob<T>>& job, T& into) {
  if (!job || !job->done()) return;
  if (auto made = job->take()) into = std::move(*made);
  job.reset();
}

// On the surface of the round cord as which it is felt, with its bones as they stand.
std::optional<TipGauge::Nearest> on_band(const SoftBand& band, const BoneSnapshot& bones,
                                         const Vec3& tip_W) {
  if (!(band.left > 0) || std::max(band.from.index, band.to.index) >= bones.count) return {};
  const Vec3 a_W = bones.bones[band.from.index].X_WB * band.from_B;
  const Vec3 way = bones.bones[band.to.index].X_WB * band.to_B - a_W;
  const double share = std::clamp((tip_W - a_W).dot(way) / way.squaredNorm(), 0.0, 1.0);
  const Vec3 line_W = a_W + share * way;
  const double away = (tip_W - line_W).norm();
  if (!(away > 0)) return {};
  const Vec3 p_W = line_W + band.radius_m / away * (tip_W - line_W);
  return TipGauge::Nearest{band.from, band.soft, p_W, away - band.radius_m};
}

// From a place outwards to where a line leaves a surface: the place may lie beyond the far side,
// and a groove on the way counts as inside. The signed distance never changes faster than the
// place, so a step as long as that passes over no crossing. Each step is kLeastStep_m or longer.
double way_out_m(const MeshDistance& surface, const Vec3& from_B, const Vec3& out_B) {
  constexpr double kMost_m = 0.2, kBeyond_m = 0.03, kGroove_m = 0.004, kLeastStep_m = 5e-5;
  double last_m = 0;
  for (double s = 0; s < kMost_m && s - last_m < (last_m > 0 ? kGroove_m : kBeyond_m);) {
    const double d = surface.closest(from_B + s * out_B).signed_distance;
    s += std::max(std::abs(d), kLeastStep_m);
    if (d < 0) last_m = s;
  }
  return last_m;
}

}  // namespace

bool TipGauge::is_seen(const GaugedSurface& surface, const ViewState& view) {
  const auto& looks = surface.soft ? view.softs : view.bones;
  const std::size_t k = surface.soft ? *surface.soft : surface.bone.index;
  return k >= looks.size() || looks[k].visible;
}

bool TipGauge::GaugedSurface::is_past(const Vec3& tip_B) const {
  if (!skin) return false;
  const Vec3 tip_S = skin->X_BS.inverse() * tip_B;
  return tip_S.z() < skin->relief.at(tip_S.head<2>()).height_m - kIntoSkin_m;
}

TipGauge::GaugedSurface TipGauge::of_skin(const SkinPatch& patch) {
  TriMesh mesh_B;
  for (int j = 0; j <= kSkinCells; ++j)
    for (int i = 0; i <= kSkinCells; ++i) {
      const SheetPoint p(patch.width_m * (static_cast<double>(i) / kSkinCells - 0.5),
                         patch.height_m * (static_cast<double>(j) / kSkinCells - 0.5));
      mesh_B.vertices.push_back(patch.X_BS * Vec3(p.x(), p.y(), patch.relief.at(p).height_m));
    }
  constexpr std::uint32_t kRow = kSkinCells + 1;
  for (std::uint32_t j = 0; j + 1 < kRow; ++j)
    for (std::uint32_t i = 0; i + 1 < kRow; ++i) {
      const std::uint32_t a = j * kRow + i;
      mesh_B.triangles.push_back({a, a + 1, a + kRow + 1});
      mesh_B.triangles.push_back({a, a + kRow + 1, a + kRow});
    }
  const Aabb box = box_around(mesh_B);
  return {patch.bone, patch.soft, MeshDistance(std::move(mesh_B)), box, 0, &patch};
}

Result<TipGauge::Surfaces> TipGauge::of_bones(const Case& the_case, const Progress& progress) {
  Surfaces out;
  for (std::uint32_t k = 0; k < the_case.bones.size(); ++k) {
    if (progress && !progress("Measuring the bones", 0)) return fail("stopped");
    const TriMesh& mesh = the_case.bones[k].mesh;
    out.push_back({BoneId{k}, {}, MeshDistance(mesh), box_around(mesh), 0, nullptr});
  }
  return out;
}

Result<TipGauge::Surfaces> TipGauge::of_softs(const Case& the_case, const SoftSetup& felt,
                                              const Progress& progress) {
  Surfaces out;
  for (const SoftSolid& solid : felt.solids) {
    if (progress && !progress("Measuring the soft parts", 0)) return fail("stopped");
    TriMesh mesh_B = solid.surface_B ? *solid.surface_B : the_case.softs[solid.soft].mesh_W;
    const Pose X_BW = the_case.bone(solid.bone).X_WB.inverse();
    if (!solid.surface_B)
      for (Vec3& p : mesh_B.vertices) p = X_BW * p;
    const Aabb box = box_around(mesh_B);
    out.push_back({solid.bone, solid.soft, MeshDistance(std::move(mesh_B)), box, 0, nullptr});
  }
  for (const SkinPatch& patch : felt.skins) out.push_back(of_skin(patch));
  return out;
}

void TipGauge::begin(std::shared_ptr<const Case> the_case) {
  bones_.clear();
  case_ = std::move(the_case);
  bones_job_ = std::make_unique<SideJob<Surfaces>>(
      [of = case_](const Progress& progress) { return of_bones(*of, progress); });
  felt_ = nullptr;
  softs_.clear();
  softs_job_.reset();
}

void TipGauge::feel(const std::shared_ptr<const SoftSetup>& felt) {
  if (felt == felt_) return;
  felt_ = felt;
  softs_.clear();
  softs_job_.reset();
  if (!felt_ || !case_) return;
  softs_job_ = std::make_unique<SideJob<Surfaces>>(
      [of = case_, felt](const Progress& progress) { return of_softs(*of, *felt, progress); });
}

void TipGauge::wait() const {
  if (bones_job_) bones_job_->wait();
  if (softs_job_) softs_job_->wait();
}

void TipGauge::take_made() {
  take_from(bones_job_, bones_);
  take_from(softs_job_, softs_);
}

std::optional<double> TipGauge::depth_m(const RenderSnapshot& snapshot, std::size_t hand) {
  take_made();
  if (hand >= snapshot.bones.guides.size()) return std::nullopt;
  const ToolGuide& guide = snapshot.bones.guides[hand];
  if (!guide.on || !guide.in_hole || guide.instrument != snapshot.tool.instrument) return {};
  if (guide.bone >= snapshot.bones.count || !is_finite(snapshot.tool.X_WP)) return std::nullopt;
  const Vec3 tip_B = snapshot.bones.bones[guide.bone].X_WB.inverse() * snapshot.tool.X_WP.p;
  for (const GaugedSurface& surface : bones_)
    if (surface.bone.index == guide.bone) return way_out_m(surface.distance, tip_B, guide.nhat_B);
  return std::nullopt;
}

// A surface whose box is farther away than the nearest one so far is not asked.
std::optional<TipGauge::Nearest> TipGauge::nearest(const RenderSnapshot& snapshot,
                                                   const ViewState& view) {
  take_made();
  const Vec3& tip_W = snapshot.tool.X_WP.p;
  std::optional<Nearest> best;
  double least = std::numeric_limits<double>::infinity();
  if (!is_finite(tip_W)) return best;
  for (Surfaces* surfaces : {&bones_, &softs_})
    for (GaugedSurface& surface : *surfaces) {
      if (surface.bone.index >= snapshot.bones.count || surface.box_B.empty()) continue;
      if (!is_seen(surface, view)) continue;
      const Pose& X_WB = snapshot.bones.bones[surface.bone.index].X_WB;
      const Vec3 tip_B = X_WB.inverse() * tip_W;
      if (distance_to_box(surface.box_B, tip_B) > std::abs(least)) continue;
      if (surface.is_past(tip_B)) continue;
      const ClosestPoint found = surface.distance.closest(tip_B, surface.guess);
      surface.guess = found.triangle;
      if (found.signed_distance >= least) continue;
      least = found.signed_distance;
      best = Nearest{surface.bone, surface.soft, X_WB * found.point, least};
    }
  for (std::size_t b = 0; felt_ && b < felt_->bands.size(); ++b) {
    const std::size_t soft = felt_->bands[b].soft;
    if (soft < view.softs.size() && !view.softs[soft].visible) continue;
    const auto found = on_band(felt_->bands[b], snapshot.bones, tip_W);
    if (!found || found->distance_m >= least) continue;
    least = found->distance_m;
    best = found;
  }
  return best;
}

}  // namespace osteon
