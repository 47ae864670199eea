#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "label_mask.h"
#include "osteon/image/distance_map.h"
#include "osteon/image/label_tools.h"
#include "osteon/image/watershed.h"

namespace osteon {
namespace {

using Voxel = std::array<int, 3>;

/// From the import's own to one that parts wherever a body is a little thinner.
constexpr std::array<double, 6> kWiderNecks = {0.42, 0.5, 0.6, 0.7, 0.8, 0.9};
/// Parts below this share of the whole stay with their neighbour: they are bumps.
constexpr double kLeastPart = 0.01;
/// How deep a neck between two peaks is sought, of the lower one; the deepest first.
constexpr std::array<double, 4> kSharesOfPeak = {0.6, 0.8, 0.95, 1.0};
/// A map deeper than any body: the mask has no outside.
constexpr double kFarthest_m = 10;
constexpr double kTopHeight = 3000;  // grow_seeds sorts heights below 4096

/// One bone's voxels with some room around them.
struct BoneMask {
  VoxelBox box;
  Mask mask;
};

BoneMask bone_mask(const LabelEdit& edit, std::uint16_t label) {
  const LabelVolume& labels = edit.labels();
  BoneMask out;
  out.box = grown(edit.bones().at(label).box, 1, labels.frame);
  out.mask = mask_over(labels, out.box, [&](std::size_t n) { return labels.values[n] == label; });
  return out;
}

/// Gives the voxels that `parts` marks to the labels `label_of[part]`, 0: leave them.
void write_parts(LabelEdit& edit, const LabelVolume& parts, const VoxelBox& box,
                 const std::vector<std::uint16_t>& label_of) {
  std::size_t n = 0;
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j)
      for (int i = box.lo[0]; i < box.hi[0]; ++i, ++n)
        if (const std::uint16_t label = label_of[parts.values[n]])
          edit.set(edit.labels().frame.index(i, j, k), 1, label);
}

/// How many voxels each part has; place 0 is empty.
std::vector<std::size_t> part_sizes(const LabelVolume& parts, int count) {
  std::vector<std::size_t> sizes(static_cast<std::size_t>(count) + 1, 0);
  for (const std::uint16_t part : parts.values)
    if (part != 0) ++sizes[part];
  return sizes;
}

/// Parts that are large enough to be a bone, the largest first.
std::vector<std::uint16_t> real_parts(const std::vector<std::size_t>& sizes) {
  std::size_t whole = 0;
  for (const std::size_t size : sizes) whole += size;
  std::vector<std::uint16_t> parts;
  for (std::size_t p = 1; p < sizes.size(); ++p)
    if (static_cast<double>(sizes[p]) >= kLeastPart * static_cast<double>(whole))
      parts.push_back(static_cast<std::uint16_t>(p));
  std::stable_sort(parts.begin(), parts.end(),
                   [&](std::uint16_t a, std::uint16_t b) { return sizes[a] > sizes[b]; });
  return parts;
}

/// The deepest voxel connected to `at` by voxels of `share` of the depth of `at`.
Voxel deepest_around(const Grid<float>& depth, const Voxel& at, double share) {
  const double least = share * static_cast<double>(depth.at(at[0], at[1], at[2]));
  std::vector<bool> seen(depth.values.size(), false);
  std::vector<Voxel> open = {at};
  seen[depth.frame.index(at[0], at[1], at[2])] = true;
  Voxel best = at;
  while (!open.empty()) {
    const Voxel v = open.back();
    open.pop_back();
    if (depth.at(v[0], v[1], v[2]) > depth.at(best[0], best[1], best[2])) best = v;
    for (std::size_t side = 0; side < 6; ++side) {
      Voxel to = v;
      to[side / 2] += side % 2 == 0 ? -1 : 1;
      if (!depth.frame.contains(to[0], to[1], to[2])) continue;
      const std::size_t n = depth.frame.index(to[0], to[1], to[2]);
      if (seen[n] || !(depth.values[n] > 0) || static_cast<double>(depth.values[n]) < least)
        continue;
      seen[n] = true;
      open.push_back(to);
    }
  }
  return best;
}

/// The peak of the body that `at` lies in: it rises over bumps, but through no neck below `share`.
Voxel peak_of(const Grid<float>& depth, Voxel at, double share) {
  for (;;) {
    const Voxel higher = deepest_around(depth, at, share);
    if (depth.at(higher[0], higher[1], higher[2]) <= depth.at(at[0], at[1], at[2])) return at;
    at = higher;
  }
}

/// Two seeds and the heights over which they grow.
struct SeededMask {
  Volume height;
  LabelVolume seeds;
};

SeededMask seeded_mask(const Mask& mask, const Voxel& a, const Voxel& b) {
  SeededMask out{{mask.frame, std::vector<std::int16_t>(mask.frame.count(), 0)},
                 {mask.frame, std::vector<std::uint16_t>(mask.frame.count(), 0)}};
  const Grid<float> depth = distance_map(mask);
  const double top =
      static_cast<double>(*std::max_element(depth.values.begin(), depth.values.end()));
  Voxel from_a = a, from_b = b;
  for (const double share : kSharesOfPeak) {
    from_a = peak_of(depth, a, share);
    from_b = peak_of(depth, b, share);
    if (from_a != from_b) break;
  }
  // Where both rise to one peak there is no neck: over equal heights both grow at equal pace.
  if (from_a == from_b || top > kFarthest_m) {
    from_a = a;
    from_b = b;
  } else {
    for (std::size_t n = 0; n < depth.values.size(); ++n)
      out.height.values[n] = static_cast<std::int16_t>(
          std::lround(kTopHeight * static_cast<double>(depth.values[n]) / top));
  }
  out.seeds.at(from_a[0], from_a[1], from_a[2]) = 1;
  out.seeds.at(from_b[0], from_b[1], from_b[2]) = 2;
  return out;
}

Result<std::uint16_t> bone_of_both(const LabelEdit& edit, const Voxel& a, const Voxel& b) {
  const LabelVolume& labels = edit.labels();
  const std::string todo = "Draw from one part of a bone to the other";
  if (!labels.frame.contains(a[0], a[1], a[2]) || !labels.frame.contains(b[0], b[1], b[2]))
    return fail("this place is outside the scan", {}, todo);
  const std::uint16_t label = labels.at(a[0], a[1], a[2]);
  if (label == 0 || label != labels.at(b[0], b[1], b[2]))
    return fail("both ends must lie in the bone that is to be split", {}, todo);
  if (a == b) return fail("both ends are at the same place", edit.bones().at(label).name, todo);
  return label;
}

Voxel within(const Voxel& v, const VoxelBox& box) {
  return {v[0] - box.lo[0], v[1] - box.lo[1], v[2] - box.lo[2]};
}

}  // namespace

