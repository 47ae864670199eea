#include "instrument/instrument_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "instrument/loop_stack.h"

namespace osteon {
namespace {

constexpr int kRound = 24;  // corners of a cross-section
constexpr double kTurn = 2 * std::numbers::pi;
// A point of a turned profile nearer to the axis than this ends it, m.
constexpr double kOnAxis = 1e-9;

// Two axes of a cross-section, u x v = along.
struct Section {
  Vec3 u, v;
};

Section any_section(const Vec3& along) {
  const Vec3 other = std::abs(along.z()) < 0.9 ? Vec3(Vec3::UnitZ()) : Vec3(Vec3::UnitX());
  const Vec3 u = other.cross(along).normalized();
  return {u, along.cross(u)};
}

Loop round_loop(const Vec3& center, const Section& section, double radius_m) {
  Loop loop;
  for (int i = 0; i < kRound; ++i) {
    const double a = kTurn * i / kRound;
    loop.push_back(center + radius_m * (std::cos(a) * section.u + std::sin(a) * section.v));
  }
  return loop;
}

TriMesh turned(const LookPart& part, double size_m) {
  const Section section{Vec3::UnitX(), Vec3::UnitY()};
  std::vector<Loop> loops;
  const auto height = [&](std::size_t i) { return Vec3(0, 0, part.profile[i][0].at(size_m)); };
  for (std::size_t i = 0; i < part.profile.size(); ++i) {
    const double radius = part.profile[i][1].at(size_m);
    if (radius > kOnAxis) loops.push_back(round_loop(height(i), section, radius));
  }
  if (loops.empty()) return {};
  return stack_loops(height(0), loops, height(part.profile.size() - 1));
}

// Cross-sections stand across the way through each point and turn with it as little as they can.
TriMesh tube(const LookPart& part, double size_m) {
  std::vector<Vec3> points;
  for (const SizedPoint& p : part.points) points.push_back(p.at(size_m));
  const std::size_t n = points.size();
  const auto step = [&](std::size_t i) { return Vec3((points[i + 1] - points[i]).normalized()); };
  Section section = any_section(step(0));
  std::vector<Loop> loops;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 before = step(i == 0 ? 0 : i - 1);
    const Vec3 after = step(i + 1 == n ? n - 2 : i);
    const Vec3 along = (before + after).normalized();
    const Vec3 u = (section.u - section.u.dot(along) * along).normalized();
    section = {u, along.cross(u)};
    const SizedLength& radius = part.radii[part.radii.size() == 1 ? 0 : i];
    loops.push_back(round_loop(points[i], section, radius.at(size_m)));
  }
  return stack_loops(points.front(), loops, points.back());
}

TriMesh box(const Vec3& half) {
  const auto corner = [&](double x, double y, double z) {
    return Vec3(half.cwiseProduct(Vec3(x, y, z)));
  };
  const Loop low{corner(1, 1, -1), corner(-1, 1, -1), corner(-1, -1, -1), corner(1, -1, -1)};
  const Loop high{corner(1, 1, 1), corner(-1, 1, 1), corner(-1, -1, 1), corner(1, -1, 1)};
  const std::array<Loop, 2> loops{low, high};
  return stack_loops(corner(0, 0, -1), loops, corner(0, 0, 1));
}

double area_2(const std::vector<Vec3>& outline) {
  double sum = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3& a = outline[i];
    const Vec3& b = outline[(i + 1) % outline.size()];
    sum += a.z() * b.x() - a.x() * b.z();
  }
  return sum;
}

// An outline in the x-z plane, thick along y. It must be seen whole from the middle of its corners.
TriMesh plate(const LookPart& part, double size_m) {
  std::vector<Vec3> outline;
  Vec3 middle = Vec3::Zero();
  for (const SizedPoint& p : part.points) outline.push_back(p.at(size_m));
  for (const Vec3& p : outline) middle += p / static_cast<double>(outline.size());
  if (area_2(outline) < 0) std::reverse(outline.begin(), outline.end());
  const Vec3 across = 0.5 * part.thickness.at(size_m) * Vec3::UnitY();
  std::array<Loop, 2> loops;
  for (const Vec3& p : outline) {
    loops[0].push_back(p - across);
    loops[1].push_back(p + across);
  }
  return stack_loops(middle - across, loops, middle + across);
}

