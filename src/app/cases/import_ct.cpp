#include "cases/import_ct.h"

#include <algorithm>
#include <new>
#include <utility>

#include "cases/whole_folder.h"
#include "osteon/image/active_contour.h"
#include "osteon/image/gaussian.h"
#include "osteon/image/load_volume.h"
#include "osteon/image/segment.h"
#include "osteon/image/threshold.h"
#include "osteon/scene/case_io.h"

namespace osteon {
namespace {

Result<Volume> load(const ImportCtOptions& options) {
  LoadVolumeOptions load;
  load.series = options.series;
  load.spacing_m = options.spacing_m;
  load.progress = part_of(options.progress, 0, 0.3);
  if (options.announce)
    load.announce = [&](const VolumeHead& head) {
      return options.announce(head.frame,
                              std::max(head.reading_bytes, segmentation_bytes(head.frame)));
    };
  auto volume = load_volume(options.source, load);
  if (volume && options.smooth_m > 0) blur_gaussian(*volume, options.smooth_m);
  return volume;
}

/// Moves the bones' outlines onto the edges of the picture, where that was asked for.
Result<void> draw_contours(const Volume& volume, const ImportCtOptions& options,
                           LabelledBones& labelled, ImportCtResult& result) {
  if (options.contour_steps == 0) return {};
  ContourOptions contour;
  contour.steps = options.contour_steps;
  contour.edge_hu = 0.2 * (result.threshold_hu - result.soft_hu);
  const auto change =
      refine_contours(volume, labelled.labels, contour, part_of(options.progress, 0.65, 0.7));
  if (!change) return tl::unexpected(change.error());
  result.gained = change->gained;
  result.lost = change->lost;
  const std::vector<Region> regions = measure_regions(labelled.labels);
  for (LabelledBone& bone : labelled.bones)
    for (const Region& region : regions)
      if (region.label == bone.label) {
        bone.voxels = region.voxels;
        bone.box = region.box;
      }
  return {};
}

Result<void> make_surfaces(const Volume& volume, const LabelledBones& labelled,
                           const ImportCtOptions& options, ImportCtResult& result) {
  LabelCaseOptions surfaces;
  surfaces.threshold_hu = result.threshold_hu;
  surfaces.soft_hu = result.soft_hu;
  surfaces.most_bones = options.most_bones;
  surfaces.progress = part_of(options.progress, 0.7, 0.98);
  auto made = bones_of_labels(volume, labelled.labels, labelled.bones, result.X_WP, surfaces);
  if (!made) return tl::unexpected(made.error());
  result.def.bones = std::move(made->bones);
  result.bones = std::move(made->figures);
  result.left_out = made->left_out;
  return {};
}

Result<ImportCtResult> convert(const ImportCtOptions& options) {
  auto volume = load(options);
  if (!volume) return tl::unexpected(volume.error());
  const BoneLevels levels = find_bone_levels(*volume);
  ImportCtResult result;
  result.frame = volume->frame;
  result.soft_hu = levels.soft_hu;
  result.threshold_hu = options.threshold_hu.value_or(levels.threshold_hu);
  auto found = find_scan_bones(*volume, result.threshold_hu, options.outside,
                               part_of(options.progress, 0.3, 0.65));
  if (!found) return tl::unexpected(found.error());
  LabelledBones* const labelled = &found->labelled;
  result.outside = found->outside;
  result.recognised = labelled->recognised;
  result.fit_residual_m = labelled->fit.residual_m;
  result.parted = labelled->parted;
  result.joined = labelled->joined;
  if (auto drawn = draw_contours(*volume, options, *labelled, result); !drawn)
    return tl::unexpected(drawn.error());
  result.X_WP = scan_pose_WP(*labelled, volume->frame);
  if (auto made = make_surfaces(*volume, *labelled, options, result); !made)
    return tl::unexpected(made.error());
  result.def.side = options.side;
  if (result.def.side.empty() && labelled->recognised)
    result.def.side = labelled->fit.mirrored ? "left" : "right";
  return result;
}

}  // namespace

Result<ImportCtResult> read_ct(const ImportCtOptions& options) {
  try {
    auto result = convert(options);
    if (result)
      result->def.name =
          options.name.empty() ? plain_folder(options.out).filename().string() : options.name;
    return result;
  } catch (const std::bad_alloc&) {
    return fail("there is not enough memory for this scan", options.source.string(),
                "Close other programs, or crop the scan to the joint");
  }
}

Result<ImportCtResult> import_ct(const ImportCtOptions& options) {
  const auto out = plain_folder(options.out);
  if (auto free = refuse_existing(out); !free) return tl::unexpected(free.error());
  auto result = read_ct(options);
  if (!result) return result;
  if (!goes_on(options.progress, "Writing the case", 0.99)) return stopped();
  const auto saved = write_whole_folder(
      out, [&](const std::filesystem::path& part) { return save_case(result->def, part); });
  if (!saved) return tl::unexpected(saved.error());
  return result;
}

}  // namespace osteon
