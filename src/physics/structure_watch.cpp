#include "osteon/physics/structure_watch.h"

#include <algorithm>
#include <utility>

#include "osteon/mesh/measure.h"
#include "osteon/scene/soft_motion.h"

namespace osteon {
namespace {

bool is_cartilage(const SoftPart& soft) { return soft.kind == "cartilage"; }

Inside* find_place(InsideList& list, SubjectKind kind, std::uint32_t subject) {
  for (Inside& one : list)
    if (one.kind == kind && one.subject == subject) return &one;
  return nullptr;
}

void free_places(std::uint64_t step, InsideList& list) {
  for (Inside& one : list)
    if (one.kind != SubjectKind::kNothing && step >= one.last_step + StructureWatch::kOutSteps)
      one = {};
}

}  // namespace

StructureWatch::StructureWatch(const Case& the_case) {
  for (const Bone& bone : the_case.bones) rest_X_WB_.push_back(bone.X_WB);
}

void StructureWatch::add(Structure structure, const TriMesh& mesh) {
  // An open mesh has no inside.
  if (mesh.triangles.empty() || !topology(mesh).closed()) return;
  structure.box = bounds(mesh);
  structure.surface = std::make_unique<const MeshDistance>(mesh);
  structures_.push_back(std::move(structure));
}

void StructureWatch::add_softs(const Case& the_case, std::span<const std::uint32_t> felt) {
  for (std::uint32_t i = 0; i < the_case.softs.size(); ++i) {
    const SoftPart& soft = the_case.softs[i];
    if (is_cartilage(soft) || std::find(felt.begin(), felt.end(), i) != felt.end()) continue;
    Structure structure;
    structure.kind = SubjectKind::kSoftPart;
    structure.subject = i;
    for (const BoneId bone : soft.bones) structure.rides_on.push_back(bone.index);
    if (!soft.mesh_W.vertices.empty()) structure.middle_W = bounds(soft.mesh_W).center();
    add(std::move(structure), soft.mesh_W);
  }
}

void StructureWatch::add_bone(const Case& the_case, std::uint32_t bone) {
  Structure structure;
  structure.kind = SubjectKind::kBone;
  structure.subject = bone;
  add(std::move(structure), the_case.bones[bone].mesh);
}

// Negative outside, and where the box alone tells that it is outside.
double StructureWatch::depth_m(const Structure& structure, const Vec3& p_W,
                               const BoneSnapshot& bones) const {
  const Pose X_WS = structure.kind == SubjectKind::kBone
                        ? bones.bones[structure.subject].X_WB
                        : mean_motion(bones, rest_X_WB_, structure.rides_on, structure.middle_W);
  const Vec3 p_S = X_WS.inverse() * p_W;
  if ((p_S.array() < structure.box.lo.array()).any() ||
      (p_S.array() > structure.box.hi.array()).any())
    return -1;
  return -structure.surface->closest(p_S).signed_distance;
}

void StructureWatch::look(const ToolState& tool, const BoneSnapshot& bones,
                          InsideList& list) const {
  if (bones.step % kEvery != 0 || tool.tick == 0 || !is_finite(tool.X_WP)) return;
  for (const Structure& structure : structures_) {
    const double deep_m = depth_m(structure, tool.X_WP.p, bones);
    if (!(deep_m > 0)) continue;
    Inside* place = find_place(list, structure.kind, structure.subject);
    if (!place && deep_m >= kIn_m) {
      place = find_place(list, SubjectKind::kNothing, 0);
      if (place) *place = {structure.kind, structure.subject, bones.step, bones.step, 0};
    }
    if (!place) continue;
    place->last_step = bones.step;
    place->deepest_m = std::max(place->deepest_m, deep_m);
  }
  free_places(bones.step, list);
}

}  // namespace osteon
