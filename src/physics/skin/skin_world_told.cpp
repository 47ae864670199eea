// What is told of the skin to those who draw, report and judge.
#include <algorithm>
#include <cmath>

#include "skin/skin_world.h"

namespace osteon {

SkinOpening SkinWorld::opening() const {
  SkinOpening out;
  for (std::size_t s = 0; s < patches_.size(); ++s) {
    const SkinPatch& patch = setup_.skins[s];
    if (is_for_portal(patch)) continue;
    out.open_m += patches_[s].cut_m;
    for (std::size_t h = 0; h < kMaxHands; ++h) {
      const SkinHand& hand = hands_[h][s];
      if (!hand.cutting) continue;
      const double past_m = hand.deepest_m - patch.cover.at(hand.p).height_m;
      out.blades[h] = {true, std::abs(hand.p.x()), std::max(0.0, past_m)};
    }
  }
  return out;
}

void SkinWorld::show(SoftPushes& pushes) const {
  for (std::size_t s = 0; s < patches_.size(); ++s) {
    pushes.skin_cuts[s] = patches_[s].shown;
    for (std::uint32_t i = 0; i < patches_[s].made_count; ++i)
      pushes.made[s * kMadePerPatch + i] = made_portal(s, i);
    for (std::size_t h = 0; h < kMaxHands; ++h) {
      const SkinHand& hand = hands_[h][s];
      const double dent_m = hand.contact.deep_m - hand.entered_m;
      if (!hand.near || hand.barred || hand.contact.through || hand.in_wound || !(dent_m > 0))
        continue;
      pushes.skin_dents[pushes.skin_count++] = {static_cast<std::uint32_t>(s), hand.p, dent_m,
                                                hand.radius_m};
    }
    for (const LipPush& push : patches_[s].pushes.list())
      if (push.force_n > 0 && pushes.lip_count < SoftPushes::kMostLipPulls)
        pushes.lip_pulls[pushes.lip_count++] = {static_cast<std::uint32_t>(s), push.at, push.out,
                                                push.force_n};
  }
}

SkinReadout SkinWorld::readout(std::size_t patch) const {
  SkinReadout out = readouts_[patch];
  out.cut_m = patches_[patch].cut_m;
  out.holes = patches_[patch].holes;
  out.portals = patches_[patch].made_count;
  return out;
}

}  // namespace osteon
