#include "osteon/physics/solid_cutter.h"

#include <algorithm>
#include <cmath>

#include "osteon/scene/instrument.h"
#include "soft/of_tray.h"

namespace osteon {
namespace {

constexpr double kBladeReach_m = 0.03;  // from the tip: so much of a tool is sharp at most
constexpr double kThin_m = 0.0005;      // half of a blade

void add_box(CutterPart& part, const Pose& X_TB, const Vec3& half) {
  for (int k = 0; k < 3; ++k) {
    const Vec3 n = X_TB.rotate(Vec3::Unit(k));
    part.planes.push_back({n, n.dot(X_TB.p) + half[k]});
    part.planes.push_back({-n, -n.dot(X_TB.p) + half[k]});
  }
  for (int c = 0; c < 8; ++c)
    part.box.include(X_TB * Vec3((c & 1 ? 1 : -1) * half.x(), (c & 2 ? 1 : -1) * half.y(),
                                 (c & 4 ? 1 : -1) * half.z()));
}

std::uint64_t bit(std::size_t part) { return part < 64 ? std::uint64_t{1} << part : 0; }

bool is_jaw(const FeltPart& part) {
  return std::visit([](const auto& p) { return p.jaw != Jaw::kNone; }, part);
}

// What the jaw that turns sweeps as it shuts onto the other: as wide and as long as it is, from the
// other's face up to where it stands wide open.
std::optional<SolidCutter> biting_with(const Instrument& instrument, const Tool& tool,
                                       double size_m) {
  SolidCutter out;
  out.way = SolidCutter::Way::kBite;
  out.cutter.name = "bite";
  out.cutter.size_m = size_m;
  out.cutter.bites = true;
  const Primitive *jaw = nullptr, *foot = nullptr;
  for (std::size_t i = 0; i < instrument.felt.size(); ++i) {
    const Primitive& part = tool.parts[i];
    if (part.kind != Primitive::Kind::kBox || part.middle.norm() > kBladeReach_m) continue;
    out.works |= bit(i);
    if (is_jaw(instrument.felt[i])) {
      jaw = jaw ? jaw : &part;
      out.lifts |= bit(i);
    } else {
      foot = foot ? foot : &part;
    }
  }
  if (!jaw || !foot || !instrument.jaws) return {};
  const Vec3 hinge = instrument.jaws->hinge.at(size_m);
  const Vec3 across = instrument.jaws->axis;
  const Vec3 lifts =
      (jaw->X_TB.p - foot->X_TB.p - across.dot(jaw->X_TB.p - foot->X_TB.p) * across).normalized();
  // Between the jaws, from the foot's face on, behind the plane in which the jaw stands open.
  const Vec3 along = across.cross(lifts);
  const Mat3 axes = (Mat3() << across, lifts, along).finished();
  const double face = support(*foot, lifts) - lifts.dot(hinge);
  const double height = 2 * jaw->half.maxCoeff();
  Vec3 half(std::min(support(*jaw, across) - across.dot(jaw->X_TB.p),
                     support(*foot, across) - across.dot(foot->X_TB.p)),
            0.5 * height, 0.5 * (support(*jaw, along) + support(*jaw, -along)));
  Vec3 middle = jaw->X_TB.p;
  middle += (lifts.dot(hinge) + face + 0.5 * height - lifts.dot(middle)) * lifts;
  CutterPart part;
  add_box(part, {middle, Quat(axes)}, half);
  const double open =
      std::max(std::abs(instrument.jaws->open_rad[0]), std::abs(instrument.jaws->open_rad[1]));
  const double way = along.dot(middle - hinge) > 0 ? 1 : -1;
  const Vec3 n = std::cos(open) * lifts - std::sin(open) * way * along;
  part.planes.push_back({n, n.dot(hinge)});
  out.cutter.parts = {part};
  return out;
}

// What clears is by so much thicker than what is felt of it, so that the hand can follow.
SolidCutter clearing_with(const ClearsDef& clears, const Tool& tool, double size_m) {
  SolidCutter out;
  out.way = SolidCutter::Way::kClear;
  out.cutter.name = "clear";
  out.cutter.size_m = size_m;
  out.from_T = clears.from.at(size_m);
  out.to_T = clears.to.at(size_m);
  out.face_T = clears.face;
  out.speed_m_per_s = clears.speed_m_per_s;
  const double radius = clears.radius.at(size_m) + kClearRoom_m;
  CutterPart part;
  part.rods.push_back({out.from_T, out.to_T, radius});
  for (const Vec3& p : {out.from_T, out.to_T}) {
    part.box.include(p - Vec3::Constant(radius));
    part.box.include(p + Vec3::Constant(radius));
  }
  out.cutter.parts = {part};
  for (std::size_t i = 0; i < tool.parts.size(); ++i)
    if (tool.parts[i].middle.norm() - tool.parts[i].radius < kBladeReach_m) out.works |= bit(i);
  return out;
}

std::optional<SolidCutter> cutter_of(const Instrument& instrument, std::size_t size) {
  const Tool tool = make_tool(instrument, size);
  const double size_m = instrument.sizes_m[size];
  if (instrument.clears) return clearing_with(*instrument.clears, tool, size_m);
  if (!instrument.can(InstrumentFunction::kCut)) return {};
  if (instrument.jaws && instrument.can(InstrumentFunction::kRemove))
    return biting_with(instrument, tool, size_m);
  return slicing_with(tool);
}

}  // namespace

std::optional<SolidCutter> slicing_with(const Tool& tool) {
  SolidCutter out;
  out.cutter.name = "edge";
  for (std::size_t i = 0; i < tool.parts.size(); ++i) {
    const Primitive& part = tool.parts[i];
    Eigen::Index thin = 0;
    if (part.kind != Primitive::Kind::kBox || part.half.minCoeff(&thin) > kThin_m ||
        part.middle.norm() > kBladeReach_m)
      continue;
    Vec3 half = part.half;
    half[thin] = std::max(half[thin], 0.5 * kLeastSlit_m);
    out.cutter.size_m = std::max(out.cutter.size_m, 2 * part.half.maxCoeff());
    out.cutter.parts.emplace_back();
    add_box(out.cutter.parts.back(), part.X_TB, half);
    out.flat_T = part.X_TB.rotate(Vec3::Unit(thin));
    out.works |= bit(i);
  }
  if (out.works == 0) return {};
  return out;
}

// F (1 - x / p) falls and the force needed rises with x: bisected, it ends at where they are equal.
double edge_goes_in(double p, double F, double f, double s, double share) {
  constexpr int kHalvings = 40;
  if (!(p > 0)) return 0;
  double lo = 0, hi = p;
  for (int i = 0; i < kHalvings; ++i) {
    const double x = 0.5 * (lo + hi);
    const double needed = f * std::max(share, x * x / (x * x + s * s));
    (F * (1 - x / p) > needed ? lo : hi) = x;
  }
  return lo;
}

Result<std::vector<std::optional<SolidCutter>>> make_solid_cutters(
    std::span<const std::string> tray) {
  return of_tray<SolidCutter>(tray, cutter_of);
}

}  // namespace osteon
