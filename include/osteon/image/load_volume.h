#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "osteon/image/progress.h"
#include "osteon/image/volume.h"

namespace osteon {

struct LoadVolumeOptions {
  std::string series;             ///< of a DICOM folder: number or UID
  std::optional<Vec3> spacing_m;  ///< of a stack of pictures, which does not know it
  Progress progress;
  /// Told the shape before the voxels are read, where the format lets it be known; false stops.
  std::function<bool(const GridFrame&)> announce;
};

/// Reads a scan, chosen by what it is: a folder or file of a DICOM series, NRRD (.nrrd, .nhdr),
/// NIfTI (.nii, .nii.gz), MetaImage (.mhd, .mha), an InVesalius project (.inv3), or a folder of PNG
/// or TIFF slices with `spacing_m`. Values are taken as Hounsfield units. Axes come out as a
/// rotation: where a file's are left-handed, the last one is turned round.
Result<Volume> load_volume(const std::filesystem::path& source,
                           const LoadVolumeOptions& options = {});

/// The same from memory for the formats of one file; `extension`: "nrrd", "nii", "mha", "inv3", or
/// "dcm", of which only the structure is checked. `where` names the source in errors.
Result<Volume> load_volume_from_memory(std::string_view bytes, const std::string& extension,
                                       const std::string& where);

}  // namespace osteon
