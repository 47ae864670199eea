#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "osteon/base/pose_track.h"
#include "osteon/base/result.h"
#include "osteon/base/types.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// A bone grown from its parametric description.
struct GeneratedBone {
  std::string name;
  int fma_id = 0;
  Pose X_WB;     ///< bone in World
  TriMesh mesh;  ///< in Bone, metres; closed, manifold, outward
  double density_kg_per_m3 = 1900;
};

/// A place where a soft part holds on to a bone.
struct GeneratedAttachment {
  std::string name;
  std::string bone;
  Vec3 p_W = Vec3::Zero();  ///< on the bone's surface
};

/// A soft part grown over the finished bones.
struct GeneratedSoft {
  std::string name;
  int fma_id = 0;
  std::string tissue;      ///< name in the tissue table
  std::string kind;        ///< "cartilage", "ligament", "tendon", "disc", "meniscus", "fat", "skin"
  TriMesh mesh_W;          ///< in World at rest, metres; closed, manifold, outward
  double thickness_m = 0;  ///< the greatest, of cartilage and bands; 0: it has none
  /// Bones that it moves with: cartilage with its own, a band with those of its ends; none: skin.
  std::vector<std::string> bones;
  std::vector<GeneratedAttachment> attachments;
};

struct GeneratedLandmark {
  std::string name;
  Vec3 p_W = Vec3::Zero();
  Vec3 inwards_W = Vec3::Zero();  ///< unit, into the body, of one on the skin; else zero
  std::string bone = {};          ///< that it goes with; empty: none
};

/// How a joint moves bones against one that stays.
struct GeneratedJoint {
  struct Moved {
    std::string bone;
    PoseTrack X_FB;  ///< pose in the fixed bone, by degrees of bend
  };
  std::string name;   ///< "knee"
  std::string fixed;  ///< the bone that stays
  double at_deg = 0;  ///< how far it is bent
  std::vector<Moved> bones;
};

/// What is wrong with an anatomy, in words.
struct GeneratedFinding {
  std::string name;   ///< "geissler"
  std::string grade;  ///< "3"
  std::string meaning;
};

struct GeneratedAnatomy {
  std::string name;
  std::string side;
  std::vector<GeneratedBone> bones;
  std::vector<GeneratedSoft> softs;
  std::vector<GeneratedLandmark> landmarks;
  std::vector<GeneratedFinding> findings;
  std::vector<GeneratedJoint> joints;
};

/// Runs task(0) to task(count - 1), in any order and on several threads if it likes, and returns
/// when all are done; tells `progress` the share done on the calling thread.
using RunTasks = std::function<void(std::size_t count, const std::function<void(std::size_t)>& task,
                                    const std::function<void(double)>& progress)>;

struct GenerateOptions {
  /// Of the grid on which the surfaces of bones are found; none: what the description says for
  /// each.
  std::optional<double> cell_m = {};
  /// Told the share of the bones done, from 0, before any, to 1; may throw to stop.
  std::function<void(double)> progress = {};
  RunTasks run = {};       ///< none: one after the other. The bytes are the same either way.
  bool soft_parts = true;  ///< false: bones alone; landmarks on soft parts stay where they were,
                           ///< but for those on the skin, which lie where they do with it
};

/// Grows every bone and soft part of a description (assets/anatomy/*.toml; docs/file-formats.md).
/// The same description and options give the same bytes on every compiler. Errors name the file,
/// the bone and the key.
Result<GeneratedAnatomy> generate_anatomy(const std::filesystem::path& description,
                                          const GenerateOptions& options = {});

}  // namespace osteon
