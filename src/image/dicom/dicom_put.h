#pragma once

#include <gdcmAttribute.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "osteon/base/result.h"

namespace gdcm {
class Writer;
}

namespace osteon {

/// Number written short enough for a decimal string (16 characters).
std::string dicom_decimal(double value);

/// Puts an element, padded to an even length as its kind asks.
void put_dicom(gdcm::DataSet& data, std::uint16_t group, std::uint16_t element, gdcm::VR vr,
               std::string text);
void put_dicom_number(gdcm::DataSet& data, std::uint16_t group, std::uint16_t element,
                      std::uint16_t value);
/// Who the picture is of: nobody. One patient called VIRTUAL, on the first day of 2000.
void put_dicom_nobody(gdcm::DataSet& data);

/// A UID under 2.25, the root for numbers drawn by anyone.
std::string dicom_uid(std::uint64_t seed, std::uint64_t hash, std::uint64_t part);

/// Writes the file in one step, explicit little endian.
Result<void> write_dicom_file(gdcm::Writer& writer, const std::filesystem::path& file);

}  // namespace osteon
