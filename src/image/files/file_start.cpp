#include "files/file_start.h"

#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <system_error>

namespace osteon {

Result<std::string> read_start(const std::filesystem::path& file, std::size_t most) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return fail("cannot be opened", file.string(), "Check the name and its permissions");
  std::string bytes(most, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(most));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

double size_of_file(const std::filesystem::path& file) {
  std::error_code ec;
  const auto size = std::filesystem::file_size(file, ec);
  return ec ? 0 : static_cast<double>(size);
}

UnpackedFile::UnpackedFile(const std::filesystem::path& file) : file_(gzopen(file.c_str(), "rb")) {}

UnpackedFile::~UnpackedFile() {
  if (file_) gzclose(file_);
}

std::string UnpackedFile::read(std::size_t count) {
  std::string bytes(count, '\0');
  std::size_t got = 0;
  while (file_ && got < count) {
    const int more = gzread(file_, bytes.data() + got,
                            static_cast<unsigned>(std::min<std::size_t>(count - got, 1 << 20)));
    if (more <= 0) break;
    got += static_cast<std::size_t>(more);
  }
  bytes.resize(got);
  return bytes;
}

bool UnpackedFile::skip(std::uint64_t count) {
  while (count > 0) {
    const auto part = static_cast<std::size_t>(std::min<std::uint64_t>(count, 1 << 16));
    if (read(part).size() < part) return false;
    count -= part;
  }
  return true;
}

}  // namespace osteon
