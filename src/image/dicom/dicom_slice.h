#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "dicom/dicom_header.h"
#include "osteon/image/volume.h"

namespace osteon {

/// Slices are at most so wide and high: no scanner makes larger ones.
inline constexpr int kWidestSlice = 8192;

/// Unpacks the pixels of a slice into HU, `rows` times `columns` of them. Fails when the file holds
/// others than its header says, or none that can be unpacked.
Result<void> decode_dicom_slice(const DicomElements& elements, const DicomHeader& header,
                                std::int16_t* out);

/// One slice alone, with its place: the whole way of a file from its bytes to HU.
Result<Volume> parse_dicom_slice(std::string_view bytes, const std::string& where);

}  // namespace osteon
