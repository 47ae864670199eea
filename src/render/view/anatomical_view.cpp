#include "osteon/render/anatomical_view.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string_view>

namespace osteon {
namespace {

/// Mean of the finite vertices in the rest pose; none for an unknown or empty bone.
std::optional<Vec3> centroid_W(const Case& the_case, std::string_view name) {
  const auto bone = std::find_if(the_case.bones.begin(), the_case.bones.end(),
                                 [&](const Bone& b) { return b.name == name; });
  if (bone == the_case.bones.end() || !is_finite(bone->X_WB)) return std::nullopt;
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (const Vec3& p_B : bone->mesh.vertices) {
    if (!is_finite(p_B)) continue;
    sum += p_B;
    count += 1;
  }
  if (count == 0) return std::nullopt;
  return bone->X_WB * Vec3(sum / count);
}

std::optional<Vec3> first_of(const Case& the_case, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    if (const auto c = centroid_W(the_case, name)) return c;
  return std::nullopt;
}

std::optional<Vec3> mean_of(const Case& the_case, std::initializer_list<std::string_view> names) {
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (const std::string_view name : names) {
    const auto c = centroid_W(the_case, name);
    if (!c) continue;
    sum += *c;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return Vec3(sum / count);
}

std::optional<Vec3> proximal_point_W(const Case& the_case) {
  if (const auto forearm = first_of(the_case, {"radius", "ulna"})) return forearm;
  return mean_of(the_case, {"scaphoid", "lunate", "triquetrum", "pisiform"});
}

std::optional<Vec3> difference(const std::optional<Vec3>& to, const std::optional<Vec3>& from) {
  if (!to || !from) return std::nullopt;
  return Vec3(*to - *from);
}

/// What is up in every view: from the forearm to the fingers, or from the tibia to the femur.
std::optional<Vec3> upwards_W(const Case& the_case) {
  const auto hand =
      difference(first_of(the_case, {"metacarpal_3", "capitate"}), proximal_point_W(the_case));
  return hand ? hand : difference(centroid_W(the_case, "femur"), centroid_W(the_case, "tibia"));
}

/// Across a knee, to the fibula's side. The fibula itself lies outwards and behind.
std::optional<Vec3> towards_fibula_W(const Case& the_case) {
  const auto tibia = centroid_W(the_case, "tibia");
  const auto forwards = difference(centroid_W(the_case, "patella"), tibia);
  const auto upwards = difference(centroid_W(the_case, "femur"), tibia);
  const auto fibula = difference(centroid_W(the_case, "fibula"), tibia);
  if (!forwards || !upwards || !fibula) return std::nullopt;
  const Vec3 across = forwards->cross(*upwards);
  return across.dot(*fibula) < 0 ? Vec3(-across) : across;
}

/// From the little finger's side to the thumb's, or across a knee.
std::optional<Vec3> towards_thumb_W(const Case& the_case) {
  auto ulnar = centroid_W(the_case, "ulna");
  auto radial = centroid_W(the_case, "radius");
  if (!ulnar || !radial) {
    ulnar = first_of(the_case, {"metacarpal_5", "hamate", "triquetrum"});
    radial = first_of(the_case, {"metacarpal_2", "trapezoid", "scaphoid"});
  }
  const auto hand = difference(radial, ulnar);
  return hand ? hand : towards_fibula_W(the_case);
}

/// +1 or -1: which way along `dorsal_W`, the right side's, the back of this hand or the front of
/// this knee lies.
double dorsal_sign(const Case& the_case, const Vec3& dorsal_W) {
  const auto forwards = difference(centroid_W(the_case, "patella"), centroid_W(the_case, "tibia"));
  if (forwards) return forwards->dot(dorsal_W) < 0 ? -1 : 1;
  const auto pisiform = centroid_W(the_case, "pisiform");
  const auto triquetrum = centroid_W(the_case, "triquetrum");
  if (pisiform && triquetrum) return (*pisiform - *triquetrum).dot(dorsal_W) > 0 ? -1 : 1;
  return the_case.side == "left" ? -1 : 1;
}

Vec3 view_from_W(ViewPreset preset, const AnatomicalFrame& frame) {
  switch (preset) {
    case ViewPreset::kPalmar:
      return -frame.dorsal_W;
    case ViewPreset::kRadial:
    case ViewPreset::kLateral:
      return frame.radial_W;
    case ViewPreset::kUlnar:
      return -frame.radial_W;
    case ViewPreset::kDorsal:
    case ViewPreset::kAp:
      break;
  }
  return frame.dorsal_W;
}

void add_points_W(const Bone& bone, std::vector<Vec3>& points) {
  for (const Vec3& p_B : bone.mesh.vertices)
    if (const Vec3 p_W = bone.X_WB * p_B; is_finite(p_W)) points.push_back(p_W);
}

std::vector<Vec3> all_points_W(const Case& the_case) {
  std::vector<Vec3> points;
  for (const Bone& bone : the_case.bones)
    if (!bone.beside) add_points_W(bone, points);
  return points;
}

std::vector<Vec3> carpal_points_W(const Case& the_case) {
  std::vector<Vec3> points;
  for (const std::string_view name : {"scaphoid", "lunate", "triquetrum", "pisiform", "trapezium",
                                      "trapezoid", "capitate", "hamate"})
    if (const BoneId id = the_case.find(name); id.valid()) add_points_W(the_case.bone(id), points);
  return points;
}

/// The knee's joint: all within 9 cm of the middle of the patella.
std::vector<Vec3> knee_points_W(const Case& the_case) {
  constexpr double kReach_m = 0.09;
  const auto middle = centroid_W(the_case, "patella");
  std::vector<Vec3> points;
  if (!middle) return points;
  for (const Vec3& p : all_points_W(the_case))
    if ((p - *middle).norm() < kReach_m) points.push_back(p);
  return points;
}

/// One axis of the screen: where its middle must lie and how far away the eye, for every point to
/// fall between `lo` and `hi` (-1..1 over the picture) of a picture with the tangent `t` of half
/// its angle. With p across and d towards the viewer the conditions lo t (D - d) <= p - c <=
/// hi t (D - d) are linear in the middle c and the distance D.
struct AxisFit {
  double t, lo, hi;
  double highest = -std::numeric_limits<double>::infinity();
  double lowest = std::numeric_limits<double>::infinity();

  void include(double p, double d) {
    highest = std::max(highest, p + hi * t * d);
    lowest = std::min(lowest, p + lo * t * d);
  }
  double distance() const { return (highest - lowest) / ((hi - lo) * t); }
  double middle(double distance) const {
    return 0.5 * (highest + lowest - (hi + lo) * t * distance);
  }
};

AxisFit free_axis(double tan_half, double covered_low, double covered_high) {
  constexpr double kMargin = 0.06;
  constexpr double kLeastFree = 0.2;
  const double low = std::clamp(covered_low, 0.0, 1.0), high = std::clamp(covered_high, 0.0, 1.0);
  const double free = 1 - low - high;
  if (free < kLeastFree) return {tan_half, -1 + kMargin, 1 - kMargin};
  const double margin = kMargin * free;
  return {tan_half, -1 + 2 * low + margin, 1 - 2 * high - margin};
}

/// Puts the eye as near as it can be with every point inside the free part of the picture.
void frame_points(const std::vector<Vec3>& points_W, double aspect, const CoveredEdges& covered,
                  Camera& camera) {
  std::vector<Vec3> points;
  Aabb box;
  for (const Vec3& p_W : points_W) {
    points.push_back(camera.q_WC.conjugate() * p_W);
    box.include(points.back());
  }
  const double depth = box.center().z();
  const double tan_y = std::tan(0.5 * camera.vertical_fov_rad);
  AxisFit x = free_axis(tan_y * std::max(aspect, 1e-3), covered.left, covered.right);
  AxisFit y = free_axis(tan_y, covered.bottom, covered.top);
  double nearest = 1e-3;
  for (const Vec3& p : points) {
    const double towards = camera.orthographic ? 0 : p.z() - depth;
    x.include(p.x(), towards);
    y.include(p.y(), towards);
    nearest = std::max(nearest, towards + 1e-3);
  }
  const double distance = std::max({x.distance(), y.distance(), nearest});
  camera.target_W = camera.q_WC * Vec3(x.middle(distance), y.middle(distance), depth);
  camera.distance_m = distance;
}

}  // namespace

AnatomicalFrame anatomical_frame(const Case& the_case) {
  AnatomicalFrame frame;
  const auto upwards = upwards_W(the_case);
  const auto thumb = towards_thumb_W(the_case);
  if (!upwards || !thumb) return frame;
  const double smallest_m = 1e-6;
  const Vec3 along = *upwards;
  if (along.norm() < smallest_m) return frame;
  const Vec3 up = along.normalized();
  const Vec3 across = *thumb - up * up.dot(*thumb);
  if (across.norm() < smallest_m) return frame;
  frame.distal_W = up;
  frame.radial_W = across.normalized();
  // The right hand seen from its back, fingers up, has the thumb on the left.
  const Vec3 dorsal = frame.distal_W.cross(frame.radial_W);
  frame.dorsal_W = dorsal * dorsal_sign(the_case, dorsal);
  frame.from_bones = true;
  return frame;
}

Camera preset_camera(ViewPreset preset, const Case& the_case, double aspect,
                     const CoveredEdges& covered) {
  const AnatomicalFrame frame = anatomical_frame(the_case);
  Camera camera;
  camera.orthographic = preset == ViewPreset::kAp || preset == ViewPreset::kLateral;
  camera.q_WC = look_rotation(view_from_W(preset, frame), frame.distal_W);
  const std::vector<Vec3> points = all_points_W(the_case);
  if (!points.empty()) frame_points(points, aspect, covered, camera);
  return camera;
}

Camera close_up_camera(const Camera& from, const Case& the_case, BoneId bone, double aspect,
                       const CoveredEdges& covered) {
  std::vector<Vec3> points;
  if (bone.index < the_case.bones.size()) add_points_W(the_case.bone(bone), points);
  if (points.empty()) points = carpal_points_W(the_case);
  if (points.empty()) points = knee_points_W(the_case);
  if (points.empty()) points = all_points_W(the_case);
  Camera camera = from;
  if (!points.empty()) frame_points(points, aspect, covered, camera);
  return camera;
}

}  // namespace osteon
