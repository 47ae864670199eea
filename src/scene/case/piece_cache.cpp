#include "osteon/scene/piece_cache.h"

#include <utility>

#include "case/cache_bytes.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

using cache::checksum;
using cache::Reader;
using cache::write;

constexpr std::string_view kPieceMagic = "OSTNPCS1";
constexpr std::uint64_t kMostPieceBytes = 1ull << 28;
constexpr std::size_t kCornerBytes = 3 * sizeof(double);

void write(std::string& out, const PieceCorners& entry) {
  write(out, entry.concavity_m);
  write(out, static_cast<std::uint32_t>(entry.pieces.size()));
  for (const auto& corners : entry.pieces) {
    write(out, static_cast<std::uint32_t>(corners.size()));
    for (const Vec3& p : corners)
      for (Eigen::Index k = 0; k < 3; ++k) write(out, p[k]);
  }
}

PieceCorners read_entry(Reader& reader) {
  PieceCorners out;
  out.concavity_m = reader.read<double>();
  out.pieces.resize(reader.count(sizeof(std::uint32_t)));
  for (auto& corners : out.pieces) {
    corners.resize(reader.count(kCornerBytes));
    for (Vec3& p : corners) {
      for (Eigen::Index k = 0; k < 3; ++k) p[k] = reader.read<double>();
      if (!is_finite(p)) reader.fail();
    }
  }
  return out;
}

}  // namespace

std::string to_bytes(const std::map<std::uint64_t, PieceCorners>& entries) {
  std::string out(kPieceMagic);
  write(out, static_cast<std::uint32_t>(entries.size()));
  for (const auto& [key, entry] : entries) {
    write(out, key);
    write(out, entry);
  }
  write(out, checksum(out));
  return out;
}

Result<std::map<std::uint64_t, PieceCorners>> read_pieces(std::string_view bytes) {
  std::string_view body;
  if (!cache::open(bytes, kPieceMagic, body)) return fail("is not a complete file of pieces");
  Reader reader(body);
  std::map<std::uint64_t, PieceCorners> out;
  const auto count = reader.count(sizeof(std::uint64_t));
  for (std::uint32_t i = 0; i < count && !reader.failed(); ++i) {
    const auto key = reader.read<std::uint64_t>();
    out[key] = read_entry(reader);
  }
  if (reader.failed() || !reader.at_end()) return fail("it is damaged");
  return out;
}

PieceCache::PieceCache(std::filesystem::path file) : file_(std::move(file)) {
  const auto bytes = read_file(file_, kMostPieceBytes);
  if (!bytes) return;
  auto read = read_pieces(*bytes);
  if (!read) return;
  entries_.take(std::move(*read));
}

const PieceCorners* PieceCache::find(std::uint64_t key) { return entries_.find(key); }

void PieceCache::put(std::uint64_t key, PieceCorners pieces) {
  entries_.put(key, std::move(pieces));
}

Result<void> PieceCache::save() { return file_.empty() ? Result<void>() : save_as(file_); }

Result<void> PieceCache::save_as(const std::filesystem::path& file) {
  return cache::save_entries(entries_, file, [](const auto& used) { return to_bytes(used); });
}

}  // namespace osteon
