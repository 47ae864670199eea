#include "osteon/procedure/course.h"

#include <charconv>

#include "osteon/base/file.h"
#include "toml_table.h"

namespace osteon {
namespace {

std::optional<CourseUnit> unit_of(const std::string& text) {
  const auto colon = text.find(':');
  CourseUnit unit{text.substr(0, colon), {}};
  if (unit.exercise.empty()) return std::nullopt;
  if (colon == std::string::npos) return unit;
  std::uint64_t seed = 0;
  const char *first = text.data() + colon + 1, *last = text.data() + text.size();
  const auto [end, fault] = std::from_chars(first, last, seed);
  if (fault != std::errc{} || end != last) return std::nullopt;
  unit.seed = seed;
  return unit;
}

}  // namespace

Result<Course> parse_course(std::string_view text, const std::string& where) {
  const auto parsed = parse_procedure_toml(text, where);
  if (!parsed) return tl::unexpected(parsed.error());
  std::optional<Error> error;
  TomlTable table(*parsed, where, error);
  Course course;
  table.number("format", 1, 1);
  course.title = table.text_or("title", "");
  for (const std::string& words : table.texts_or_empty("exercises")) {
    const auto unit = unit_of(words);
    if (unit)
      course.units.push_back(*unit);
    else
      table.set_error("'" + words + "' names no exercise", "exercises", "Use NAME or NAME:SEED");
  }
  if (course.units.empty()) table.set_error("a course needs exercises", "exercises");
  table.refuse_others();
  if (error) return tl::unexpected(*error);
  return course;
}

Result<Course> load_course(const std::filesystem::path& file) {
  const auto text = read_file(file, 1u << 20);
  if (!text) return tl::unexpected(text.error());
  return parse_course(*text, file.string());
}

}  // namespace osteon
