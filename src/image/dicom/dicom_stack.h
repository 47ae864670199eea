#pragma once

#include <array>
#include <string>
#include <vector>

#include "dicom/dicom_header.h"
#include "osteon/image/volume.h"

namespace osteon {

/// The slices of a series in their order along k, and the upright grid that they fill.
struct DicomStack {
  std::vector<DicomHeader> slices;
  GridFrame frame;
  /// By how much slice k lies aside of an upright stack, m along i and j; only with a tilted
  /// gantry.
  std::vector<std::array<double, 2>> shift_m;
  bool tilted = false;
};

/// Fails, naming the file, unless the slice is CT, has a place, a size and a scale.
Result<void> check_slice(const DicomHeader& slice);

/// Sorts and checks; `where` names the series in errors.
Result<DicomStack> stack_slices(std::vector<DicomHeader> slices, const std::string& where);

}  // namespace osteon
