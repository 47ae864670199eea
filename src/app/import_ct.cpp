#include "import_ct.h"

#include <algorithm>
#include <new>
#include <utility>

#include "osteon/anatomy/generate.h"
#include "osteon/anatomy/label_bones.h"
#include "osteon/base/file.h"
#include "osteon/image/active_contour.h"
#include "osteon/image/gaussian.h"
#include "osteon/image/load_volume.h"
#include "osteon/image/segment.h"
#include "osteon/image/threshold.h"
#include "osteon/image/tissue.h"
#include "osteon/mesh/bone_surface.h"
#include "osteon/mesh/measure.h"
#include "osteon/scene/case_io.h"
#include "whole_folder.h"

namespace osteon {
namespace {

/// Progress of a part of the work, as its share of the whole.
Progress part_of(const Progress& whole, double from, double to) {
  if (!whole) return {};
  return [whole, from, to](const char* what, double share) {
    return whole(what, from + (to - from) * share);
  };
}

Result<Volume> load(const ImportCtOptions& options) {
  LoadVolumeOptions load;
  load.series = options.series;
  load.spacing_m = options.spacing_m;
  load.progress = part_of(options.progress, 0, 0.3);
  if (options.announce)
    load.announce = [&](const GridFrame& frame) {
      return options.announce(frame, segmentation_bytes(frame));
    };
  auto volume = load_volume(options.source, load);
  if (volume && options.smooth_m > 0) blur_gaussian(*volume, options.smooth_m);
  return volume;
}

Result<GeneratedAnatomy> wrist_model() {
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  GenerateOptions coarse;
  coarse.cell_m = 0.0012;
  coarse.soft_parts = false;
  return generate_anatomy(*data / "assets/anatomy/wrist.toml", coarse);
}

/// Patient on the back: z_W up is to the front, x_W to the left hand.
Pose lying_pose_WP(const GridFrame& frame) {
  Mat3 R_WP;
  R_WP << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const Vec3 middle =
      frame.point_P(0.5 * Vec3(frame.size[0] - 1, frame.size[1] - 1, frame.size[2] - 1));
  const Quat q(R_WP);
  return {-(q * middle), q};
}

BoneDef make_bone(const std::string& name, TriMesh mesh_P, const Pose& X_WP, const Tissue& bone) {
  BoneDef def;
  def.name = name;
  def.fma_id = fma_id_of(name);
  for (Vec3& v : mesh_P.vertices) v = X_WP * v;
  def.X_WB.p = centroid(mesh_P);
  for (Vec3& v : mesh_P.vertices) v -= def.X_WB.p;
  def.mesh = std::move(mesh_P);
  def.density_kg_per_m3 = bone.density_kg_per_m3.value;
  def.material = {bone.stiffness_n_per_m.value, bone.static_friction.value,
                  bone.dynamic_friction.value};
  return def;
}

/// The largest bones, in the order of their labels.
std::vector<LabelledBone> largest(std::vector<LabelledBone> bones, std::size_t most) {
  std::stable_sort(bones.begin(), bones.end(),
                   [](const auto& a, const auto& b) { return a.voxels > b.voxels; });
  if (bones.size() > most) bones.resize(most);
  std::stable_sort(bones.begin(), bones.end(),
                   [](const auto& a, const auto& b) { return a.label < b.label; });
  return bones;
}

Result<void> make_surfaces(const Volume& volume, const LabelledBones& labelled, const Pose& X_WP,
                           const ImportCtOptions& options, ImportCtResult& result) {
  const auto tissues = load_default_tissues();
  if (!tissues) return tl::unexpected(tissues.error());
  const Tissue* cortical = tissues->find("cortical_bone");
  if (!cortical) return fail("has no tissue 'cortical_bone'", "the tissue table");
  const auto bones = largest(labelled.bones, options.most_bones);
  result.left_out = labelled.bones.size() - bones.size();
  BoneSurfaceOptions surface;
  surface.threshold_hu = result.threshold_hu;
  surface.soft_hu = result.soft_hu;
  for (std::size_t n = 0; n < bones.size(); ++n) {
    const double share = static_cast<double>(n) / static_cast<double>(bones.size());
    if (!goes_on(options.progress, "Drawing surfaces", 0.7 + 0.28 * share)) return stopped();
    auto mesh = bone_surface(volume, labelled.labels, bones[n].label, bones[n].box, surface);
    if (!mesh) return tl::unexpected(mesh.error());
    result.bones.push_back(
        {bones[n].name, osteon::volume(*mesh), mesh->triangles.size(), topology(*mesh).closed()});
    result.def.bones.push_back(make_bone(bones[n].name, std::move(*mesh), X_WP, *cortical));
  }
  return {};
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

Result<ImportCtResult> convert(const ImportCtOptions& options) {
  auto volume = load(options);
  if (!volume) return tl::unexpected(volume.error());
  const BoneLevels levels = find_bone_levels(*volume);
  ImportCtResult result;
  result.frame = volume->frame;
  result.soft_hu = levels.soft_hu;
  result.threshold_hu = options.threshold_hu.value_or(levels.threshold_hu);
  SegmentOptions segment;
  segment.threshold_hu = result.threshold_hu;
  segment.progress = part_of(options.progress, 0.3, 0.6);
  auto segmentation = segment_bone(*volume, segment);
  if (!segmentation) return tl::unexpected(segmentation.error());
  const auto model = wrist_model();
  if (!model) return tl::unexpected(model.error());
  if (!goes_on(options.progress, "Naming bones", 0.6)) return stopped();
  LabelledBones labelled = label_bones(*volume, std::move(*segmentation), *model);
  result.recognised = labelled.recognised;
  result.fit_residual_m = labelled.fit.residual_m;
  result.parted = labelled.parted;
  result.joined = labelled.joined;
  if (auto drawn = draw_contours(*volume, options, labelled, result); !drawn)
    return tl::unexpected(drawn.error());
  const Pose X_WP =
      labelled.recognised ? labelled.fit.X_PM.inverse() : lying_pose_WP(volume->frame);
  result.X_WP = X_WP;
  if (auto made = make_surfaces(*volume, labelled, X_WP, options, result); !made)
    return tl::unexpected(made.error());
  result.def.side = options.side;
  if (result.def.side.empty() && labelled.recognised)
    result.def.side = labelled.fit.mirrored ? "left" : "right";
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
