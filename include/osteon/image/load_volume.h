#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "osteon/image/progress.h"
#include "osteon/image/volume.h"

namespace osteon {

/// What a scan's headers say before its voxels are read.
struct VolumeHead {
  GridFrame frame;
  double reading_bytes = 0;  ///< what reading takes at its peak, the voxels included
};

struct LoadVolumeOptions {
  std::string series;             ///< of a DICOM folder: number or UID
  std::optional<Vec3> spacing_m;  ///< of a stack of pictures, which does not know it
  Progress progress;
  /// Told what the headers say, before the voxels are read; false stops.
  std::function<bool(const VolumeHead&)> announce;
};

/// Reads a scan, chosen by what it is: a folder or file of a DICOM series, NRRD (.nrrd, .nhdr),
/// NIfTI (.nii, .nii.gz), MetaImage (.mhd, .mha), an InVesalius project (.inv3), or a folder of PNG
/// or TIFF slices with `spacing_m`. Values are taken as Hounsfield units. Axes come out as a
/// rotation: where a file's are left-handed, the last one is turned round.
Result<Volume> load_volume(const std::filesystem::path& source,
                           const LoadVolumeOptions& options = {});

/// The same from memory for the formats of one file; `extension`: "nrrd", "nii", "mha", "inv3", or
/// "dcm", which gives one slice, or "png", one slice in PNG or TIFF. `where` names the source in
/// errors.
Result<Volume> load_volume_from_memory(std::string_view bytes, const std::string& extension,
                                       const std::string& where);

}  // namespace osteon
