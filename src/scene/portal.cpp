#include "osteon/scene/portal.h"

#include <algorithm>
#include <limits>

#include "osteon/base/hash.h"
#include "osteon/mesh/measure.h"
#include "osteon/scene/made_portal.h"

namespace osteon {
namespace {

constexpr std::string_view kPrefix = "portal_";
// The skin's direction is that of its surface this far about a portal, m.
constexpr double kAbout = 0.006;

const SoftPart* skin_of(const Case& the_case) {
  for (const SoftPart& soft : the_case.softs)
    if (soft.kind == "skin" && !soft.mesh_W.triangles.empty()) return &soft;
  return nullptr;
}

// Mean outward normal of the triangles about a point, by area; zero where there are none.
Vec3 normal_about(const TriMesh& mesh, const Vec3& p) {
  Vec3 sum = Vec3::Zero();
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    if (((a + b + c) / 3 - p).norm() < kAbout) sum += (b - a).cross(c - a);
  }
  const double size = sum.norm();
  return size > 0 ? Vec3(sum / size) : Vec3(Vec3::Zero());
}

Vec3 towards_bone(const Case& the_case, const Vec3& p_W) {
  double least = std::numeric_limits<double>::infinity();
  Vec3 way = -Vec3::UnitZ();
  for (const Bone& bone : the_case.bones)
    for (const Vec3& p_B : bone.mesh.vertices) {
      const Vec3 to = bone.X_WB * p_B - p_W;
      if (!(to.squaredNorm() < least) || !(to.squaredNorm() > 0)) continue;
      least = to.squaredNorm();
      way = to;
    }
  return way.normalized();
}

// "portal_3_4" -> "3-4", "portal_mcr" -> "MCR".
std::string title_of(std::string_view name) {
  std::string title(name.substr(kPrefix.size()));
  for (char& c : title) {
    if (c == '_') c = '-';
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return title;
}

}  // namespace

std::vector<Portal> find_portals(const Case& the_case, const PortalSkin& skin) {
  std::vector<Portal> out;
  const SoftPart* surface = skin_of(the_case);
  for (std::uint32_t i = 0; i < the_case.landmarks.size(); ++i) {
    const Landmark& landmark = the_case.landmarks[i];
    if (landmark.name.size() <= kPrefix.size() || landmark.name.compare(0, kPrefix.size(), kPrefix))
      continue;
    Vec3 inwards = landmark.inwards_W;
    if (inwards.isZero(0) && surface) inwards = -normal_about(surface->mesh_W, landmark.p_W);
    if (inwards.isZero(0)) inwards = towards_bone(the_case, landmark.p_W);
    out.push_back({landmark.name, title_of(landmark.name), i, landmark.p_W, inwards, skin});
  }
  return out;
}

std::vector<Portal> room_to_make(std::string_view place, std::uint32_t landmark,
                                 std::uint32_t first, const PortalSkin& skin) {
  std::vector<Portal> out(kMadePerPatch);
  const bool known = place.starts_with(kPrefix) && place.size() > kPrefix.size();
  const std::string title = known ? title_of(place) : std::string(place);
  for (std::uint32_t i = 0; i < out.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    out[i].name = std::string(place) + "_made_" + number;
    out[i].title = title + " made " + number;
    out[i].landmark = landmark;
    out[i].skin = skin;
    out[i].made = first + i;
    out[i].open = false;
  }
  return out;
}

PortalSkin portal_skin(const Tissue& skin) {
  PortalSkin out;
  out.stiffness_n_per_m = skin.stiffness_n_per_m.value;
  out.static_friction = skin.static_friction.value;
  out.dynamic_friction = skin.dynamic_friction.value;
  return out;
}

const Portal* find_portal(const std::vector<Portal>& portals, std::string_view name) {
  for (const Portal& portal : portals)
    if (portal.name == name || portal.title == name) return &portal;
  return nullptr;
}

std::uint64_t hash_of(const std::vector<Portal>& portals) {
  Hasher hasher;
  for (const Portal& portal : portals) {
    hasher.add(std::string_view(portal.name));
    hasher.add(portal.p_W);
    hasher.add(portal.nhat_W);
    hasher.add(portal.skin.stiffness_n_per_m);
    hasher.add(portal.skin.static_friction);
    hasher.add(portal.skin.dynamic_friction);
    hasher.add(portal.skin.squeeze_n);
    if (portal.made != kNotMade) hasher.add(portal.made);
  }
  return hasher.value();
}

}  // namespace osteon
