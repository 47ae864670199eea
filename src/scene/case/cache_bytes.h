#pragma once

// How cache files are written and read: little-endian values, last a checksum over all before it.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "osteon/base/file.h"
#include "osteon/base/hash.h"
#include "osteon/scene/keyed_entries.h"

namespace osteon::cache {

static_assert(std::endian::native == std::endian::little, "the files are little-endian");

template <class T>
requires std::is_arithmetic_v<T>
void write(std::string& out, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

inline std::uint64_t checksum(std::string_view bytes) {
  Hasher hasher;
  hasher.bytes(bytes.data(), bytes.size());
  return hasher.value();
}

/// Whether bytes begin with `magic` and end with the checksum of the rest; `body` gets what lies
/// between.
inline bool open(std::string_view bytes, std::string_view magic, std::string_view& body) {
  if (bytes.size() < magic.size() + sizeof(std::uint64_t) || !bytes.starts_with(magic))
    return false;
  const std::string_view whole = bytes.substr(0, bytes.size() - sizeof(std::uint64_t));
  std::uint64_t told = 0;
  std::memcpy(&told, bytes.data() + whole.size(), sizeof told);
  body = whole.substr(magic.size());
  return told == checksum(whole);
}

/// Reads values until the bytes end; then it fails and stays failed.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  bool failed() const { return failed_; }
  bool at_end() const { return bytes_.empty(); }
  void fail() { failed_ = true; }

  template <class T>
  T read() {
    T value{};
    if (failed_ || bytes_.size() < sizeof value) {
      failed_ = true;
      return value;
    }
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_.remove_prefix(sizeof value);
    return value;
  }

  /// A count of things of at least `least` bytes each, so that a wild one cannot ask for memory.
  std::uint32_t count(std::size_t least) {
    const auto n = read<std::uint32_t>();
    if (n > bytes_.size() / least) failed_ = true;
    return failed_ ? 0 : n;
  }

 private:
  std::string_view bytes_;
  bool failed_ = false;
};

/// Writes the entries in use where any was put since; `bytes_of` makes the file's bytes of them.
template <class T, class ToBytes>
Result<void> save_entries(KeyedEntries<T>& entries, const std::filesystem::path& file,
                          const ToBytes& bytes_of) {
  if (!entries.changed()) return {};
  std::error_code ec;
  std::filesystem::create_directories(file.parent_path(), ec);
  auto written = write_file_atomic(file, bytes_of(entries.used()));
  if (written) entries.saved();
  return written;
}

}  // namespace osteon::cache
