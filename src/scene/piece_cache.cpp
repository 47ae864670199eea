#include "osteon/scene/piece_cache.h"

#include <bit>
#include <cstring>
#include <system_error>
#include <utility>

#include "osteon/base/file.h"
#include "osteon/base/hash.h"

namespace osteon {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is little-endian");

constexpr std::string_view kMagic = "OSTNPCS1";
constexpr std::uint64_t kMostBytes = 1ull << 28;
constexpr std::size_t kCornerBytes = 3 * sizeof(double);

template <class T>
void write(std::string& out, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

void write(std::string& out, const PieceCorners& entry) {
  write(out, entry.concavity_m);
  write(out, static_cast<std::uint32_t>(entry.pieces.size()));
  for (const auto& corners : entry.pieces) {
    write(out, static_cast<std::uint32_t>(corners.size()));
    for (const Vec3& p : corners)
      for (Eigen::Index k = 0; k < 3; ++k) write(out, p[k]);
  }
}

std::uint64_t checksum(std::string_view bytes) {
  Hasher hasher;
  hasher.bytes(bytes.data(), bytes.size());
  return hasher.value();
}

// Reads values until the bytes end; then it fails and stays failed.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  bool failed() const { return failed_; }
  bool at_end() const { return bytes_.empty(); }

  template <class T>
  T read() {
    T value{};
    if (bytes_.size() < sizeof value) {
      failed_ = true;
      return value;
    }
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_.remove_prefix(sizeof value);
    return value;
  }

  // A count of things of at least `least` bytes each, so that a wild one cannot ask for memory.
  std::uint32_t count(std::size_t least) {
    const auto n = read<std::uint32_t>();
    if (n > bytes_.size() / least) failed_ = true;
    return failed_ ? 0 : n;
  }

  PieceCorners entry() {
    PieceCorners out;
    out.concavity_m = read<double>();
    out.pieces.resize(count(sizeof(std::uint32_t)));
    for (auto& corners : out.pieces) {
      corners.resize(count(kCornerBytes));
      for (Vec3& p : corners) {
        for (Eigen::Index k = 0; k < 3; ++k) p[k] = read<double>();
        failed_ |= !is_finite(p);
      }
    }
    return out;
  }

 private:
  std::string_view bytes_;
  bool failed_ = false;
};

}  // namespace

std::string to_bytes(const std::map<std::uint64_t, PieceCorners>& entries) {
  std::string out(kMagic);
  write(out, static_cast<std::uint32_t>(entries.size()));
  for (const auto& [key, entry] : entries) {
    write(out, key);
    write(out, entry);
  }
  write(out, checksum(out));
  return out;
}

Result<std::map<std::uint64_t, PieceCorners>> read_pieces(std::string_view bytes) {
  constexpr std::size_t kLeast = kMagic.size() + sizeof(std::uint32_t) + sizeof(std::uint64_t);
  if (bytes.size() < kLeast || !bytes.starts_with(kMagic)) return fail("is not a file of pieces");
  const std::string_view body = bytes.substr(0, bytes.size() - sizeof(std::uint64_t));
  if (Reader(bytes.substr(body.size())).read<std::uint64_t>() != checksum(body))
    return fail("its checksum is wrong");
  Reader reader(body.substr(kMagic.size()));
  std::map<std::uint64_t, PieceCorners> out;
  const auto count = reader.count(sizeof(std::uint64_t));
  for (std::uint32_t i = 0; i < count && !reader.failed(); ++i) {
    const auto key = reader.read<std::uint64_t>();
    out[key] = reader.entry();
  }
  if (reader.failed() || !reader.at_end()) return fail("it is damaged");
  return out;
}

PieceCache::PieceCache(std::filesystem::path file) : file_(std::move(file)) {
  const auto bytes = read_file(file_, kMostBytes);
  if (!bytes) return;
  auto read = read_pieces(*bytes);
  if (!read) return;
  for (auto& [key, pieces] : *read) entries_[key] = {std::move(pieces), false};
}

const PieceCorners* PieceCache::find(std::uint64_t key) {
  const auto at = entries_.find(key);
  if (at == entries_.end()) return nullptr;
  at->second.used = true;
  return &at->second.pieces;
}

void PieceCache::put(std::uint64_t key, PieceCorners pieces) {
  entries_[key] = {std::move(pieces), true};
  changed_ = true;
}

Result<void> PieceCache::save() { return file_.empty() ? Result<void>() : save_as(file_); }

Result<void> PieceCache::save_as(const std::filesystem::path& file) {
  if (!changed_) return {};
  std::map<std::uint64_t, PieceCorners> kept;
  for (const auto& [key, entry] : entries_)
    if (entry.used) kept[key] = entry.pieces;
  std::error_code ec;
  std::filesystem::create_directories(file.parent_path(), ec);
  auto written = write_file_atomic(file, to_bytes(kept));
  if (written) changed_ = false;
  return written;
}

}  // namespace osteon
