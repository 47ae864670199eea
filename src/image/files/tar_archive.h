#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "osteon/base/result.h"

namespace osteon {

inline constexpr std::size_t kTarBlock = 512;

struct TarEntry {
  std::string name;  ///< without folders
  std::uint64_t size = 0;
  bool is_file = false;
  /// Blocks that the content takes, in bytes.
  std::uint64_t stored() const { return (size + kTarBlock - 1) / kTarBlock * kTarBlock; }
};

/// Reads the block before an entry's content; none where it is damaged.
std::optional<TarEntry> read_tar_entry(std::string_view block);

/// The files of a tar archive by their names without folders; views into `bytes`.
Result<std::map<std::string, std::string_view>> read_tar(std::string_view bytes,
                                                         const std::string& where);

}  // namespace osteon
