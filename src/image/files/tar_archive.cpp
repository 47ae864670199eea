#include "files/tar_archive.h"

#include <algorithm>

namespace osteon {
namespace {

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

std::optional<TarEntry> read_tar_entry(std::string_view block) {
  TarEntry entry;
  if (block.size() < kTarBlock || block.substr(257, 5) != "ustar" ||
      !read_octal(block.substr(124, 12), entry.size))
    return std::nullopt;
  entry.name = block.substr(0, std::min<std::size_t>(100, block.find('\0')));
  if (const std::size_t slash = entry.name.rfind('/'); slash != entry.name.npos)
    entry.name.erase(0, slash + 1);
  entry.is_file = block[156] == '0' || block[156] == '\0';
  return entry;
}

Result<std::map<std::string, std::string_view>> read_tar(std::string_view bytes,
                                                         const std::string& where) {
  std::map<std::string, std::string_view> files;
  for (std::size_t at = 0; at + kTarBlock <= bytes.size();) {
    const std::string_view head = bytes.substr(at, kTarBlock);
    if (head[0] == '\0') break;
    const auto entry = read_tar_entry(head);
    if (!entry || entry->size > bytes.size() - at - kTarBlock)
      return fail("is truncated or damaged inside", where, "Copy or save it again");
    if (entry->is_file)
      files[entry->name] = bytes.substr(at + kTarBlock, static_cast<std::size_t>(entry->size));
    at += kTarBlock + static_cast<std::size_t>(entry->stored());
  }
  return files;
}

}  // namespace osteon
