#include "scan/scan_body.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "osteon/mesh/measure.h"
#include "osteon/mesh/repair.h"

namespace osteon {
namespace {

/// A border is curved by less than this lets show.
constexpr double kFineCell_m = 0.00055, kSkinCell_m = 0.0012, kFleshCell_m = 0.0025;

/// Kinds of soft parts, those that hide the others first.
constexpr std::string_view kSeenFirst[] = {"cartilage", "meniscus", "disc", "ligament",
                                           "tendon",    "fat",      "skin"};

class BodyMaker {
 public:
  BodyMaker(const ScannedBody& body, const TissueTable& tissues, const ScanOptions& options)
      : body_(body), tissues_(tissues), options_(options) {}

  Result<ScanBody> make() {
    if (auto ok = check_softs(); !ok) return tl::unexpected(ok.error());
    const double cortical = hu_of("cortical_bone"), cancellous = hu_of("cancellous_bone");
    out_.air_hu = hu_of("air");
    add(bones(), ScanProfile({{0, cortical}, {options_.cortical_m, cancellous}}), kFineCell_m);
    for (const std::string_view kind : kSeenFirst)
      if (kind != "skin") add_softs(kind);
    add_flesh();
    if (missing_) return fail("has no tissue '" + *missing_ + "'", "the tissue table");
    for (const ScanTarget& bone : out_.parts.surfaces.front()) include(bone.box);
    return std::move(out_);
  }

 private:
  double hu_of(const std::string& tissue) {
    const Tissue* found = tissues_.find(tissue);
    if (!found && !missing_) missing_ = tissue;
    return found ? found->hu.value : 0;
  }

  Result<void> check_softs() const {
    for (const ScannedSoft& soft : body_.softs) {
      const std::string where = "soft part '" + soft.name + "'";
      if (std::find(std::begin(kSeenFirst), std::end(kSeenFirst), soft.kind) ==
          std::end(kSeenFirst))
        return fail("is of the kind '" + soft.kind + "', which the scanner does not know", where,
                    "Give it another kind, or scan the bones alone");
      if (!topology(*soft.mesh_W).closed())
        return fail("is not closed, so its inside is undefined", where,
                    "Close its surface, or scan the bones alone");
    }
    return {};
  }

  void include(const Aabb& box) {
    out_.box_P.include(box.lo);
    out_.box_P.include(box.hi);
  }

  static ScanTarget target(TriMesh mesh_P) {
    const Aabb box = bounds(mesh_P);
    return {MeshDistance(std::move(mesh_P)), box};
  }

  ScanSurfaces bones() const {
    ScanSurfaces out;
    for (const ScannedBone& bone : body_.bones) {
      TriMesh mesh_P = *bone.mesh;
      for (Vec3& v : mesh_P.vertices) v = X_PW_ * (bone.X_WB * v);
      out.push_back(target(std::move(mesh_P)));
    }
    return out;
  }

  /// A part of its own surfaces.
  void add(ScanSurfaces surfaces, ScanProfile profile, double cell_m, bool is_shell = false) {
    out_.parts.parts.push_back({out_.parts.surfaces.size(), std::move(profile), cell_m, is_shell});
    out_.parts.surfaces.push_back(std::move(surfaces));
  }

  ScanSurfaces softs(std::string_view kind, std::string_view tissue) const {
    ScanSurfaces out;
    for (const ScannedSoft& soft : body_.softs) {
      if (soft.kind != kind || (!tissue.empty() && soft.tissue != tissue)) continue;
      TriMesh mesh_P = *soft.mesh_W;
      for (Vec3& v : mesh_P.vertices) v = X_PW_ * v;
      out.push_back(target(std::move(mesh_P)));
    }
    return out;
  }

  /// All of a kind, one part a tissue, in the order in which the tissues occur.
  void add_softs(std::string_view kind) {
    std::vector<std::string> tissues;
    for (const ScannedSoft& soft : body_.softs)
      if (soft.kind == kind &&
          std::find(tissues.begin(), tissues.end(), soft.tissue) == tissues.end())
        tissues.push_back(soft.tissue);
    for (const std::string& tissue : tissues) {
      add(softs(kind, tissue), ScanProfile({{0, hu_of(tissue)}}), kFineCell_m);
      for (const ScanTarget& soft : out_.parts.surfaces.back()) include(soft.box);
    }
  }

  void add_flesh() {
    const double muscle = hu_of("muscle");
    const ScanProfile around_bone({{-options_.flesh_m, muscle}});
    ScanSurfaces skin = softs("skin", {});
    if (skin.empty()) {
      out_.parts.parts.push_back({0, around_bone, kFleshCell_m, false});
      return;
    }
    for (const ScanTarget& part : skin) include(part.box);
    TriMesh stumps = bone_outside(skin);
    const double fat_from = options_.skin_m, muscle_from = options_.skin_m + options_.fat_m;
    add(std::move(skin),
        ScanProfile({{0, hu_of("skin")}, {fat_from, hu_of("fat")}, {muscle_from, muscle}}),
        kSkinCell_m);
    if (stumps.triangles.empty()) return;
    ScanSurfaces bare;
    bare.push_back(target(std::move(stumps)));
    add(std::move(bare), around_bone, kFleshCell_m, true);
  }

  /// The surfaces of the bones where they reach out of the skin. What of them lies within it does
  /// not matter: the skin is seen first.
  TriMesh bone_outside(const ScanSurfaces& skin) const {
    TriMesh out;
    for (const ScanTarget& bone : out_.parts.surfaces.front()) {
      const TriMesh& mesh = bone.distance.mesh();
      const auto first = static_cast<std::uint32_t>(out.vertices.size());
      std::vector<char> is_out;
      for (const Vec3& v : mesh.vertices)
        is_out.push_back(std::none_of(skin.begin(), skin.end(), [&](const ScanTarget& part) {
          return part.distance.closest(v).signed_distance < 0;
        }));
      out.vertices.insert(out.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
      for (const Triangle& t : mesh.triangles)
        if (is_out[t[0]] || is_out[t[1]] || is_out[t[2]])
          out.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    weld_vertices(out, 0);
    return out;
  }

  const ScannedBody& body_;
  const TissueTable& tissues_;
  const ScanOptions& options_;
  const Pose X_PW_ = scanner_pose_PW();
  ScanBody out_;
  std::optional<std::string> missing_;
};

}  // namespace

Result<ScanBody> make_scan_body(const ScannedBody& body, const TissueTable& tissues,
                                const ScanOptions& options) {
  return BodyMaker(body, tissues, options).make();
}

}  // namespace osteon
