// InVesalius 3 projects: a gzipped tar of property lists, the voxels (matrix.dat, C order, slices
// first) and masks, whose first plane, row and column hold flags. Names in it are not read. Rows
// run from the back to the front there (InVesalius turns each slice over as it reads it), and from
// the front to the back in a Grid: taken as they come they would be a mirror image.
#include <algorithm>
#include <cmath>
#include <fstream>

#include "files/file_start.h"
#include "files/raw_values.h"
#include "files/tar_archive.h"
#include "files/text_header.h"
#include "files/volume_files.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

using Files = std::map<std::string, std::string_view>;

constexpr std::uint8_t kInside = 127;  // mask values above it are inside

/// What follows <key>`key`</key> up to its closing tag; empty when there is none.
std::string_view plist_value(std::string_view plist, const std::string& key) {
  const std::string mark = "<key>" + key + "</key>";
  std::size_t at = plist.find(mark);
  if (at == plist.npos) return {};
  at = plist.find('<', at + mark.size());
  if (at == plist.npos) return {};
  const std::size_t end = plist.find('>', at);
  if (end == plist.npos) return {};
  const std::string tag(plist.substr(at + 1, end - at - 1));
  const std::size_t close = plist.find("</" + tag + ">", end);
  return close == plist.npos ? std::string_view() : plist.substr(end + 1, close - end - 1);
}

std::string plist_text(std::string_view plist, const std::string& key) {
  return trimmed(plist_value(plist, key));
}

std::vector<double> plist_numbers(std::string_view plist, const std::string& key) {
  std::string text(plist_value(plist, key));
  for (std::size_t at; (at = text.find('<')) != text.npos;) {
    const std::size_t end = text.find('>', at);
    if (end == text.npos) return {};
    text.replace(at, end - at + 1, " ");
  }
  return numbers_in(text).value_or(std::vector<double>());
}

struct Project {
  std::string unpacked;
  Files files;
  std::string_view main;
};

Result<Project> open_project(std::string_view bytes, const std::string& where) {
  Project project;
  auto unpacked = gunzip(bytes, kVolumeLimitBytes, where);
  if (!unpacked) return tl::unexpected(unpacked.error());
  project.unpacked = std::move(*unpacked);
  auto files = read_tar(project.unpacked, where);
  if (!files) return tl::unexpected(files.error());
  project.files = std::move(*files);
  if (!project.files.count("main.plist"))
    return fail("is not an InVesalius project: it has no main.plist", where, "Save it again");
  project.main = project.files["main.plist"];
  return project;
}

Result<GridFrame> frame_of(std::string_view main, const std::string& where) {
  GridFrame frame;
  const auto shape = plist_numbers(main, "shape"), spacing = plist_numbers(main, "spacing");
  if (shape.size() != 3 || spacing.size() != 3)
    return fail("does not give its size and spacing", where, "Save it again");
  for (std::size_t a = 0; a < 3; ++a) {
    frame.size[a] = whole_number(shape[2 - a]).value_or(0);
    frame.spacing_m[static_cast<int>(a)] = spacing[a] * 0.001;
  }
  if (auto sane = check_size(frame, where); !sane) return tl::unexpected(sane.error());
  return frame;
}

Result<std::string_view> file_named(const Project& project, const std::string& name,
                                    const std::string& where) {
  const auto file = project.files.find(name);
  if (file == project.files.end())
    return fail("lacks the part '" + name + "'", where, "Copy or save it again");
  return file->second;
}

Result<Mask> unpack_mask(const GridFrame& frame, std::string_view bytes, const std::string& where) {
  const std::size_t ni = static_cast<std::size_t>(frame.size[0]) + 1,
                    nj = static_cast<std::size_t>(frame.size[1]) + 1,
                    nk = static_cast<std::size_t>(frame.size[2]) + 1;
  if (bytes.size() < ni * nj * nk)
    return fail("is truncated inside its mask", where, "Copy or save it again");
  Mask mask{frame, {}};
  for (std::size_t k = 1; k < nk; ++k)
    for (std::size_t j = nj - 1; j > 0; --j)
      for (std::size_t i = 1; i < ni; ++i) {
        const auto value = static_cast<std::uint8_t>(bytes[(k * nj + j) * ni + i]);
        mask.values.push_back(value > kInside ? 1 : 0);
      }
  return mask;
}

