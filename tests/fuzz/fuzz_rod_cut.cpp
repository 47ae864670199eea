// Rods and cuts from the bytes: mass, length and momentum stay, and all parts move on.
#include <cstddef>
#include <cstdint>

#include "osteon/base/check.h"
#include "tissue/rod/random_rod_cuts.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::size_t at = 0;
  const auto next = [&] {
    const auto byte = static_cast<std::int8_t>(at < size ? data[at++] : 0);
    return byte == -128 ? -1 : byte / 127.0;
  };
  osteon::testing::RandomRodCuts rods;
  if (!rods.begin(next)) return 0;
  for (int n = 0; n < 24 && at < size && rods.can_cut(); ++n) {
    const std::string why = rods.cut(next);
    osteon::demand(why.empty(), why.c_str());
  }
  return 0;
}
