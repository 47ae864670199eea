// A DICOM file of one slice, through GDCM to HU: reading it must end without a crash, and what it
// gives must be whole.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "osteon/base/check.h"
#include "osteon/image/load_volume.h"

// GDCM 3.0 and OpenJPEG 2.5 leak a buffer where a compressed stream is damaged.
extern "C" const char* __lsan_default_suppressions() { return "leak:libgdcm\nleak:libopenjp2\n"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto slice = osteon::load_volume_from_memory(bytes, "dcm", "fuzz");
  if (!slice) return 0;
  osteon::demand(slice->values.size() == slice->frame.count(), "the slice is not whole");
  osteon::demand(slice->frame.axes_P.determinant() > 0, "left-handed axes");
  return 0;
}
