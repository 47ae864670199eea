#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "osteon/base/result.h"
#include "osteon/image/load_volume.h"

namespace osteon {

/// Files larger than this, packed or unpacked, are refused.
inline constexpr std::uint64_t kVolumeLimitBytes = 4ull << 30;
inline constexpr double kMostVoxels = 1.2e9;

// From the headers alone.
Result<VolumeHead> head_of_nrrd(const std::filesystem::path& file);
Result<VolumeHead> head_of_nifti(const std::filesystem::path& file);
Result<VolumeHead> head_of_meta(const std::filesystem::path& file);
Result<VolumeHead> head_of_inv3(const std::filesystem::path& file);
Result<VolumeHead> head_of_slice_stack(const std::filesystem::path& folder,
                                       const std::optional<Vec3>& spacing_m);

Result<Volume> read_nrrd(const std::filesystem::path& file);
Result<Volume> read_nifti(const std::filesystem::path& file);
Result<Volume> read_meta(const std::filesystem::path& file);
Result<Volume> read_inv3(const std::filesystem::path& file);
bool is_picture(const std::filesystem::path& file);
Result<Volume> read_slice_stack(const std::filesystem::path& folder,
                                const std::optional<Vec3>& spacing_m);

// From memory, for tests and fuzzing. `folder` holds detached data; empty: there is none.
Result<Volume> parse_nrrd(std::string_view bytes, const std::filesystem::path& folder,
                          const std::string& where);
Result<Volume> parse_nifti(std::string_view bytes, const std::string& where);
Result<Volume> parse_meta(std::string_view bytes, const std::filesystem::path& folder,
                          const std::string& where);
Result<Volume> parse_inv3(std::string_view bytes, const std::string& where);
/// One PNG or TIFF slice; its spacing is not known.
Result<Volume> parse_picture(std::string_view bytes, const std::string& where);

/// The first mask of an InVesalius project (0 or 1 a voxel) and its thresholds.
struct Inv3Mask {
  Mask mask;
  double low_hu = 0, high_hu = 0;
};
Result<Inv3Mask> read_inv3_mask(const std::filesystem::path& file);

}  // namespace osteon
