// The first byte chooses the format, the rest is the file: reading a scan must end without a crash,
// and what it gives must be whole. DICOM has a target of its own.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "osteon/base/check.h"
#include "osteon/image/load_volume.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static constexpr const char* kFormats[] = {"nrrd", "nii", "mha", "inv3"};
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto volume = osteon::load_volume_from_memory(bytes, kFormats[data[0] % 4], "fuzz");
  if (!volume) return 0;
  osteon::demand(volume->values.size() == volume->frame.count(), "the volume is not whole");
  const osteon::Mat3& R = volume->frame.axes_P;
  osteon::demand((R.transpose() * R - osteon::Mat3::Identity()).norm() < 1e-9, "no rotation");
  osteon::demand(R.determinant() > 0, "left-handed axes");
  return 0;
}
