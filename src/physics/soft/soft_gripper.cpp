#include "osteon/physics/soft_gripper.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "osteon/physics/joint_fluid.h"
#include "osteon/scene/instrument.h"
#include "soft/of_tray.h"

namespace osteon {
namespace {

std::uint64_t jaw_bit(std::size_t part) { return part < 64 ? std::uint64_t{1} << part : 0; }

bool turns(const FeltPart& part) {
  return std::visit([](const auto& p) { return p.jaw != Jaw::kNone; }, part);
}

double area_of(const SoftGripper& mouth) {
  return std::numbers::pi / 4 * mouth.bore_m * mouth.bore_m;
}

void add_mouth(SoftGripper& jaws) {
  const auto add = [&](const Vec3& n, double d) {
    jaws.mouth_T.push_back({n, n.dot(jaws.hinge_T) + d});
  };
  add(jaws.axis_T, jaws.half_width_m);
  add(-jaws.axis_T, jaws.half_width_m);
  add(jaws.along_T, jaws.length_m);
  add(-jaws.along_T, 0);
  add(std::cos(jaws.high_rad) * jaws.rise_T - std::sin(jaws.high_rad) * jaws.along_T, 0);
  add(-std::cos(jaws.low_rad) * jaws.rise_T + std::sin(jaws.low_rad) * jaws.along_T, 0);
}

}  // namespace

// The jaws are what turns before the hinge, and what stands there and does not: a punch's foot.
// Handles turn too, behind it.
std::optional<SoftGripper> gripper_of(const Instrument& instrument, std::size_t size) {
  if (!instrument.jaws || !(instrument.jaws->holds_n > 0)) return {};
  const double size_m = instrument.sizes_m.at(size);
  const Tool tool = make_tool(instrument, size);
  SoftGripper out;
  out.hinge_T = instrument.jaws->hinge.at(size_m);
  out.axis_T = instrument.jaws->axis;
  out.along_T = (out.axis_T.z() * out.axis_T - Vec3::UnitZ()).normalized();
  out.rise_T = out.axis_T.cross(out.along_T);
  out.holds_n = instrument.jaws->holds_n;
  const auto& open = instrument.jaws->open_rad;
  out.low_rad = std::min({open[0], open[1], 0.0});
  out.high_rad = std::max({open[0], open[1], 0.0});
  double width = 1;
  for (std::size_t i = 0; i < instrument.felt.size(); ++i) {
    const Primitive& part = tool.parts[i];
    if (!((part.middle - out.hinge_T).dot(out.along_T) > 0)) continue;
    out.jaws |= jaw_bit(i);
    if (!turns(instrument.felt[i])) continue;
    out.length_m =
        std::max(out.length_m, support(part, out.along_T) - out.along_T.dot(out.hinge_T));
    width = std::min(width, support(part, out.axis_T) - out.axis_T.dot(out.hinge_T));
  }
  out.half_width_m = width;
  if (out.jaws == 0 || !(out.length_m > 0) || !is_finite(out.along_T)) return {};
  add_mouth(out);
  return out;
}

std::optional<SoftGripper> sucker_of(const Instrument& instrument, std::size_t size) {
  if (!instrument.power || instrument.power->kind != "suction") return {};
  SoftGripper out;
  out.bore_m = kBoreOfOuter * instrument.sizes_m.at(size);
  for (const Primitive& part : make_tool(instrument, size).parts)
    out.bore_T.z() = std::min(out.bore_T.z(), -support(part, -Vec3::UnitZ()));
  out.holds_n = FluidJoint{}.suction_pa * area_of(out);
  return out;
}

double suction_at(const SoftGripper& mouth, double gap_m) {
  const double area = area_of(mouth), gap = std::max(gap_m, 0.0);
  const double speed = area / (area + 10 * gap * gap);
  return area > 0 ? mouth.holds_n * speed * speed : 0;
}

Result<std::vector<std::optional<SoftGripper>>> make_soft_grippers(
    std::span<const std::string> tray) {
  return of_tray<SoftGripper>(tray, [](const Instrument& instrument, std::size_t size) {
    auto jaws = gripper_of(instrument, size);
    return jaws ? jaws : sucker_of(instrument, size);
  });
}

}  // namespace osteon
