#include "incision_way.h"

#include <algorithm>

#include "osteon/mesh/distance.h"

namespace osteon {
namespace {

constexpr double kOverSite_m = 0.06, kJustOver_m = 0.004, kOffSite_m = 0.12;
constexpr double kHalfCut_m = 0.016, kBesideSite_m = 0.015;
// So far below the skin a hand goes: hand and skin give way by half of the first.
constexpr double kInFat_m = 0.011, kBeyondFat_m = 0.022;
constexpr double kCutting_m_per_s = 0.012;
constexpr int kStretches = 8;  // of the stroke, from place to place on the skin

}  // namespace

void open_skin(const Case& the_case, const Pose& X_WS, const RoundJoint& knee,
               const std::string& fault, HandWay& way) {
  const auto skin = std::find_if(
      the_case.softs.begin(), the_case.softs.end(),
      [](const SoftPart& part) { return part.kind == "skin" && !part.mesh_W.triangles.empty(); });
  if (skin == the_case.softs.end()) return;
  const MeshDistance surface(skin->mesh_W);
  const Vec3 n_W = X_WS.rotate(Vec3::UnitZ());
  Mat3 blade;
  blade.col(0) = X_WS.rotate(Vec3::UnitY());
  blade.col(2) = n_W;
  blade.col(1) = blade.col(2).cross(blade.col(0));
  const Quat q(blade);
  const double aside_m = fault == "incision_aside" ? kBesideSite_m : 0;
  const double deep_m = fault == "incision_deep" ? kBeyondFat_m : kInFat_m;
  const auto at = [&](double along_m, double in_m) {
    const Vec3 on_W = surface.closest(X_WS * Vec3(aside_m, along_m, 0)).point;
    return Pose{on_W - in_m * n_W, q};
  };
  change_round(way, knee, "scalpel_15", at(-kHalfCut_m, -kOverSite_m).p, n_W);
  way.go(at(-kHalfCut_m, -kJustOver_m), kHandCarry_m_per_s);
  way.go(at(-kHalfCut_m, deep_m), kHandNear_m_per_s);
  for (int i = 1; i <= kStretches; ++i)
    way.go(at(kHalfCut_m * (2.0 * i / kStretches - 1), deep_m), kCutting_m_per_s);
  way.go(at(kHalfCut_m, -kJustOver_m), kHandNear_m_per_s);
  way.go(at(kHalfCut_m, -kOffSite_m), kHandCarry_m_per_s);
}

}  // namespace osteon
