#include "runs/hands/push_history.h"

#include <algorithm>

namespace osteon {

void PushHistory::add(const SolidPushes& pushes, double time_s) {
  if (time_s < due_s_) return;
  due_s_ = time_s + 1 / kPictureHz;
  const auto begin = pushes.all.begin();
  const auto end =
      begin + static_cast<std::ptrdiff_t>(std::min<std::size_t>(pushes.count, SolidPushes::kMost));
  const bool same = kept_.empty()
                        ? begin == end
                        : std::equal(begin, end, kept_.back().all.begin(), kept_.back().all.end());
  if (!same) kept_.push_back({time_s, {begin, end}});
}

SolidPushes PushHistory::at(double time_s) const {
  const auto later = std::upper_bound(kept_.begin(), kept_.end(), time_s,
                                      [](double t, const Kept& kept) { return t < kept.time_s; });
  SolidPushes out;
  if (later == kept_.begin()) return out;
  const std::vector<SolidPushes::One>& all = (later - 1)->all;
  std::copy(all.begin(), all.end(), out.all.begin());
  out.count = static_cast<std::uint32_t>(all.size());
  return out;
}

}  // namespace osteon
