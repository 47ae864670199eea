#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/raw_values.h"
#include "osteon/image/load_volume.h"

namespace osteon {

std::string trimmed(std::string_view text);
std::string lower_case(std::string_view text);
/// All numbers of a text in which blanks, commas and brackets part them; none when something else
/// is in it or one is not finite.
std::optional<std::vector<double>> numbers_in(std::string_view text);
/// A whole number of reasonable size.
std::optional<int> whole_number(double value);

/// "key: value" or "key = value" lines with keys in lower case.
using TextHeader = std::map<std::string, std::string>;

/// What NRRD and MetaImage files have in common.
struct TextVolumeHead {
  TextHeader header;
  ValueType type = ValueType::int16;
  GridFrame frame;
  bool flip_k = false;        ///< see set_axes
  std::string_view attached;  ///< what follows the header
};

/// `data`: name of the file beside `file` that holds the voxels, or empty; `packed`: by gzip.
VolumeHead volume_head(const TextVolumeHead& head, const std::filesystem::path& file,
                       const std::string& data, bool packed);

std::filesystem::path folder_of(const std::filesystem::path& file);

}  // namespace osteon