TriMesh spiral(const LookPart& part, double size_m) {
  constexpr double kStepsPerTurn = 16;
  constexpr int kMostSteps = 512;
  constexpr int kAround = 36;
  const double length = part.length.at(size_m);
  const double outer = part.radius.at(size_m);
  const double depth = std::min(part.depth.at(size_m), 0.8 * outer);
  const int steps =
      std::clamp(static_cast<int>(std::ceil(kStepsPerTurn * part.starts * length / part.pitch_m)),
                 2, kMostSteps);
  std::vector<Loop> loops(static_cast<std::size_t>(steps) + 1);
  for (int k = 0; k <= steps; ++k) {
    const double z = length * k / steps;
    for (int i = 0; i < kAround; ++i) {
      const double a = kTurn * i / kAround;
      const double groove = 0.5 - 0.5 * std::cos(part.starts * (a - kTurn * z / part.pitch_m));
      const double r = outer - depth * groove;
      loops[static_cast<std::size_t>(k)].push_back({r * std::cos(a), r * std::sin(a), z});
    }
  }
  return stack_loops(Vec3::Zero(), loops, Vec3(0, 0, length));
}

TriMesh ring(const LookPart& part, double size_m) {
  std::vector<Loop> loops;
  for (int i = 0; i < kRound; ++i) {
    const double a = kTurn * i / kRound;
    const Vec3 out(std::cos(a), std::sin(a), 0);
    loops.push_back(
        round_loop(part.radius.at(size_m) * out, {out, -Vec3::UnitZ()}, part.thickness.at(size_m)));
  }
  return ring_of_loops(loops);
}

TriMesh about_origin(const LookPart& part, double size_m) {
  switch (part.kind) {
    case LookPart::Kind::kTurned:
      return turned(part, size_m);
    case LookPart::Kind::kTube:
      return tube(part, size_m);
    case LookPart::Kind::kBox:
      return box(part.half.at(size_m));
    case LookPart::Kind::kPlate:
      return plate(part, size_m);
    case LookPart::Kind::kSpiral:
      return spiral(part, size_m);
    case LookPart::Kind::kRing:
      return ring(part, size_m);
  }
  return {};
}

}  // namespace

Quat turn_of(const Vec3& deg) {
  const Vec3 rad = deg * std::numbers::pi / 180;
  const auto about = [](double angle, const Vec3& axis) {
    const Vec3 v = std::sin(0.5 * angle) * axis;
    return Quat(std::cos(0.5 * angle), v.x(), v.y(), v.z());
  };
  return about(rad.z(), Vec3::UnitZ()) * about(rad.y(), Vec3::UnitY()) *
         about(rad.x(), Vec3::UnitX());
}

Pose jaw_pose(const Instrument& instrument, Jaw jaw, double size_m, double opening) {
  if (jaw == Jaw::kNone || !instrument.jaws) return {};
  const JawDef& jaws = *instrument.jaws;
  const double angle = opening * jaws.open_rad[jaw == Jaw::kFirst ? 0 : 1];
  const Vec3 v = std::sin(0.5 * angle) * jaws.axis;
  const Quat q(std::cos(0.5 * angle), v.x(), v.y(), v.z());
  const Vec3 hinge = jaws.hinge.at(size_m);
  return {hinge - q * hinge, q};
}

TriMesh look_mesh(const LookPart& part, double size_m) {
  TriMesh mesh = about_origin(part, size_m);
  if (part.kind == LookPart::Kind::kTube) return mesh;
  const Pose X_TP{part.at.at(size_m), turn_of(part.turn_deg)};
  for (Vec3& p : mesh.vertices) p = X_TP * p;
  return mesh;
}

TriMesh bar_mesh(const Vec3& from, const Vec3& to, double radius_m) {
  const Section section = any_section((to - from).normalized());
  const std::array<Loop, 2> loops{round_loop(from, section, radius_m),
                                  round_loop(to, section, radius_m)};
  return stack_loops(from, loops, to);
}

}  // namespace osteon
