#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "osteon/image/progress.h"
#include "osteon/image/volume.h"

namespace osteon {

/// What tells one series of a folder from another. Holds nothing that names the patient.
struct DicomSeries {
  std::string uid;
  std::string modality;  ///< "CT"
  int number = 0;        ///< as shown on the scanner; 0 when the files do not say
  std::vector<std::filesystem::path> files;
};

/// True when the file starts as DICOM does.
bool is_dicom_file(const std::filesystem::path& file);

/// The series in a folder (not those of folders inside it), or the one that a file belongs to;
/// in the order of their numbers.
Result<std::vector<DicomSeries>> list_dicom_series(const std::filesystem::path& source);

/// Shape of a series from its headers alone.
Result<GridFrame> dicom_frame(const DicomSeries& series);

/// Reads a CT series: HU by slope and intercept, slices sorted by their positions, the distance
/// between slices from their positions, a tilted gantry resampled to upright. Refuses, naming file
/// and reason: other modalities, mixed or truncated files, missing or doubled slices, positions or
/// spacings that do not fit.
Result<Volume> read_dicom(const DicomSeries& series, const Progress& progress = {});

/// The series that `wanted` (number or UID) names; with an empty `wanted` the only CT series there
/// is. Several to choose from: an error that lists them.
Result<DicomSeries> choose_series(const std::vector<DicomSeries>& all, const std::string& wanted,
                                  const std::string& where);

struct DicomWriteOptions {
  std::uint64_t seed = 1;  ///< makes the UIDs: the same volume and seed give the same bytes
  std::string description = "Osteon virtual scan";
  Progress progress;
};

/// Writes a CT series, one file a slice (0001.dcm, ...), uncompressed, into an existing folder. The
/// patient is called VIRTUAL.
Result<void> write_dicom(const Volume& volume, const std::filesystem::path& folder,
                         const DicomWriteOptions& options = {});

}  // namespace osteon
