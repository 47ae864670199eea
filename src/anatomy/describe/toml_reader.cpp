#include "describe/toml_reader.h"

#include <cmath>
#include <cstdio>

namespace osteon {
namespace {

std::string shown(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", v);
  return text;
}

}  // namespace

void TomlReader::reject(const std::string& what, const std::string& key) {
  if (!error_) error_ = Error{"key '" + key + "' " + what, where_, ""};
}

const toml::node* TomlReader::find(const std::string& key) {
  asked_.insert(key);
  const toml::node* node = table_.get(key);
  if (!node) reject("is missing", key);
  return node;
}

std::optional<double> TomlReader::finite_in(const toml::node& node, Range range,
                                            const std::string& key) {
  const auto v = node.is_number() ? node.value<double>() : std::nullopt;
  if (!v || !std::isfinite(*v)) {
    reject("must hold finite numbers", key);
    return std::nullopt;
  }
  if (*v < range.lo || *v > range.hi) {
    reject(
        "must lie between " + shown(range.lo) + " and " + shown(range.hi) + ", not be " + shown(*v),
        key);
    return std::nullopt;
  }
  return v;
}

std::string TomlReader::text(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) return {};
  const auto v = node->value_exact<std::string>();
  if (!v || v->empty()) reject("must be a text that is not empty", key);
  return v.value_or("");
}

std::vector<std::string> TomlReader::texts(const std::string& key) {
  asked_.insert(key);
  std::vector<std::string> found;
  if (!has(key)) return found;
  const toml::array* array = table_.get(key)->as_array();
  if (!array) reject("must be a list of texts", key);
  for (std::size_t i = 0; array && i < array->size(); ++i) {
    const auto v = array->get(i)->value_exact<std::string>();
    if (!v) reject("must be a list of texts", key);
    found.push_back(v.value_or(""));
  }
  return found;
}

bool TomlReader::flag_or(const std::string& key, bool otherwise) {
  asked_.insert(key);
  if (!has(key)) return otherwise;
  const auto v = table_.get(key)->value_exact<bool>();
  if (!v) reject("must be true or false", key);
  return v.value_or(otherwise);
}

int TomlReader::integer(const std::string& key, int lo, int hi) {
  const toml::node* node = find(key);
  if (!node) return lo;
  const auto v = node->value_exact<std::int64_t>();
  if (v && *v >= lo && *v <= hi) return static_cast<int>(*v);
  reject("must be a whole number from " + std::to_string(lo) + " to " + std::to_string(hi), key);
  return lo;
}

double TomlReader::number(const std::string& key, Range range) {
  const toml::node* node = find(key);
  return node ? finite_in(*node, range, key).value_or(range.lo) : range.lo;
}

double TomlReader::number_or(const std::string& key, Range range, double otherwise) {
  asked_.insert(key);
  return has(key) ? number(key, range) : otherwise;
}

std::vector<double> TomlReader::numbers(const std::string& key, Range range) {
  const toml::node* node = find(key);
  if (!node) return {};
  const toml::array* array = node->as_array();
  if (!array || array->empty()) {
    reject("must be a list of numbers", key);
    return {};
  }
  std::vector<double> values;
  for (const toml::node& element : *array)
    values.push_back(finite_in(element, range, key).value_or(range.lo));
  return values;
}

Vec3 TomlReader::vec3(const std::string& key, Range range) {
  const std::vector<double> v = numbers(key, range);
  if (v.size() == 3) return {v[0], v[1], v[2]};
  reject("must be a list of three numbers", key);
  return Vec3::Zero();
}

Vec3 TomlReader::vec3_or(const std::string& key, Range range, const Vec3& otherwise) {
  asked_.insert(key);
  return has(key) ? vec3(key, range) : otherwise;
}

std::vector<Vec3> TomlReader::points(const std::string& key, Range range) {
  const toml::node* node = find(key);
  const toml::array* array = node ? node->as_array() : nullptr;
  if (node && (!array || array->size() < 2)) reject("must be a list of two points or more", key);
  std::vector<Vec3> points;
  if (!array) return points;
  for (const toml::node& element : *array) {
    const toml::array* p = element.as_array();
    if (!p || p->size() != 3) {
      reject("must hold points of three numbers", key);
      return {};
    }
    Vec3 point;
    for (std::size_t k = 0; k < 3; ++k)
      point[static_cast<int>(k)] = finite_in(*p->get(k), range, key).value_or(0.0);
    points.push_back(point);
  }
  return points;
}

std::vector<const toml::table*> TomlReader::tables(const std::string& key, bool required) {
  asked_.insert(key);
  std::vector<const toml::table*> found;
  const toml::node* node = table_.get(key);
  if (!node && !required) return found;
  const toml::array* array = node ? node->as_array() : nullptr;
  if (!array || array->empty()) {
    reject(node ? "must be a list of tables" : "is missing", key);
    return found;
  }
  for (const toml::node& element : *array) {
    if (!element.is_table()) {
      reject("must hold tables only", key);
      return {};
    }
    found.push_back(element.as_table());
  }
  return found;
}

Result<void> TomlReader::finish() {
  if (!error_)
    for (const auto& [key, value] : table_)
      if (!asked_.contains(std::string(key.str()))) {
        reject("is not known here", std::string(key.str()));
        break;
      }
  if (error_) return tl::unexpected(*error_);
  return {};
}

Result<toml::table> parse_toml(std::string_view text, const std::string& file) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    return fail("is not TOML: " + std::string(error.description()),
                file + ": line " + std::to_string(error.source().begin.line));
  }
}

}  // namespace osteon
