#include "cases/pose_case.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "cases/open_case.h"

namespace osteon {
namespace {

/// Two ways of keeping one surface differ by less: files of meshes hold single precision.
constexpr double kSame_m = 1e-6;

bool is_same_surface(const TriMesh& a, const TriMesh& b) {
  if (a.triangles.size() != b.triangles.size()) return false;
  for (std::size_t i = 0; i < a.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 apart = a.vertices[a.triangles[i][k]] - b.vertices[b.triangles[i][k]];
      if (!(apart.cwiseAbs().maxCoeff() < kSame_m)) return false;
    }
  return true;
}

std::string in_degrees(double degrees) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", degrees);
  return text;
}

Result<void> check_bend(const CaseDef& def, const std::string& joint, double degrees) {
  const std::string where = "case '" + def.name + "'";
  const auto at = std::find_if(def.joints.begin(), def.joints.end(),
                               [&](const JointDef& j) { return j.name == joint; });
  if (at == def.joints.end())
    return fail("it has no joint '" + joint + "'", where,
                def.joints.empty() ? "Cases of the built-in knee have one: flexion"
                                   : "It has " + def.joints[0].name);
  if (!(degrees >= at->min_deg() && degrees <= at->max_deg()))
    return fail("the joint bends from " + in_degrees(at->min_deg()) + " to " +
                    in_degrees(at->max_deg()) + " degrees, not to " + in_degrees(degrees),
                "joint '" + joint + "'");
  if (!def.recipe)
    return fail("it does not record how it was generated, so its soft parts cannot be bent", where,
                "Make the patient with osteon anatomy make");
  return {};
}

/// Takes over what depends on the pose.
Result<void> take_pose(CaseDef grown, CaseDef& def) {
  const std::string where = "case '" + def.name + "'";
  const bool same_count = grown.bones.size() == def.bones.size();
  for (std::size_t i = 0; i < def.bones.size(); ++i) {
    if (!same_count || grown.bones[i].name != def.bones[i].name ||
        !is_same_surface(grown.bones[i].mesh, def.bones[i].mesh))
      return fail("bone '" + def.bones[i].name +
                      "' was changed after it was generated, so it cannot be bent",
                  where, "Make the patient again with osteon anatomy make and bend that");
    def.bones[i].X_WB = grown.bones[i].X_WB;
  }
  def.softs = std::move(grown.softs);
  def.landmarks = std::move(grown.landmarks);
  def.joints = std::move(grown.joints);
  def.recipe = std::move(grown.recipe);
  return {};
}

}  // namespace

PatientOrder order_of(const CaseRecipe& recipe) {
  PatientOrder order{recipe.anatomy, recipe.seed, recipe.set, {}, recipe.side};
  for (const auto& [finding, grade] : recipe.findings) order.findings.push_back({finding, grade});
  return order;
}

CaseRecipe recipe_of(const PatientOrder& order) {
  CaseRecipe recipe{order.anatomy, order.seed, order.side, order.set, {}};
  for (const FindingChoice& f : order.findings) recipe.findings.emplace_back(f.finding, f.grade);
  return recipe;
}

Result<CaseDef> bend_case(CaseDef def, const std::string& joint, double degrees, bool soft_parts,
                          const std::function<void(double)>& progress) {
  if (auto ok = check_bend(def, joint, degrees); !ok) return tl::unexpected(ok.error());
  PatientOrder order = order_of(*def.recipe);
  const std::string parameter = joint + "_deg";
  std::erase_if(order.set, [&](const ParameterValue& set) { return set.first == parameter; });
  order.set.emplace_back(parameter, degrees);
  auto grown = grow_patient(order, progress, soft_parts);
  if (!grown) return tl::unexpected(grown.error());
  CaseDef posed = case_from(std::move(grown->anatomy));
  posed.recipe = recipe_of(order);
  if (auto ok = take_pose(std::move(posed), def); !ok) return tl::unexpected(ok.error());
  return def;
}

}  // namespace osteon
