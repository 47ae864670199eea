#include "commands/support/pose_table.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace osteon {
namespace {

constexpr std::size_t kColumns = 7;
using Fields = std::array<std::string_view, kColumns>;

std::string_view trimmed(std::string_view s) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!s.empty() && is_space(s.front())) s.remove_prefix(1);
  while (!s.empty() && is_space(s.back())) s.remove_suffix(1);
  return s;
}

// Splits at commas; returns how many fields there are, whatever the room.
std::size_t split(std::string_view line, Fields& fields) {
  std::size_t count = 0;
  for (;; ++count) {
    const std::size_t comma = line.find(',');
    if (count < kColumns) fields[count] = trimmed(line.substr(0, comma));
    if (comma == std::string_view::npos) return count + 1;
    line.remove_prefix(comma + 1);
  }
}

bool is_header(std::string_view line) {
  const std::string_view first = trimmed(line.substr(0, line.find(',')));
  return !first.empty() &&
         ((first[0] >= 'a' && first[0] <= 'z') || (first[0] >= 'A' && first[0] <= 'Z')) &&
         first != "nan" && first != "NaN" && first != "inf";
}

Result<void> check_header(const Fields& fields, std::size_t count, const std::string& where) {
  Fields expected;
  split(kPoseColumns, expected);
  const std::string todo = "The columns are " + std::string(kPoseColumns);
  for (std::size_t k = 0; k < kColumns; ++k) {
    if (k >= count) return fail("column " + std::string(expected[k]) + " is missing", where, todo);
    if (fields[k] != expected[k])
      return fail("column " + std::to_string(k + 1) + " is \"" + std::string(fields[k]) +
                      "\" instead of \"" + std::string(expected[k]) + "\"",
                  where, todo);
  }
  if (count > kColumns) return fail("there are more than 7 columns", where, todo);
  return {};
}

Result<double> number(std::string_view text, std::string_view column, const std::string& where) {
  const std::string name = std::string(column) + " is \"" + std::string(text) + "\"";
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    return fail(name + ", which is not a number", where);
  if (!std::isfinite(value)) return fail(name + ", which is not finite", where);
  return value;
}

Result<Pose> pose_of(const Fields& fields, std::size_t count, const std::string& where) {
  if (count != kColumns)
    return fail("has " + std::to_string(count) + " columns instead of 7", where,
                "The columns are " + std::string(kPoseColumns));
  Fields columns;
  split(kPoseColumns, columns);
  std::array<double, kColumns> v{};
  for (std::size_t k = 0; k < kColumns; ++k) {
    const auto value = number(fields[k], columns[k], where);
    if (!value) return tl::unexpected(value.error());
    v[k] = *value;
  }
  const double largest = std::max({std::abs(v[3]), std::abs(v[4]), std::abs(v[5]), std::abs(v[6])});
  if (largest == 0)
    return fail("the quaternion has length zero", where, "Without rotation it is 1,0,0,0");
  const Quat q(v[3] / largest, v[4] / largest, v[5] / largest, v[6] / largest);
  return Pose{Vec3(v[0], v[1], v[2]) * 1e-3, q.normalized()};
}

}  // namespace

Result<std::vector<Pose>> parse_pose_table(std::string_view text, std::string_view where) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::vector<Pose> poses;
  bool first = true;
  for (std::size_t line_number = 1; !text.empty(); ++line_number) {
    const std::size_t end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty()) continue;
    const std::string at = std::string(where) + " line " + std::to_string(line_number);
    Fields fields;
    const std::size_t count = split(line, fields);
    if (first && is_header(line)) {
      if (auto ok = check_header(fields, count, at); !ok) return tl::unexpected(ok.error());
    } else {
      const auto pose = pose_of(fields, count, at);
      if (!pose) return tl::unexpected(pose.error());
      poses.push_back(*pose);
    }
    first = false;
  }
  if (poses.empty()) return fail("holds no poses", std::string(where));
  return poses;
}

}  // namespace osteon
