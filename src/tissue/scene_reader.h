#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"

namespace osteon {

/// Metres of a millimetre, in which scene files give lengths.
constexpr double kMm = 1e-3;

/// Bounds of a number, both allowed.
struct Within {
  double lo, hi;
};

/// Reads keys of one scene file and keeps the first complaint, with the key's whole name
/// ("run.time_s") and its line. What was complained of comes back as some sound value.
class SceneReader {
 public:
  explicit SceneReader(std::string file) : file_(std::move(file)) {}

  /// A table and its name, to name keys by.
  struct Table {
    const toml::table* keys;
    std::string name;
  };

  Table table(const Table& in, std::string_view key);
  std::vector<Table> tables(const Table& in, std::string_view key);
  /// Refuses other keys than these.
  void only(const Table& in, std::initializer_list<std::string_view> known);
  static bool has(const Table& in, std::string_view key) { return in.keys->contains(key); }

  double number(const Table& in, std::string_view key, Within within);
  double number_or(const Table& in, std::string_view key, Within within, double otherwise);
  int integer(const Table& in, std::string_view key, int lo, int hi);
  bool truth_or(const Table& in, std::string_view key, bool otherwise);
  std::string text(const Table& in, std::string_view key);
  Vec3 vec3(const Table& in, std::string_view key, Within within);
  std::vector<Vec3> points(const Table& in, std::string_view key, Within within);

  void complain(const std::string& what, const Table& in, std::string_view key,
                std::string todo = "See docs/tissue.md");
  const std::optional<Error>& error() const { return error_; }

 private:
  std::optional<Vec3> three(const toml::node* node, Within within) const;

  std::string file_;
  std::optional<Error> error_;
};

/// The text of a scene file as TOML; `name` is how errors call the file.
Result<toml::table> parse_scene_toml(std::string_view text, const std::string& name);
/// The text of a scene file.
Result<std::string> read_scene_file(const std::filesystem::path& path);

}  // namespace osteon
