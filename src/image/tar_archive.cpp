#include "tar_archive.h"

#include <cstdint>

namespace osteon {
namespace {

constexpr std::size_t kBlock = 512;

/// Octal digits up to a blank or zero byte.
bool read_octal(std::string_view text, std::uint64_t& value) {
  value = 0;
  bool any = false;
  for (const char c : text) {
    if (c == ' ' && !any) continue;
    if (c == ' ' || c == '\0') break;
    if (c < '0' || c > '7') return false;
    value = value * 8 + static_cast<std::uint64_t>(c - '0');
    any = true;
  }
  return any;
}

}  // namespace

Result<std::map<std::string, std::string_view>> read_tar(std::string_view bytes,
                                                         const std::string& where) {
  std::map<std::string, std::string_view> files;
  for (std::size_t at = 0; at + kBlock <= bytes.size();) {
    const std::string_view head = bytes.substr(at, kBlock);
    if (head[0] == '\0') break;
    std::uint64_t size = 0;
    const bool good = head.substr(257, 5) == "ustar" && read_octal(head.substr(124, 12), size);
    if (!good || size > bytes.size() - at - kBlock)
      return fail("is truncated or damaged inside", where, "Copy or save it again");
    std::string name(head.substr(0, head.substr(0, 100).find('\0')));
    if (name.size() > 100) name.resize(100);
    if (const std::size_t slash = name.rfind('/'); slash != name.npos) name.erase(0, slash + 1);
    if (head[156] == '0' || head[156] == '\0')
      files[name] = bytes.substr(at + kBlock, static_cast<std::size_t>(size));
    at += kBlock + (static_cast<std::size_t>(size) + kBlock - 1) / kBlock * kBlock;
  }
  return files;
}

}  // namespace osteon
