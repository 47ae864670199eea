#include "commands/standard_views.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "osteon/base/file.h"

namespace osteon {
namespace {

constexpr std::size_t kWords = 3, kNumbers = 11;
constexpr std::string_view kHeader =
    "name,title,scope,flexion_deg,at_x,at_y,at_z,toward_x,toward_y,toward_z,post_deg,up_x,up_y,"
    "up_z";

Result<StandardView> parse_view_line(const std::string& line, const std::string& where) {
  std::istringstream fields(line);
  std::array<std::string, kWords + kNumbers> field;
  std::size_t count = 0;
  for (std::string text; std::getline(fields, text, ','); ++count)
    if (count < field.size()) field[count] = text;
  if (count != field.size())
    return fail("has " + std::to_string(count) + " columns, not " + std::to_string(field.size()),
                where);
  std::array<double, kNumbers> x{};
  for (std::size_t k = 0; k < kNumbers; ++k) {
    const std::string& text = field[kWords + k];
    char* end = nullptr;
    x[k] = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != 0 || !std::isfinite(x[k]))
      return fail("'" + text + "' is no number", where);
  }
  StandardView view{field[0], field[1], field[2], x[0], {}, {}, {}, x[7]};
  view.at_mm = Vec3(x[1], x[2], x[3]);
  view.toward_mm = Vec3(x[4], x[5], x[6]);
  view.up = Vec3(x[8], x[9], x[10]);
  return view;
}

}  // namespace

Result<std::vector<StandardView>> parse_standard_views(std::string_view text,
                                                       const std::string& where) {
  std::istringstream lines{std::string(text)};
  std::vector<StandardView> views;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string here = where + ", line " + std::to_string(number);
    if (number == 1 && line != kHeader)
      return fail("is not the header of views", here, "it must be " + std::string(kHeader));
    if (number == 1 || line.empty()) continue;
    auto view = parse_view_line(line, here);
    if (!view) return tl::unexpected(view.error());
    views.push_back(std::move(*view));
  }
  if (views.empty()) return fail("holds no view", where);
  return views;
}

Result<std::vector<StandardView>> standard_views(const Case& the_case) {
  const bool knee = the_case.find("femur").valid(), wrist = the_case.find("radius").valid();
  if (!knee && !wrist)
    return fail("has neither a femur nor a radius", the_case.name,
                "Standard views are those of a knee or a wrist; --at and --toward draw any other");
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  const auto file = *data / "assets/views" / (knee ? "knee.csv" : "wrist.csv");
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  return parse_standard_views(*text, file.string());
}

}  // namespace osteon
