#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "osteon/tissue/skin_scene.h"

namespace osteon {
namespace {

double off_segment(const SheetPoint& p, const SheetPoint& a, const SheetPoint& b) {
  const SheetPoint way = b - a;
  const double along = way.squaredNorm() > 0 ? (p - a).dot(way) / way.squaredNorm() : 0;
  return (p - a - std::clamp(along, 0.0, 1.0) * way).norm();
}

double off_stroke(const SheetPoint& p, const std::vector<SheetPoint>& stroke) {
  double nearest = off_segment(p, stroke[0], stroke[1]);
  for (std::size_t i = 2; i < stroke.size(); ++i)
    nearest = std::min(nearest, off_segment(p, stroke[i - 1], stroke[i]));
  return nearest;
}

// The blade moves in small ways, as a hand's does.
SkinCutResult cut(const SkinSheet& sheet, SheetCuts& cuts, const SkinStroke& stroke) {
  SkinCutResult out;
  const std::vector<double> before = cuts.depth_m;
  begin_stroke(sheet, cuts, stroke.points.front());
  for (std::size_t i = 1; i < stroke.points.size(); ++i) {
    const SheetPoint from = stroke.points[i - 1], way = stroke.points[i] - from;
    const int parts = std::max(1, static_cast<int>(std::ceil(8 * way.norm() / sheet.edge_m())));
    for (int k = 1; k <= parts; ++k) {
      const SheetPoint p = from + way * (double(k) / parts);
      if (cuts.blade_in)
        out.opened_m += go_on(sheet, cuts, p, stroke.depth_m);
      else
        begin_stroke(sheet, cuts, p);  // it comes onto the sheet
    }
    out.stroke_m += way.norm();
  }
  out.opened_m += end_stroke(sheet, cuts, stroke.points.back(), stroke.depth_m);
  for (std::size_t e = 0; e < before.size(); ++e)
    if (cuts.depth_m[e] != before[e])
      for (const std::uint32_t v : {sheet.edges()[e].a, sheet.edges()[e].b})
        out.off_m = std::max(out.off_m, off_stroke(cuts.points[v], stroke.points));
  return out;
}

Error off_sheet(const std::string& what) {
  return {what + " is not on the sheet with all of its radius", "skin scene",
          "Move it further in, or make the sheet larger"};
}

/// Dent and force of a tool pressed down until the sheet breaks.
struct Rise {
  std::vector<double> depth_m{0}, force_n{0};

