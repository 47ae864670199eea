#include "knee/knee_parts.h"

#include <algorithm>
#include <utility>

#include "osteon/mesh/append_mesh.h"

namespace osteon {
namespace {

constexpr std::string_view kMakeOne =
    "Make a knee with osteon anatomy make knee, or use builtin:knee";

Vec3 mirrored(const Vec3& p) { return {p.x(), -p.y(), p.z()}; }

/// Across the plane y = 0.
Pose mirrored(const Pose& X) { return {mirrored(X.p), Quat(X.q.w(), -X.q.x(), X.q.y(), -X.q.z())}; }

const BoneDef* find_bone(const CaseDef& def, std::string_view name) {
  const auto at = std::find_if(def.bones.begin(), def.bones.end(),
                               [&](const BoneDef& bone) { return bone.name == name; });
  return at == def.bones.end() ? nullptr : &*at;
}

TriMesh moved_mesh(const TriMesh& mesh, const Pose& X, bool mirror) {
  TriMesh out = mesh;
  for (Vec3& v : out.vertices) v = mirror ? mirrored(X * v) : Vec3(X * v);
  if (mirror)
    for (Triangle& t : out.triangles) std::swap(t[1], t[2]);
  return out;
}

const PoseTrack* find_track(const CaseDef& def, std::string_view bone) {
  for (const JointDef& joint : def.joints)
    for (const JointDef::Moved& moved : joint.bones)
      if (joint.name == "flexion" && joint.fixed == "femur" && moved.bone == bone &&
          !moved.X_FB.poses.empty())
        return &moved.X_FB;
  return nullptr;
}

KneeParts::Bone placed(const BoneDef& bone, const Pose& X_FB, bool left) {
  return {bone.name, X_FB * bone.X_WB.inverse(),
          std::make_shared<MeshDistance>(moved_mesh(bone.mesh, X_FB, left))};
}

/// The tibia's poses against where it is when stretched.
PoseTrack bending(const PoseTrack& X_FB, bool left) {
  PoseTrack out = X_FB;
  const Pose straight = pose_at(X_FB, 0).inverse();
  for (Pose& X : out.poses) {
    X = X * straight;
    if (left) X = mirrored(X);
  }
  return out;
}

/// Triangles of a mesh that are farther than this from another surface.
TriMesh farther_than(double gap, const TriMesh& mesh, const MeshDistance& other) {
  TriMesh out{mesh.vertices, {}};
  for (const Triangle& t : mesh.triangles) {
    const Vec3 middle = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3;
    if (std::abs(other.closest(middle).signed_distance) > gap) out.triangles.push_back(t);
  }
  return out;
}

/// Free faces of the layer, and of the bone what it leaves bare.
TriMesh touchable(const MeshDistance& bone, const MeshDistance& layer) {
  constexpr double kUnderside_m = 0.0003;
  TriMesh out = farther_than(kUnderside_m, layer.mesh(), bone);
  append_mesh(out, farther_than(kUnderside_m, bone.mesh(), layer));
  return out;
}

Result<void> take_cartilage(const CaseDef& def, KneeParts& parts) {
  TriMesh femoral;
  for (const SoftDef& soft : def.softs) {
    if (soft.kind != "cartilage" || soft.bones.empty()) continue;
    if (soft.bones[0] == "femur") {
      append_mesh(femoral, moved_mesh(soft.mesh_W, parts.femur.X_FW, parts.left));
      parts.femoral_thickness_m = std::max(parts.femoral_thickness_m, soft.thickness_m);
    }
    if (soft.bones[0] == "tibia")
      parts.plateaus.push_back(moved_mesh(soft.mesh_W, parts.tibia.X_FW, parts.left));
  }
  if (femoral.triangles.empty() || parts.plateaus.empty())
    return fail("it has no cartilage on femur and tibia", "case '" + def.name + "'",
                std::string(kMakeOne));
  parts.femoral_cartilage = std::make_shared<MeshDistance>(std::move(femoral));
  parts.femoral_surface =
      std::make_shared<MeshDistance>(touchable(*parts.femur.surface, *parts.femoral_cartilage));
  return {};
}

Result<double> width_of(const CaseDef& def) {
  const Vec3* ends[2] = {nullptr, nullptr};
  for (const Landmark& landmark : def.landmarks) {
    if (landmark.name == "medial_epicondyle") ends[0] = &landmark.p_W;
    if (landmark.name == "lateral_epicondyle") ends[1] = &landmark.p_W;
  }
  const double width = ends[0] && ends[1] ? (*ends[0] - *ends[1]).norm() : 0;
  if (!(width > 0.01))
    return fail("it lacks the landmarks medial_epicondyle and lateral_epicondyle",
                "case '" + def.name + "'", std::string(kMakeOne));
  return width;
}

}  // namespace

Vec3 KneeParts::place(const Bone& bone, const Vec3& p_W) const {
  const Vec3 p_F = bone.X_FW * p_W;
  return left ? mirrored(p_F) : p_F;
}

Result<KneeParts> find_knee_bones(const CaseDef& def) {
  const std::string where = "case '" + def.name + "'";
  for (const std::string_view name : {"femur", "tibia"})
    if (const BoneDef* bone = find_bone(def, name); !bone || bone->mesh.triangles.empty())
      return fail("it has no " + std::string(name), where, std::string(kMakeOne));
  const PoseTrack* track = find_track(def, "tibia");
  if (!track)
    return fail("it has no joint 'flexion' that bends the tibia against the femur", where,
                std::string(kMakeOne));
  KneeParts parts;
  parts.left = def.side == "left";
  parts.femur = placed(*find_bone(def, "femur"), Pose{}, parts.left);
  parts.tibia = placed(*find_bone(def, "tibia"), pose_at(*track, 0), parts.left);
  const BoneDef* fibula = find_bone(def, "fibula");
  const PoseTrack* with = find_track(def, "fibula");
  if (fibula && with) parts.fibula = placed(*fibula, pose_at(*with, 0), parts.left);
  parts.X_FT = bending(*track, parts.left);
  parts.straight_BF = pose_at(*track, 0).inverse();
  return parts;
}

Result<KneeParts> find_knee_parts(const CaseDef& def, double width_m) {
  auto parts = find_knee_bones(def);
  if (!parts) return parts;
  if (auto ok = take_cartilage(def, *parts); !ok) return tl::unexpected(ok.error());
  const auto width = width_of(def);
  if (!width) return tl::unexpected(width.error());
  parts->scale = *width / width_m;
  return parts;
}

}  // namespace osteon
