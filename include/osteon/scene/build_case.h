#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/scene/case.h"

namespace osteon {

/// A bone before its hulls are made.
struct BoneDef {
  std::string name;
  int fma_id = 0;
  Pose X_WB;
  TriMesh mesh;  ///< in Bone, metres
  double density_kg_per_m3 = 1900;
  Material material;
  Felt felt = Felt::kPieces;
  bool beside = false;  ///< see Bone
  /// With the cartilage on it; made by cover_bones (bone_cover.h), and by build_case where it was
  /// not.
  std::shared_ptr<const CoveredSurface> covered;
};

/// A place where a soft part holds on to a bone.
struct AttachmentDef {
  std::string name;
  std::string bone;
  Vec3 p_W = Vec3::Zero();
};

/// A soft part, its bones by name.
struct SoftDef {
  std::string name;
  int fma_id = 0;
  std::string tissue;
  std::string kind;
  TriMesh mesh_W;  ///< in World, bones at rest, metres
  double thickness_m = 0;
  std::array<float, 3> color_srgb{0.86f, 0.82f, 0.74f};  ///< for pictures alone
  std::vector<std::string> bones;
  std::vector<AttachmentDef> attachments;
};

struct CaseDef {
  std::string name;
  std::string side;
  std::vector<BoneDef> bones;
  std::vector<SoftDef> softs;
  std::vector<Landmark> landmarks;
  std::vector<CaseFinding> findings;
  std::vector<JointDef> joints;
  std::optional<CaseRecipe> recipe;  ///< none: the case was not grown
};

class FieldCache;
class PieceCache;

struct BuildOptions {
  PieceCache* pieces = nullptr;  ///< asked first, told what was made; none: all is made anew
  FieldCache* fields = nullptr;  ///< the same, of the bones felt as distance fields
  /// Called before each bone with its number and the count of bones.
  std::function<void(std::size_t, std::size_t)> progress;
};

/// Builds pieces, bodies and masses and hashes the lot. Fails with the bone's name when a hull
/// cannot be made, when the mesh of one felt as a field is not closed, when names repeat, when
/// a soft part names a bone that there is not, or when there are no bones or more than kMaxBones.
/// The same case comes out whether its pieces and fields were in the caches or not.
Result<Case> build_case(CaseDef def, const BuildOptions& options = {});

/// FMA id of a bone by its name or a usual file name ("1mc", "scaphoid"); 0 when unknown.
int fma_id_of(const std::string& bone_name);
/// Osteon's own name of a bone for a usual file name: "1mc" -> "metacarpal_1"; else the name
/// itself.
std::string canonical_bone_name(const std::string& file_stem);

}  // namespace osteon
