#include "osteon/image/segment.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "osteon/image/components.h"
#include "osteon/image/distance_map.h"
#include "osteon/image/fill.h"
#include "osteon/image/outside_body.h"

namespace osteon {
namespace {

Mask above(const Volume& volume, double threshold_hu) {
  Mask mask{volume.frame, std::vector<std::uint8_t>(volume.values.size())};
  const auto level =
      static_cast<std::int16_t>(std::clamp(std::ceil(threshold_hu), -32768., 32767.));
  for (std::size_t n = 0; n < mask.values.size(); ++n)
    mask.values[n] = volume.values[n] >= level ? 1 : 0;
  return mask;
}

Mask mask_of(const LabelVolume& labels, std::uint16_t label, const VoxelBox& box) {
  Mask mask;
  mask.frame = cropped(labels.frame, box);
  mask.values.reserve(mask.frame.count());
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j)
      for (int i = box.lo[0]; i < box.hi[0]; ++i)
        mask.values.push_back(labels.at(i, j, k) == label ? 1 : 0);
  return mask;
}

/// Writes a component's parts over it and over the marrow that it encloses.
void place(const LabelVolume& parts, const VoxelBox& box, std::uint16_t component,
           std::uint16_t first_label, LabelVolume& labels) {
  std::size_t n = 0;
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j)
      for (int i = box.lo[0]; i < box.hi[0]; ++i, ++n) {
        std::uint16_t& label = labels.at(i, j, k);
        if (!parts.values[n] || (label != 0 && label != component)) continue;
        label = static_cast<std::uint16_t>(first_label + parts.values[n] - 1);
      }
}

/// Fills and parts one component; returns how many parts it has.
int part_component(const Component& component, const SegmentOptions& options, int next,
                   LabelVolume& labels) {
  const VoxelBox box = grown(component.box, 1, labels.frame);
  Mask mask = mask_of(labels, component.label, box);
  fill_holes(mask);
  LabelVolume parts;
  int count = 1;
  if (options.split) {
    count = split_at_necks(distance_map(mask), options.necks, parts);
  } else {
    parts.frame = mask.frame;
    parts.values.assign(mask.values.begin(), mask.values.end());
  }
  if (next + count > 65535) return 0;
  place(parts, box, component.label, static_cast<std::uint16_t>(next), labels);
  return count;
}

std::size_t smallest_voxels(const GridFrame& frame, double smallest_m3) {
  return static_cast<std::size_t>(std::max(1.0, std::ceil(smallest_m3 / frame.voxel_volume_m3())));
}

/// Takes parts outside the body from the labels and from the list; returns how many of them are as
/// large as a bone.
std::size_t drop_outside(const Volume& volume, std::size_t smallest,
                         std::vector<Component>& components, LabelVolume& labels) {
  const std::vector<bool> outside = parts_outside_body(volume, labels, components);
  std::vector<bool> drop(components.size() + 1, false);
  std::size_t large = 0;
  for (std::size_t n = 0; n < components.size(); ++n) {
    if (!outside[n]) continue;
    drop[components[n].label] = true;
    large += components[n].voxels >= smallest ? 1 : 0;
  }
  for (std::uint16_t& label : labels.values)
    if (label < drop.size() && drop[label]) label = 0;
  std::erase_if(components, [&](const Component& c) { return drop[c.label]; });
  return large;
}

std::vector<Region> measure(const LabelVolume& labels) {
  std::vector<Region> regions(65536);
  const auto& size = labels.frame.size;
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i) {
        const std::uint16_t label = labels.at(i, j, k);
        if (label == 0) continue;
        Region& region = regions[label];
        const std::array<int, 3> at = {i, j, k};
        if (region.voxels++ == 0) region.box = {at, {i + 1, j + 1, k + 1}};
        for (std::size_t a = 0; a < 3; ++a) {
          region.box.lo[a] = std::min(region.box.lo[a], at[a]);
          region.box.hi[a] = std::max(region.box.hi[a], at[a] + 1);
        }
      }
  return regions;
}

