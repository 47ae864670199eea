#include "osteon/image/load_volume.h"

#include <algorithm>
#include <system_error>

#include "dicom/dicom_slice.h"
#include "files/raw_values.h"
#include "files/volume_files.h"
#include "osteon/image/dicom.h"

namespace osteon {
namespace fs = std::filesystem;
namespace {

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

bool ends_with(const std::string& name, const std::string& end) {
  return name.size() >= end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
}

struct Format {
  const char* end;
  Result<VolumeHead> (*head)(const fs::path& file);
  Result<Volume> (*read)(const fs::path& file);
};

// One row a format that one file holds.
constexpr Format kFormats[] = {
    {".nrrd", head_of_nrrd, read_nrrd},  {".nhdr", head_of_nrrd, read_nrrd},
    {".nii", head_of_nifti, read_nifti}, {".nii.gz", head_of_nifti, read_nifti},
    {".mhd", head_of_meta, read_meta},   {".mha", head_of_meta, read_meta},
    {".inv3", head_of_inv3, read_inv3},
};

Result<void> check_usable(const GridFrame& frame, const fs::path& source) {
  const auto& size = frame.size;
  if (std::min({size[0], size[1], size[2]}) < 3)
    return fail("is only " + std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " +
                    std::to_string(size[2]) + " voxels large",
                source.string(), "A bone needs at least 3 voxels along each axis");
  const Vec3 s = frame.spacing_m;
  if (!is_finite(s) || !is_finite(frame.origin_P) || s.minCoeff() < 1e-5 || s.maxCoeff() > 0.02)
    return fail("has a voxel spacing outside 0.01 to 20 mm", source.string(),
                "Correct the spacing in the file, or give it with --spacing for pictures");
  return {};
}

/// Tells what the headers say, where they make sense; fails where they do not or nobody wants more.
Result<void> announce(const Result<VolumeHead>& head, const fs::path& source,
                      const LoadVolumeOptions& options) {
  if (!head) return tl::unexpected(head.error());
  if (auto usable = check_usable(head->frame, source); !usable) return usable;
  if (options.announce && !options.announce(*head)) return stopped();
  return {};
}

Result<VolumeHead> head_of_dicom(const DicomSeries& series) {
  const auto frame = dicom_frame(series);
  if (!frame) return tl::unexpected(frame.error());
  // Besides the volume, one slice at a time: its file twice and its pixels.
  return VolumeHead{*frame, reading_bytes(*frame, 16 * static_cast<double>(frame->index(0, 0, 1)))};
}

Result<Volume> load_dicom(const fs::path& source, const LoadVolumeOptions& options) {
  const auto all = list_dicom_series(source);
  if (!all) return tl::unexpected(all.error());
  const auto series = choose_series(*all, options.series, source.string());
  if (!series) return tl::unexpected(series.error());
  if (auto wanted = announce(head_of_dicom(*series), source, options); !wanted)
    return tl::unexpected(wanted.error());
  return read_dicom(*series, options.progress);
}

bool holds_pictures(const fs::path& folder) {
  std::error_code ec;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ec))
    if (is_picture(entry.path())) return true;
  return false;
}

Result<Volume> load_any(const fs::path& source, const LoadVolumeOptions& options) {
  std::error_code ec;
  if (fs::is_directory(source, ec)) {
    if (!holds_pictures(source)) return load_dicom(source, options);
    const auto head = head_of_slice_stack(source, options.spacing_m);
    if (auto wanted = announce(head, source, options); !wanted)
      return tl::unexpected(wanted.error());
    return read_slice_stack(source, options.spacing_m);
  }
  if (!fs::is_regular_file(source, ec))
    return fail("does not exist", source.string(), "Check the name");
  const std::string name = lower(source.filename().string());
  for (const Format& format : kFormats)
    if (ends_with(name, format.end)) {
      if (auto wanted = announce(format.head(source), source, options); !wanted)
        return tl::unexpected(wanted.error());
      return format.read(source);
    }
  if (is_dicom_file(source)) return load_dicom(source, options);
  return fail("is not a scan format that Osteon knows", source.string(),
              "Name a DICOM folder or a .nrrd, .nii, .mhd, .mha or .inv3 file");
}

}  // namespace

Result<Volume> load_volume(const fs::path& source, const LoadVolumeOptions& options) {
  auto volume = load_any(source, options);
  if (!volume) return volume;
  if (auto usable = check_usable(volume->frame, source); !usable)
    return tl::unexpected(usable.error());
  return volume;
}

Result<Volume> load_volume_from_memory(std::string_view bytes, const std::string& extension,
                                       const std::string& where) {
  if (extension == "nrrd") return parse_nrrd(bytes, {}, where);
  if (extension == "nii") return parse_nifti(bytes, where);
  if (extension == "mha") return parse_meta(bytes, {}, where);
  if (extension == "inv3") return parse_inv3(bytes, where);
  if (extension == "dcm") return parse_dicom_slice(bytes, where);
  if (extension == "png") return parse_picture(bytes, where);
  return fail("has an unknown extension '" + extension + "'", where);
}

}  // namespace osteon
