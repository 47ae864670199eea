#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "osteon/base/result.h"
#include "osteon/collide/distance_field.h"
#include "osteon/scene/keyed_entries.h"

namespace osteon {

/// Key of a mesh's distance field; changes with the way of making it.
std::uint64_t field_key(const TriMesh& mesh, const FieldOptions& options = {});

/// Distance fields that were made before, by field_key. A cache, as PieceCache is: what is missing,
/// stale or damaged is simply made again.
class FieldCache {
 public:
  using Field = std::shared_ptr<const DistanceField>;

  /// In memory alone.
  FieldCache() = default;
  /// Backed by a file, which need not be there. A file that cannot be read counts as empty. It is
  /// read when a field is first asked for: most cases need none.
  explicit FieldCache(std::filesystem::path file);

  Field find(std::uint64_t key);
  void put(std::uint64_t key, Field field);
  /// Writes what was found or put since the start, when anything was put, and drops the rest.
  Result<void> save();
  Result<void> save_as(const std::filesystem::path& file);

 private:
  void read_file_once();

  std::filesystem::path file_;
  bool read_ = false;
  KeyedEntries<Field> entries_;
};

/// The bytes of a cache file (docs/file-formats.md), and back. Damaged bytes give an error, never a
/// part of the fields.
std::string to_bytes(const std::map<std::uint64_t, FieldCache::Field>& entries);
Result<std::map<std::uint64_t, FieldCache::Field>> read_fields(std::string_view bytes);

}  // namespace osteon
