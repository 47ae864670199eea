#include "runs/hands/push_history.h"

#include <algorithm>
#include <span>

namespace osteon {
namespace {

template <class T, std::size_t N>
std::span<const T> first_of(const std::array<T, N>& all, std::uint32_t count) {
  return {all.data(), std::min<std::size_t>(count, N)};
}

template <class T>
bool are_same(std::span<const T> a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace

void PushHistory::add(const SoftPushes& pushes, double time_s) {
  if (time_s < due_s_) return;
  due_s_ = time_s + 1 / kPictureHz;
  const auto all = first_of(pushes.all, pushes.count);
  const auto bends = first_of(pushes.bends, pushes.bend_count);
  const auto breaks = first_of(pushes.breaks, pushes.break_count);
  const auto notches = first_of(pushes.notches, pushes.notch_count);
  const auto loads = first_of(pushes.loads, pushes.load_count);
  const auto dents = first_of(pushes.skin_dents, pushes.skin_count);
  const auto lips = first_of(pushes.lip_pulls, pushes.lip_count);
  const auto pieces = first_of(pushes.pieces, pushes.piece_count);
  const Kept nothing;
  const Kept& last = kept_.empty() ? nothing : kept_.back();
  if (are_same(all, last.all) && are_same(bends, last.bends) && are_same(breaks, last.breaks) &&
      are_same(notches, last.notches) && are_same(loads, last.loads) && pushes.cuts == last.cuts &&
      are_same(dents, last.dents) && pushes.skin_cuts == last.skin_cuts &&
      are_same(pieces, last.pieces) && are_same(lips, last.lips))
    return;
  kept_.push_back({time_s,
                   {all.begin(), all.end()},
                   {bends.begin(), bends.end()},
                   {breaks.begin(), breaks.end()},
                   {notches.begin(), notches.end()},
                   {loads.begin(), loads.end()},
                   pushes.cuts,
                   {dents.begin(), dents.end()},
                   {pieces.begin(), pieces.end()},
                   pushes.skin_cuts,
                   {lips.begin(), lips.end()}});
}

SoftPushes PushHistory::at(double time_s) const {
  const auto later = std::upper_bound(kept_.begin(), kept_.end(), time_s,
                                      [](double t, const Kept& kept) { return t < kept.time_s; });
  SoftPushes out;
  if (later == kept_.begin()) return out;
  const Kept& kept = *(later - 1);
  std::copy(kept.all.begin(), kept.all.end(), out.all.begin());
  std::copy(kept.bends.begin(), kept.bends.end(), out.bends.begin());
  std::copy(kept.breaks.begin(), kept.breaks.end(), out.breaks.begin());
  std::copy(kept.notches.begin(), kept.notches.end(), out.notches.begin());
  std::copy(kept.loads.begin(), kept.loads.end(), out.loads.begin());
  std::copy(kept.dents.begin(), kept.dents.end(), out.skin_dents.begin());
  std::copy(kept.pieces.begin(), kept.pieces.end(), out.pieces.begin());
  std::copy(kept.lips.begin(), kept.lips.end(), out.lip_pulls.begin());
  out.lip_count = static_cast<std::uint32_t>(kept.lips.size());
  out.piece_count = static_cast<std::uint32_t>(kept.pieces.size());
  out.cuts = kept.cuts;
  out.skin_cuts = kept.skin_cuts;
  out.skin_count = static_cast<std::uint32_t>(kept.dents.size());
  out.count = static_cast<std::uint32_t>(kept.all.size());
  out.bend_count = static_cast<std::uint32_t>(kept.bends.size());
  out.break_count = static_cast<std::uint32_t>(kept.breaks.size());
  out.notch_count = static_cast<std::uint32_t>(kept.notches.size());
  out.load_count = static_cast<std::uint32_t>(kept.loads.size());
  return out;
}

}  // namespace osteon
