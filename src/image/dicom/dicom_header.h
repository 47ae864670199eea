#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "dicom/dicom_walk.h"
#include "osteon/base/result.h"
#include "osteon/base/types.h"

namespace osteon {

/// What one DICOM file says about its slice; lengths in metres. Nothing that names the patient.
struct DicomHeader {
  std::filesystem::path file;
  std::string series_uid, modality, image_type;
  int series_number = 0;
  int rows = 0, columns = 0, frames = 1;
  double slope = 1, intercept = 0;
  bool has_rescale = false;
  bool has_pixels = false;
  std::optional<Vec3> position_P;
  std::optional<Mat3> axes_P;               ///< of i and j as written; k is their cross product
  double spacing_i_m = 0, spacing_j_m = 0;  ///< 0: missing
};

/// Whole content of a file.
Result<std::string> read_dicom_bytes(const std::filesystem::path& file);

/// What the elements of a file say. Fails when the series is not named, or a CT slice has no
/// pixels.
Result<DicomHeader> dicom_header(const DicomElements& elements, const std::filesystem::path& file);

/// The same from a file. Fails when it is no DICOM file or stops early.
Result<DicomHeader> read_dicom_header(const std::filesystem::path& file);

}  // namespace osteon
