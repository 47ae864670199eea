#include <algorithm>
#include <system_error>

#include "files/grey_picture.h"
#include "files/picture_header.h"
#include "files/raw_values.h"
#include "files/text_header.h"
#include "files/volume_files.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kPictureLimitBytes = 1ull << 30;

/// "slice9" comes before "slice10".
bool natural_less(const fs::path& a, const fs::path& b) {
  const std::string s = a.filename().string(), t = b.filename().string();
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0, j = 0;
  while (i < s.size() && j < t.size()) {
    if (digit(s[i]) && digit(t[j])) {
      while (i < s.size() && s[i] == '0') ++i;
      while (j < t.size() && t[j] == '0') ++j;
      std::size_t m = i, n = j;
      while (m < s.size() && digit(s[m])) ++m;
      while (n < t.size() && digit(t[n])) ++n;
      if (m - i != n - j) return m - i < n - j;
      if (const int order = s.compare(i, m - i, t, j, n - j)) return order < 0;
      i = m;
      j = n;
    } else {
      if (s[i] != t[j]) return s[i] < t[j];
      ++i;
      ++j;
    }
  }
  return s.size() - i < t.size() - j;
}

Result<GreyPicture> decode_picture(std::string_view bytes, const std::string& where) {
  if (auto sane = check_picture_header(bytes, where); !sane) return tl::unexpected(sane.error());
  return bytes.front() == '\x89' ? decode_png(bytes, where) : decode_tiff(bytes, where);
}

Result<GreyPicture> read_picture(const fs::path& file) {
  const auto bytes = read_file(file, kPictureLimitBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  return decode_picture(*bytes, file.string());
}

/// Unsigned pictures hold HU + 1024.
void append(const GreyPicture& picture, Volume& volume) {
  for (std::size_t k = 0; k < picture.count(); ++k) {
    const int hu =
        picture.is_signed ? static_cast<std::int16_t>(picture.values[k]) : picture.values[k] - 1024;
    volume.values.push_back(static_cast<std::int16_t>(std::min(hu, 32767)));
  }
}

Result<std::vector<fs::path>> pictures_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ec;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ec))
    if (is_picture(entry.path())) files.push_back(entry.path());
  if (files.empty())
    return fail("holds no PNG or TIFF pictures", folder.string(), "Check the name");
  std::sort(files.begin(), files.end(), natural_less);
  return files;
}

/// By the first picture and the number of pictures.
Result<GridFrame> frame_of_stack(const std::vector<fs::path>& files,
                                 const std::optional<Vec3>& spacing_m, const std::string& where) {
  if (!spacing_m)
    return fail("holds pictures, which do not store their pixel size", where,
                "Give --spacing X,Y,Z in mm");
  const auto first = read_picture(files.front());
  if (!first) return tl::unexpected(first.error());
  GridFrame frame;
  frame.spacing_m = *spacing_m;
  frame.size = {first->width, first->height,
                static_cast<int>(std::min<std::size_t>(files.size(), 1 << 20))};
  if (auto sane = check_size(frame, where); !sane) return tl::unexpected(sane.error());
  return frame;
}

}  // namespace

bool is_picture(const fs::path& file) {
  const std::string end = lower_case(file.extension().string());
  return end == ".png" || end == ".tif" || end == ".tiff";
}

Result<Volume> parse_picture(std::string_view bytes, const std::string& where) {
  const auto picture = decode_picture(bytes, where);
  if (!picture) return tl::unexpected(picture.error());
  Volume volume;
  volume.frame.size = {picture->width, picture->height, 1};
  append(*picture, volume);
  return volume;
}

Result<VolumeHead> head_of_slice_stack(const fs::path& folder,
                                       const std::optional<Vec3>& spacing_m) {
  const auto files = pictures_in(folder);
  if (!files) return tl::unexpected(files.error());
  const auto frame = frame_of_stack(*files, spacing_m, folder.string());
  if (!frame) return tl::unexpected(frame.error());
  // One picture at a time beside the volume.
  return VolumeHead{*frame, reading_bytes(*frame, 4 * static_cast<double>(frame->index(0, 0, 1)))};
}

Result<Volume> read_slice_stack(const fs::path& folder, const std::optional<Vec3>& spacing_m) {
  const auto files = pictures_in(folder);
  if (!files) return tl::unexpected(files.error());
  const auto frame = frame_of_stack(*files, spacing_m, folder.string());
  if (!frame) return tl::unexpected(frame.error());
  Volume volume{*frame, {}};
  volume.values.reserve(frame->count());
  for (const fs::path& file : *files) {
    const auto picture = read_picture(file);
    if (!picture) return tl::unexpected(picture.error());
    if (picture->width != frame->size[0] || picture->height != frame->size[1])
      return fail("has a different size from " + files->front().filename().string(), file.string(),
                  "Put the slices of one scan into the folder");
    append(*picture, volume);
  }
  return volume;
}

}  // namespace osteon
