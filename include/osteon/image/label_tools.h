#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/image/label_edit.h"
#include "osteon/image/progress.h"

namespace osteon {

/// Values that count as bone: lo <= HU <= hi.
struct HuRange {
  int lo = 300, hi = 32767;
  bool holds(std::int16_t hu) const { return hu >= lo && hu <= hi; }
  bool operator==(const HuRange&) const = default;
};

struct GrowOptions {
  HuRange range;
  double reach_m = 0;  ///< no farther from the seed than this; 0: as far as it is connected
  bool fill = true;    ///< takes what the grown part encloses too: the marrow
};

/// Grows a bone from a voxel over the voxels of the range connected to it by faces.
/// Takes nothing from another bone and does not pass through one. One step of history; returns how
/// many voxels the bone gained. Fails where the seed lies outside the scan, outside the range or in
/// another bone, and when told to stop; then, as in the tools below, nothing has changed.
Result<std::size_t> grow_label(LabelEdit& edit, std::uint16_t label, const std::array<int, 3>& seed,
                               const GrowOptions& options, const Progress& progress = {});

/// The same for a bone that is made for it, within the same step; seeds in any bone are refused.
Result<std::size_t> grow_new_label(LabelEdit& edit, const std::array<int, 3>& seed,
                                   const GrowOptions& options, const Progress& progress = {});

struct LabelBrush {
  double radius_m = 0.003;
  int slice_axis = -1;              ///< a disc in the slice across this voxel axis; -1: a ball
  bool erase = false;               ///< takes the bone's voxels away instead
  bool over_others = false;         ///< takes voxels of other bones too
  std::optional<HuRange> within{};  ///< touches voxels of this range alone
};

/// One dab of a brush that is drawn from one place to the next, in voxel coordinates (whole numbers
/// are voxel centres): all voxels whose centre lies within the radius of the straight way, and the
/// voxel at its end. Belongs to the step under way, which the caller begins and commits, so that a
/// whole stroke is undone at once. Beyond the scan nothing is drawn. Returns how many voxels
/// changed.
std::size_t dab_label(LabelEdit& edit, std::uint16_t label, const Vec3& from_voxel,
                      const Vec3& to_voxel, const LabelBrush& brush);

/// Parts a bone at its necks (watershed of the map of distances to its outside, split_at_necks):
/// first at necks as the import takes them, then at ever wider ones until it comes apart. The
/// largest part keeps the label. One step of history; returns the labels of the other parts. Fails
/// when there is no neck.
Result<std::vector<std::uint16_t>> split_label(LabelEdit& edit, std::uint16_t label,
                                               const Progress& progress = {});

/// Parts a bone between two of its voxels: the border runs through the neck between them; where
/// there is none, half-way. The part of `keep` keeps the label. One step of history; returns the
/// other part's label. Fails unless both voxels lie in one bone and are two.
Result<std::uint16_t> split_label_between(LabelEdit& edit, const std::array<int, 3>& keep,
                                          const std::array<int, 3>& part,
                                          const Progress& progress = {});

struct BodyOptions {
  HuRange range;
  double smallest_m3 = 1e-7;  ///< smaller ones are left out
  bool fill = true;           ///< with what they enclose
  std::size_t most = 64;      ///< the largest ones
};

/// Makes a bone of each part of the range connected by faces and belongs to no bone yet,
/// the largest first, without those outside the body (parts_outside_body). One step of history;
/// returns the new labels. Fails when there is none.
Result<std::vector<std::uint16_t>> label_bodies(LabelEdit& edit, const BodyOptions& options,
                                                const Progress& progress = {});

}  // namespace osteon
