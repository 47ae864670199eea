#include "cases/label_case.h"

#include <algorithm>
#include <utility>

#include "osteon/base/file.h"
#include "osteon/image/segment.h"
#include "osteon/image/tissue.h"
#include "osteon/mesh/bone_surface.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

Result<GeneratedAnatomy> wrist_model() {
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  GenerateOptions coarse;
  coarse.cell_m = 0.0012;
  coarse.soft_parts = false;
  return generate_anatomy(*data / "assets/anatomy/wrist.toml", coarse);
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

}  // namespace

Progress part_of(const Progress& whole, double from, double to) {
  if (!whole) return {};
  return [whole, from, to](const char* what, double share) {
    return whole(what, from + (to - from) * share);
  };
}

Result<ScanBones> find_scan_bones(const Volume& volume, double threshold_hu, bool outside,
                                  const Progress& progress) {
  SegmentOptions segment;
  segment.outside = outside;
  segment.threshold_hu = threshold_hu;
  segment.progress = part_of(progress, 0, 0.85);
  auto segmentation = segment_bone(volume, segment);
  if (!segmentation) return tl::unexpected(segmentation.error());
  const auto model = wrist_model();
  if (!model) return tl::unexpected(model.error());
  if (!goes_on(progress, "Naming bones", 0.85)) return stopped();
  ScanBones out;
  out.outside = segmentation->outside;
  out.labelled = label_bones(volume, std::move(*segmentation), *model);
  return out;
}

// z_W up is to the front, x_W to the left hand.
Pose lying_pose_WP(const GridFrame& frame) {
  Mat3 R_WP;
  R_WP << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const Vec3 middle =
      frame.point_P(0.5 * Vec3(frame.size[0] - 1, frame.size[1] - 1, frame.size[2] - 1));
  const Quat q(R_WP);
  return {-(q * middle), q};
}

Pose scan_pose_WP(const LabelledBones& labelled, const GridFrame& frame) {
  return labelled.recognised ? labelled.fit.X_PM.inverse() : lying_pose_WP(frame);
}

Result<LabelCase> bones_of_labels(const Volume& volume, const LabelVolume& labels,
                                  const std::vector<LabelledBone>& all, const Pose& X_WP,
                                  const LabelCaseOptions& options) {
  const auto tissues = load_default_tissues();
  if (!tissues) return tl::unexpected(tissues.error());
  const Tissue* cortical = tissues->find("cortical_bone");
  if (!cortical) return fail("has no tissue 'cortical_bone'", "the tissue table");
  const auto bones = largest(all, options.most_bones);
  LabelCase out;
  out.left_out = all.size() - bones.size();
  BoneSurfaceOptions surface;
  surface.threshold_hu = options.threshold_hu;
  surface.soft_hu = options.soft_hu;
  for (std::size_t n = 0; n < bones.size(); ++n) {
    const double share = static_cast<double>(n) / static_cast<double>(bones.size());
    if (!goes_on(options.progress, "Drawing surfaces", share)) return stopped();
    auto mesh = bone_surface(volume, labels, bones[n].label, bones[n].box, surface);
    if (!mesh) return tl::unexpected(mesh.error());
    out.figures.push_back(
        {bones[n].name, osteon::volume(*mesh), mesh->triangles.size(), topology(*mesh).closed()});
    out.bones.push_back(make_bone(bones[n].name, std::move(*mesh), X_WP, *cortical));
  }
  return out;
}

}  // namespace osteon
