#pragma once

#include <toml++/toml.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "osteon/base/result.h"
#include "osteon/device/haptic_device.h"

namespace osteon {

/// Reads keys of one profile and keeps the first complaint, with its line. A value that was
/// complained of comes back as some value in range.
class ProfileReader {
 public:
  ProfileReader(const toml::table& root, std::string file) : root_(root), file_(std::move(file)) {}

  // Refuses keys of `table` that are not in `known`.
  void only(const toml::table& table, std::initializer_list<std::string_view> known) {
    for (const auto& [key, node] : table) {
      bool found = false;
      for (const std::string_view k : known) found = found || (!k.empty() && k == key.str());
      if (!found) complain("unknown key '" + std::string(key.str()) + "'", &node, "Remove it");
    }
  }

  const toml::table& table(std::string_view name) {
    static const toml::table empty;
    const toml::table* t = root_[name].as_table();
    if (!t) complain("table [" + std::string(name) + "] is missing", &root_, "Add it");
    return t ? *t : empty;
  }

  /// A table inside another.
  const toml::table& table(const toml::table& in, std::string_view name) {
    static const toml::table empty;
    const auto* node = in.get(name);
    if (node && node->is_table()) return *node->as_table();
    complain("table [" + std::string(name) + "] is missing", node ? node : &in, "Add it");
    return empty;
  }

  std::string text(const toml::table& table, std::string_view key) {
    const auto* node = table.get(key);
    const auto value = node ? node->value_exact<std::string>() : std::nullopt;
    if (!value || value->empty()) complain(quoted(key) + " must be a text", node ? node : &table);
    return value.value_or("");
  }

  /// One of `allowed`; its index.
  std::size_t choice(const toml::table& table, std::string_view key,
                     std::initializer_list<std::string_view> allowed) {
    const std::string value = text(table, key);
    std::string known;
    std::size_t i = 0;
    for (const std::string_view a : allowed) {
      if (value == a) return i;
      known += (i++ ? ", " : "") + std::string(a);
    }
    complain(quoted(key) + " must be one of: " + known, table.get(key));
    return 0;
  }

  std::int64_t integer(const toml::table& table, std::string_view key, std::int64_t lo,
                       std::int64_t hi) {
    const auto* node = table.get(key);
    const auto value = node ? node->value_exact<std::int64_t>() : std::nullopt;
    if (value && *value >= lo && *value <= hi) return *value;
    complain(quoted(key) + " must be a whole number from " + std::to_string(lo) + " to " +
                 std::to_string(hi),
             node ? node : &table);
    return lo;
  }

  double number(const toml::table& table, std::string_view key, double lo, double hi) {
    const auto* node = table.get(key);
    const auto value = node && node->is_number() ? node->value<double>() : std::nullopt;
    if (!value || !(*value >= lo && *value <= hi)) {
      complain(quoted(key) + " must be a number from " + short_form(lo) + " to " + short_form(hi),
               node ? node : &table);
      return lo;
    }
    return *value;
  }

  std::array<bool, 3> axes(const toml::table& table, std::string_view key) {
    std::array<bool, 3> out{};
    const toml::array* a = three(table, key);
    for (std::size_t i = 0; a && i < 3; ++i) {
      const auto value = (*a)[i].value_exact<bool>();
      if (!value) complain(quoted(key) + " must be three of true or false", a);
      out[i] = value.value_or(false);
    }
    return out;
  }

  Vec3 lengths_mm(const toml::table& table, std::string_view key) {
    Vec3 out = Vec3::Zero();
    const toml::array* a = three(table, key);
    for (std::size_t i = 0; a && i < 3; ++i) {
      const double mm = (*a)[i].is_number() ? (*a)[i].value<double>().value_or(0) : 0;
      if (!(mm > 0 && mm <= 5000))
        complain(quoted(key) + " must be three lengths above 0 and up to 5000 mm", a);
      out[static_cast<Eigen::Index>(i)] = 1e-3 * mm;
    }
    return out;
  }

  void complain(const std::string& what, const toml::node* at, std::string todo = {}) {
    if (error_) return;
    const auto line = at ? at->source().begin.line : 0;
    const std::string where = line > 0 ? file_ + ", line " + std::to_string(line) : file_;
    if (todo.empty()) todo = "Compare with the profiles in assets/devices";
    error_ = Error{what, where, std::move(todo)};
  }

  const std::optional<Error>& error() const { return error_; }

 private:
  static std::string quoted(std::string_view key) {
    std::string s(1, '\'');
    s.append(key).push_back('\'');
    return s;
  }

  static std::string short_form(double x) {
    std::string s = std::to_string(x);
    s.erase(s.find_last_not_of('0') + 1);
    if (s.back() == '.') s.pop_back();
    return s;
  }

  const toml::array* three(const toml::table& table, std::string_view key) {
    const auto* node = table.get(key);
    const toml::array* a = node ? node->as_array() : nullptr;
    if (a && a->size() == 3) return a;
    complain(quoted(key) + " must be a list of three", node ? node : &table);
    return nullptr;
  }

  const toml::table& root_;
  std::string file_;
  std::optional<Error> error_;
};

/// The file as TOML; an error names its line.
Result<toml::table> parse_profile(const std::filesystem::path& path);

/// The keys that every profile has. Beside them only a table named `driver_table` is allowed at the
/// root: what the device's own driver needs. Empty: none.
DeviceInfo read_device_info(ProfileReader& in, const toml::table& root,
                            std::string_view driver_table);

}  // namespace osteon
