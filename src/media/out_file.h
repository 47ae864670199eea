#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "osteon/base/result.h"

namespace osteon {

/// A file that grows piece by piece beside its place (FILE.part) and is moved there by `keep`;
/// without it nothing is left. A device or pipe is written straight away.
class OutFile {
 public:
  static Result<OutFile> create(const std::filesystem::path& file);
  ~OutFile();
  OutFile(OutFile&& other) noexcept;
  OutFile& operator=(OutFile&& other) noexcept;

  /// The errno of what went wrong; 0: all of it is written.
  int write(const void* bytes, std::size_t count);
  /// From the begin; false where it cannot.
  bool seek(std::int64_t to);
  std::int64_t size() const { return size_; }
  bool seekable() const { return seekable_; }
  const std::filesystem::path& file() const { return file_; }
  Result<void> keep();

 private:
  OutFile() = default;
  int fd_ = -1;
  std::int64_t at_ = 0, size_ = 0;
  bool seekable_ = true;
  std::filesystem::path file_, part_;  ///< `part_` empty: written straight away
};

/// What a failed write says to its user.
Error write_error(int error_number, const std::filesystem::path& file);

}  // namespace osteon
