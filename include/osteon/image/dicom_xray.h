#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "osteon/base/result.h"

namespace osteon {

/// A picture of a C-arm, and how it was taken, as a DICOM file tells it.
struct XrayFilm {
  int width = 0, height = 0;
  std::vector<float> grey;  ///< 0: dark, 1: bright; rows from the top
  double kv = 60;
  double mas = 0.05;
  double exposure_s = 0.01;
  double source_detector_m = 1;
  double source_isocenter_m = 0.6;
  double pixel_m = 0.00045;   ///< at the detector
  double orbit_rad = 0;       ///< positioner's primary angle
  double angulation_rad = 0;  ///< positioner's secondary angle
  double kerma_area_mgy_cm2 = 0;
  int number = 1;  ///< of the shot in its series
};

struct XrayFilmOptions {
  std::uint64_t seed = 1;  ///< makes the UIDs: the same film and seed give the same bytes
  std::string description = "Osteon C-arm";
};

/// Writes an X-ray angiographic image (XA), 12 of 16 bits, uncompressed, grey by the logarithm of
/// what was detected. The patient is called VIRTUAL. Fails when there is no picture or the file
/// cannot be written; a file that was there stays whole.
Result<void> write_dicom_xray(const XrayFilm& film, const std::filesystem::path& file,
                              const XrayFilmOptions& options = {});

}  // namespace osteon
