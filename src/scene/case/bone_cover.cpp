#include "osteon/scene/bone_cover.h"

#include <utility>
#include <vector>

#include "case/mesh_hash.h"
#include "osteon/base/log.h"
#include "osteon/mesh/measure.h"
#include "osteon/scene/field_cache.h"

namespace osteon {
namespace {

bool lies_on(const SoftDef& soft, const BoneDef& bone) {
  return soft.kind == "cartilage" && soft.bones.size() == 1 && soft.bones.front() == bone.name;
}

bool is_closed(const TriMesh& mesh) {
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t)
      if (v >= mesh.vertices.size() || !is_finite(mesh.vertices[v])) return false;
  return !mesh.triangles.empty() && topology(mesh).closed() && volume(mesh) > 0;
}

}  // namespace

std::shared_ptr<const CoveredSurface> covered_bone(const CaseDef& def, const BoneDef& bone) {
  std::vector<TriMesh> layers;
  for (const SoftDef& soft : def.softs) {
    if (!lies_on(soft, bone)) continue;
    if (!is_closed(soft.mesh_W)) {
      log(LogLevel::kWarning, "the cartilage '" + soft.name + "' on '" + bone.name +
                                  "' is not one closed surface: it is neither felt nor carved");
      continue;
    }
    TriMesh& layer = layers.emplace_back(soft.mesh_W);
    const Pose X_BW = bone.X_WB.inverse();
    for (Vec3& v : layer.vertices) v = X_BW * v;
  }
  if (layers.empty() || !is_closed(bone.mesh)) return nullptr;
  auto made = CoveredSurface::make(bone.mesh, layers);
  if (made) return std::make_shared<const CoveredSurface>(std::move(*made));
  log(LogLevel::kWarning,
      "the cartilage on '" + bone.name + "' is neither felt nor carved: " + made.error().message());
  return nullptr;
}

void cover_bones(CaseDef& def) {
  for (BoneDef& bone : def.bones)
    if (bone.felt == Felt::kCovered && !bone.covered) bone.covered = covered_bone(def, bone);
}

Result<DistanceField> make_felt_field(const BoneDef& bone, const FieldOptions& options) {
  const bool covered = bone.felt == Felt::kCovered && bone.covered;
  return covered ? DistanceField::make(*bone.covered, options)
                 : DistanceField::make(bone.mesh, options);
}

std::uint64_t field_key(const BoneDef& bone, const FieldOptions& options) {
  const std::uint64_t alone = field_key(bone.mesh, options);
  if (bone.felt != Felt::kCovered || !bone.covered) return alone;
  Hasher hasher;
  hasher.add(alone);
  add_mesh(hasher, bone.covered->touched());
  return hasher.value();
}

}  // namespace osteon
