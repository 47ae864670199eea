#include "out_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace osteon {

namespace fs = std::filesystem;

Error write_error(int error_number, const fs::path& file) {
  const bool full = error_number == ENOSPC || error_number == EDQUOT || error_number == EFBIG;
  return {std::string(full ? "the disk is full" : "cannot be written") + " (" +
              std::strerror(error_number) + ")",
          file.string(), full ? "free some space or choose another disk" : "choose another place"};
}

Result<OutFile> OutFile::create(const fs::path& file) {
  OutFile out;
  out.file_ = file;
  std::error_code ec;
  const fs::file_status there = fs::status(file, ec);
  if (fs::is_directory(there)) return fail("is a folder", file.string(), "Name a file");
  const bool special = fs::exists(there) && !fs::is_regular_file(there);
  fs::path target = file;
  if (!special && fs::is_symlink(fs::symlink_status(file, ec))) target = fs::canonical(file, ec);
  if (!special) {
    out.file_ = target;
    out.part_ = target;
    out.part_ += ".part";
  }
  out.fd_ =
      ::open((special ? file : out.part_).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (out.fd_ < 0) return tl::unexpected(write_error(errno, file));
  out.seekable_ = !special;
  return out;
}

OutFile::OutFile(OutFile&& other) noexcept { *this = std::move(other); }
OutFile& OutFile::operator=(OutFile&& other) noexcept {
  std::swap(fd_, other.fd_);
  std::swap(at_, other.at_);
  std::swap(size_, other.size_);
  std::swap(seekable_, other.seekable_);
  std::swap(file_, other.file_);
  std::swap(part_, other.part_);
  return *this;
}

OutFile::~OutFile() {
  if (fd_ < 0) return;
  ::close(fd_);
  std::error_code ec;
  if (!part_.empty()) fs::remove(part_, ec);
}

int OutFile::write(const void* bytes, std::size_t count) {
  const auto* at = static_cast<const char*>(bytes);
  while (count > 0) {
    const ssize_t done = ::write(fd_, at, count);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) return errno;
    if (done == 0) return EIO;
    at += done;
    count -= static_cast<std::size_t>(done);
    at_ += done;
    size_ = std::max(size_, at_);
  }
  return 0;
}

bool OutFile::seek(std::int64_t to) {
  if (!seekable_ || ::lseek(fd_, to, SEEK_SET) != to) return false;
  at_ = to;
  return true;
}

Result<void> OutFile::keep() {
  if (fd_ < 0) return {};
  const bool flushed = !seekable_ || ::fsync(fd_) == 0;
  const int bad = flushed ? 0 : errno;
  ::close(fd_);
  fd_ = -1;
  std::error_code ec;
  if (!part_.empty()) fs::rename(part_, file_, ec);
  if (bad != 0) return tl::unexpected(write_error(bad, file_));
  if (ec) return fail("cannot be given its final name (" + ec.message() + ")", file_.string());
  return {};
}

}  // namespace osteon
