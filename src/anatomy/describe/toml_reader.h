#pragma once

#include <toml++/toml.h>

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"

namespace osteon {

/// Metres in a millimetre, the unit of descriptions.
inline constexpr double kMm = 0.001;

/// Range of a number, both ends allowed.
struct Range {
  double lo, hi;
};

/// Parses a text; toml++ reports by exceptions, which go no further than here.
Result<toml::table> parse_toml(std::string_view text, const std::string& file);

/// Reads one TOML table key by key. The first mistake is kept; the calls after it return defaults,
/// so that a reader of many keys checks once, at `finish`.
class TomlReader {
 public:
  TomlReader(const toml::table& table, std::string where)
      : table_(table), where_(std::move(where)) {}

  bool has(const std::string& key) const { return table_.contains(key); }
  std::string text(const std::string& key);
  /// None where the key is absent.
  std::vector<std::string> texts(const std::string& key);
  bool flag_or(const std::string& key, bool otherwise);
  int integer(const std::string& key, int lo, int hi);
  double number(const std::string& key, Range range);
  double number_or(const std::string& key, Range range, double otherwise);
  std::vector<double> numbers(const std::string& key, Range range);
  Vec3 vec3(const std::string& key, Range range);
  Vec3 vec3_or(const std::string& key, Range range, const Vec3& otherwise);
  std::vector<Vec3> points(const std::string& key, Range range);
  /// Tables of an array of tables; none where the key is absent and `required` is false.
  std::vector<const toml::table*> tables(const std::string& key, bool required);

  void reject(const std::string& what, const std::string& key);
  bool failed() const { return error_.has_value(); }
  /// The first mistake, or that of a key that nothing asked for.
  Result<void> finish();
  const std::string& where() const { return where_; }

 private:
  const toml::node* find(const std::string& key);
  std::optional<double> finite_in(const toml::node& node, Range range, const std::string& key);

  const toml::table& table_;
  std::string where_;
  std::set<std::string> asked_;
  std::optional<Error> error_;
};

/// Reads every table of the array `key` of `in`, which may be missing, with `read`; each strictly.
template <class Entry>
Result<void> read_entries(TomlReader& in, const std::string& key, Entry (*read)(TomlReader&),
                          std::vector<Entry>& entries) {
  std::size_t n = 0;
  for (const toml::table* table : in.tables(key, false)) {
    TomlReader entry(*table, in.where() + ", " + key + " " + std::to_string(++n));
    entries.push_back(read(entry));
    if (auto ok = entry.finish(); !ok) return ok;
  }
  return {};
}

}  // namespace osteon
