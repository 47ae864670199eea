#pragma once

#include <string_view>
#include <vector>

namespace osteon {

/// What a DICOM file says of its compressed pixels.
struct EncodedPixels {
  std::string_view syntax;  ///< UID of the transfer syntax
  unsigned rows = 0, columns = 0, bits = 0;
  std::vector<std::string_view> fragments;  ///< the table of offsets first
};

/// True when the head of the compressed pixels says the same as the file: one component of the same
/// size, and no more bits than the file has room for. Decoders crash or take memory on what does
/// not fit. Only compressions that Osteon reads pass.
bool fits_header(const EncodedPixels& pixels);

}  // namespace osteon
