#include "osteon/carve/node_moments.h"

#include <algorithm>

namespace osteon {
namespace {

template <class Counts>
NodeMoments moments_of_block(const std::array<int, 3>& block, const Counts& counts) {
  NodeMoments out;
  for (int n = 0; n < static_cast<int>(BlockGrid::kNodes); ++n) {
    if (!counts(static_cast<std::size_t>(n))) continue;
    const std::int64_t x = 8 * block[0] + n % 8, y = 8 * block[1] + n / 8 % 8,
                       z = 8 * block[2] + n / 64;
    ++out.count;
    const std::array<std::int64_t, 3> first{x, y, z};
    const std::array<std::int64_t, 6> second{x * x, y * y, z * z, x * y, x * z, y * z};
    for (std::size_t a = 0; a < 3; ++a) out.first[a] += first[a];
    for (std::size_t a = 0; a < 6; ++a) out.second[a] += second[a];
  }
  return out;
}

RemovedTissue::Counts gone_of_block(const CarvedField& field, std::uint32_t block) {
  const std::int16_t *cuts = field.cuts(block), *all = field.heights(block),
                     *bare = field.bare_heights(block);
  RemovedTissue::Counts out{};
  for (std::size_t n = 0; n < BlockGrid::kNodes; ++n) {
    if (!(all[n] < 0 && cuts[n] <= 0)) continue;
    const BoneTissue tissue =
        bare[n] < 0 ? field.layers().at(-1e-6 * bare[n]) : BoneTissue::kCartilage;
    ++out[static_cast<std::size_t>(tissue)];
  }
  return out;
}

}  // namespace

void NodeMoments::add(const NodeMoments& other, int sign) {
  count += sign * other.count;
  for (std::size_t a = 0; a < 3; ++a) first[a] += sign * other.first[a];
  for (std::size_t a = 0; a < 6; ++a) second[a] += sign * other.second[a];
}

NodeMoments whole_nodes(const UncutField& bone) {
  NodeMoments sum;
  for (std::uint32_t block = 0; block < bone.grid().count(); ++block) {
    if (bone.place(block) == UncutField::Place::kOutside) continue;
    const std::int16_t* heights = bone.stored(block);
    const auto in_bone = [&](std::size_t node) { return !heights || heights[node] < 0; };
    sum.add(moments_of_block(bone.grid().place(block), in_bone), 1);
  }
  return sum;
}

RemovedTissue::RemovedTissue(const CarvedField& field)
    : blocks_(field.most_blocks()), epoch_(field.epoch()) {}

const RemovedTissue::Counts& RemovedTissue::of(const CarvedField& field) {
  const bool anew = field.epoch() != epoch_;
  if (anew) {
    std::fill(blocks_.begin(), blocks_.end(), Counts{});
    sum_ = {};
  }
  if (!anew && field.step() == since_) return sum_;
  for (std::size_t n = 0; n < field.block_count(); ++n) {
    if (!anew && field.changed_at(n) <= since_) continue;
    const Counts now = gone_of_block(field, field.block_at(n));
    for (std::size_t t = 0; t < now.size(); ++t) sum_[t] += now[t] - blocks_[n][t];
    blocks_[n] = now;
  }
  since_ = field.step();
  epoch_ = field.epoch();
  return sum_;
}

RemovedNodes::RemovedNodes(const CarvedField& field)
    : blocks_(field.most_blocks()), epoch_(field.epoch()) {}

const NodeMoments& RemovedNodes::of(const CarvedField& field) {
  const bool anew = field.epoch() != epoch_;
  if (anew) {
    std::fill(blocks_.begin(), blocks_.end(), NodeMoments{});
    sum_ = {};
  }
  if (!anew && field.step() == since_) return sum_;
  for (std::size_t n = 0; n < field.block_count(); ++n) {
    if (!anew && field.changed_at(n) <= since_) continue;
    const std::uint32_t block = field.block_at(n);
    const std::int16_t *cuts = field.cuts(block), *heights = field.bare_heights(block);
    sum_.add(blocks_[n], -1);
    blocks_[n] = moments_of_block(field.grid().place(block), [&](std::size_t node) {
      return heights[node] < 0 && cuts[node] <= 0;
    });
    sum_.add(blocks_[n], 1);
  }
  since_ = field.step();
  epoch_ = field.epoch();
  return sum_;
}

}  // namespace osteon
