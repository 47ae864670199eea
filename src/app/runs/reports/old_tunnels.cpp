#include "runs/reports/old_tunnels.h"

#include <algorithm>

#include "osteon/collide/segments.h"

namespace osteon {
namespace {

std::optional<DrilledLine> main_of(const std::vector<DrilledLine>& holes) {
  return holes.empty() ? std::nullopt : std::optional<DrilledLine>(holes.front());
}

double between_m(const Capsule& a, const Capsule& b) {
  const AxisPoints nearest = nearest_on_axes(a, b);
  return (nearest.a - nearest.b).norm() - a.radius - b.radius;
}

// The least bone between what was drilled now, from its mouth on, and any of the old holes.
template <class Tunnel>
std::optional<double> to_old_m(const std::vector<DrilledLine>& old, const Tunnel& drilled,
                               double wide_to_m, double channel_to_m, double channel_m) {
  std::optional<double> least;
  const auto on_axis = [&](double m) { return Vec3(drilled.aperture_W + m * drilled.inwards_W); };
  const Capsule wide{on_axis(0), on_axis(wide_to_m), 0.5 * drilled.diameter_m};
  const Capsule narrow{on_axis(wide_to_m), on_axis(std::max(wide_to_m, channel_to_m)),
                       0.5 * channel_m};
  for (const DrilledLine& hole : old) {
    const Capsule other{hole.from_W, hole.to_W, 0.5 * hole.diameter_m};
    least = std::min(least.value_or(1), between_m(wide, other));
    if (channel_m > 0) least = std::min(*least, between_m(narrow, other));
  }
  return least;
}

}  // namespace

Result<AclReport> report_beside_old(const CaseDef& undrilled, const OldHoles& old,
                                    const AclDrilling& drilled,
                                    const std::array<double, 2>& channels_m,
                                    const std::optional<GraftChoices>& choices) {
  auto before = measure_tunnels(undrilled, {main_of(old[0]), main_of(old[1])});
  if (!before) return tl::unexpected(before.error());
  AclDrilling now = drilled;
  if (!now.femur) now.femur = main_of(old[0]);
  if (!now.tibia) now.tibia = main_of(old[1]);
  auto report = make_acl_report(undrilled, now, choices);
  if (!report) return report;
  report->before = std::move(*before);
  const AclTunnels& tunnels = report->tunnels;
  if (drilled.femur && tunnels.femur)
    report->femur_to_old_m = to_old_m(old[0], *tunnels.femur, tunnels.femur->drilled_m,
                                      tunnels.femur->channel_m, channels_m[0]);
  if (drilled.tibia && tunnels.tibia)
    report->tibia_to_old_m = to_old_m(old[1], *tunnels.tibia, tunnels.tibia->length_m, 0, 0);
  return report;
}

}  // namespace osteon
