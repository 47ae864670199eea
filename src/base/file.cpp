#include "osteon/base/file.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <system_error>
#include <vector>

#if defined(__unix__) || defined(__APPLE__)
#include <fcntl.h>
#include <unistd.h>
#endif

#include "osteon/base/links.h"

namespace osteon {
namespace fs = std::filesystem;
namespace {

std::string reason() { return std::strerror(errno); }

struct FileCloser {
  std::FILE* f;
  ~FileCloser() {
    if (f) std::fclose(f);
  }
};

bool flush_to_disk(std::FILE* f) {
  if (std::fflush(f) != 0) return false;
#if defined(__unix__) || defined(__APPLE__)
  return ::fsync(::fileno(f)) == 0;
#else
  return true;
#endif
}

}  // namespace

Result<std::string> read_file(const fs::path& path, std::uint64_t limit_bytes) {
  std::error_code ec;
  if (fs::is_directory(path, ec)) return fail("this is a folder, not a file", path.string());
  std::FILE* f = std::fopen(path.string().c_str(), "rb");
  if (!f) return fail("cannot be opened (" + reason() + ")", path.string(), "Check the name");
  const FileCloser closer{f};
  std::string content;
  char block[65536];
  for (;;) {
    const std::size_t got = std::fread(block, 1, sizeof block, f);
    content.append(block, got);
    if (content.size() > limit_bytes)
      return fail("is larger than " + std::to_string(limit_bytes) + " bytes", path.string());
    if (got < sizeof block) break;
  }
  if (std::ferror(f)) return fail("could not be read completely", path.string());
  return content;
}

namespace {

// Writes all of it and closes. Empty when done, else why not.
std::string write_and_close(std::FILE* f, std::string_view content, bool to_disk) {
  bool ok = std::fwrite(content.data(), 1, content.size(), f) == content.size();
  ok = ok && (to_disk ? flush_to_disk(f) : std::fflush(f) == 0);
  const std::string why = ok ? "" : reason();
  return std::fclose(f) != 0 && ok ? reason() : why;
}

tl::unexpected<Error> cannot_open(const fs::path& path) {
  return fail("cannot be written (" + reason() + ")", path.string(),
              "Check that the folder exists and may be written to");
}

// A device, a pipe or a socket is no file that could be replaced: what reads it waits there.
Result<void> write_through(const fs::path& path, int descriptor, std::string_view content) {
  std::FILE* f =
      descriptor < 0 ? std::fopen(path.string().c_str(), "wb") : ::fdopen(::dup(descriptor), "wb");
  if (!f) return cannot_open(path);
  const std::string why = write_and_close(f, content, false);
  if (why.empty()) return {};
  return fail("could not be written (" + why + ")", path.string(),
              "Free some space or choose another file");
}

Result<void> replace_file(const fs::path& path, std::string_view content) {
  const fs::path temporary = path.string() + ".part";
  std::FILE* f = std::fopen(temporary.string().c_str(), "wb");
  if (!f) return cannot_open(path);
  std::string why = write_and_close(f, content, true);
  std::error_code ec;
  if (why.empty()) {
    fs::rename(temporary, path, ec);
    if (!ec) return {};
    why = ec.message();
  }
  fs::remove(temporary, ec);
  return fail("could not be written (" + why + "); the previous content is unchanged",
              path.string(), "Free some space or choose another folder");
}

}  // namespace

Result<void> write_file_atomic(const fs::path& path, std::string_view content) {
  std::error_code ec;
  const fs::path target = behind_links(path);
  const int descriptor = open_descriptor(target);
  const fs::file_status there = fs::status(target, ec);
  if (fs::is_symlink(fs::symlink_status(target, ec)) && descriptor < 0)
    return fail("is a circular link", path.string(), "Give another file");
  if (fs::is_directory(there))
    return fail("is a folder", path.string(), "Give the name of a file in it");
  if (descriptor >= 0 || (fs::exists(there) && !fs::is_regular_file(there)))
    return write_through(target, descriptor, content);
  return replace_file(target, content);
}

namespace {

fs::path executable_dir() {
#if defined(__linux__)
  std::error_code ec;
  const fs::path self = fs::read_symlink("/proc/self/exe", ec);
  if (!ec) return self.parent_path();
#endif
  return {};
}

// Where packages put data, from the desktop's variable: a system need not say where the program is.
std::vector<fs::path> installed_data_dirs() {
  const char* set = std::getenv("XDG_DATA_DIRS");
  std::istringstream list(set && *set ? set : "/usr/local/share:/usr/share");
  std::vector<fs::path> dirs;
  for (std::string dir; std::getline(list, dir, ':');)
    if (fs::path(dir).is_absolute()) dirs.push_back(fs::path(dir) / "osteon");
  return dirs;
}

}  // namespace

Result<fs::path> find_data_dir() {
  std::error_code ec;
  std::string tried;
  const auto holds_assets = [&](const fs::path& dir) {
    if (dir.empty()) return false;
    tried += (tried.empty() ? "" : ", ") + dir.string();
    return fs::is_directory(dir / "assets", ec) && fs::is_directory(dir / "shaders", ec);
  };
  if (const char* set = std::getenv("OSTEON_DATA"); set && *set) {
    if (holds_assets(set)) return fs::path(set);
    return fail("has no assets and shaders folders", set, "Correct or unset OSTEON_DATA");
  }
  const fs::path exe = executable_dir();
  if (!exe.empty()) {
    for (const fs::path& dir : {exe, exe / "../share/osteon"})
      if (holds_assets(dir)) return dir;
  }
  if (holds_assets(OSTEON_SOURCE_DIR)) return fs::path(OSTEON_SOURCE_DIR);
  for (const fs::path& dir : installed_data_dirs())
    if (holds_assets(dir)) return dir;
  return fail("the folders assets and shaders were not found (looked in " + tried + ")", "Osteon",
              "Set OSTEON_DATA to the folder that holds them");
}

}  // namespace osteon
