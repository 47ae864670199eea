#include "exercises/debrief_pictures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "osteon/base/file.h"
#include "osteon/render/anatomical_view.h"

namespace osteon {
namespace {

constexpr int kWide = 1200, kHigh = 900;
constexpr double kWay_m = 0.00025;
constexpr float kSeenThrough = 0.45f;
constexpr double kWayRoom = 1.3;  // tools come from beside the bones
constexpr double kBead_m = 0.0005, kLeastBead = 0.05;
constexpr std::array<std::array<float, 4>, 4> kHandColors{{{0.95f, 0.62f, 0.14f, 0.95f},
                                                           {0.62f, 0.78f, 0.20f, 0.95f},
                                                           {0.85f, 0.35f, 0.55f, 0.95f},
                                                           {0.55f, 0.45f, 0.85f, 0.95f}}};
constexpr std::array<float, 4> kExpertColor{0.20f, 0.55f, 0.95f, 0.85f};

std::vector<Vec3> thinned(std::span<const Vec3> line_W, double least_m) {
  std::vector<Vec3> out;
  for (const Vec3& p_W : line_W)
    if (is_finite(p_W) && (out.empty() || (p_W - out.back()).norm() >= least_m)) out.push_back(p_W);
  return out;
}

void add_way(std::span<const Vec3> way_W, const std::array<float, 4>& color,
             std::vector<SolidMark>& marks) {
  TriMesh tube = tube_along(way_W, kWay_m, 6);
  if (!tube.triangles.empty()) marks.push_back({std::move(tube), color});
}

// A ball that holds all of the damage, and the direction out of the surfaces there.
struct DamagePlace {
  Vec3 center_W = Vec3::Zero(), out_W = Vec3::Zero();
  double radius_m = 0;
};

DamagePlace place_of(const Debrief& debrief, DamageKind kind) {
  DamagePlace place;
  Aabb box;
  for (std::size_t b = 0; b < debrief.damage.size(); ++b)
    for (const DamageSpot& spot : debrief.damage[b]) {
      const double share = share_of(kind, spot.of(kind));
      if (share < 0.05) continue;
      const Pose& X_WB = debrief.the_case->bones[b].X_WB;
      box.include(X_WB * spot.p_B);
      place.out_W += share * X_WB.rotate(spot.n_B);
    }
  if (box.empty()) return place;
  place.center_W = box.center();
  place.radius_m = 0.5 * box.extent().norm();
  return place;
}

// An octahedron.
void add_bead(const Vec3& p_W, TriMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {kBead_m, -kBead_m})
      mesh.vertices.push_back(p_W + side * Vec3::Unit(axis));
  for (std::uint32_t k = 0; k < 8; ++k) {
    const std::uint32_t x = k & 1u, y = k >> 1u & 1u, z = k >> 2u & 1u;
    Triangle facet{first + x, first + 2 + y, first + 4 + z};
    if ((x + y + z) % 2 == 1) std::swap(facet[1], facet[2]);
    mesh.triangles.push_back(facet);
  }
}

std::string way_title(const Debrief& debrief) {
  return debrief.expert.empty() ? "Paths of the tips"
                                : "Paths of the tips beside the expert's (blue)";
}

std::string damage_title(DamageKind kind) {
  const DamageScale& scale = scale_of(kind);
  const auto number = [](double value) { return std::to_string(static_cast<int>(value)); };
  return std::string(scale.title) + ": orange from " + number(scale.full) + " " +
         std::string(scale.unit) + ", none at " + number(scale.none);
}

}  // namespace

TriMesh tube_along(std::span<const Vec3> line_W, double radius_m, int sides) {
  const std::vector<Vec3> line = thinned(line_W, 0.5 * radius_m);
  TriMesh tube;
  if (line.size() < 2 || sides < 3) return tube;
  Vec3 across = Vec3::Zero();
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec3 way = line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0];
    // Where the line turns back upon itself there is no way: the ring before is kept.
    const Vec3 along = way.norm() > 1e-3 * radius_m ? Vec3(way.normalized())
                                                    : Vec3(line[i] - line[i - 1]).normalized();
    const Vec3 kept = across - across.dot(along) * along;
    across = kept.norm() > 0.1 ? Vec3(kept.normalized()) : along.unitOrthogonal();
    const Vec3 up = along.cross(across);
    for (int k = 0; k < sides; ++k) {
      const double a = 2 * std::numbers::pi * k / sides;
      tube.vertices.push_back(line[i] + radius_m * (std::cos(a) * across + std::sin(a) * up));
    }
  }
  const auto n = static_cast<std::uint32_t>(sides);
  const auto rings = static_cast<std::uint32_t>(line.size());
  for (std::uint32_t ring = 0; ring + 1 < rings; ++ring)
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t a = ring * n + k, b = ring * n + (k + 1) % n;
      tube.triangles.push_back({a, b, b + n});
      tube.triangles.push_back({a, b + n, a + n});
    }
  for (std::uint32_t k = 1; k + 1 < n; ++k) {
    tube.triangles.push_back({0, k + 1, k});
    const std::uint32_t last = (rings - 1) * n;
    tube.triangles.push_back({last, last + k, last + k + 1});
  }
  return tube;
}

