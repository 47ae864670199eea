// What is pressed against bone, burr and scraper, and a punch that bites.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "carving_push.h"
#include "cutter_front.h"
#include "osteon/scene/carve_events.h"

namespace osteon {

using namespace carving;

namespace {

constexpr double kLeastFacing = 0.2;  // of what cuts on one side: so far it must look at the bone
constexpr double kBurrFastest_m_per_s = 0.02;
constexpr double kBurrLead_m = 1e-4;

}  // namespace

// The middle of the ball that cuts where the tool presses, in Tool: of a tube it lies on its axis
// along the window. None: it presses beside what cuts.
std::optional<Vec3> cutting_middle(const CarvingTool& with, const Vec3& at_T) {
  const RoundRod& rod = with.cutter.parts.front().rods.front();
  const Vec3 along = rod.p1 - rod.p0;
  const double length = along.norm(), reach = with.cutter.size_m / 4;
  if (!(length > 0)) return with.middle_T;
  const double on = (at_T - rod.p0).dot(along) / length;
  if (on < reach) return with.middle_T;  // at its round end
  if (on > length) return std::nullopt;
  return Vec3(rod.p0 + on / length * along);
}

// Of what scrapes, its speed is that of the hand along the bone.
void Carving::burr(std::size_t hand, const CarvingTool& with, const Push& push, double step_s) {
  CarvingHand& h = hands_[hand];
  const double press = push.force_B.norm(), radius = 0.5 * with.cutter.size_m;
  const Vec3 nhat = push.force_B / press;
  const auto middle_T = cutting_middle(with, push.X_BT.inverse() * push.at_B);
  if (!middle_T) return rest(hand, push);
  if (with.one_sided && (push.X_BT.q * Vec3::UnitY()).dot(nhat) > -kLeastFacing)
    return rest(hand, push);
  if (h.bone != push.bone) begin(hand, with, push);
  const CarvedField& field = *bones_[h.bone].field;
  const FrontShare front = look_under_ball(field, radius, push.X_BT * *middle_T, nhat);
  // The points over its half lie beside the pole, which touches: a shaver asks there too.
  const double ahead = radius + 0.6 * field.grid().cell_m;
  const auto pole =
      with.soft_only ? tissue_at(field, push.X_BT * *middle_T - ahead * nhat) : std::nullopt;
  const bool hard = pole == BoneTissue::kCortical || pole == BoneTissue::kCancellous;
  if (with.soft_only && ((front.left() == 0 && !pole) || front.meets_bone() || hard))
    return rest(hand, push);
  note_tissue(hand, push, front.left() == 0 ? pole : front.most());
  const DrillMaterial material = mixed(setup_->table, front);
  const bool scrapes = with.way == CarvingTool::Way::kScrape;
  const Vec3 drawn = push.X_WB.q.conjugate() * push.tool->v_W;
  const double m_per_s =
      scrapes ? (drawn - nhat * nhat.dot(drawn)).norm()
              : std::numbers::pi * with.cutter.size_m * push.tool->power * with.most_rev_per_s;
  const double force = with.grip * (scrapes ? setup_->thrust_scale * press : press);
  const double area = 0.5 * std::numbers::pi * radius * radius;
  // Over the whole half ball the energy is that of its shares; the rest of it cuts air.
  const double rate = force * m_per_s / material.specific_energy_j_per_m3 / area;
  const double advance = std::min(rate, kBurrFastest_m_per_s) * step_s;
  const bool first = h.most_torque_nm == 0;
  const double torque = force * radius;
  readouts_[hand] = {h.bone,  push.X_BT * *middle_T,
                     nhat,    radius,
                     advance, press,
                     torque,  advance * area * material.specific_energy_j_per_m3 / step_s,
                     0,       true};
  if (!(advance > 0)) return;
  h.idle = 0;
  h.was_in = true;
  h.most_torque_nm = std::max(h.most_torque_nm, torque);
  if (first) tell(hand, push, kCutBegin, {1000 * with.cutter.size_m, press, 0});
  // So far the cut lies ahead of the ball: a shallow one is smoothed away until it is deep enough
  // for the ball to follow.
  const Vec3 moved = first ? Vec3(Vec3::Zero()) : Vec3(push.X_BT.p - h.p_out);
  h.p_out = push.X_BT.p;
  h.due_m = std::clamp(h.due_m + advance - moved.norm(), 0.0, kBurrLead_m);
  h.plunge_m += advance;
  if (h.plunge_m < CarvingSetup::kBite_m) return;
  const Pose from = moved_along(push.X_BT, (CarvingSetup::kSlack_m - kSkin_m) * nhat);
  h.X_BC = moved_along(from, -std::max(h.due_m, h.plunge_m) * nhat);
  h.drill.depth_m += h.plunge_m;
  const bool was_full = full_;
  if (!remove(hand, with.cutter, from, h.X_BC)) tell_full(hand, push, was_full);
  h.plunge_m = 0;
}

void Carving::bite(std::size_t hand, const CarvingTool& with, const ToolState& tool,
                   const Pose& X_BT, std::uint32_t bone) {
  CarvingHand& h = hands_[hand];
  if (!h.jaw_open || tool.jaw > 0.1) return;
  const std::uint32_t bone_before = h.bone;
  h.bone = bone;
  const std::size_t before = changed_.size();
  Push push;
  push.tool = &tool;
  push.bone = bone;
  const bool was_full = full_;
  if (!remove(hand, with.cutter, X_BT, X_BT)) tell_full(hand, push, was_full);
  if (changed_.size() > before)
    tell(hand, push, kCutBegin, {1000 * with.cutter.size_m, 0, 0});
  else
    h.bone = bone_before;
}

}  // namespace osteon