void turn_rows_over(Volume& volume) {
  const GridFrame& frame = volume.frame;
  for (int k = 0; k < frame.size[2]; ++k)
    for (int j = 0, last = frame.size[1] - 1; j < last; ++j, --last)
      for (int i = 0; i < frame.size[0]; ++i) std::swap(volume.at(i, j, k), volume.at(i, last, k));
}

/// The project's description, wherever it lies in the archive.
std::string find_main(UnpackedFile& archive) {
  for (std::uint64_t passed = 0; passed <= kVolumeLimitBytes;) {
    const auto entry = read_tar_entry(archive.read(kTarBlock));
    if (!entry) return {};
    if (entry->size > kVolumeLimitBytes) return {};
    passed += kTarBlock + entry->stored();
    if (entry->is_file && entry->name == "main.plist" && entry->size <= kHeaderLimitBytes)
      return archive.read(static_cast<std::size_t>(entry->size));
    if (!archive.skip(entry->stored())) return {};
  }
  return {};
}

/// As the end of a gzip file has it, which counts up to 4 GiB.
Result<double> unpacked_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return fail("cannot be opened", file.string(), "Check the name and its permissions");
  unsigned char end[4] = {};
  in.seekg(-4, std::ios::end);
  in.read(reinterpret_cast<char*>(end), sizeof end);
  return end[0] + 256.0 * (end[1] + 256.0 * (end[2] + 256.0 * end[3]));
}

}  // namespace

Result<Volume> parse_inv3(std::string_view bytes, const std::string& where) {
  const auto project = open_project(bytes, where);
  if (!project) return tl::unexpected(project.error());
  const std::string modality = plist_text(project->main, "modality");
  if (!modality.empty() && modality != "CT")
    return fail("is of modality '" + modality + "', not CT", where,
                "CT is needed, because bone is found by its Hounsfield units");
  if (plist_text(project->main, "dtype") != "int16")
    return fail("has voxels that are not 16-bit", where, "Save it again");
  const auto frame = frame_of(project->main, where);
  if (!frame) return tl::unexpected(frame.error());
  const std::string_view matrix = plist_value(project->main, "matrix");
  const auto data = file_named(*project, plist_text(matrix, "filename"), where);
  if (!data) return tl::unexpected(data.error());
  auto volume = unpack_values(*frame, *data, {}, where);
  if (volume) turn_rows_over(*volume);
  return volume;
}

Result<VolumeHead> head_of_inv3(const std::filesystem::path& file) {
  const auto unpacked = unpacked_bytes(file);
  if (!unpacked) return tl::unexpected(unpacked.error());
  UnpackedFile archive(file);
  const std::string main = find_main(archive);
  const auto frame = frame_of(main, file.string());
  if (!frame) {
    // Reading all of it says what is wrong.
    const auto volume = read_inv3(file);
    return tl::unexpected(volume ? frame.error() : volume.error());
  }
  return VolumeHead{*frame, reading_bytes(*frame, size_of_file(file), *unpacked)};
}

Result<Volume> read_inv3(const std::filesystem::path& file) {
  const auto bytes = read_file(file, kVolumeLimitBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  return parse_inv3(*bytes, file.string());
}

Result<Inv3Mask> read_inv3_mask(const std::filesystem::path& file) {
  const auto bytes = read_file(file, kVolumeLimitBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  const std::string where = file.string();
  const auto project = open_project(*bytes, where);
  if (!project) return tl::unexpected(project.error());
  const auto frame = frame_of(project->main, where);
  if (!frame) return tl::unexpected(frame.error());
  const auto plist = file_named(*project, "mask_0.plist", where);
  if (!plist) return tl::unexpected(plist.error());
  const auto data = file_named(*project, plist_text(*plist, "mask_file"), where);
  if (!data) return tl::unexpected(data.error());
  auto mask = unpack_mask(*frame, *data, where);
  if (!mask) return tl::unexpected(mask.error());
  const auto range = plist_numbers(*plist, "threshold_range");
  if (range.size() != 2) return fail("does not give its mask's thresholds", where, "Save it again");
  return Inv3Mask{std::move(*mask), range[0], range[1]};
}

}  // namespace osteon
