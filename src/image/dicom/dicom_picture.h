#pragma once

#include <string>

#include "dicom/dicom_walk.h"

namespace osteon {

/// A DICOM file with nothing in it but the grey picture of the one walked through, every element
/// but the pixels written anew (PS3.3, C.7.6.3): GDCM pads short pixels in silence and aborts on
/// some damaged headers, so it is given no other. Fails on colours, on sizes and depths that do not
/// fit one another or the pixels, and on compressions that are not read.
Result<std::string> picture_file(const DicomElements& elements, const std::string& where);

}  // namespace osteon
