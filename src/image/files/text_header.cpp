#include "files/text_header.h"

#include <charconv>
#include <cmath>

#include "files/file_start.h"

namespace osteon {

std::string trimmed(std::string_view text) {
  const char* blank = " \t\r\n";
  const std::size_t from = text.find_first_not_of(blank);
  if (from == std::string_view::npos) return {};
  return std::string(text.substr(from, text.find_last_not_of(blank) - from + 1));
}

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

std::optional<std::vector<double>> numbers_in(std::string_view text) {
  std::vector<double> out;
  for (std::size_t at = 0;;) {
    at = text.find_first_not_of(" \t\r\n,()", at);
    if (at == std::string_view::npos) return out;
    if (text[at] == '+') ++at;
    double value = 0;
    const auto parsed = std::from_chars(text.data() + at, text.data() + text.size(), value);
    if (parsed.ec != std::errc() || !std::isfinite(value)) return std::nullopt;
    out.push_back(value);
    at = static_cast<std::size_t>(parsed.ptr - text.data());
  }
}

std::optional<int> whole_number(double value) {
  if (!(std::abs(value) < 1e9) || value != std::floor(value)) return std::nullopt;
  return static_cast<int>(value);
}

VolumeHead volume_head(const TextVolumeHead& head, const std::filesystem::path& file,
                       const std::string& data, bool packed) {
  GridFrame frame = head.frame;
  if (head.flip_k) turn_frame_k(frame);
  double stored = size_of_file(file);
  if (!data.empty()) stored += size_of_file(folder_of(file) / data);
  const auto voxels = static_cast<double>(frame.count() * size_of(head.type));
  return {frame, reading_bytes(frame, stored, packed ? voxels : 0)};
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

}  // namespace osteon
