#include "cases/xdg.h"

#include <cstdlib>
#include <ctime>
#include <system_error>

namespace osteon {
namespace fs = std::filesystem;
namespace {

// The standard has relative paths ignored.
fs::path folder_from(const char* variable, const char* below_home) {
  const char* set = std::getenv(variable);
  if (set && fs::path(set).is_absolute()) return fs::path(set) / "osteon";
  const char* home = std::getenv("HOME");
  return (home && *home ? fs::path(home) : fs::temp_directory_path()) / below_home / "osteon";
}

}  // namespace

fs::path config_dir() { return folder_from("XDG_CONFIG_HOME", ".config"); }
fs::path cache_dir() { return folder_from("XDG_CACHE_HOME", ".cache"); }
fs::path data_home_dir() { return folder_from("XDG_DATA_HOME", ".local/share"); }

fs::path dated_file(const fs::path& folder, const std::string& stem, const std::string& extension) {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char date[32];
  std::strftime(date, sizeof date, "%Y-%m-%d-%H-%M-%S", &local);
  const fs::path base = folder / (stem + "-" + date);
  std::error_code ec;
  fs::path file = base.string() + extension;
  for (int i = 2; fs::exists(file, ec); ++i)
    file = base.string() + "-" + std::to_string(i) + extension;
  return file;
}

}  // namespace osteon
