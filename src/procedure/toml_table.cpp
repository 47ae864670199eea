#include "toml_table.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

std::string quoted_key(std::string_view key) { return "'" + std::string(key) + "'"; }

std::string short_decimal(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

void TomlTable::set_error(std::string what, std::string_view key, std::string todo) {
  if (error_) return;
  const toml::node* node = table_.get(key);
  const auto line = (node ? node->source() : table_.source()).begin.line;
  error_ = Error{std::move(what), where_ + ":" + std::to_string(line), std::move(todo)};
}

const toml::node* TomlTable::find(std::string_view key) {
  asked_.emplace(key);
  const toml::node* node = table_.get(key);
  if (!node) set_error("the key " + quoted_key(key) + " is missing", key);
  return node;
}

std::string TomlTable::text(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return {};
  const auto value = node->value_exact<std::string>();
  if (!value) set_error(quoted_key(key) + " must be text in quotes", key);
  return value.value_or("");
}

std::string TomlTable::text_or(std::string_view key, std::string fallback) {
  asked_.emplace(key);
  return has(key) ? text(key) : fallback;
}

double TomlTable::number(std::string_view key, double lo, double hi) {
  const toml::node* node = find(key);
  if (!node) return lo;
  const bool is_number = node->is_floating_point() || node->is_integer();
  const double value = is_number ? node->value<double>().value_or(NAN) : NAN;
  if (std::isfinite(value) && value >= lo && value <= hi) return value;
  set_error(quoted_key(key) + " must be a number between " + short_decimal(lo) + " and " +
                short_decimal(hi),
            key);
  return lo;
}

double TomlTable::number_or(std::string_view key, double lo, double hi, double fallback) {
  asked_.emplace(key);
  return has(key) ? number(key, lo, hi) : fallback;
}

bool TomlTable::flag_or(std::string_view key, bool fallback) {
  asked_.emplace(key);
  if (!has(key)) return fallback;
  const auto value = table_.get(key)->value_exact<bool>();
  if (!value) set_error(quoted_key(key) + " must be true or false", key);
  return value.value_or(fallback);
}

std::vector<std::string> TomlTable::texts_or_empty(std::string_view key) {
  asked_.emplace(key);
  std::vector<std::string> texts;
  if (!has(key)) return texts;
  const toml::array* array = table_.get(key)->as_array();
  if (!array) set_error(quoted_key(key) + " must be a list of texts", key);
  for (std::size_t i = 0; array && i < array->size(); ++i) {
    const auto value = array->get(i)->value_exact<std::string>();
    if (!value) set_error(quoted_key(key) + " must be a list of texts", key);
    texts.push_back(value.value_or(""));
  }
  return texts;
}

std::vector<TomlTable> TomlTable::tables_or_empty(std::string_view key) {
  asked_.emplace(key);
  std::vector<TomlTable> tables;
  if (!has(key)) return tables;
  const toml::array* array = table_.get(key)->as_array();
  if (!array) set_error(quoted_key(key) + " must be written [[" + std::string(key) + "]]", key);
  for (std::size_t i = 0; array && i < array->size(); ++i) {
    if (const toml::table* table = array->get(i)->as_table())
      tables.emplace_back(*table, where_, error_);
    else
      set_error(quoted_key(key) + " must be written [[" + std::string(key) + "]]", key);
  }
  return tables;
}

std::string TomlTable::word(std::string_view key, std::initializer_list<std::string_view> words,
                            bool may_miss) {
  if (may_miss && !has(key)) {
    asked_.emplace(key);
    return std::string(*words.begin());
  }
  const std::string given = text(key);
  if (std::find(words.begin(), words.end(), given) != words.end()) return given;
  std::string all;
  for (const std::string_view word : words) all += (all.empty() ? "" : ", ") + std::string(word);
  set_error(quoted_key(key) + " must be one of: " + all, key);
  return std::string(*words.begin());
}

void TomlTable::refuse_others() {
  for (const auto& [key, node] : table_)
    if (!asked_.count(key.str()))
      set_error("the key " + quoted_key(key.str()) + " is unknown", key.str(),
                "Check its spelling or remove it");
}

Result<toml::table> parse_procedure_toml(std::string_view text, const std::string& where) {
  try {
    return toml::parse(text, where);
  } catch (const toml::parse_error& e) {
    return fail(std::string("is not TOML (") + std::string(e.description()) + ")",
                where + ":" + std::to_string(e.source().begin.line));
  }
}

}  // namespace osteon
