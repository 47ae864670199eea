#include "cases/case_bone.h"

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <utility>

#include "cases/felt_choice.h"
#include "cases/open_case.h"
#include "osteon/base/file.h"
#include "osteon/scene/bone_cover.h"
#include "osteon/scene/case_io.h"

namespace osteon {
namespace {

/// Metres in the unit of the case's mesh files.
Result<double> unit_of_case(const std::string& source) {
  if (source.starts_with("builtin:")) return 1.0;
  const auto file = std::filesystem::path(source) / "case.toml";
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  const auto parsed = parse_case_toml(*text, file.string());
  if (!parsed) return tl::unexpected(parsed.error());
  return parsed->metres_per_unit;
}

std::string unit_name(double metres) { return metres == 1 ? "m" : metres == 0.01 ? "cm" : "mm"; }

}  // namespace

Result<CaseBone> load_case_bone(const std::string& spec, bool with_cartilage) {
  const std::size_t mark = spec.rfind('#');
  if (mark == std::string::npos)
    return fail("names no bone", spec, "Name one of a case: CASE#BONE, such as builtin:knee#femur");
  const std::string source = spec.substr(0, mark), name = spec.substr(mark + 1);
  const auto choice = parse_felt_choice(source);
  if (!choice) return tl::unexpected(choice.error());
  const auto unit = unit_of_case(choice->source);
  if (!unit) return tl::unexpected(unit.error());
  auto def = open_case_def(source, {}, with_cartilage ? CaseParts::kAll : CaseParts::kFelt);
  if (!def) return tl::unexpected(def.error());
  std::string names;
  for (BoneDef& bone : def->bones) {
    if (bone.name == name) {
      auto covered = with_cartilage ? covered_bone(*def, bone) : nullptr;
      return CaseBone{std::move(bone), std::move(covered), unit_name(*unit), *unit};
    }
    names += (names.empty() ? "" : ", ") + bone.name;
  }
  return fail("has no bone '" + name + "'", source, "It has " + names);
}

Result<Vec3> point_from_mm(const std::string& text, const std::string& option) {
  constexpr double kFarthest_mm = 10000;
  std::array<double, 3> mm{};
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [next, error] = std::from_chars(at, end, mm[k]);
    const bool ends_well = k < 2 ? next != end && *next == ',' : next == end;
    if (error != std::errc{} || !ends_well || !std::isfinite(mm[k]))
      return fail("is not three numbers: '" + text + "'", option,
                  "Write it as x,y,z in mm without spaces, such as 10,-2.5,30");
    if (std::abs(mm[k]) > kFarthest_mm)
      return fail("lies farther than 10 m away: '" + text + "'", option,
                  "Give three numbers from -10000 to 10000, in mm");
    at = next + 1;
  }
  return Vec3(mm[0], mm[1], mm[2]) / 1000;
}

}  // namespace osteon
