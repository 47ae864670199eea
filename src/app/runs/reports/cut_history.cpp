#include "runs/reports/cut_history.h"

#include <algorithm>

namespace osteon {

void CutHistory::add(const CutsPatch& patch, double time_s) {
  constexpr double kApart_s = 0.1;
  if (patch.heat) {
    heat_.push_back({time_s, *patch.heat});
    return;
  }
  if (patch.clear) newest_.clear();
  if (!patch.clear && !patch.piece) {
    const auto [at, is_new] = newest_.try_emplace({patch.bone, patch.block}, kept_.size());
    if (!is_new && time_s - kept_[at->second].time_s < kApart_s) {
      kept_[at->second].patch = patch;
      return;
    }
    at->second = kept_.size();
  }
  kept_.push_back({time_s, patch});
}

std::size_t CutHistory::show(double time_s, std::size_t place, CarvedPicture& picture) const {
  const auto end = std::upper_bound(kept_.begin(), kept_.end(), time_s,
                                    [](double t, const Kept& kept) { return t < kept.time_s; });
  const auto until = static_cast<std::size_t>(end - kept_.begin());
  const bool heat_back = picture.pulses() > 0 && heat_[picture.pulses() - 1].time_s > time_s;
  if (until < place || heat_back) {
    picture.make_whole();
    place = 0;
  }
  for (; place < until; ++place) picture.take(kept_[place].patch);
  CutsPatch warmed;
  for (std::size_t n = picture.pulses(); n < heat_.size() && heat_[n].time_s <= time_s; ++n) {
    warmed.heat = heat_[n].pulse;
    picture.take(warmed);
  }
  return until;
}

}  // namespace osteon
