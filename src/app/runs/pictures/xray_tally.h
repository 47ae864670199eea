#pragma once

#include <array>

#include "osteon/scene/state.h"
#include "runs/pictures/xray_shot.h"

namespace osteon {

/// What an examination's X-ray pictures have given together.
struct XrayTally {
  XrayDose dose;                              ///< the beam's area is that of the last
  std::array<double, kMaxHands> hands_mgy{};  ///< air kerma in each hand's middle
  std::size_t hands = 0;                      ///< most that any picture was taken with

  void add(const XrayDose& shot, const std::vector<HandDose>& to_hands);
};

/// "0.31 uGy", "12.4 uGy", "1.25 mGy" (with the Greek letter): three digits that count.
std::string dose_words(double mgy);

}  // namespace osteon
