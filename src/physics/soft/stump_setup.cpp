#include "osteon/physics/stump_setup.h"

#include <cmath>
#include <memory>

#include "osteon/mesh/distance.h"
#include "osteon/mesh/measure.h"
#include "osteon/scene/soft_solid.h"
#include "osteon/scene/stumps.h"
#include "soft/solid_fields.h"

namespace osteon {
namespace {

constexpr const char* kStumps = "stumps";
constexpr const char* kStumpsWhere = "--soft";
constexpr double kLeftOfTorn = 0.5;  // D
constexpr double kHeld_m = 0.0015;   // so near the bone the solid does not move
constexpr double kHangs_m = 0.0007;  // two cells of the field that is cut
constexpr double kFootprint_m = 0.0015;

// Height over a bone, for many places near one another.
std::function<double(const Vec3&)> height_over(const TriMesh& bone) {
  auto surface = std::make_shared<const MeshDistance>(bone);
  return [surface](const Vec3& p_B) { return surface->closest(p_B).signed_distance; };
}

Result<SoftSolid> stump_of(const Case& the_case, TornStump&& stump, const StumpStiffness& of,
                           FieldCache* known) {
  SoftSolid out;
  out.name = the_case.softs[stump.soft].name + "_stump_" + the_case.bone(stump.bone).name;
  out.soft = stump.soft;
  out.bone = stump.bone;
  out.cutting_n = kLeftOfTorn * of.cutting_n;
  const std::string what = "the stump '" + out.name + "'";
  if (auto made = make_solid_fields(stump.mesh_B, what, known, out); !made)
    return tl::unexpected(made.error());
  const auto height = height_over(the_case.bone(stump.bone).mesh);
  PressedSolidDef def;
  def.box = bounds(stump.mesh_B);
  def.field = out.field;
  def.up = (centroid(stump.mesh_B) - stump.foot_B).normalized();
  def.stiffness_n_per_m = kLeftOfTorn * of.stiffness_n_per_m;
  def.held = [height](const Vec3& p_B) { return height(p_B) < kHeld_m; };
  def.rests = [](const Vec3&) { return false; };
  auto body = PressedSolid::make(def);
  if (!body) {
    body.error().where = what;
    return tl::unexpected(body.error());
  }
  out.body = std::make_shared<const PressedSolid>(std::move(*body));
  out.surface_B = std::make_shared<const TriMesh>(std::move(stump.mesh_B));
  // The bed of the footprint has vessels, torn ends have none left (an assumption of ours).
  out.bleeds = [height](const Vec3& p_B) { return height(p_B) < kFootprint_m; };
  out.hangs = [height](const Vec3& p_B) { return height(p_B) < kHangs_m; };
  out.to_clear = [height](const Vec3& p_B) { return height(p_B) > kFootprint_m; };
  return out;
}

}  // namespace

bool names_stumps(const std::string& name) { return name == kStumps; }

Result<std::vector<SoftSolid>> make_stumps(const Case& the_case, const StumpStiffness& of,
                                           FieldCache* known) {
  std::vector<TornStump> stumps = torn_stumps(the_case);
  if (stumps.empty())
    return fail("no ligament of the case is torn through", kStumpsWhere,
                "Give a knee with the finding acl_tear=midsubstance, or leave out stumps");
  if (stumps.size() > kMaxSolids)
    return fail("more than " + std::to_string(kMaxSolids) + " stumps", kStumpsWhere,
                "Leave out stumps");
  if (!(of.stiffness_n_per_m > 0 && std::isfinite(of.stiffness_n_per_m)))
    return fail("a stump has no stiffness", kStumpsWhere, "Correct the tissue table");
  std::vector<SoftSolid> out;
  for (TornStump& stump : stumps) {
    auto solid = stump_of(the_case, std::move(stump), of, known);
    if (!solid) return tl::unexpected(solid.error());
    out.push_back(std::move(*solid));
  }
  return out;
}

}  // namespace osteon
