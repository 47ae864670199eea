#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/label_case.h"
#include "osteon/image/progress.h"
#include "osteon/image/volume.h"
#include "osteon/scene/build_case.h"

namespace osteon {

struct ImportCtOptions {
  std::filesystem::path source;
  std::filesystem::path out;
  std::string name, side, series;
  std::optional<double> threshold_hu;  ///< none: suggested from the scan
  std::optional<Vec3> spacing_m;       ///< of a stack of pictures
  double smooth_m = 0;                 ///< blur before segmentation, for noisy scans
  int contour_steps = 0;        ///< of the active contours; 0: outlines as the threshold has them
  std::size_t most_bones = 32;  ///< the largest ones are kept
  bool outside = false;         ///< keeps what lies outside the body, such as a head rest
  Progress progress;
  /// Told size and memory before the voxels are read; false stops.
  std::function<bool(const GridFrame& frame, double bytes)> announce;
};

struct ImportCtResult {
  CaseDef def;
  Pose X_WP;                          ///< Patient of the scan in World of the case
  std::vector<ImportedCtBone> bones;  ///< parallel to def.bones
  GridFrame frame;
  double threshold_hu = 0, soft_hu = 0;
  bool recognised = false;           ///< the bones are those of the built-in wrist
  double fit_residual_m = 0;         ///< of the built-in wrist; meaningful where recognised
  std::size_t gained = 0, lost = 0;  ///< voxels, by the active contours
  int parted = 0, joined = 0;        ///< regions that held several bones; that were pieces of one
  std::size_t left_out = 0;          ///< small bones beyond most_bones
  std::size_t outside = 0;           ///< parts outside the body that were left out
};

/// Reads a scan and turns it into a case, without writing it. World is that of the built-in wrist
/// where it is recognised, else the patient on the back, z up, x to the left, the scan's middle at
/// the origin. Nothing of the scan but its numbers gets into the case.
Result<ImportCtResult> read_ct(const ImportCtOptions& options);

/// The same, and writes the case: whole or not at all.
Result<ImportCtResult> import_ct(const ImportCtOptions& options);

}  // namespace osteon
