#include "osteon/carve/cutter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace osteon {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

using Shape = CutterPart (*)(double size_m);

struct Kind {
  CutterKind text;
  Shape shape;
  bool bites = false;
};

Aabb turned_box(double radius, double z0, double z1) {
  return {Vec3(-radius, -radius, z0), Vec3(radius, radius, z1)};
}

CutterPart ball(double size) {
  const double r = 0.5 * size;
  return {{{Vec3::Zero(), Vec3::Zero(), r}}, {}, {}, turned_box(r, -r, r)};
}

// A cylinder that begins with a cone of that full angle, its point at the origin.
CutterPart pointed(double size, double angle_deg, double length) {
  const double r = 0.5 * size, half = 0.5 * angle_deg * kDegree;
  return {{},
          {{1, 0, r}, {std::cos(half), -std::sin(half), 0}, {0, 1, length}},
          {},
          turned_box(r, 0, length)};
}

CutterPart drill(double size) { return pointed(size, 118, std::max(0.03, 3 * size)); }
CutterPart pin(double size) { return pointed(size, 60, std::max(0.03, 3 * size)); }
CutterPart awl(double size) { return pointed(size, 30, std::max(0.02, 3 * size)); }

// A reamer's head: a flat front whose rim is cut off at 45 degrees.
CutterPart reamer(double size) {
  const double r = 0.5 * size, rim = 0.25 * r, length = 1.5 * size;
  const double s = std::sqrt(0.5);
  return {{},
          {{1, 0, r}, {s, -s, s * (r - rim)}, {0, -1, 0}, {0, 1, length}},
          {},
          turned_box(r, 0, length)};
}

CutterPart prism(const Vec3& lo, const Vec3& hi) {
  CutterPart part;
  for (int k = 0; k < 3; ++k) {
    part.planes.push_back({Vec3::Unit(k), hi[k]});
    part.planes.push_back({-Vec3::Unit(k), -lo[k]});
  }
  part.box = {lo, hi};
  return part;
}

// The bite of a punch: as wide as the jaw, cut towards the shaft from the foot, which lies at the
// tip and keeps what is beyond it.
CutterPart kerrison(double size) {
  return prism({-0.5 * size, -0.5 * size, 0}, {0.5 * size, 0.5 * size, size});
}

// A cup that cuts with its rim: the half of a ball on the side of +y.
CutterPart curette(double size) {
  CutterPart part = ball(size);
  part.planes.push_back({-Vec3::UnitY(), 0});
  part.box.lo.y() = 0;
  return part;
}

// A blade as wide as the size along x, 2 mm thick, 20 mm long, its edge through the origin.
constexpr double kBlade_m = 0.002, kBladeLength_m = 0.02;

CutterPart chisel(double size) {
  CutterPart part = prism({-0.5 * size, 0, 0}, {0.5 * size, kBlade_m, kBladeLength_m});
  const double bevel = 25 * kDegree;
  part.planes.push_back({Vec3(0, std::cos(bevel), -std::sin(bevel)), 0});
  return part;
}

CutterPart osteotome(double size) {
  CutterPart part =
      prism({-0.5 * size, -0.5 * kBlade_m, 0}, {0.5 * size, 0.5 * kBlade_m, kBladeLength_m});
  const double bevel = 10 * kDegree;
  for (const double side : {1.0, -1.0})
    part.planes.push_back({Vec3(0, side * std::cos(bevel), -std::sin(bevel)), 0});
  return part;
}

// A round-ended tube whose window of 6 mm looks to +y: the half on that side cuts.
CutterPart shaver(double size) {
  constexpr double kWindow_m = 0.006;
  const double r = 0.5 * size;
  CutterPart part;
  part.rods.push_back({Vec3::Zero(), Vec3(0, 0, kWindow_m), r});
  part.planes.push_back({-Vec3::UnitY(), 0});
  part.planes.push_back({Vec3::UnitZ(), kWindow_m});
  part.box = {Vec3(-r, 0, -r), Vec3(r, r, kWindow_m)};
  return part;
}

constexpr std::array<Kind, 10> kKinds{{
    {{"burr", "a ball about the origin"}, ball},
    {{"drill", "a cylinder with a point of 118 degrees"}, drill},
    {{"pin", "a wire with a point of 60 degrees"}, pin},
    {{"reamer", "a cylinder with a flat front, its rim cut off at 45 degrees"}, reamer},
    {{"awl", "a cone of 30 degrees that ends in a cylinder"}, awl},
    {{"kerrison", "a punch: one bite a pose, a cube between foot and jaw"}, kerrison, true},
    {{"curette", "a cup: half a ball, on the side of +y"}, curette},
    {{"chisel", "a blade of 2 mm, one side sharpened at 25 degrees, its edge along x"}, chisel},
    {{"osteotome", "a blade of 2 mm, both sides sharpened at 10 degrees, its edge along x"},
     osteotome},
    {{"shaver", "a tube with a round end and a window of 6 mm on the side of +y"}, shaver},
}};

constexpr auto kTexts = [] {
  std::array<CutterKind, kKinds.size()> texts{};
  for (std::size_t n = 0; n < kKinds.size(); ++n) texts[n] = kKinds[n].text;
  return texts;
}();

}  // namespace

std::span<const CutterKind> cutter_kinds() { return kTexts; }

bool Cutter::finite() const {
  const auto sound = [](const CutterPart& part) {
    const auto rod = [](const RoundRod& r) {
      return is_finite(r.p0) && is_finite(r.p1) && std::isfinite(r.radius) && r.radius > 0;
    };
    const auto face = [](const TurnedFace& f) {
      return std::isfinite(f.n_rho) && std::isfinite(f.n_z) && std::isfinite(f.offset);
    };
    const auto plane = [](const Plane& p) { return is_finite(p.n) && std::isfinite(p.d); };
    return is_finite(part.box.lo) && is_finite(part.box.hi) && !part.box.empty() &&
           std::all_of(part.rods.begin(), part.rods.end(), rod) &&
           std::all_of(part.faces.begin(), part.faces.end(), face) &&
           std::all_of(part.planes.begin(), part.planes.end(), plane);
  };
  return std::all_of(parts.begin(), parts.end(), sound);
}

Result<Cutter> make_cutter(std::string_view name, double size_m) {
  std::string names;
  for (const Kind& kind : kKinds) {
    names += (names.empty() ? "" : ", ") + std::string(kind.text.name);
    if (kind.text.name != name) continue;
    constexpr double kLeast_m = 0.0002, kMost_m = 0.04;
    if (!(size_m >= kLeast_m && size_m <= kMost_m))
      return fail("the size must be 0.2 to 40 mm", std::string(name));
    return Cutter{std::string(name), size_m, {kind.shape(size_m)}, kind.bites};
  }
  return fail("there is no tool '" + std::string(name) + "'", "carving", "Use one of " + names);
}

}  // namespace osteon
