#include "cases/cache_room.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

namespace osteon {
namespace fs = std::filesystem;
namespace {

struct Entry {
  fs::path file;
  std::uintmax_t bytes = 0;
  fs::file_time_type used;
};

bool is_ours(const fs::path& file) {
  const std::string name = file.filename().string();
  return file.extension() == ".bin" && (name.starts_with("pieces-") || name.starts_with("fields-"));
}

// Other programs may remove a file at any moment: what is gone counts for nothing.
std::vector<Entry> entries_of(const fs::path& folder) {
  std::vector<Entry> out;
  std::error_code ec;
  for (fs::directory_iterator it(folder, ec), end; !ec && it != end; it.increment(ec)) {
    std::error_code one;
    if (!is_ours(it->path()) || !it->is_regular_file(one)) continue;
    const std::uintmax_t bytes = it->file_size(one);
    const fs::file_time_type used = it->last_write_time(one);
    if (!one) out.push_back({it->path(), bytes, used});
  }
  return out;
}

}  // namespace

void note_use(const fs::path& file) {
  std::error_code ec;
  fs::last_write_time(file, fs::file_time_type::clock::now(), ec);
}

void keep_cache_room(const fs::path& folder, const fs::path& newest, std::uintmax_t most_bytes) {
  std::vector<Entry> entries = entries_of(folder);
  std::uintmax_t total = 0;
  for (const Entry& entry : entries) total += entry.bytes;
  if (total <= most_bytes) return;
  std::error_code ec;
  const fs::file_time_type now = fs::last_write_time(newest, ec);
  if (ec) return;
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.used < b.used; });
  for (const Entry& entry : entries) {
    if (total <= most_bytes || entry.used >= now) return;
    if (fs::remove(entry.file, ec)) total -= entry.bytes;
  }
}

}  // namespace osteon
