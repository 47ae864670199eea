// What case check says of soft parts.
#include <algorithm>
#include <cmath>
#include <set>

#include "case/soft_parts.h"
#include "numbers.h"
#include "osteon/mesh/distance.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

/// A bone's surface in World.
struct PlacedBone {
  std::string name;
  MeshDistance surface;
  Aabb box;
};

std::vector<PlacedBone> place(const CaseDef& def) {
  std::vector<PlacedBone> placed;
  for (const BoneDef& bone : def.bones) {
    TriMesh mesh_W = bone.mesh;
    for (Vec3& v : mesh_W.vertices) v = bone.X_WB * v;
    const Aabb box = bounds(mesh_W);
    placed.push_back({bone.name, MeshDistance(std::move(mesh_W)), box});
  }
  return placed;
}

/// Checks of one soft part, each adding its findings.
class SoftCheck {
 public:
  SoftCheck(const SoftDef& soft, const std::vector<PlacedBone>& bones,
            std::vector<std::string>& found)
      : soft_(soft), bones_(bones), found_(found) {}

  void run() {
    check_mesh();
    check_bones();
    if (soft_.kind != "skin") check_depth();
  }

 private:
  void add(const std::string& what) { found_.push_back(soft_.name + ": " + what); }

  void check_mesh() {
    const Topology shape = topology(soft_.mesh_W);
    if (soft_.mesh_W.triangles.empty()) return add("the mesh has no triangles");
    if (!shape.closed()) return add("the mesh is not closed, or its triangles face both ways");
    if (!(volume(soft_.mesh_W) > 0)) add("the mesh is inside out");
  }

  const PlacedBone* find(const std::string& name) const {
    for (const PlacedBone& bone : bones_)
      if (bone.name == name) return &bone;
    return nullptr;
  }

  void check_bones() {
    for (const std::string& name : soft_.bones)
      if (!find(name)) add("there is no bone '" + name + "'");
    for (const AttachmentDef& attachment : soft_.attachments) {
      const PlacedBone* bone = find(attachment.bone);
      if (!bone) {
        add("there is no bone '" + attachment.bone + "'");
        continue;
      }
      const double off = std::abs(bone->surface.closest(attachment.p_W).signed_distance);
      if (!(off <= kFarthestAttachment_m))
        add("the attachment '" + attachment.name + "' lies " + in_mm(off) + " off the " +
            attachment.bone);
    }
  }

  void check_depth() {
    for (const PlacedBone& bone : bones_) {
      double deepest = 0;
      for (const Vec3& p : soft_.mesh_W.vertices)
        if (bone.box.overlaps({p, p}))
          deepest = std::max(deepest, -bone.surface.closest(p).signed_distance);
      if (deepest > kDeepestSoft_m) add("reaches " + in_mm(deepest) + " into the " + bone.name);
    }
  }

  const SoftDef& soft_;
  const std::vector<PlacedBone>& bones_;
  std::vector<std::string>& found_;
};

}  // namespace

std::vector<std::string> check_softs(const CaseDef& def) {
  std::vector<std::string> found;
  if (def.softs.empty()) return found;
  const std::vector<PlacedBone> bones = place(def);
  std::set<std::string> names;
  for (const SoftDef& soft : def.softs) {
    if (!names.insert(soft.name).second) found.push_back(soft.name + ": the name is used twice");
    SoftCheck(soft, bones, found).run();
  }
  return found;
}

}  // namespace osteon