bool on_boundary(const LabelVolume& labels, int i, int j, int k) {
  const std::uint16_t label = labels.at(i, j, k);
  const int d[6][3] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
  for (const auto& s : d)
    if (labels.frame.contains(i + s[0], j + s[1], k + s[2]) &&
        labels.at(i + s[0], j + s[1], k + s[2]) != label)
      return true;
  return false;
}

}  // namespace

double segmentation_bytes(const GridFrame& frame) {
  // Volume 2, labels 2, mask 1; one body as large as the grid adds its mask 1, distances 4, basins
  // 4 and parts 2; a fifth of the voxels are bone, with 4 each for their order and as much to sort
  // it.
  return static_cast<double>(frame.count()) * (2 + 2 + 1 + 4 + 4 + 2 + 1.6) + 150e6;
}

void renumber(Segmentation& segmentation, double smallest_m3) {
  LabelVolume& labels = segmentation.labels;
  std::vector<Region> regions = measure(labels);
  std::vector<std::uint16_t> order(regions.size());
  std::iota(order.begin(), order.end(), std::uint16_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::uint16_t a, std::uint16_t b) {
    return regions[a].voxels > regions[b].voxels;
  });
  const std::size_t smallest = smallest_voxels(labels.frame, smallest_m3);
  std::vector<std::uint16_t> new_label(regions.size(), 0);
  segmentation.regions.clear();
  for (const std::uint16_t old : order) {
    if (regions[old].voxels < smallest) break;
    new_label[old] = static_cast<std::uint16_t>(segmentation.regions.size() + 1);
    segmentation.regions.push_back({new_label[old], regions[old].voxels, regions[old].box});
  }
  for (std::uint16_t& label : labels.values) label = new_label[label];
}

Result<Segmentation> segment_bone(const Volume& volume, const SegmentOptions& options) {
  Segmentation out;
  if (!goes_on(options.progress, "Finding bone", 0)) return stopped();
  const std::size_t smallest = smallest_voxels(volume.frame, options.smallest_m3);
  std::vector<Component> components;
  {
    const Mask mask = above(volume, options.threshold_hu);
    components = label_components(mask, std::max<std::size_t>(1, smallest / 4), out.labels);
  }
  if (components.size() > 2000) components.resize(2000);
  int next = static_cast<int>(components.size()) + 1;
  if (!options.outside) out.outside = drop_outside(volume, smallest, components, out.labels);
  std::size_t done = 0;
  for (const Component& component : components) {
    const double share = static_cast<double>(done++) / static_cast<double>(components.size());
    if (!goes_on(options.progress, "Separating bones", share)) return stopped();
    next += part_component(component, options, next, out.labels);
  }
  renumber(out, options.smallest_m3);
  if (out.regions.empty())
    return fail(
        "no bone is found above " + std::to_string(std::lround(options.threshold_hu)) + " HU",
        "scan", "Choose a lower --threshold, or another series");
  return out;
}

std::vector<Region> measure_regions(const LabelVolume& labels) {
  std::vector<Region> used;
  const std::vector<Region> all = measure(labels);
  for (std::size_t label = 1; label < all.size(); ++label)
    if (all[label].voxels > 0)
      used.push_back({static_cast<std::uint16_t>(label), all[label].voxels, all[label].box});
  return used;
}

std::vector<Vec3> boundary_points_P(const Segmentation& segmentation, const Region& region,
                                    std::size_t most) {
  const LabelVolume& labels = segmentation.labels;
  std::vector<Vec3> points;
  for (int k = region.box.lo[2]; k < region.box.hi[2]; ++k)
    for (int j = region.box.lo[1]; j < region.box.hi[1]; ++j)
      for (int i = region.box.lo[0]; i < region.box.hi[0]; ++i)
        if (labels.at(i, j, k) == region.label && on_boundary(labels, i, j, k))
          points.push_back(labels.frame.point_P(Vec3(i, j, k)));
  if (points.size() <= most) return points;
  std::vector<Vec3> fewer;
  for (std::size_t n = 0; n < most; ++n) fewer.push_back(points[n * points.size() / most]);
  return fewer;
}

}  // namespace osteon