std::vector<SolidMark> way_marks(const Debrief& debrief) {
  std::vector<SolidMark> marks;
  for (const auto& way_W : debrief.expert) add_way(way_W, kExpertColor, marks);
  for (std::size_t h = 0; h < debrief.hands.size(); ++h)
    add_way(debrief.hands[h].tip_W, kHandColors[h % kHandColors.size()], marks);
  return marks;
}

void color_by_damage(const DamageMap& map, DamageKind kind, PreparedCase& prepared) {
  for (std::size_t b = 0; b < std::min(map.size(), prepared.bones.size()); ++b) {
    ShadedMesh& mesh = prepared.bones[b];
    const std::vector<float> shares = damage_at(map[b], kind, mesh.positions);
    for (std::size_t v = 0; v < mesh.shades.size(); ++v)
      mesh.shades[v].felt = static_cast<std::uint8_t>(128 + std::lround(127 * shares[v]));
  }
}

Camera camera_at_damage(const Debrief& debrief, DamageKind kind, double aspect) {
  constexpr double kLeast_m = 0.012, kMargin = 1.25;
  Camera camera = preset_camera(ViewPreset::kDorsal, *debrief.the_case, aspect);
  const DamagePlace place = place_of(debrief, kind);
  if (!(place.radius_m > 0)) return camera;
  camera.target_W = place.center_W;
  const double high_m = kMargin * std::max(kLeast_m, place.radius_m);
  camera.distance_m = high_m / std::tan(0.5 * camera.vertical_fov_rad);
  const Vec3 up_W = camera.q_WC * Vec3(Vec3::UnitY());
  if (!(place.out_W.norm() > 1e-6)) return camera;
  const Vec3 from_W = place.out_W.normalized();
  if (std::abs(from_W.dot(up_W)) < 0.9) camera.q_WC = look_rotation(from_W, up_W);
  return camera;
}

std::vector<SolidMark> damage_marks(const Debrief& debrief, DamageKind kind) {
  constexpr std::array<std::array<float, 4>, 3> kSteps{
      {{0.98f, 0.86f, 0.45f, 0.95f}, {0.96f, 0.60f, 0.18f, 0.95f}, {0.86f, 0.22f, 0.08f, 0.95f}}};
  std::array<TriMesh, kSteps.size()> beads;
  for (std::size_t b = 0; b < debrief.damage.size(); ++b)
    for (const DamageSpot& spot : debrief.damage[b]) {
      const double share = share_of(kind, spot.of(kind));
      if (share < kLeastBead) continue;
      const auto step =
          std::min(kSteps.size() - 1, static_cast<std::size_t>(share * double(kSteps.size())));
      add_bead(debrief.the_case->bones[b].X_WB * spot.p_B, beads[step]);
    }
  std::vector<SolidMark> marks;
  for (std::size_t k = 0; k < kSteps.size(); ++k)
    if (!beads[k].triangles.empty()) marks.push_back({std::move(beads[k]), kSteps[k]});
  return marks;
}

Result<std::vector<DebriefPicture>> draw_debrief(const Debrief& debrief) {
  const auto context = OffscreenContext::create();
  if (!context) return tl::unexpected(context.error());
  return draw_debrief_here(debrief);
}

Result<std::vector<DebriefPicture>> draw_debrief_here(const Debrief& debrief) {
  const auto data_dir = find_data_dir();
  if (!data_dir) return tl::unexpected(data_dir.error());
  PreparedCase prepared = prepare_case(*debrief.the_case);
  auto renderer = Renderer::create(*debrief.the_case, Tool{}, *data_dir, prepared);
  if (!renderer) return tl::unexpected(renderer.error());
  RenderSnapshot snapshot;
  snapshot.bones = rest_snapshot(*debrief.the_case);
  const double aspect = static_cast<double>(kWide) / kHigh;
  ViewState view = default_view(*debrief.the_case);
  view.show_proxy = view.show_force = view.show_hand_ghost = false;
  view.quality = RenderQuality::kFine;
  std::vector<DebriefPicture> pictures;
  const auto draw = [&](std::string title) {
    Image image = renderer->draw_image(snapshot, view, kWide, kHigh);
    if (!image.rgb.empty()) pictures.push_back({std::move(title), std::move(image)});
  };
  view.camera = preset_camera(ViewPreset::kDorsal, *debrief.the_case, aspect);
  view.camera.distance_m *= kWayRoom;
  const std::vector<BoneAppearance> solid = view.bones;
  for (BoneAppearance& look : view.bones) look.opacity = kSeenThrough;
  renderer->set_marks(way_marks(debrief));
  draw(way_title(debrief));
  renderer->set_marks({});
  view.bones = solid;
  view.show_felt = true;
  for (const DamageKind kind : kDamageKinds) {
    if (!shows_damage(debrief.damage, kind)) continue;
    color_by_damage(debrief.damage, kind, prepared);
    renderer->set_surfaces(prepared);
    view.camera = camera_at_damage(debrief, kind, aspect);
    draw(damage_title(kind));
  }
  return pictures;
}

}  // namespace osteon
