#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/id.h"
#include "osteon/base/types.h"
#include "osteon/collide/convex_body.h"
#include "osteon/collide/distance_field.h"
#include "osteon/hull/hull.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/scene/joint.h"

namespace osteon {

/// How a surface answers a probe.
struct Material {
  double stiffness_n_per_m = 2000;  ///< at the hand; the device's own limit may be lower
  double static_friction = 0.20;    ///< ratio of tangential to normal force at which sliding starts
  double dynamic_friction = 0.12;   ///< ratio while sliding; not above the static one
};

/// What of a bone is felt.
enum class Felt : std::uint8_t {
  kPieces,  ///< convex pieces that follow the mesh (osteon/hull/decompose.h)
  kHull,    ///< one convex hull
  kField,   ///< the mesh itself, as a distance field (osteon/collide/distance_field.h)
  kCovered  ///< the same, of the bone with the case's cartilage on it
};
/// Whether a distance field is felt.
inline bool is_field(Felt felt) { return felt == Felt::kField || felt == Felt::kCovered; }
/// "pieces", "hull", "field", "covered".
std::string_view to_text(Felt felt);
std::optional<Felt> felt_from_text(std::string_view text);

/// One bone of a case. Immutable once the case is made.
struct Bone {
  std::string name;  ///< "scaphoid"
  int fma_id = 0;    ///< Foundational Model of Anatomy; 0 when unknown
  Pose X_WB;         ///< rest pose of the bone in World
  TriMesh mesh;      ///< in Bone
  Felt felt = Felt::kPieces;
  /// In Bone; their union is what is felt, but for a bone felt as a field: there they are what
  /// physics and pictures know of it.
  std::vector<Hull> pieces;
  std::vector<ConvexBody> bodies;              ///< one a piece, for contact queries
  std::shared_ptr<const DistanceField> field;  ///< in Bone; of a bone felt as a field alone
  /// In Bone; of a bone felt with its cartilage; null where the case has none on it.
  std::shared_ptr<const CoveredSurface> covered;
  std::shared_ptr<const DistanceField> wide;  ///< of such a bone: for thick parts (wide_field.h)
  double mass_kg = 0.005;
  Material material;
  /// A thing that lies beside the patient: no view is framed by it, and nothing carves it.
  bool beside = false;
};

/// A place where a soft part holds on to a bone.
struct Attachment {
  std::string name;
  BoneId bone;
  Vec3 p_W = Vec3::Zero();
};

/// Cartilage, a ligament, a tendon, a disc, a meniscus, fat or the skin. It is seen;
/// nothing of it is felt yet. Immutable once the case is made.
struct SoftPart {
  std::string name;        ///< "scaphoid_fossa"
  int fma_id = 0;          ///< Foundational Model of Anatomy; 0 when unknown
  std::string tissue;      ///< name in the tissue table (assets/materials/tissue.toml)
  std::string kind;        ///< one of soft_kinds()
  TriMesh mesh_W;          ///< in World, with every bone in its rest pose
  double thickness_m = 0;  ///< 0: it has none that one could name
  std::array<float, 3> color_srgb{0.86f, 0.82f,
                                  0.74f};  ///< 0..1, of the tissue; for pictures alone
  /// Bones that it moves with: their mean motion away from rest; none: it stays.
  std::vector<BoneId> bones;
  std::vector<Attachment> attachments;
};

/// "cartilage", "ligament", "tendon", "disc", "meniscus", "fat", "skin".
std::span<const std::string_view> soft_kinds();

/// A named point of the case, in World.
struct Landmark {
  std::string name;
  Vec3 p_W = Vec3::Zero();
  Vec3 inwards_W = Vec3::Zero();  ///< unit, into the body, of one on the skin; zero: not known
  std::string bone = {};          ///< name of the one that it goes with; empty: it stays
};

/// What is wrong with the patient, in words: for who teaches with the case. The parts of the case
/// show it; nothing reads it.
struct CaseFinding {
  std::string name;   ///< "geissler"
  std::string grade;  ///< "3"
  std::string meaning;
};

/// The immutable half of a simulation: what is there. World: patient lying, z up, metres.
struct Case {
  std::string name;
  std::string side;  ///< "left", "right" or empty
  std::vector<Bone> bones;
  std::vector<SoftPart> softs;
  std::vector<Landmark> landmarks;
  std::vector<CaseFinding> findings;
  std::vector<CaseJoint> joints;
  std::uint64_t hash = 0;  ///< over everything that is felt
  BoneId find(std::string_view bone_name) const;
  const Bone& bone(BoneId id) const { return bones[id.index]; }
  /// Of the patient's bones: the skin may reach farther, and what lies beside the patient.
  Aabb bounds_W() const;
};

/// The most bones that a case may have: snapshots have fixed size.
inline constexpr std::size_t kMaxBones = 64;
/// The most soft parts of a case.
inline constexpr std::size_t kMaxSofts = 256;

}  // namespace osteon
