#include "cases/felt_choice.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

namespace osteon {
namespace {

constexpr double kLeastNear_mm = 60, kMostNear_mm = 400;

std::optional<double> degrees_from(const std::string& text) {
  double value = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = read.ec == std::errc{} && read.ptr == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

constexpr std::string_view kPortalPrefix = "portal_";
constexpr std::string_view kBeginPrefix = "begin_";
constexpr double kFarthest_mm = 1000;

// "31.5/-20/4/0.6/0.8/0".
std::optional<FeltChoice::Place> place_from(const std::string& text) {
  std::istringstream parts(text);
  std::vector<double> numbers;
  for (std::string part; std::getline(parts, part, '/');) {
    const auto number = degrees_from(part);
    if (!number || std::abs(*number) > kFarthest_mm) return std::nullopt;
    numbers.push_back(*number);
  }
  if (numbers.size() != 6) return std::nullopt;
  FeltChoice::Place out;
  out.p_W = Vec3(numbers[0], numbers[1], numbers[2]) / 1000;
  const Vec3 inwards(numbers[3], numbers[4], numbers[5]);
  if (!(inwards.norm() > 0.5)) return std::nullopt;
  // What was written by to_text stays as it is.
  out.inwards_W = std::abs(inwards.norm() - 1) < 1e-12 ? inwards : Vec3(inwards.normalized());
  return out;
}

std::string shortest(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value);
  return std::string(text, end.ptr);
}

}  // namespace

Result<FeltChoice> parse_felt_choice(const std::string& spec) {
  const std::size_t mark = spec.rfind('#');
  std::error_code ec;
  if (mark == std::string::npos || std::filesystem::exists(spec, ec)) return FeltChoice{spec, {}};
  FeltChoice out{spec.substr(0, mark), {}};
  std::istringstream parts(spec.substr(mark + 1));
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t equals = part.find('=');
    const bool all = equals == std::string::npos;
    const std::string value = all ? part : part.substr(equals + 1);
    if (!all && part.substr(0, equals) == "beside") {
      out.beside = value;
      continue;
    }
    if (!all && part.starts_with(kPortalPrefix)) {
      const auto place = place_from(value);
      if (!place)
        return fail("'" + part + "' does not set where a portal is", spec,
                    "Write PORTAL=X/Y/Z/INX/INY/INZ: a place in mm, World, and a direction into "
                    "the body");
      out.portals[part.substr(0, equals)] = *place;
      continue;
    }
    if (const auto degrees = all ? std::nullopt : degrees_from(value)) {
      const std::string name = part.substr(0, equals);
      if (name.starts_with(kBeginPrefix)) {
        out.begins[name.substr(kBeginPrefix.size())] = *degrees;
        continue;
      }
      const bool near = name == "near";
      if (near && !(*degrees >= kLeastNear_mm && *degrees <= kMostNear_mm))
        return fail("'" + part + "' is not 60 to 400 mm", spec);
      (near ? out.near_mm : out.bent[name]) = *degrees;
      continue;
    }
    const auto felt = felt_from_text(value);
    if (!felt)
      return fail(
          "'" + part + "' does not set how a bone is felt or a joint is bent", spec,
          "Write BONE=pieces, BONE=hull, BONE=field, BONE=covered or JOINT=DEGREES, separated "
          "by commas");
    out.of_bone[all ? std::string() : part.substr(0, equals)] = *felt;
  }
  return out;
}

std::string to_text(const FeltChoice& choice) {
  std::string out;
  for (const auto& [bone, felt] : choice.of_bone) {
    out += out.empty() ? "#" : ",";
    if (!bone.empty()) out.append(bone).append("=");
    out += to_text(felt);
  }
  for (const auto& [joint, degrees] : choice.bent)
    out.append(out.empty() ? "#" : ",").append(joint).append("=").append(shortest(degrees));
  for (const auto& [joint, degrees] : choice.begins)
    out.append(out.empty() ? "#" : ",")
        .append(kBeginPrefix)
        .append(joint)
        .append("=")
        .append(shortest(degrees));
  if (choice.near_mm > 0)
    out.append(out.empty() ? "#" : ",").append("near=" + shortest(choice.near_mm));
  for (const auto& [portal, place] : choice.portals) {
    out.append(out.empty() ? "#" : ",").append(portal).append("=");
    for (int i = 0; i < 3; ++i) out.append(shortest(1000 * place.p_W[i])).append("/");
    for (int i = 0; i < 3; ++i) out.append(shortest(place.inwards_W[i])).append(i < 2 ? "/" : "");
  }
  if (!choice.beside.empty()) out.append(out.empty() ? "#" : ",").append("beside=" + choice.beside);
  return choice.source + out;
}

Result<std::string> bent_spec(const std::string& spec, const std::string& joint, double degrees) {
  auto choice = parse_felt_choice(spec);
  if (!choice) return tl::unexpected(choice.error());
  choice->bent[joint] = degrees;
  return to_text(*choice);
}

std::string source_without_choice(const std::string& spec) {
  const auto choice = parse_felt_choice(spec);
  return choice ? choice->source : spec;
}

Result<void> apply(const FeltChoice& choice, CaseDef& def) {
  for (const auto& [name, felt] : choice.of_bone) {
    bool there = name.empty();
    for (BoneDef& bone : def.bones) {
      if (!name.empty() && bone.name != name) continue;
      bone.felt = felt;
      there = true;
    }
    if (!there)
      return fail("there is no bone '" + name + "'", "case '" + def.name + "'",
                  "'osteon case info' lists the bones");
  }
  for (const auto& [name, degrees] : choice.begins) {
    const auto joint = std::find_if(def.joints.begin(), def.joints.end(),
                                    [&of = name](const JointDef& j) { return j.name == of; });
    if (joint == def.joints.end())
      return fail("it has no joint '" + name + "'", "case '" + def.name + "'");
    joint->begin_deg = degrees;
  }
  for (const auto& [name, place] : choice.portals) {
    const auto mark =
        std::find_if(def.landmarks.begin(), def.landmarks.end(),
                     [&of = name](const Landmark& landmark) { return landmark.name == of; });
    if (mark == def.landmarks.end())
      return fail("there is no portal '" + name + "'", "case '" + def.name + "'");
    mark->p_W = place.p_W;
    mark->inwards_W = place.inwards_W;
  }
  return {};
}

}  // namespace osteon
