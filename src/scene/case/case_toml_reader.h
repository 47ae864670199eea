#pragma once

#include <toml++/toml.h>

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"

namespace osteon {

struct NumberRange {
  double lo = 0;
  double hi = 0;
};

/// Strict reading of one TOML table. The first thing wrong is kept as the error, later calls do
/// nothing: read all fields, then look at `error()` once.
class CaseTomlReader {
 public:
  /// `where` names the file; `title` the table ("bone 3").
  CaseTomlReader(const toml::table& table, std::string where, std::string title)
      : table_(table), where_(std::move(where)), title_(std::move(title)) {}

  /// An unknown key is an error.
  void allow_only(std::initializer_list<std::string_view> keys);

  std::string text(std::string_view key);
  std::string text_or(std::string_view key, std::string fallback);
  bool flag_or(std::string_view key, bool fallback);
  double number(std::string_view key, NumberRange range);
  double number_or(std::string_view key, NumberRange range, double fallback);
  int integer_or(std::string_view key, NumberRange range, int fallback);
  /// Array of exactly `size` numbers.
  std::vector<double> numbers(std::string_view key, std::size_t size, NumberRange range);
  /// Array of arrays of exactly `width` numbers; empty when absent.
  std::vector<std::vector<double>> rows_or_empty(std::string_view key, std::size_t width,
                                                 NumberRange range);
  Vec3 position(std::string_view key);
  /// Empty when absent.
  std::vector<std::string> texts_or_empty(std::string_view key);
  const toml::table* table_or_null(std::string_view key);
  std::vector<const toml::table*> tables_or_empty(std::string_view key);

  bool has(std::string_view key) const { return table_.contains(key); }
  void set_error(std::string what, std::string_view key, std::string todo = {});
  void adopt_error(const CaseTomlReader& other);
  const std::optional<Error>& error() const { return error_; }

 private:
  const toml::node* find(std::string_view key);
  double as_number(const toml::node& node, std::string_view key, NumberRange range);

  const toml::table& table_;
  std::string where_;
  std::string title_;
  std::optional<Error> error_;
};

/// "file:line" of a place in a TOML file.
std::string case_toml_place(const std::string& where, const toml::source_region& region);

}  // namespace osteon
