#pragma once

#include <string>
#include <string_view>

#include "osteon/base/result.h"

namespace osteon {

/// Steps through the elements of a DICOM file and fails unless every one of them, the pixels
/// included, lies whole within it. GDCM pads short pixels in silence and aborts on some broken
/// headers, so nothing reaches it unchecked.
Result<void> check_dicom_structure(std::string_view bytes, const std::string& where);

}  // namespace osteon
