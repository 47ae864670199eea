#include "osteon/image/label_tools.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "label_mask.h"
#include "osteon/image/components.h"
#include "osteon/image/fill.h"
#include "osteon/image/outside_body.h"

namespace osteon {
namespace {

using Voxel = std::array<int, 3>;

constexpr std::size_t kRowsBetweenLooks = 4096;  // at whether to go on

bool in_scan(const LabelEdit& edit, const Voxel& v) {
  return edit.labels().frame.contains(v[0], v[1], v[2]);
}

/// Rows of voxels connected to a seed, found one run after the other.
class RegionGrowth {
 public:
  RegionGrowth(const LabelEdit& edit, std::uint16_t label, const Voxel& seed,
               const GrowOptions& options)
      : edit_(edit), frame_(edit.labels().frame), label_(label), seed_(seed), options_(options) {
    seen_.resize(frame_.count(), false);
    box_ = {seed, {seed[0] + 1, seed[1] + 1, seed[2] + 1}};
  }

  /// False when told to stop.
  bool run(const Progress& progress) {
    std::vector<Voxel> open = {seed_};
    for (std::size_t rows = 0; !open.empty(); ++rows) {
      if (rows % kRowsBetweenLooks == 0 && !goes_on(progress, "Growing", share_seen()))
        return false;
      const Voxel at = open.back();
      open.pop_back();
      if (!is_open(at[0], at[1], at[2])) continue;
      take_row(at, open);
    }
    return true;
  }

  const VoxelBox& box() const { return box_; }
  bool holds(std::size_t n) const { return seen_[n]; }

 private:
  /// Of the whole scan: growing ends sooner than this says.
  double share_seen() const {
    return static_cast<double>(taken_) / static_cast<double>(frame_.count());
  }

  bool is_open(int i, int j, int k) const {
    const std::size_t n = frame_.index(i, j, k);
    if (seen_[n] || !options_.range.holds(edit_.volume().values[n])) return false;
    const std::uint16_t there = edit_.labels().values[n];
    if (there != 0 && there != label_) return false;
    if (options_.reach_m <= 0) return true;
    const Vec3 way = frame_.spacing_m.cwiseProduct(Vec3(i - seed_[0], j - seed_[1], k - seed_[2]));
    return way.squaredNorm() <= options_.reach_m * options_.reach_m;
  }

  void take_row(const Voxel& at, std::vector<Voxel>& open) {
    int lo = at[0], hi = at[0] + 1;
    while (lo > 0 && is_open(lo - 1, at[1], at[2])) --lo;
    while (hi < frame_.size[0] && is_open(hi, at[1], at[2])) ++hi;
    for (int i = lo; i < hi; ++i) seen_[frame_.index(i, at[1], at[2])] = true;
    taken_ += static_cast<std::size_t>(hi - lo);
    const Voxel first = {lo, at[1], at[2]}, last = {hi, at[1] + 1, at[2] + 1};
    for (std::size_t a = 0; a < 3; ++a) {
      box_.lo[a] = std::min(box_.lo[a], first[a]);
      box_.hi[a] = std::max(box_.hi[a], last[a]);
    }
    if (at[1] > 0) look_into(lo, hi, at[1] - 1, at[2], open);
    if (at[1] + 1 < frame_.size[1]) look_into(lo, hi, at[1] + 1, at[2], open);
    if (at[2] > 0) look_into(lo, hi, at[1], at[2] - 1, open);
    if (at[2] + 1 < frame_.size[2]) look_into(lo, hi, at[1], at[2] + 1, open);
  }

  /// The first voxel of each open run of a neighbouring row.
  void look_into(int lo, int hi, int j, int k, std::vector<Voxel>& open) const {
    bool before = false;
    for (int i = lo; i < hi; ++i) {
      const bool here = is_open(i, j, k);
      if (here && !before) open.push_back({i, j, k});
      before = here;
    }
  }

