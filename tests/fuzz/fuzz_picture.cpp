// Any bytes as a PNG or TIFF slice: an error or a whole slice.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "osteon/base/check.h"
#include "osteon/image/load_volume.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto slice = osteon::load_volume_from_memory({reinterpret_cast<const char*>(data), size},
                                                     "png", "fuzz.png");
  if (!slice) return 0;
  osteon::demand(slice->values.size() == slice->frame.count(), "the slice is not whole");
  osteon::demand(!slice->values.empty(), "a slice has pixels");
  return 0;
}
