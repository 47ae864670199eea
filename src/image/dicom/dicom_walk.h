#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "dicom/dicom_codestream.h"
#include "osteon/base/result.h"

namespace osteon {

/// A tag's group and element in one number.
constexpr std::uint32_t dicom_tag(std::uint16_t group, std::uint16_t element) {
  return static_cast<std::uint32_t>(group) << 16 | element;
}

/// What a DICOM file holds, as views of its bytes.
struct DicomElements {
  std::string_view syntax;  ///< UID of the transfer syntax
  bool big_endian = false;
  /// Of the outermost elements of groups 8, 20 and 28 (hexadecimal) that may matter, by tag: no
  /// sequences, nothing longer than 1024 bytes, nothing of the patient's group. The first of twins.
  std::map<std::uint32_t, std::string_view> values;
  bool has_pixels = false;
  std::string_view plain_pixels;                  ///< where they are not compressed
  std::vector<std::string_view> pixel_fragments;  ///< where they are: the table of offsets first

  /// Without the blanks and zeros that fill it up; empty: missing.
  std::string_view text(std::uint16_t group, std::uint16_t element) const;
  /// An unsigned number of two bytes; `otherwise` where there is none.
  unsigned number(std::uint16_t group, std::uint16_t element, unsigned otherwise) const;
};

/// Steps through the elements of a DICOM file (PS3.5, 7) and fails unless every one of them, the
/// pixels included, lies whole within it. The views live as long as `bytes`.
Result<DicomElements> walk_dicom(std::string_view bytes, const std::string& where);

}  // namespace osteon
