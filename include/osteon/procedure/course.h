#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"

namespace osteon {

/// An exercise that is set, and on which patient.
struct CourseUnit {
  std::string exercise;               ///< its name
  std::optional<std::uint64_t> seed;  ///< none: the built-in patient
};

/// The exercises that an instructor has set, in their order: data, course.toml.
struct Course {
  std::string title;
  std::vector<CourseUnit> units;
};

/// Reads `format = 1`, `title` (optional) and `exercises = ["NAME", "NAME:SEED", ...]`. Fails, with
/// the line, on any other key, on an empty list, and on a seed that is no whole number.
Result<Course> parse_course(std::string_view text, const std::string& where);
Result<Course> load_course(const std::filesystem::path& file);

}  // namespace osteon
