#include "case/case_toml_reader.h"

#include <algorithm>
#include <cmath>

#include "numbers.h"

namespace osteon {
namespace {

std::string named(std::string_view key) {
  std::string text(1, '\'');
  text.append(key).append(1, '\'');
  return text;
}

}  // namespace

std::string case_toml_place(const std::string& where, const toml::source_region& region) {
  return where + ":" + std::to_string(region.begin.line);
}

void CaseTomlReader::set_error(std::string what, std::string_view key, std::string todo) {
  if (error_) return;
  const toml::node* node = table_.get(key);
  const toml::source_region& region = node ? node->source() : table_.source();
  std::string place = case_toml_place(where_, region);
  if (!title_.empty()) place.append(" (").append(title_).append(")");
  error_ = Error{std::move(what), std::move(place), std::move(todo)};
}

void CaseTomlReader::adopt_error(const CaseTomlReader& other) {
  if (!error_) error_ = other.error_;
}

void CaseTomlReader::allow_only(std::initializer_list<std::string_view> keys) {
  for (const auto& [key, node] : table_) {
    if (std::find(keys.begin(), keys.end(), key.str()) != keys.end()) continue;
    set_error("the key " + named(key.str()) + " is unknown", key.str(),
              "Check its spelling or remove it");
  }
}

const toml::node* CaseTomlReader::find(std::string_view key) {
  const toml::node* node = table_.get(key);
  if (!node) set_error("the key " + named(key) + " is missing", key);
  return node;
}

std::string CaseTomlReader::text(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return {};
  const auto value = node->value_exact<std::string>();
  if (!value) set_error(named(key) + " must be text in quotes", key);
  return value.value_or("");
}

std::string CaseTomlReader::text_or(std::string_view key, std::string fallback) {
  return has(key) ? text(key) : fallback;
}

bool CaseTomlReader::flag_or(std::string_view key, bool fallback) {
  const toml::node* node = has(key) ? find(key) : nullptr;
  if (!node) return fallback;
  const auto* flag = node->as_boolean();
  if (!flag) set_error(named(key) + " must be true or false", key);
  return flag ? flag->get() : fallback;
}

double CaseTomlReader::as_number(const toml::node& node, std::string_view key, NumberRange range) {
  double value = 0;
  if (const auto* floating = node.as_floating_point()) {
    value = floating->get();
  } else if (const auto* integer = node.as_integer()) {
    value = static_cast<double>(integer->get());
  } else {
    set_error(named(key) + " must be a number", key);
    return range.lo;
  }
  if (std::isfinite(value) && value >= range.lo && value <= range.hi) return value;
  set_error(named(key) + " must lie between " + format_number(range.lo) + " and " +
                format_number(range.hi),
            key);
  return range.lo;
}

double CaseTomlReader::number(std::string_view key, NumberRange range) {
  const toml::node* node = find(key);
  return node ? as_number(*node, key, range) : range.lo;
}

double CaseTomlReader::number_or(std::string_view key, NumberRange range, double fallback) {
  return has(key) ? number(key, range) : fallback;
}

int CaseTomlReader::integer_or(std::string_view key, NumberRange range, int fallback) {
  if (!has(key)) return fallback;
  if (!table_.get(key)->is_integer()) set_error(named(key) + " must be a whole number", key);
  return static_cast<int>(number(key, range));
}

std::vector<double> CaseTomlReader::numbers(std::string_view key, std::size_t size,
                                            NumberRange range) {
  std::vector<double> values(size, 0);
  const toml::node* node = find(key);
  if (!node) return values;
  const toml::array* array = node->as_array();
  if (!array || array->size() != size) {
    set_error(named(key) + " must be " + std::to_string(size) + " numbers in square brackets", key);
    return values;
  }
  for (std::size_t i = 0; i < size; ++i) values[i] = as_number(*array->get(i), key, range);
  return values;
}

std::vector<std::vector<double>> CaseTomlReader::rows_or_empty(std::string_view key,
                                                               std::size_t width,
                                                               NumberRange range) {
  std::vector<std::vector<double>> rows;
  const toml::node* node = table_.get(key);
  if (!node) return rows;
  const toml::array* array = node->as_array();
  const std::string wanted =
      named(key) + " must hold " + std::to_string(width) + " numbers in square brackets each";
  if (!array) set_error(wanted, key);
  for (std::size_t i = 0; array && i < array->size(); ++i) {
    const toml::array* row = array->get(i)->as_array();
    if (!row || row->size() != width) {
      set_error(wanted, key);
      return rows;
    }
    std::vector<double> values;
    for (const toml::node& entry : *row) values.push_back(as_number(entry, key, range));
    rows.push_back(std::move(values));
  }
  return rows;
}

Vec3 CaseTomlReader::position(std::string_view key) {
  const std::vector<double> p = numbers(key, 3, {-100, 100});
  return {p[0], p[1], p[2]};
}

std::vector<std::string> CaseTomlReader::texts_or_empty(std::string_view key) {
  std::vector<std::string> texts;
  const toml::node* node = table_.get(key);
  if (!node) return texts;
  const toml::array* array = node->as_array();
  if (!array) {
    set_error(named(key) + " must be texts in square brackets", key);
    return texts;
  }
  for (const toml::node& entry : *array) {
    if (const auto text = entry.value_exact<std::string>())
      texts.push_back(*text);
    else
      set_error(named(key) + " must be texts in square brackets", key);
  }
  return texts;
}

const toml::table* CaseTomlReader::table_or_null(std::string_view key) {
  const toml::node* node = table_.get(key);
  if (!node) return nullptr;
  if (!node->is_table()) set_error(named(key) + " must be a table", key);
  return node->as_table();
}

std::vector<const toml::table*> CaseTomlReader::tables_or_empty(std::string_view key) {
  std::vector<const toml::table*> tables;
  const toml::node* node = table_.get(key);
  if (!node) return tables;
  const toml::array* array = node->as_array();
  if (!array) {
    set_error(named(key) + " must be written as [[" + std::string(key) + "]]", key);
    return tables;
  }
  for (const toml::node& entry : *array) {
    if (entry.is_table())
      tables.push_back(entry.as_table());
    else
      set_error(named(key) + " must hold tables only", key);
  }
  return tables;
}

}  // namespace osteon
