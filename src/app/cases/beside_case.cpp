#include "cases/beside_case.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "cases/open_case.h"

namespace osteon {
namespace {

constexpr std::string_view kBench = "graft_bench";
// On the inner side of the knee, farther from its middle than any instrument's grip that is in use
// there or waits.
Vec3 bench_at_W(const CaseDef& def) {
  return def.side == "left" ? Vec3(-0.1, -0.53, 0.1) : Vec3(-0.1, 0.75, 0.1);
}
// They mark the channel that a graft of the bench alone is for. Here it is that of this knee.
constexpr std::array<std::string_view, 3> kMarksOfItsOwn{"knob_channel", "knob_socket",
                                                         "knob_cortex"};

std::string bench_spec(const CaseDef& def) {
  std::string spec = "builtin:" + std::string(kBench);
  if (!def.recipe || !def.recipe->seed) return spec;
  spec += ":" + std::to_string(*def.recipe->seed);
  return def.side.empty() ? spec : spec + ":" + def.side;
}

bool has_bone(const CaseDef& def, const std::string& name) {
  return std::any_of(def.bones.begin(), def.bones.end(),
                     [&](const BoneDef& bone) { return bone.name == name; });
}

bool has_landmark(const CaseDef& def, const std::string& name) {
  return std::any_of(def.landmarks.begin(), def.landmarks.end(),
                     [&](const Landmark& mark) { return mark.name == name; });
}

}  // namespace

Result<void> lay_beside(const std::string& anatomy, CaseDef& def) {
  if (anatomy.empty()) return {};
  const std::string where = "case '" + def.name + "'";
  if (anatomy != kBench)
    return fail("nothing called '" + anatomy + "' can lie beside it", where,
                "Use beside=graft_bench");
  auto bench = open_case_def(bench_spec(def), {}, CaseParts::kFelt);
  if (!bench) return tl::unexpected(bench.error());
  const Vec3 at_W = bench_at_W(def);
  for (BoneDef& bone : bench->bones) {
    if (std::find(kMarksOfItsOwn.begin(), kMarksOfItsOwn.end(), bone.name) != kMarksOfItsOwn.end())
      continue;
    if (has_bone(def, bone.name)) return fail("it has a bone '" + bone.name + "' already", where);
    bone.X_WB.p += at_W;
    bone.felt = Felt::kHull;
    bone.beside = true;
    def.bones.push_back(std::move(bone));
  }
  for (Landmark& mark : bench->landmarks) {
    if (has_landmark(def, mark.name))
      return fail("it has a landmark '" + mark.name + "' already", where);
    mark.p_W += at_W;
    def.landmarks.push_back(std::move(mark));
  }
  return {};
}

}  // namespace osteon
