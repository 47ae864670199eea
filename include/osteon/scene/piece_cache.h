#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"
#include "osteon/scene/keyed_entries.h"

namespace osteon {

/// Corners of the convex pieces of one bone: all that a hull is rebuilt from.
struct PieceCorners {
  std::vector<std::vector<Vec3>> pieces;  ///< in Bone, m; each the corners of one hull
  double concavity_m = 0;                 ///< as Decomposition has it
  bool coarser = false;                   ///< likewise; not kept in a file
};

/// Pieces that were found before, by a key over the mesh and how it was cut (piece_key). A cache:
/// what is missing, stale or damaged is simply made again.
class PieceCache {
 public:
  /// In memory alone.
  PieceCache() = default;
  /// Backed by a file, which need not be there. A file that cannot be read counts as empty.
  explicit PieceCache(std::filesystem::path file);

  const PieceCorners* find(std::uint64_t key);
  void put(std::uint64_t key, PieceCorners pieces);
  /// Writes what was found or put since the start, when anything was put, and drops the rest.
  Result<void> save();
  Result<void> save_as(const std::filesystem::path& file);

 private:
  std::filesystem::path file_;
  KeyedEntries<PieceCorners> entries_;
};

/// The bytes of a cache file (docs/file-formats.md), and back. Damaged bytes give an error, never
/// a part of the pieces.
std::string to_bytes(const std::map<std::uint64_t, PieceCorners>& entries);
Result<std::map<std::uint64_t, PieceCorners>> read_pieces(std::string_view bytes);

}  // namespace osteon
