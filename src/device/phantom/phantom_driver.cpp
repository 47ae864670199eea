#include "phantom_driver.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <mutex>

#include "osteon/base/clock.h"
#include "osteon/base/file.h"
#include "osteon/device/profile.h"
#include "phantom_device.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

// The library keeps one servo loop and one list of arms for the whole program, whoever loads it;
// this remembers the session that owns them while any arm is open.
Result<std::shared_ptr<HdSession>> shared_session() {
  static std::mutex guard;
  static std::weak_ptr<HdSession> current;
  const std::lock_guard lock(guard);
  if (auto session = current.lock()) return session;
  const auto api = load_hd_api(hd_library_candidates());
  if (!api) return tl::unexpected(api.error());
  auto session = std::make_shared<HdSession>(*api, steady_now_ns);
  current = session;
  return session;
}

// Folders in which the maker's set-up program leaves "<name>.config".
std::vector<fs::path> config_dirs() {
  std::vector<fs::path> dirs;
  if (const char* home = std::getenv("GTDD_HOME"); home && *home) dirs.push_back(home);
  if (const char* home = std::getenv("HOME"); home && *home)
    dirs.push_back(fs::path(home) / ".3dsystems");
  dirs.emplace_back("/usr/share/3DSystems");
  if (const char* shared = std::getenv("PUBLIC"); shared && *shared)
    dirs.push_back(fs::path(shared) / "Documents" / "3DSystems");
  for (fs::path& dir : dirs) dir /= "config";
  return dirs;
}

std::vector<std::string> configured_names() {
  for (const fs::path& dir : config_dirs()) {
    std::vector<std::string> names;
    std::error_code unreadable;
    for (const auto& entry : fs::directory_iterator(dir, unreadable))
      if (entry.path().extension() == ".config") names.push_back(entry.path().stem().string());
    if (names.empty()) continue;
    std::sort(names.begin(), names.end());
    return names;
  }
  return {"Default Device"};
}

}  // namespace

Result<std::vector<DeviceInfo>> list_phantom() {
  if (!load_hd_api(hd_library_candidates())) return std::vector<DeviceInfo>{};
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  auto weakest = load_device_profile(*data / "assets" / "devices" / "phantom_touch.toml");
  if (!weakest) return tl::unexpected(weakest.error());
  std::vector<DeviceInfo> arms;
  for (const std::string& name : configured_names()) {
    arms.push_back(*weakest);
    arms.back().name = kArmName;
    arms.back().serial = name;
  }
  return arms;
}

Result<std::unique_ptr<HapticDevice>> open_phantom(const DeviceInfo& info) {
  auto session = shared_session();
  if (!session) return tl::unexpected(session.error());
  return PhantomDevice::open(std::move(*session), info.serial);
}

std::vector<std::string> unusable_phantom() {
  const auto api = load_hd_api(hd_library_candidates());
  if (api) return {};
  return {api.error().message()};
}

}  // namespace osteon
