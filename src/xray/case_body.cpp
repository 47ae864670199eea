#include "osteon/xray/case_body.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "offset_surface.h"
#include "osteon/mesh/distance.h"
#include "osteon/mesh/measure.h"
#include "osteon/scene/soft_motion.h"

namespace osteon {
namespace {

/// Kinds of soft parts, those that hide the others first, as the virtual scanner has them.
constexpr std::string_view kSeenFirst[] = {"cartilage", "meniscus", "disc", "ligament",
                                           "tendon",    "fat",      "skin"};

Result<void> check(const CaseBodyOptions& o) {
  for (const double m : {o.cortical_m, o.skin_m, o.fat_m, o.flesh_m})
    if (!(m >= 0 && m <= 0.1))
      return fail("layers must be 0 to 100 mm thick", "the body for X-rays");
  if (o.bones_hu && !(*o.bones_hu >= -1024 && *o.bones_hu <= 31000))
    return fail("bones must have -1024 to 31000 HU", "the body for X-rays");
  return {};
}

}  // namespace

struct CaseBody::Builder {
  const Case& from;
  const TissueTable& tissues;
  const CaseBodyOptions& options;
  CaseBody out{};
  std::optional<Error> failed{};

  Result<CaseBody> build() {
    if (from.bones.empty()) return fail("there is no bone to X-ray", "case '" + from.name + "'");
    for (const Bone& bone : from.bones) out.rest_X_WB_.push_back(bone.X_WB);
    std::vector<Part> bones = bone_parts();
    if (options.bones_hu) {
      out.layers_.push_back({"bones", material_of_hu(*options.bones_hu), std::move(bones)});
    } else {
      out.layers_.push_back(
          {"cancellous bone", material("cancellous_bone"), offset(bones, -options.cortical_m)});
      out.layers_.push_back({"cortical bone", material("cortical_bone"), bones});
      for (const std::string_view kind : kSeenFirst)
        if (kind != "skin") add_softs(kind);
      add_flesh(bones);
    }
    if (failed) return tl::unexpected(*failed);
    return std::move(out);
  }

  XrayMaterial material(const std::string& tissue) {
    const Tissue* found = tissues.find(tissue);
    if (!found && !failed) failed = Error{"has no tissue '" + tissue + "'", "the tissue table", ""};
    return found ? material_of_hu(found->hu.value) : XrayMaterial{};
  }

  std::shared_ptr<const TriMesh> surface(const TriMesh& mesh, const std::string& name) {
    auto made = xray_surface(mesh, name);
    if (made) return *made;
    if (!failed) failed = made.error();
    return std::make_shared<const TriMesh>();
  }

  std::vector<Part> bone_parts() {
    std::vector<Part> parts;
    for (std::size_t n = 0; n < from.bones.size(); ++n) {
      Part part;
      part.mesh = surface(from.bones[n].mesh, "bone '" + from.bones[n].name + "'");
      part.bone = n;
      parts.push_back(std::move(part));
    }
    return parts;
  }

  Part soft_part(const SoftPart& soft) {
    Part part;
    part.mesh = surface(soft.mesh_W, "soft part '" + soft.name + "'");
    part.soft = true;
    for (const BoneId bone : soft.bones) part.on.push_back(bone.index);
    part.center = part.mesh->vertices.empty() ? Vec3::Zero() : Vec3(bounds(*part.mesh).center());
    return part;
  }

  static std::vector<Part> offset(std::vector<Part> parts, double by_m) {
    for (Part& part : parts)
      part.mesh = std::make_shared<const TriMesh>(offset_surface(*part.mesh, by_m));
    return parts;
  }

  std::vector<Part> softs(std::string_view kind, std::string_view tissue = {}) {
    std::vector<Part> parts;
    for (const SoftPart& soft : from.softs)
      if (soft.kind == kind && (tissue.empty() || soft.tissue == tissue))
        parts.push_back(soft_part(soft));
    return parts;
  }

  /// All of a kind, one layer a tissue, in the order in which the tissues occur.
  void add_softs(std::string_view kind) {
    std::vector<std::string> seen;
    for (const SoftPart& soft : from.softs) {
      if (soft.kind != kind || std::find(seen.begin(), seen.end(), soft.tissue) != seen.end())
        continue;
      seen.push_back(soft.tissue);
      out.layers_.push_back({soft.tissue, material(soft.tissue), softs(kind, soft.tissue)});
    }
  }

  /// What the skin encloses, by its depth, and flesh around bone that reaches out of it.
  void add_flesh(const std::vector<Part>& bones) {
    const XrayMaterial muscle = material("muscle");
    const std::vector<Part> skin = softs("skin");
    if (failed) return;
    if (!skin.empty()) {
      out.layers_.push_back({"muscle", muscle, offset(skin, -options.skin_m - options.fat_m)});
      out.layers_.push_back({"fat under the skin", material("fat"), offset(skin, -options.skin_m)});
      out.layers_.push_back({"skin", material("skin"), skin});
    }
    if (options.flesh_m > 0)
      out.layers_.push_back({"flesh around bare bone", muscle, flesh_around(bones, skin)});
  }

  /// Bones grown by the flesh's thickness where they lie outside the skin.
  std::vector<Part> flesh_around(const std::vector<Part>& bones, const std::vector<Part>& skin) {
    std::vector<MeshDistance> to_skin;
    for (const Part& part : skin) to_skin.emplace_back(*part.mesh);
    std::vector<Part> parts;
    for (const Part& bone : bones) {
      std::vector<double> by_m(bone.mesh->vertices.size(), options.flesh_m);
      bool bare = skin.empty();
      for (std::size_t v = 0; v < by_m.size() && !skin.empty(); ++v) {
        const Vec3 p_W = out.rest_X_WB_[bone.bone] * bone.mesh->vertices[v];
        const bool covered = std::any_of(to_skin.begin(), to_skin.end(), [&](const auto& s) {
          return s.closest(p_W).signed_distance < 0;
        });
        if (covered) by_m[v] = 0;
        bare = bare || !covered;
      }
      if (!bare) continue;
      parts.push_back(bone);
      parts.back().mesh = std::make_shared<const TriMesh>(offset_surface(*bone.mesh, by_m));
    }
    return parts;
  }
};

Result<CaseBody> CaseBody::create(const Case& the_case, const TissueTable& tissues,
                                  const CaseBodyOptions& options) {
  if (auto ok = check(options); !ok) return tl::unexpected(ok.error());
  return Builder{the_case, tissues, options}.build();
}

Pose CaseBody::pose_of(const Part& part, const BoneSnapshot& bones) const {
  if (!part.soft) return bones.bones[part.bone].X_WB;
  return mean_motion(bones, rest_X_WB_, part.on, part.center);
}

XrayBody CaseBody::posed(const BoneSnapshot& bones) const {
  XrayBody body;
  for (const Layer& layer : layers_) {
    XrayLayer posed{layer.name, layer.material, {}};
    for (const Part& part : layer.parts)
      posed.surfaces.push_back({part.mesh, pose_of(part, bones)});
    body.layers.push_back(std::move(posed));
  }
  return body;
}

XrayBody CaseBody::at_rest() const {
  BoneSnapshot rest;
  rest.count = static_cast<std::uint32_t>(rest_X_WB_.size());
  for (std::size_t n = 0; n < rest_X_WB_.size(); ++n) rest.bones[n].X_WB = rest_X_WB_[n];
  return posed(rest);
}

}  // namespace osteon