  double force_at(double depth) const {
    const auto hi = std::upper_bound(depth_m.begin(), depth_m.end(), depth);
    if (hi == depth_m.end()) return force_n.back();
    const auto i = static_cast<std::size_t>(hi - depth_m.begin());
    if (i == 0) return 0;
    const double share = (depth - depth_m[i - 1]) / (depth_m[i] - depth_m[i - 1]);
    return force_n[i - 1] + share * (force_n[i] - force_n[i - 1]);
  }
};

Rise rise_of(const SheetBalance& balance, const SheetLoad& load, double peak_n) {
  constexpr int kPoints = 40;
  Rise out;
  SheetDent dent;
  for (int i = 1; i <= kPoints; ++i) {
    const double share = double(i) / kPoints;
    dent = balance.pressed(load, peak_n * share * share, dent);
    if (!(dent.mean_m > out.depth_m.back())) continue;
    out.depth_m.push_back(dent.mean_m);
    out.force_n.push_back(dent.force_n);
  }
  return out;
}

SkinPierceResult pierce(const SkinSheet& sheet, SheetCuts& cuts, const SheetBalance& balance,
                        const SheetLoad& load, const SkinThrust& thrust) {
  constexpr double kStep_s = 0.001, kShown_m = 0.00025;
  SkinPierceResult out;
  out.thrust = thrust;
  const SheetDisc& disc = thrust.disc;
  out.law = pierce_law(sheet.material(), disc.radius_m,
                       slit_under(sheet, cuts, disc.p, disc.radius_m), balance.stiffness(load));
  const Rise rise = rise_of(balance, load, out.law.peak_n);
  PierceState state;
  const int way =
      std::max(1, static_cast<int>(std::ceil(thrust.depth_m / thrust.speed_m_per_s / kStep_s)));
  double shown_at = -1;
  for (int i = 0; i <= 2 * way; ++i) {
    const double depth = thrust.depth_m * (way - std::abs(i - way)) / way;
    const bool breaks = pierce_step(state, out.law, depth, rise.force_at(depth), kStep_s);
    out.pierced = out.pierced || breaks;
    if (state.force_n > out.peak_n) {
      out.peak_n = state.force_n;
      out.peak_depth_m = depth;
    }
    if (i == way) out.deepest_n = state.force_n;
    out.pull_n = std::max(out.pull_n, -state.force_n);
    if (!breaks && std::abs(depth - shown_at) < kShown_m && i < 2 * way) continue;
    out.curve.push_back({i * kStep_s, depth, state.force_n});
    shown_at = depth;
  }
  // The tip parts the sheet along x: lines of the skin's fibres.
  const double half = 0.5 * std::numbers::pi * out.law.hole_m;
  if (out.pierced && out.law.peak_n > 0)
    cut(sheet, cuts,
        {{disc.p - SheetPoint(half, 0), disc.p + SheetPoint(half, 0)},
         sheet.material().thickness_m});
  return out;
}

}  // namespace

Result<SkinResult> run_skin(const SkinScene& scene) {
  const auto sheet = SkinSheet::make(scene.width_m, scene.height_m, scene.edge_m, scene.material);
  if (!sheet) return tl::unexpected(sheet.error());
  SkinResult out;
  SheetCuts cuts = whole_sheet(*sheet);
  for (const SkinStroke& stroke : scene.cuts) out.cuts.push_back(cut(*sheet, cuts, stroke));
  const auto balance = [&] { return SheetBalance(*sheet, split(*sheet, cuts)); };
  if (!scene.presses.empty()) {
    const SheetBalance now = balance();
    for (std::size_t i = 0; i < scene.presses.size(); ++i) {
      const SheetLoad load = load_on(now.split(), scene.presses[i].disc);
      if (load.copy.empty()) return tl::unexpected(off_sheet("press[" + std::to_string(i) + "]"));
      const SheetDent dent = now.pressed(load, scene.presses[i].force_n);
      out.presses.push_back({scene.presses[i], dent.mean_m, now.stiffness(load)});
    }
  }
  for (std::size_t i = 0; i < scene.pierces.size(); ++i) {
    const SheetBalance now = balance();
    const SheetLoad load = load_on(now.split(), scene.pierces[i].disc);
    if (load.copy.empty()) return tl::unexpected(off_sheet("pierce[" + std::to_string(i) + "]"));
    out.pierces.push_back(pierce(*sheet, cuts, now, load, scene.pierces[i]));
  }
  const SheetBalance end = balance();
  std::vector<double> down;
  if (!scene.presses.empty())
    down =
        end.pressed(load_on(end.split(), scene.presses.back().disc), scene.presses.back().force_n)
            .down_m;
  const TriMesh flat = sheet_surface(end.split(), end.ways(), {});
  out.surface = sheet_surface(end.split(), end.ways(), down);
  out.vertices = out.surface.vertices.size();
  out.triangles = end.split().triangles.size();
  out.groove_triangles = out.surface.triangles.size() - out.triangles;
  out.opening_m2 = open_area(end.split(), end.ways());
  out.widest_m = widest(end.split(), end.ways());
  out.groove_m3 = groove_volume(end.split(), flat);
  return out;
}

std::string skin_vtk(const SkinResult& result) {
  const TriMesh& mesh = result.surface;
  std::string out = "# vtk DataFile Version 3.0\nskin, mm\nASCII\nDATASET POLYDATA\nPOINTS " +
                    std::to_string(mesh.vertices.size()) + " double\n";
  char line[128];
  for (const Vec3& p : mesh.vertices) {
    std::snprintf(line, sizeof line, "%.9g %.9g %.9g\n", 1000 * p.x(), 1000 * p.y(), 1000 * p.z());
    out += line;
  }
  const std::string count = std::to_string(mesh.triangles.size());
  out += "POLYGONS " + count + " " + std::to_string(4 * mesh.triangles.size()) + "\n";
  for (const Triangle& t : mesh.triangles) {
    std::snprintf(line, sizeof line, "3 %u %u %u\n", t[0], t[1], t[2]);
    out += line;
  }
  out += "CELL_DATA " + count + "\nSCALARS part int 1\nLOOKUP_TABLE default\n";
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    out += t < result.triangles ? "0\n" : "1\n";
  return out;
}

}  // namespace osteon
