#include "runs/pictures/xray_tally.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace osteon {

void XrayTally::add(const XrayDose& shot, const std::vector<HandDose>& to_hands) {
  dose.air_kerma_mgy += shot.air_kerma_mgy;
  dose.kerma_area_mgy_cm2 += shot.kerma_area_mgy_cm2;
  dose.seconds += shot.seconds;
  dose.shots += shot.shots;
  dose.beam_area_cm2 = shot.beam_area_cm2;
  const std::size_t count = std::min<std::size_t>(to_hands.size(), kMaxHands);
  for (std::size_t h = 0; h < count; ++h) hands_mgy[h] += to_hands[h].total_mgy();
  hands = std::max(hands, count);
}

std::string dose_words(double mgy) {
  const bool large = mgy >= 0.9995;
  const double value = large ? mgy : 1000 * mgy;
  const int whole = value < 9.995 ? 2 : value < 99.95 ? 1 : 0;
  char text[32];
  std::snprintf(text, sizeof text, "%.*f %s", whole, value, large ? "mGy" : "\xC2\xB5Gy");
  return text;
}

}  // namespace osteon