  const LabelEdit& edit_;
  const GridFrame& frame_;
  std::uint16_t label_;
  Voxel seed_;
  const GrowOptions& options_;
  std::vector<bool> seen_;
  std::size_t taken_ = 0;
  VoxelBox box_;
};

Result<void> check_seed(const LabelEdit& edit, std::uint16_t label, const Voxel& seed,
                        const HuRange& range) {
  if (!in_scan(edit, seed)) return fail("this place is outside the scan", {}, "Click inside it");
  const std::size_t n = edit.labels().frame.index(seed[0], seed[1], seed[2]);
  const std::uint16_t there = edit.labels().values[n];
  if (there != 0 && there != label)
    return fail("this place belongs to " + edit.bones().at(there).name, {},
                "Choose that bone, or merge the two");
  const int hu = edit.volume().values[n];
  if (!range.holds(edit.volume().values[n]))
    return fail("this place has " + std::to_string(hu) + " HU, outside the threshold", {},
                "Click on brighter bone, or move the threshold");
  return {};
}

/// Gives unlabelled voxels of a mask over `box` to a label.
std::size_t take_mask(LabelEdit& edit, std::uint16_t label, const Mask& mask, const VoxelBox& box) {
  std::size_t taken = 0;
  each_run(mask, [&](int begin, int end, int j, int k) {
    for (int i = begin; i < end; ++i) {
      const std::size_t n = edit.labels().frame.index(box.lo[0] + i, box.lo[1] + j, box.lo[2] + k);
      if (edit.labels().values[n] == 0) taken += edit.set(n, 1, label);
    }
  });
  return taken;
}

/// `label` 0: a new bone, made within the same step.
Result<std::size_t> grow_from(LabelEdit& edit, std::uint16_t label, const Voxel& seed,
                              const GrowOptions& options, const Progress& progress) {
  if (auto good = check_seed(edit, label, seed, options.range); !good)
    return tl::unexpected(good.error());
  RegionGrowth growth(edit, label, seed, options);
  if (!growth.run(progress)) return stopped();
  const VoxelBox box = grown(growth.box(), 1, edit.labels().frame);
  Mask mask = mask_over(edit.labels(), box, [&](std::size_t n) { return growth.holds(n); });
  if (options.fill) fill_holes(mask);
  if (!goes_on(progress, "Growing", 0.99)) return stopped();
  edit.begin_step(label == 0 ? "Grow a bone" : "Grow " + edit.bones().at(label).name);
  if (label == 0) {
    const auto fresh = edit.add();
    if (!fresh) {
      edit.cancel_step();
      return tl::unexpected(fresh.error());
    }
    label = *fresh;
  }
  const std::size_t gained = take_mask(edit, label, mask, box);
  edit.commit_step();
  return gained;
}

bool is_in(const LabelVolume& bodies, const Component& body, const LabelVolume& others,
           const std::vector<bool>& of_others) {
  for (int k = body.box.lo[2]; k < body.box.hi[2]; ++k)
    for (int j = body.box.lo[1]; j < body.box.hi[1]; ++j)
      for (int i = body.box.lo[0]; i < body.box.hi[0]; ++i)
        if (bodies.at(i, j, k) == body.label) {
          const std::uint16_t other = others.at(i, j, k);
          return other != 0 && of_others[other - 1u];
        }
  return false;
}

/// Takes what lies outside the body from the list. Bones that are made already tell as well
/// whether the scan shows a body.
void leave_outside(const LabelEdit& edit, const HuRange& range, std::size_t smallest,
                   const LabelVolume& bodies, std::vector<Component>& found) {
  const Mask all = mask_over(bodies, {{0, 0, 0}, bodies.frame.size},
                             [&](std::size_t n) { return range.holds(edit.volume().values[n]); });
  LabelVolume parts;
  const std::vector<Component> of_all = label_components(all, smallest, parts);
  const std::vector<bool> outside = parts_outside_body(edit.volume(), parts, of_all);
  std::erase_if(found, [&](const Component& body) { return is_in(bodies, body, parts, outside); });
}

}  // namespace

Result<std::size_t> grow_label(LabelEdit& edit, std::uint16_t label, const Voxel& seed,
                               const GrowOptions& options, const Progress& progress) {
  if (!edit.has(label)) return fail("no bone is chosen", {}, "Choose or add one first");
  return grow_from(edit, label, seed, options, progress);
}

Result<std::size_t> grow_new_label(LabelEdit& edit, const Voxel& seed, const GrowOptions& options,
                                   const Progress& progress) {
  return grow_from(edit, 0, seed, options, progress);
}

Result<std::vector<std::uint16_t>> label_bodies(LabelEdit& edit, const BodyOptions& options,
                                                const Progress& progress) {
  if (!goes_on(progress, "Finding parts", 0)) return stopped();
  const GridFrame& frame = edit.labels().frame;
  const auto smallest = static_cast<std::size_t>(
      std::max(1.0, std::ceil(options.smallest_m3 / frame.voxel_volume_m3())));
  const Mask mask = mask_over(edit.labels(), {{0, 0, 0}, frame.size}, [&](std::size_t n) {
    return edit.labels().values[n] == 0 && options.range.holds(edit.volume().values[n]);
  });
  LabelVolume bodies;
  std::vector<Component> found = label_components(mask, smallest, bodies);
  leave_outside(edit, options.range, smallest, bodies, found);
  if (found.empty())
    return fail("no part within the threshold is as large as a bone", {}, "Move the threshold");
  if (found.size() > options.most) found.resize(options.most);
  edit.begin_step("Find bodies");
  std::vector<std::uint16_t> labels;
  for (const Component& body : found) {
    const double share = static_cast<double>(labels.size()) / static_cast<double>(found.size());
    if (!goes_on(progress, "Finding parts", 0.3 + 0.7 * share)) {
      edit.cancel_step();
      return stopped();
    }
    const auto label = edit.add();
    if (!label) break;
    const VoxelBox box = grown(body.box, 1, frame);
    Mask part =
        mask_over(bodies, box, [&](std::size_t n) { return bodies.values[n] == body.label; });
    if (options.fill) fill_holes(part);
    take_mask(edit, *label, part, box);
    labels.push_back(*label);
  }
  edit.commit_step();
  return labels;
}

}  // namespace osteon
