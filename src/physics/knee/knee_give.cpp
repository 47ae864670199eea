#include "osteon/physics/knee_give.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "knee/knee_parts.h"

namespace osteon {
namespace {

// A left knee is solved as a right one: across the plane y = 0, and turns the other way round.
Vec3 on_side(const Vec3& way, bool left) { return {way.x(), left ? -way.y() : way.y(), way.z()}; }
Vec3 turn_on_side(const Vec3& turn, bool left) {
  return left ? Vec3(-turn.x(), turn.y(), -turn.z()) : turn;
}

Vec3 turn_of(const Quat& q) {
  const Eigen::AngleAxisd turn(q.w() < 0 ? Quat(-q.coeffs()) : q);
  return turn.angle() * turn.axis();
}

KneeGive give_from(const KneeModel& knee, const KneeLaxity& found, bool left) {
  const Pose before = pose_of(knee.joint, found.rest), after = pose_of(knee.joint, found.loaded);
  KneeGive out;
  out.way_B = on_side(after * knee.joint.middle_T - before * knee.joint.middle_T, left);
  out.turn_B = turn_on_side(turn_of(after.q * before.q.conjugate()), left);
  out.front_m = found.anterior_m;
  return out;
}

Result<LaxityTestRow> laxity_row(const LigamentTable& table, const std::string& name) {
  for (const LaxityTestRow& row : table.tests)
    if (row.name == name) return row;
  return fail("has no test " + name, "table of ligaments");
}

Result<KneeGiveTable::Curve> curve_at(const KneeModel& knee, LaxityTestRow test, double bend_deg,
                                      bool left) {
  test.flexion_deg = bend_deg;
  const auto found = laxity_curve(knee, test);
  if (!found) return tl::unexpected(found.error());
  KneeGiveTable::Curve curve;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const KneeLaxity& at = (*found)[k];
    if (!at.converged)
      return fail("reaches no equilibrium at " + std::to_string(std::lround(bend_deg)) + " degrees",
                  "knee");
    curve[k] = give_from(knee, at, left);
  }
  return curve;
}

}  // namespace

Result<KneeGiveTable> give_of_knee(const CaseDef& def, const LigamentTable& table,
                                   const KneeChanges& changes) {
  const auto lachman = laxity_row(table, "lachman"), pivot = laxity_row(table, "pivot");
  if (!lachman || !pivot) return tl::unexpected((lachman ? pivot : lachman).error());
  const auto knee = make_knee(def, table, changes);
  if (!knee) return tl::unexpected(knee.error());
  const auto bones = find_knee_bones(def);
  if (!bones) return tl::unexpected(bones.error());
  KneeGiveTable out;
  out.knee = changes.graft ? 1 : 0;
  out.front_n = lachman->anterior_n;
  out.valgus_nm = -pivot->varus_nm;
  out.internal_nm = pivot->internal_nm;
  out.middle_T = bones->straight_BF * on_side(knee->joint.middle_T, bones->left);
  for (std::size_t i = 0; i < kKneeTests; ++i)
    for (std::size_t b = 0; b < KneeGiveTable::kBends; ++b) {
      const double bend_deg = KneeGiveTable::kBend_deg * static_cast<double>(b);
      auto curve = curve_at(*knee, i == 0 ? *lachman : *pivot, bend_deg, bones->left);
      if (!curve) return tl::unexpected(curve.error());
      out.gives[i][b] = *curve;
    }
  return out;
}

void set_other_knee(KneeGiveTable& table, const KneeGiveTable& intact) {
  for (std::size_t i = 0; i < kKneeTests; ++i)
    for (std::size_t b = 0; b < KneeGiveTable::kBends; ++b)
      for (std::size_t k = 0; k < KneeGiveTable::kShares; ++k)
        table.gives[i][b][k].other_front_m = intact.gives[i][b][k].front_m;
}

}  // namespace osteon