Result<std::vector<std::uint16_t>> split_label(LabelEdit& edit, std::uint16_t label,
                                               const Progress& progress) {
  if (!edit.has(label)) return fail("no bone is chosen", {}, "Click on one");
  if (!goes_on(progress, "Splitting", 0)) return stopped();
  const BoneMask bone = bone_mask(edit, label);
  const Grid<float> depth = distance_map(bone.mask);
  LabelVolume parts;
  std::vector<std::uint16_t> found;
  for (const double widest : kWiderNecks) {
    if (!goes_on(progress, "Splitting", widest - kWiderNecks.front() + 0.3)) return stopped();
    NeckOptions necks;
    necks.widest_neck = widest;
    const int count = split_at_necks(depth, necks, parts);
    found = real_parts(part_sizes(parts, count));
    if (found.size() > 1) break;
  }
  if (found.size() < 2)
    return fail("has no neck to split it at", edit.bones().at(label).name,
                "Draw from one part to the other with the split tool");
  if (!goes_on(progress, "Splitting", 0.95)) return stopped();
  edit.begin_step("Split " + edit.bones().at(label).name);
  std::vector<std::uint16_t> label_of(65536, 0), made;
  for (std::size_t p = 1; p < found.size(); ++p) {
    const auto fresh = edit.add();
    if (!fresh) break;
    label_of[found[p]] = *fresh;
    made.push_back(*fresh);
  }
  write_parts(edit, parts, bone.box, label_of);
  edit.commit_step();
  return made;
}

Result<std::uint16_t> split_label_between(LabelEdit& edit, const Voxel& keep, const Voxel& part,
                                          const Progress& progress) {
  const auto label = bone_of_both(edit, keep, part);
  if (!label) return label;
  if (!goes_on(progress, "Splitting", 0)) return stopped();
  const BoneMask bone = bone_mask(edit, *label);
  SeededMask seeded = seeded_mask(bone.mask, within(keep, bone.box), within(part, bone.box));
  if (!goes_on(progress, "Splitting", 0.6)) return stopped();
  grow_seeds(seeded.height, bone.mask, seeded.seeds);
  if (!goes_on(progress, "Splitting", 0.95)) return stopped();
  edit.begin_step("Split " + edit.bones().at(*label).name);
  const auto fresh = edit.add();
  if (!fresh) {
    edit.cancel_step();
    return fresh;
  }
  write_parts(edit, seeded.seeds, bone.box, {0, 0, *fresh});
  edit.commit_step();
  return *fresh;
}

}  // namespace osteon
