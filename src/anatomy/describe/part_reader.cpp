#include "describe/part_reader.h"

#include <algorithm>

namespace osteon {
namespace {

/// Turns bone directions into the axes of a part that the description turns by `rotation_deg`, or
/// by `tilt_deg` about y alone.
Mat3 local_axes(TomlReader& in) {
  if (in.has("tilt_deg")) {
    if (in.has("rotation_deg")) in.reject("cannot be combined with 'rotation_deg'", "tilt_deg");
    return rotation_xyz_deg({0, in.number("tilt_deg", kAngle_deg), 0}).transpose();
  }
  return rotation_xyz_deg(in.vec3_or("rotation_deg", kAngle_deg, Vec3::Zero())).transpose();
}

/// Of an ellipsoid: three, or one of a ball.
Vec3 read_radii_mm(TomlReader& in) {
  const std::vector<double> r = in.numbers("radii_mm", kRadius_mm);
  if (r.size() == 3) return {r[0], r[1], r[2]};
  if (r.size() != 1) in.reject("must be a list of three numbers, or of one", "radii_mm");
  return Vec3::Constant(r.empty() ? 1 : r[0]);
}

Primitive read_ellipsoid(TomlReader& in) {
  Ellipsoid e;
  e.center = in.vec3("center_mm", kPlace_mm) * kMm;
  e.radii = read_radii_mm(in) * kMm;
  e.R_local = local_axes(in);
  return e;
}

Primitive read_tube(TomlReader& in) {
  std::vector<Vec3> points = in.points("points_mm", kPlace_mm);
  std::vector<double> radii = in.numbers("radii_mm", kRadius_mm);
  if (radii.size() == 1) radii.resize(points.size(), radii[0]);
  if (points.size() != radii.size())
    in.reject("must hold one radius per point, or one for all", "radii_mm");
  for (std::size_t i = 1; i < points.size(); ++i)
    if ((points[i] - points[i - 1]).norm() < 1e-3)
      in.reject("holds the same point twice in a row", "points_mm");
  if (in.failed()) return {};
  for (Vec3& p : points) p *= kMm;
  for (double& r : radii) r *= kMm;
  Tube tube = tube_through(points, radii);
  if (*std::min_element(tube.radii.begin(), tube.radii.end()) <= 0)
    in.reject("vary so much that the curve through them falls below zero", "radii_mm");
  return tube;
}

Primitive read_box(TomlReader& in) {
  RoundedBox b;
  b.center = in.vec3("center_mm", kPlace_mm) * kMm;
  b.half = in.vec3("half_mm", kRadius_mm) * kMm;
  b.round = in.number("round_mm", kBlend_mm) * kMm;
  b.R_local = local_axes(in);
  if (b.round > b.half.minCoeff()) in.reject("must not exceed the smallest of half_mm", "round_mm");
  return b;
}

Vec3 read_normal(TomlReader& in) {
  const Vec3 normal = in.vec3("normal", {-1, 1});
  const double length = normal.norm();
  if (length < 1e-3) in.reject("must not be zero", "normal");
  return normal / std::max(length, 1e-3);
}

Primitive read_half_space(TomlReader& in) {
  HalfSpace h;
  h.point = in.vec3("point_mm", kPlace_mm) * kMm;
  h.normal = read_normal(in);
  return h;
}

Primitive read_crack(TomlReader& in) {
  Crack c;
  c.point = in.vec3("point_mm", kPlace_mm) * kMm;
  c.normal = read_normal(in);
  c.gap = in.number("gap_mm", kRadius_mm) * kMm;
  c.rough = in.number("rough_mm", kBlend_mm) * kMm;
  c.grain = in.number("grain_mm", kRadius_mm) * kMm;
  return c;
}

struct ShapeReader {
  const char* name;
  Primitive (*read)(TomlReader&);
  bool has_end;
};

constexpr ShapeReader kShapes[] = {{"ellipsoid", read_ellipsoid, true},
                                   {"tube", read_tube, true},
                                   {"box", read_box, true},
                                   {"half_space", read_half_space, false},
                                   {"crack", read_crack, false}};

struct Mirror {
  void operator()(Ellipsoid& e) const { turned(e.center, e.R_local); }
  void operator()(RoundedBox& b) const { turned(b.center, b.R_local); }
  void operator()(HalfSpace& h) const { directed(h.point, h.normal); }
  void operator()(Crack& c) const { directed(c.point, c.normal); }
  void operator()(Tube& t) const {
    for (Vec3& p : t.points) p.y() = -p.y();
  }

 private:
  /// Axes that are symmetric themselves stay right-handed: S R S with S = diag(1, -1, 1).
  static void turned(Vec3& center, Mat3& R_local) {
    center.y() = -center.y();
    R_local.row(1) = -R_local.row(1);
    R_local.col(1) = -R_local.col(1);
  }
  static void directed(Vec3& point, Vec3& normal) {
    point.y() = -point.y();
    normal.y() = -normal.y();
  }
};

struct Shift {
  Vec3 by;
  void operator()(Ellipsoid& e) const { e.center += by; }
  void operator()(RoundedBox& b) const { b.center += by; }
  void operator()(HalfSpace& h) const { h.point += by; }
  void operator()(Crack& c) const { c.point += by; }
  void operator()(Tube& t) const {
    for (Vec3& p : t.points) p += by;
  }
};

/// A part `like` one of the same operation further up, mirrored, then shifted.
Part read_copy(TomlReader& in, Operation operation, const Solid& above) {
  const std::string like = in.text("like");
  const auto model = std::find_if(above.parts.begin(), above.parts.end(), [&](const Part& p) {
    return p.operation == operation && !like.empty() && p.name == like;
  });
  if (model == above.parts.end()) {
    in.reject("names no earlier part of the list: '" + like + "'", "like");
    return {};
  }
  Part part = *model;
  part.name = in.has("name") ? in.text("name") : "";
  if (in.flag_or("mirror", false)) std::visit(Mirror{}, part.primitive);
  std::visit(Shift{in.vec3_or("shift_mm", kPlace_mm, Vec3::Zero()) * kMm}, part.primitive);
  part.blend = in.number_or("blend_mm", kBlend_mm, part.blend / kMm) * kMm;
  return part;
}

}  // namespace

Part read_part(TomlReader& in, Operation operation, double blend) {
  Part part;
  part.operation = operation;
  if (in.has("name")) part.name = in.text("name");
  const std::string shape = in.text("shape");
  const auto* known = std::find_if(std::begin(kShapes), std::end(kShapes),
                                   [&](const ShapeReader& s) { return shape == s.name; });
  if (known == std::end(kShapes)) {
    in.reject("names no known shape: '" + shape + "'", "shape");
  } else if (operation == Operation::kAdd && !known->has_end) {
    in.reject("can only cut, not add: '" + shape + "'", "shape");
  } else {
    part.primitive = known->read(in);
  }
  part.blend = in.number_or("blend_mm", kBlend_mm, blend / kMm) * kMm;
  return part;
}

Result<void> read_parts(TomlReader& in, const std::string& key, Operation operation, double blend,
                        Solid& solid) {
  std::size_t n = 0;
  for (const toml::table* table : in.tables(key, operation == Operation::kAdd)) {
    TomlReader entry(*table, in.where() + ", " + key + " " + std::to_string(++n));
    if (entry.has("section")) entry.text("section");  // what its numbers are counted under
    solid.parts.push_back(entry.has("like") ? read_copy(entry, operation, solid)
                                            : read_part(entry, operation, blend));
    if (auto ok = entry.finish(); !ok) return ok;
  }
  return {};
}

}  // namespace osteon
