#include "osteon/base/links.h"

#include <charconv>
#include <string>
#include <system_error>

namespace osteon {
namespace fs = std::filesystem;

int open_descriptor(const fs::path& path) {
  const fs::path folder = path.parent_path();
  if (folder != "/dev/fd" && folder != "/proc/self/fd") return -1;
  const std::string number = path.filename().string();
  int descriptor = -1;
  const auto read = std::from_chars(number.data(), number.data() + number.size(), descriptor);
  return read.ec == std::errc{} && read.ptr == number.data() + number.size() ? descriptor : -1;
}

fs::path behind_links(const fs::path& path) {
  constexpr int kMostLinks = 40;  // as many as the kernel follows
  fs::path at = path;
  std::error_code ec;
  for (int n = 0; n < kMostLinks && open_descriptor(at) < 0; ++n) {
    const fs::path target = fs::read_symlink(at, ec);
    if (ec) return at;
    at = at.parent_path() / target;  // an absolute target stands alone
  }
  return at;
}

}  // namespace osteon
