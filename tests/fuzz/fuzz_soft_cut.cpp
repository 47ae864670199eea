// Cuts from the bytes through a strip of soft tissue, with the shapes of the shipped instruments:
// whatever they are, what is left is a closed surface about the volume that is left, and its
// stiffness is sound.
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "osteon/base/check.h"
#include "physics/soft/grid_cut_rig.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using osteon::demand;
  static const osteon::testing::CutBlocks blocks(osteon::Vec3(0.006, 0.002, 0.002));
  static osteon::testing::GridCutRig rig(blocks);
  std::size_t at = 0;
  const auto byte = [&] { return at < size ? data[at++] : std::uint8_t{0}; };
  // -1 to 1, or not a number where the byte is the lowest.
  const auto next = [&] {
    const auto signed_byte = static_cast<std::int8_t>(byte());
    return signed_byte == -128 ? std::nan("") : signed_byte / 127.0;
  };
  rig.make_whole(byte() % rig.solids());
  for (int n = 0; n < 12 && at < size; ++n) {
    rig.cut(byte() % rig.instruments(), next);
    const std::string why = rig.why_unsound();
    demand(why.empty(), why.c_str());
  }
  for (const std::string& why : {rig.why_not_whole(), rig.why_not_elastic()})
    demand(why.empty(), why.c_str());
  return 0;
}
