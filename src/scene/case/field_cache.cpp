#include "osteon/scene/field_cache.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "case/cache_bytes.h"
#include "case/mesh_hash.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

using cache::Reader;
using cache::write;

// Counts up with every change of the field's making that changes its bits.
constexpr std::uint32_t kFieldVersion = 1;
constexpr std::string_view kMagic = "OSTNFLD1";
constexpr std::uint64_t kMostBytes = 1ull << 32;

void write_point(std::string& out, const Vec3& p) {
  for (Eigen::Index k = 0; k < 3; ++k) write(out, p[k]);
}

template <class T>
void write_list(std::string& out, const std::vector<T>& list) {
  write(out, static_cast<std::uint32_t>(list.size()));
  out.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T));
}

void write_field(std::string& out, const FieldData& d) {
  for (const double x : {d.cell_m, d.step_m, d.outside_m, d.inside_m}) write(out, x);
  write_point(out, d.box.lo);
  write_point(out, d.box.hi);
  write_point(out, d.lo);
  for (const std::int32_t n : d.blocks) write(out, n);
  write_list(out, d.middle);
  write_list(out, d.stored);
  write_list(out, d.height);
}

Vec3 read_point(Reader& reader) {
  Vec3 p;
  for (Eigen::Index k = 0; k < 3; ++k) p[k] = reader.read<double>();
  return p;
}

template <class T>
void read_list(Reader& reader, std::vector<T>& list) {
  list.resize(reader.count(sizeof(T)));
  for (T& value : list) value = reader.read<T>();
}

FieldData read_field(Reader& reader) {
  FieldData d;
  for (double* x : {&d.cell_m, &d.step_m, &d.outside_m, &d.inside_m}) *x = reader.read<double>();
  d.box.lo = read_point(reader);
  d.box.hi = read_point(reader);
  d.lo = read_point(reader);
  for (std::int32_t& n : d.blocks) n = reader.read<std::int32_t>();
  read_list(reader, d.middle);
  read_list(reader, d.stored);
  read_list(reader, d.height);
  return d;
}

}  // namespace

std::uint64_t field_key(const TriMesh& mesh, const FieldOptions& options) {
  Hasher hasher;
  hasher.add(kFieldVersion);
  for (const double x : {options.cell_m, options.outside_m, options.inside_m}) hasher.add(x);
  hasher.add(static_cast<std::uint64_t>(options.most_blocks));
  add_mesh(hasher, mesh);
  return hasher.value();
}

std::string to_bytes(const std::map<std::uint64_t, FieldCache::Field>& entries) {
  std::string out(kMagic);
  write(out, static_cast<std::uint32_t>(entries.size()));
  for (const auto& [key, field] : entries) {
    write(out, key);
    write_field(out, field->data());
  }
  write(out, cache::checksum(out));
  return out;
}

Result<std::map<std::uint64_t, FieldCache::Field>> read_fields(std::string_view bytes) {
  std::string_view body;
  if (!cache::open(bytes, kMagic, body)) return fail("is not a complete file of fields");
  Reader reader(body);
  std::map<std::uint64_t, FieldCache::Field> out;
  const auto count = reader.count(sizeof(std::uint64_t));
  for (std::uint32_t i = 0; i < count && !reader.failed(); ++i) {
    const auto key = reader.read<std::uint64_t>();
    FieldCache::Field field = DistanceField::from(read_field(reader));
    if (!field) return fail("it is damaged");
    out[key] = std::move(field);
  }
  if (reader.failed() || !reader.at_end()) return fail("it is damaged");
  return out;
}

FieldCache::FieldCache(std::filesystem::path file) : file_(std::move(file)) {}

void FieldCache::read_file_once() {
  if (read_ || file_.empty()) return;
  read_ = true;
  const auto bytes = read_file(file_, kMostBytes);
  if (!bytes) return;
  auto read = read_fields(*bytes);
  if (!read) return;
  entries_.take(std::move(*read));
}

FieldCache::Field FieldCache::find(std::uint64_t key) {
  read_file_once();
  const Field* found = entries_.find(key);
  return found ? *found : nullptr;
}

void FieldCache::put(std::uint64_t key, Field field) {
  read_file_once();
  entries_.put(key, std::move(field));
}

Result<void> FieldCache::save() { return file_.empty() ? Result<void>() : save_as(file_); }

Result<void> FieldCache::save_as(const std::filesystem::path& file) {
  return cache::save_entries(entries_, file, [](const auto& used) { return to_bytes(used); });
}

}  // namespace osteon
