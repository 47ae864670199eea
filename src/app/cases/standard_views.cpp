#include "cases/standard_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <sstream>
#include <utility>

#include "cases/colour_softs.h"
#include "cases/open_case.h"
#include "cases/pose_case.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

constexpr std::string_view kViewsHeader =
    "name,title,scope,finding,shows,flexion_deg,at_x,at_y,at_z,toward_x,toward_y,toward_z,post_deg,"
    "up_x,up_y,up_z";
constexpr std::size_t kViewWords = 5, kViewNumbers = 11;

Result<StandardView> parse_view_line(const std::string& line, const std::string& where) {
  std::istringstream fields(line);
  std::array<std::string, kViewWords + kViewNumbers> field;
  std::size_t count = 0;
  for (std::string text; std::getline(fields, text, ','); ++count)
    if (count < field.size()) field[count] = text;
  if (count != field.size())
    return fail("has " + std::to_string(count) + " columns, not " + std::to_string(field.size()),
                where);
  std::array<double, kViewNumbers> x{};
  for (std::size_t k = 0; k < kViewNumbers; ++k) {
    const std::string& text = field[kViewWords + k];
    char* end = nullptr;
    x[k] = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != 0 || !std::isfinite(x[k]))
      return fail("'" + text + "' is not a number", where);
  }
  StandardView view{field[0], field[1], field[2], x[0], field[3], {}, {}};
  view.pose.at_W = 0.001 * Vec3(x[1], x[2], x[3]);
  view.pose.toward_W = 0.001 * Vec3(x[4], x[5], x[6]);
  view.pose.post_rad = x[7] * std::numbers::pi / 180;
  view.pose.up_W = Vec3(x[8], x[9], x[10]);
  std::istringstream shown(field[4]);
  for (std::string part; shown >> part;) view.shows.push_back(part);
  // It becomes the name of a file.
  if (view.name.empty() || view.name.find('/') != std::string::npos ||
      (view.pose.toward_W - view.pose.at_W).cross(view.pose.up_W).norm() < 1e-6)
    return fail("needs a name without '/', and a shaft that is not parallel to 'up'", where);
  return view;
}

bool has_finding(const CaseDef& def, const std::string& finding) {
  return std::any_of(def.findings.begin(), def.findings.end(),
                     [&](const CaseFinding& f) { return f.name + "=" + f.grade == finding; });
}

bool is_bent_to(const CaseDef& def, double flexion_deg) {
  if (!def.recipe) return false;
  double now = 0;
  for (const auto& [name, value] : def.recipe->set)
    if (name == "flexion_deg") now = value;
  return now == flexion_deg;
}

Result<void> add_finding(const std::string& finding, CaseDef& def) {
  const std::size_t equals = finding.find('=');
  if (equals == std::string::npos)
    return fail("'" + finding + "' is not a finding", "a view", "Write FINDING=GRADE");
  if (!def.recipe)
    return fail("it does not record how it was generated, so no finding can be added",
                "case '" + def.name + "'", "Make the patient with osteon anatomy make");
  def.recipe->findings.emplace_back(finding.substr(0, equals), finding.substr(equals + 1));
  return {};
}

}  // namespace

Result<std::vector<StandardView>> parse_standard_views(std::string_view text,
                                                       const std::string& where) {
  std::istringstream lines{std::string(text)};
  std::vector<StandardView> views;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string here = where + ", line " + std::to_string(number);
    if (number == 1 && line != kViewsHeader)
      return fail("is not the header of a table of views", here,
                  "It must be " + std::string(kViewsHeader));
    if (number == 1 || line.empty()) continue;
    auto view = parse_view_line(line, here);
    if (!view) return tl::unexpected(view.error());
    views.push_back(std::move(*view));
  }
  if (views.empty()) return fail("holds no view", where);
  return views;
}

Result<std::vector<StandardView>> standard_views(const CaseDef& def) {
  const auto has = [&](std::string_view bone) {
    return std::any_of(def.bones.begin(), def.bones.end(),
                       [&](const BoneDef& b) { return b.name == bone; });
  };
  const bool knee = has("femur");
  if (!knee && !has("radius"))
    return fail("has neither a femur nor a radius", "case '" + def.name + "'",
                "Standard views are those of a knee or a wrist; --at and --toward draw any other");
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  const auto file = *data / "assets/views" / (knee ? "knee.csv" : "wrist.csv");
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  return parse_standard_views(*text, file.string());
}

Result<Case> open_scoped_case(const std::string& spec, std::optional<double> flexion_deg,
                              const std::string& finding) {
  auto def = open_case_def(spec, {}, flexion_deg ? CaseParts::kFelt : CaseParts::kSeen);
  if (!def) return tl::unexpected(def.error());
  bool as_wanted = !flexion_deg || (!def->softs.empty() && is_bent_to(*def, *flexion_deg));
  if (!finding.empty() && !has_finding(*def, finding)) {
    if (auto ok = add_finding(finding, *def); !ok) return tl::unexpected(ok.error());
    as_wanted = false;
  }
  if (!as_wanted) def = bend_case(std::move(*def), "flexion", flexion_deg.value_or(0), true);
  if (!def) return tl::unexpected(def.error());
  colour_softs(*def);
  for (BoneDef& bone : def->bones) bone.felt = Felt::kHull;
  return build_case(std::move(*def));
}

}  // namespace osteon
