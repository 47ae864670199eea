#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "osteon/base/result.h"

struct gzFile_s;

namespace osteon {

/// So much of a file holds its header: longer ones are cut.
inline constexpr std::size_t kHeaderLimitBytes = 1 << 20;

/// The first bytes of a file, at most `most`.
Result<std::string> read_start(const std::filesystem::path& file,
                               std::size_t most = kHeaderLimitBytes);

/// Size in bytes; 0 where it is not there.
double size_of_file(const std::filesystem::path& file);

/// A file read from its start on, unpacked where it is packed by gzip, without ever holding more
/// than what is asked for.
class UnpackedFile {
 public:
  explicit UnpackedFile(const std::filesystem::path& file);
  ~UnpackedFile();
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;

  /// The next bytes; fewer at the end and where it is damaged.
  std::string read(std::size_t count);
  /// False at the end and where it is damaged.
  bool skip(std::uint64_t count);

 private:
  gzFile_s* file_;
};

}  // namespace osteon
