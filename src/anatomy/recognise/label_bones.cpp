#include "osteon/anatomy/label_bones.h"

#include <algorithm>
#include <map>
#include <set>

#include "osteon/image/components.h"
#include "osteon/image/fill.h"
#include "osteon/image/watershed.h"
#include "osteon/mesh/distance.h"
#include "recognise/point_cloud.h"

namespace osteon {
namespace {

constexpr std::size_t kPointsARegion = 400, kMostRegions = 60;
constexpr double kSeedDepth_m = 0.0008;
constexpr double kLooseSeedDepth_m = 0.0;

std::vector<ModelBone> model_points(const GeneratedAnatomy& model) {
  std::vector<ModelBone> out;
  for (const GeneratedBone& bone : model.bones) {
    ModelBone points{bone.name, thinned(bone.mesh.vertices, kPointsARegion)};
    for (Vec3& p : points.points_M) p = bone.X_WB * p;
    out.push_back(std::move(points));
  }
  return out;
}

Mask mask_of(const LabelVolume& labels, std::uint16_t label) {
  Mask mask{labels.frame, {}};
  for (const std::uint16_t l : labels.values) mask.values.push_back(l == label ? 1 : 0);
  return mask;
}

/// Takes the label off all but its largest part.
void drop_islands(std::uint16_t label, LabelVolume& labels) {
  LabelVolume parts;
  label_components(mask_of(labels, label), 1, parts);
  for (std::size_t n = 0; n < labels.values.size(); ++n)
    if (labels.values[n] == label && parts.values[n] != 1) labels.values[n] = 0;
}

/// Gives the label what it encloses within the region.
void fill(std::uint16_t label, const Mask& region, LabelVolume& labels) {
  Mask mask = mask_of(labels, label);
  fill_holes(mask);
  for (std::size_t n = 0; n < labels.values.size(); ++n)
    if (mask.values[n] && region.values[n]) labels.values[n] = label;
}

/// Parts regions by the model bones that they hold.
class Parting {
 public:
  Parting(const Volume& volume, const GeneratedAnatomy& model, const BoneNames& names)
      : volume_(volume), names_(names) {
    for (const GeneratedBone& bone : model.bones) {
      TriMesh mesh_M = bone.mesh;
      for (Vec3& v : mesh_M.vertices) v = bone.X_WB * v;
      bones_.emplace_back(std::move(mesh_M));
    }
  }

  /// Voxels of the region get the labels bone + 1 of the bones that it holds.
  void part(const LabelVolume& regions, const Region& region, const std::vector<int>& held,
            LabelVolume& out) const {
    Mask mask;
    mask.frame = cropped(regions.frame, region.box);
    LabelVolume seeds{mask.frame, {}};
    for (int k = region.box.lo[2]; k < region.box.hi[2]; ++k)
      for (int j = region.box.lo[1]; j < region.box.hi[1]; ++j)
        for (int i = region.box.lo[0]; i < region.box.hi[0]; ++i) {
          const bool inside = regions.at(i, j, k) == region.label;
          mask.values.push_back(inside ? 1 : 0);
          seeds.values.push_back(inside ? seed_at(regions.frame.point_P(Vec3(i, j, k)), held)
                                        : std::uint16_t{0});
        }
    const Volume height = crop(volume_, region.box);
    grow_seeds(height, mask, seeds);
    for (const int b : held) drop_islands(static_cast<std::uint16_t>(b + 1), seeds);
    grow_seeds(height, mask, seeds);
    for (const int b : held) fill(static_cast<std::uint16_t>(b + 1), mask, seeds);
    std::size_t n = 0;
    for (int k = region.box.lo[2]; k < region.box.hi[2]; ++k)
      for (int j = region.box.lo[1]; j < region.box.hi[1]; ++j)
        for (int i = region.box.lo[0]; i < region.box.hi[0]; ++i, ++n)
          if (mask.values[n]) out.at(i, j, k) = seeds.values[n];
  }

 private:
  std::uint16_t seed_at(const Vec3& p_P, const std::vector<int>& held) const {
    double deepest = 1e9, second = 1e9;
    int bone = -1;
    for (const int b : held) {
      const auto n = static_cast<std::size_t>(b);
      const ModelFit& fit = names_.fit_of_bone[n];
      const double depth = fit.scale * bones_[n].closest(fit.to_model(p_P)).signed_distance;
      if (depth < deepest) {
        second = deepest;
        deepest = depth;
        bone = b;
      } else {
        second = std::min(second, depth);
      }
    }
    const bool sure = deepest < -kSeedDepth_m ||
                      (deepest < kLooseSeedDepth_m && second - deepest > 4 * kSeedDepth_m);
    return sure ? static_cast<std::uint16_t>(bone + 1) : std::uint16_t{0};
  }

