#include "case/soft_parts.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace osteon {
namespace {

Result<BoneId> bone_named(const std::vector<Bone>& bones, const std::string& name,
                          const std::string& where) {
  for (std::uint32_t i = 0; i < bones.size(); ++i)
    if (bones[i].name == name) return BoneId{i};
  return fail("there is no bone '" + name + "'", where, "Name a bone of the case");
}

bool is_kind(const std::string& kind) {
  const auto kinds = soft_kinds();
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

Result<void> check_soft(const SoftDef& def, const std::string& where) {
  if (def.name.empty()) return fail("a soft part has no name", "case", "Give every one a name");
  if (!is_kind(def.kind)) return fail("the kind '" + def.kind + "' is not known", where);
  if (def.mesh_W.triangles.empty()) return fail("the mesh has no triangles", where);
  if (!std::isfinite(def.thickness_m) || def.thickness_m < 0)
    return fail("the thickness must not be negative", where);
  for (const Triangle& t : def.mesh_W.triangles)
    for (const std::uint32_t v : t)
      if (v >= def.mesh_W.vertices.size() || !is_finite(def.mesh_W.vertices[v]))
        return fail("a triangle refers to a vertex that does not exist or is not finite", where);
  for (const AttachmentDef& attachment : def.attachments)
    if (!is_finite(attachment.p_W)) return fail("an attachment is not finite", where);
  return {};
}

Result<SoftPart> build_soft(SoftDef def, const std::vector<Bone>& bones) {
  const std::string where = "soft part '" + def.name + "'";
  if (auto sound = check_soft(def, where); !sound) return tl::unexpected(sound.error());
  SoftPart soft;
  for (const std::string& name : def.bones) {
    const auto bone = bone_named(bones, name, where);
    if (!bone) return tl::unexpected(bone.error());
    soft.bones.push_back(*bone);
  }
  for (AttachmentDef& attachment : def.attachments) {
    const auto bone = bone_named(bones, attachment.bone, where);
    if (!bone) return tl::unexpected(bone.error());
    soft.attachments.push_back({std::move(attachment.name), *bone, attachment.p_W});
  }
  soft.name = std::move(def.name);
  soft.fma_id = def.fma_id;
  soft.tissue = std::move(def.tissue);
  soft.kind = std::move(def.kind);
  soft.mesh_W = std::move(def.mesh_W);
  soft.thickness_m = def.thickness_m;
  soft.color_srgb = def.color_srgb;
  return soft;
}

}  // namespace

Result<std::vector<SoftPart>> build_softs(std::vector<SoftDef> defs,
                                          const std::vector<Bone>& bones) {
  if (defs.size() > kMaxSofts)
    return fail("it has more than " + std::to_string(kMaxSofts) + " soft parts", "case");
  std::vector<SoftPart> softs;
  std::set<std::string> names;
  for (SoftDef& def : defs) {
    if (!names.insert(def.name).second)
      return fail("two soft parts have the name '" + def.name + "'", "case", "Rename one of them");
    auto soft = build_soft(std::move(def), bones);
    if (!soft) return tl::unexpected(soft.error());
    softs.push_back(std::move(*soft));
  }
  return softs;
}

}  // namespace osteon
