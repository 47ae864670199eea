#include "osteon/scene/instrument_size.h"

#include <toml++/toml.h>
#include <cmath>
#include <cstdlib>
#include <system_error>

#include "osteon/base/file.h"

namespace osteon {
namespace {

constexpr std::uint64_t kLargestSizeFile = 1 << 20;  // bytes
constexpr double kSameSize_mm = 1e-6;

// The table [size] alone: whether the rest of the file is right was looked at when the tray was
// made. Below 0: none, or not of this size.
double listed_size_mm(const std::filesystem::path& file, std::string_view wanted) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return -1;
  const auto text = read_file(file, kLargestSizeFile);
  if (!text) return -1;
  try {
    const toml::table root = toml::parse(*text);
    const auto size = root["size"];
    if (wanted.empty()) return size["usual_mm"].value_or(-1.0);
    const double wanted_mm = std::strtod(std::string(wanted).c_str(), nullptr);
    const toml::array* list = size["list_mm"].as_array();
    for (std::size_t i = 0; list && i < list->size(); ++i) {
      const double mm = list->get(i)->value_or(-1.0);
      if (std::abs(mm - wanted_mm) < kSameSize_mm) return mm;
    }
  } catch (const toml::parse_error&) {
    return -1;
  }
  return -1;
}

}  // namespace

double size_in_use_mm(const std::string& tray_name, const Tool& tool) {
  const double tip_mm = 2e3 * tool.tip_radius_m;
  const auto data = find_data_dir();
  if (!data || tray_name.find('/') != std::string::npos) return tip_mm;
  const auto colon = tray_name.find(':');
  const auto file = *data / "assets" / "instruments" / (tray_name.substr(0, colon) + ".toml");
  const std::string_view size = colon == std::string::npos
                                    ? std::string_view()
                                    : std::string_view(tray_name).substr(colon + 1);
  const double mm = listed_size_mm(file, size);
  return mm > 0 ? mm : tip_mm;
}

}  // namespace osteon