  const Volume& volume_;
  const BoneNames& names_;
  std::vector<MeshDistance> bones_;
};

/// Pairs of labels that share a face of a voxel.
std::set<std::pair<std::uint16_t, std::uint16_t>> touching(const LabelVolume& labels) {
  std::set<std::pair<std::uint16_t, std::uint16_t>> pairs;
  const auto& size = labels.frame.size;
  const std::size_t steps[3] = {1, static_cast<std::size_t>(size[0]), labels.frame.index(0, 0, 1)};
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i) {
        const std::size_t n = labels.frame.index(i, j, k);
        const int at[3] = {i, j, k};
        if (labels.values[n] == 0) continue;
        for (std::size_t a = 0; a < 3; ++a) {
          if (at[a] + 1 >= size[a]) continue;
          const std::uint16_t other = labels.values[n + steps[a]];
          if (other == 0 || other == labels.values[n]) continue;
          pairs.insert(std::minmax(labels.values[n], other));
        }
      }
  return pairs;
}

/// Region that stands for each bone: the largest of its pieces.
std::map<int, std::size_t> main_regions(const BoneNames& names) {
  std::map<int, std::size_t> main;
  for (std::size_t r = 0; r < names.bone_of_region.size(); ++r)
    if (names.bone_of_region[r] >= 0) main.emplace(names.bone_of_region[r], r);
  return main;
}

/// New label of each region; 0 for those that are parted instead.
std::vector<std::uint16_t> relabel(const Segmentation& segmentation, const BoneNames& names,
                                   std::size_t bones, LabelledBones& out) {
  const auto pairs = touching(segmentation.labels);
  const auto main = main_regions(names);
  std::vector<std::uint16_t> label_of(segmentation.regions.size(), 0);
  auto next = static_cast<std::uint16_t>(bones + 1);
  for (std::size_t r = 0; r < label_of.size(); ++r) {
    const int bone = r < names.bone_of_region.size() ? names.bone_of_region[r] : -1;
    if (bone >= 0 && names.bones_in_region[r].size() > 1) {
      ++out.parted;
    } else if (bone >= 0 && main.at(bone) == r) {
      label_of[r] = static_cast<std::uint16_t>(bone + 1);
    } else if (bone >= 0 && pairs.count(std::minmax(segmentation.regions[r].label,
                                                    segmentation.regions[main.at(bone)].label))) {
      label_of[r] = static_cast<std::uint16_t>(bone + 1);
      ++out.joined;
    } else {
      label_of[r] = next++;
    }
  }
  return label_of;
}

void rewrite(const Volume& volume, const Segmentation& segmentation, const BoneNames& names,
             const GeneratedAnatomy& model, LabelledBones& out) {
  const auto label_of = relabel(segmentation, names, model.bones.size(), out);
  out.labels = segmentation.labels;
  for (std::uint16_t& label : out.labels.values)
    if (label != 0) label = label_of[static_cast<std::size_t>(label - 1)];
  if (out.parted == 0) return;
  const Parting parting(volume, model, names);
  for (std::size_t r = 0; r < label_of.size(); ++r)
    if (label_of[r] == 0)
      parting.part(segmentation.labels, segmentation.regions[r], names.bones_in_region[r],
                   out.labels);
}

}  // namespace

LabelledBones label_bones(const Volume& volume, Segmentation segmentation,
                          const GeneratedAnatomy& model) {
  LabelledBones out;
  std::vector<std::vector<Vec3>> regions_P;
  for (const Region& region : segmentation.regions) {
    if (regions_P.size() == kMostRegions) break;
    regions_P.push_back(boundary_points_P(segmentation, region, kPointsARegion));
  }
  const BoneNames names = name_bones(model_points(model), regions_P);
  out.fit = names.fit;
  out.recognised = names.recognised();
  if (out.recognised) {
    rewrite(volume, segmentation, names, model, out);
  } else {
    out.labels = std::move(segmentation.labels);
  }
  const std::size_t known = out.recognised ? model.bones.size() : 0;
  int unnamed = 0;
  for (const Region& region : measure_regions(out.labels)) {
    const std::string name = region.label <= known ? model.bones[region.label - 1u].name
                                                   : "bone_" + std::to_string(++unnamed);
    out.bones.push_back({name, region.label, region.voxels, region.box});
  }
  return out;
}

}  // namespace osteon
