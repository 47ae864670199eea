#pragma once

#include <toml++/toml.h>

#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"

namespace osteon {

/// Strict reading of one TOML table: every key must be asked for, a number must lie in its range.
/// The first thing wrong is kept in the error that all tables of one file share; later calls do
/// nothing.
class TomlTable {
 public:
  TomlTable(const toml::table& table, std::string where, std::optional<Error>& error)
      : table_(table), where_(std::move(where)), error_(error) {}

  bool has(std::string_view key) const { return table_.contains(key); }
  int line() const { return static_cast<int>(table_.source().begin.line); }
  std::string text(std::string_view key);
  std::string text_or(std::string_view key, std::string fallback);
  double number(std::string_view key, double lo, double hi);
  double number_or(std::string_view key, double lo, double hi, double fallback);
  bool flag_or(std::string_view key, bool fallback);
  std::vector<std::string> texts_or_empty(std::string_view key);
  std::vector<TomlTable> tables_or_empty(std::string_view key);
  /// One of the words; the first where the key is missing and `may_miss`.
  std::string word(std::string_view key, std::initializer_list<std::string_view> words,
                   bool may_miss = false);
  /// Call last: a key that nothing asked for is an error.
  void refuse_others();
  void set_error(std::string what, std::string_view key, std::string todo = {});

 private:
  const toml::node* find(std::string_view key);
  const toml::table& table_;
  std::string where_;
  std::optional<Error>& error_;
  std::set<std::string, std::less<>> asked_;
};

/// The text as a table, or where it is no TOML.
Result<toml::table> parse_procedure_toml(std::string_view text, const std::string& where);

}  // namespace osteon
