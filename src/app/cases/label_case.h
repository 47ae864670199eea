#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "osteon/anatomy/label_bones.h"
#include "osteon/image/progress.h"
#include "osteon/image/volume.h"
#include "osteon/scene/build_case.h"

namespace osteon {

struct ScanBones {
  LabelledBones labelled;
  std::size_t outside = 0;  ///< parts that were left out because they lie outside the body
};

/// Finds, parts and names the bones of a scan with no hand work: what is above the threshold, named
/// after the built-in wrist where the scan shows one. `outside`: keeps what lies outside the body.
Result<ScanBones> find_scan_bones(const Volume& volume, double threshold_hu, bool outside,
                                  const Progress& progress = {});

/// Where Patient lies in World: as the built-in wrist does where it was recognised, else on the
/// back, z up, x to the left, the scan's middle at the origin.
Pose lying_pose_WP(const GridFrame& frame);
Pose scan_pose_WP(const LabelledBones& labelled, const GridFrame& frame);

struct ImportedCtBone {
  std::string name;
  double volume_m3 = 0;
  std::size_t triangles = 0;
  bool closed = false;
};

struct LabelCaseOptions {
  double threshold_hu = 300, soft_hu = 50;  ///< of find_bone_levels
  std::size_t most_bones = 32;              ///< the largest ones are kept
  Progress progress;
};

struct LabelCase {
  std::vector<BoneDef> bones;
  std::vector<ImportedCtBone> figures;  ///< parallel to bones
  std::size_t left_out = 0;             ///< small bones beyond most_bones
};

/// Draws the surface of each labelled bone and makes a case's bones of them, whoever labelled them:
/// the import or a person. Fails when a surface cannot be drawn and when told to stop.
Result<LabelCase> bones_of_labels(const Volume& volume, const LabelVolume& labels,
                                  const std::vector<LabelledBone>& bones, const Pose& X_WP,
                                  const LabelCaseOptions& options = {});

/// Progress of a part of the work, as its share of the whole.
Progress part_of(const Progress& whole, double from, double to);

}  // namespace osteon
