#include "felt_choice.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <system_error>

namespace osteon {

Result<FeltChoice> parse_felt_choice(const std::string& spec) {
  const std::size_t mark = spec.rfind('#');
  std::error_code ec;
  if (mark == std::string::npos || std::filesystem::exists(spec, ec)) return FeltChoice{spec, {}};
  FeltChoice out{spec.substr(0, mark), {}};
  std::istringstream parts(spec.substr(mark + 1));
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t equals = part.find('=');
    const bool all = equals == std::string::npos;
    const auto felt = felt_from_text(all ? part : part.substr(equals + 1));
    if (!felt)
      return fail("'" + part + "' does not say how a bone is felt", spec,
                  "Write BONE=pieces, BONE=hull or BONE=field, with commas between");
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
  return choice.source + out;
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
  return {};
}

}  // namespace osteon
