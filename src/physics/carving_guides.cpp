// What leads an instrument that carves: its own hole, a pin, the sleeve of an aimer.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "carving_push.h"
#include "cutter_front.h"
#include "osteon/physics/carving.h"
#include "osteon/physics/guide_line.h"
#include "osteon/scene/carve_events.h"

namespace osteon {
namespace {

constexpr double kOutOfHole_m = 0.0005;  // so far before its mouth a drill has left a hole
constexpr double kCapture_m = 0.003;     // so near an instrument is slipped on to a rod
constexpr double kCaptureTurn_rad = 0.35;
constexpr double kDragged_m = 0.015;      // pulled aside so far outside of bone, it is off again
constexpr double kGripPerStep = 0.02;     // a rod holds within 50 steps
constexpr double kFits_m = 0.0002;        // room between a rod and what is hollow
constexpr double kShortestPin_m = 0.005;  // that holds in bone
constexpr double kTakesPin_m = 0.006;     // so near a chuck shuts about a pin
constexpr double kBesidePin_m = 0.003;    // a sleeve ends so far before the place that it aims at
constexpr double kKeptHole_m = 0.003;     // a hole that is as deep is known again
constexpr double kIntoHole_m = 0.0005;    // so near its axis and mouth a tip falls into it
constexpr double kFillsHole = 0.8;        // by diameter: what is thinner meets the wall as it is
constexpr std::size_t kMostGuideEvents = 32;  // of a step
// Of 316L steel, Pa (ASM Handbook, volume 1).
constexpr double kSteel_Pa = 193e9;

struct Beside {
  double along_m = 0;   // of the tip, from the rod's inner end outwards
  double across_m = 0;  // from its line
  double turn_rad = 0;  // between the axes
};

Beside beside(const GuideRod& rod, const Pose& X_BT) {
  const Vec3 out = rod.X_BR.q * Vec3::UnitZ(), off = X_BT.p - rod.X_BR.p;
  const double along = off.dot(out);
  const double c = std::clamp(out.dot(X_BT.q * Vec3::UnitZ()), -1.0, 1.0);
  return {along, (off - along * out).norm(), std::acos(c)};
}

// A round bar that a force bends at the end of a free length L: L^3 / (3 E I), I = pi r^4 / 4
// (Euler and Bernoulli; Timoshenko, Strength of Materials, chapter 5).
double give_of(const GuideRod& rod, double tip_along_m) {
  if (rod.kind != GuideRod::Kind::kPin) return 0;
  const double free = std::max(0.0, tip_along_m - rod.in_bone_m);
  const double r2 = rod.radius_m * rod.radius_m;
  return free * free * free / (3 * kSteel_Pa * std::numbers::pi * r2 * r2 / 4);
}

Vec3 outwards(const Pose& X) { return X.q * Vec3::UnitZ(); }

}  // namespace

void Carving::tell_of(std::size_t hand, const ToolState& tool, EventKind kind, std::uint32_t bone,
                      std::array<double, 3> values) {
  if (events_.size() == kMostGuideEvents) return;
  events_.push_back({tool.tick, kind, static_cast<std::uint8_t>(hand), SubjectKind::kBone, bone,
                     tool.X_WP.p, values});
}

GuideRod* Carving::free_rod() {
  for (GuideRod& rod : rods_)
    if (rod.kind == GuideRod::Kind::kNone) return &rod;
  return nullptr;
}

void Carving::drop_rod(std::size_t place) {
  rods_[place] = {};
  for (CarvingHand& hand : hands_)
    if (hand.rod == place + 1) hand.rod = 0;
}

// Beyond the far side nothing stops a drill: its hole goes on, up to the next bone before it.
void Carving::run_free(CarvingHand& h, const CarvingTool& with, const Pose& X_BT) {
  const bool blade = with.way == CarvingTool::Way::kStrike;
  // A blade cuts as it goes on, so its end stays near it.
  const int most_strides = blade ? 2 : 16;
  const double ahead_m = blade ? 0.0003 : 0.003;
  const CarvedField& field = *bones_[h.bone].field;
  const Vec3 back = outwards(h.X_BC);
  for (int i = 0; i < most_strides && back.dot(h.X_BC.p - X_BT.p) > -ahead_m; ++i) {
    const Pose next{h.X_BC.p - 0.5 * field.grid().cell_m * back, h.X_BC.q};
    // A blade has an edge and no faces.
    const FrontShare front = blade ? look_before_edge(field, with.cutter.size_m, next)
                                   : look_before(field, with.cutter, with.pilot_m, next);
    if (front.left() > 0) {
      h.open = false;
      return;
    }
    h.X_BC = next;
  }
}

void Carving::leave_hole(std::size_t hand, const CarvingTool& with, const ToolState& tool,
                         const BoneSnapshot& bones) {
  CarvingHand& h = hands_[hand];
  if (!h.in_hole || h.bone >= bones.count) return;
  const Pose X_BT = bones.bones[h.bone].X_WB.inverse() * tool.X_WP;
  const Pose X_BC_before = h.X_BC;
  if (h.open) run_free(h, with, X_BT);
  // Its edge is out, its faces are not: the slot grows as wide as the blade.
  if (with.way == CarvingTool::Way::kStrike && h.X_BC.p != X_BC_before.p)
    (void)remove(hand, with.cutter, X_BC_before, h.X_BC);
  const Vec3 out = outwards(h.X_BC), off = X_BT.p - h.X_BC.p;
  // Put back into its hole by a restore point while the hand is elsewhere, it is not drawn there.
  const bool elsewhere = (off - off.dot(out) * out).norm() > kCapture_m;
  if (!elsewhere && !(out.dot(X_BT.p - h.mouth_B) > kOutOfHole_m)) return;
  keep_hole(h, with);
  end_hole(hand, tool);
}

void Carving::keep_hole(const CarvingHand& h, const CarvingTool& with) {
  if (with.way != CarvingTool::Way::kDrill || (h.mouth_B - h.X_BC.p).norm() < kKeptHole_m) return;
  std::copy_backward(holes_.begin(), holes_.end() - 1, holes_.end());
  holes_.front() = {h.bone, h.X_BC, h.mouth_B, with.cutter.size_m, h.lag_m, h.open};
}

// A tool that fills its hole is as far from its wall all along its axis, so the field says nothing
// of a direction there: it is led by the hole from where its tip falls into the mouth.
void Carving::come_back(std::size_t hand, const CarvingTool& with, const ToolState& tool,
                        const BoneSnapshot& bones) {
  CarvingHand& h = hands_[hand];
  h.loose = std::max(0.0, h.loose - kGripPerStep);
  if (h.in_hole || h.rod != 0) return;
  for (std::size_t i = 0; i < holes_.size(); ++i) {
    const LeftHole hole = holes_[i];
    if (hole.bone >= bones.count || with.cutter.size_m > hole.diameter_m + kFits_m ||
        with.cutter.size_m < kFillsHole * hole.diameter_m)
      continue;
    const Pose X_BT = bones.bones[hole.bone].X_WB.inverse() * tool.X_WP;
    const Beside at = beside({GuideRod::Kind::kNone, hole.bone, hole.X_BC, 0, 0, 0}, X_BT);
    const double before = at.along_m - (hole.mouth_B - hole.X_BC.p).norm();
    if (at.across_m > kIntoHole_m || at.turn_rad > kCaptureTurn_rad ||
        std::abs(before) > 0.8 * kIntoHole_m)
      continue;
    h = anew(h);
    h.bone = hole.bone;
    h.X_BC = hole.X_BC;
    h.mouth_B = hole.mouth_B;
    h.lag_m = hole.lag_m;
    h.open = hole.open;
    h.drill.depth_m = (hole.mouth_B - hole.X_BC.p).norm();
    h.since = steps_;
    h.in_hole = h.was_in = true;
    h.loose = 1;
    // Left again, it is the newest.
    std::copy(holes_.begin() + static_cast<std::ptrdiff_t>(i) + 1, holes_.end(),
              holes_.begin() + static_cast<std::ptrdiff_t>(i));
    holes_.back() = {};
    return;
  }
}

void Carving::end_hole(std::size_t hand, const ToolState& tool) {
  const auto since = [&](std::uint64_t step) { return 0.002 * static_cast<double>(steps_ - step); };
  CarvingHand& h = hands_[hand];
  if (h.chatter.amplitude_m > 0)
    tell_of(hand, tool, kChatterEnd, h.bone, {since(h.chatters_since), 0, 0});
  if (h.most_torque_nm > 0)
    tell_of(hand, tool, kCutEnd, h.bone,
            {1000 * h.drill.depth_m, since(h.since), 1000 * h.most_torque_nm});
  h = anew(h);
}

// An instrument is slipped on where it is brought to a rod, from the side as well: no device
// reaches round the end of a long pin. It is off where it is pulled beyond the rod's end, or far
// aside outside of the bone.
void Carving::follow_rods(std::size_t hand, const CarvingTool& with, const ToolState& tool,
                          const BoneSnapshot& bones) {
  CarvingHand& h = hands_[hand];
  const auto pose_on = [&](const GuideRod& rod) {
    return bones.bones[rod.bone].X_WB.inverse() * tool.X_WP;
  };
  if (h.rod != 0) {
    const GuideRod& rod = rods_[h.rod - 1];
    const Pose X_BD = bones.bones[rod.bone].X_WB.inverse() * tool.X_WD;
    const bool off = beside(rod, pose_on(rod)).along_m > rod.length_m ||
                     (!h.in_hole && beside(rod, X_BD).across_m > kDragged_m) ||
                     !rod_leads(rod, with);
    if (off) h.rod = 0;
    h.grip = off ? 0 : std::min(1.0, h.grip + kGripPerStep);
    return;
  }
  for (std::uint32_t r = 0; r < rods_.size() && !h.in_hole; ++r) {
    if (!rod_leads(rods_[r], with) || rods_[r].bone >= bones.count) continue;
    const Beside at = beside(rods_[r], pose_on(rods_[r]));
    const double least = rods_[r].kind == GuideRod::Kind::kPin ? rods_[r].in_bone_m : kBesidePin_m;
    if (at.across_m > kCapture_m || at.turn_rad > kCaptureTurn_rad || at.along_m < least ||
        at.along_m > rods_[r].length_m)
      continue;
    h.rod = r + 1;
    h.grip = 0;
    tell_of(hand, tool, kLed, rods_[r].bone, {});
    return;
  }
}

// An open chuck that still holds the pin it let go: the pin in its hole is not felt as bone.
void Carving::slide_on_pin(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones) {
  CarvingHand& h = hands_[hand];
  if (h.rod == 0) return;
  const GuideRod& rod = rods_[h.rod - 1];
  if (rod.kind != GuideRod::Kind::kPin || rod.bone >= bones.count) {
    h.rod = 0;
    return;
  }
  const Pose X_BT = bones.bones[rod.bone].X_WB.inverse() * tool.X_WP;
  if (beside(rod, X_BT).along_m > rod.in_bone_m + kOutOfHole_m) h = anew(h), h.rod = 0;
}

// Opened, a chuck lets its pin go; shut beside one, it takes it out.
void Carving::follow_chuck(std::size_t hand, const CarvingTool& with, const ToolState& tool,
                           const BoneSnapshot& bones) {
  CarvingHand& h = hands_[hand];
  const bool was_open = h.jaw_open;
  h.jaw_open = tool.jaw > 0.5 || (h.jaw_open && tool.jaw > 0.1);
  if (h.jaw_open == was_open) return;
  if (h.jaw_open) {
    // It stays where its tip is now, which may have been drawn back from the hole's end.
    Pose X_BR = h.X_BC;
    if (h.in_hole && h.bone < bones.count) {
      const Pose X_BT = bones.bones[h.bone].X_WB.inverse() * tool.X_WP;
      const double back = outwards(X_BR).dot(X_BT.p - X_BR.p);
      if (back > kOutOfHole_m) X_BR.p += back * outwards(X_BR);
    }
    const double in_bone = outwards(X_BR).dot(h.mouth_B - X_BR.p);
    GuideRod* rod = h.in_hole && in_bone >= kShortestPin_m ? free_rod() : nullptr;
    const std::uint32_t bone = h.bone;
    if (rod)
      *rod = {GuideRod::Kind::kPin, bone, X_BR, 0.5 * with.cutter.size_m, with.length_m, in_bone};
    h = anew(h);
    h.rod = 0;
    if (rod) {
      // The chuck slides along the pin until it is off.
      h.rod = static_cast<std::uint32_t>(rod - rods_.data()) + 1;
      h.grip = 1;
      h.bone = bone;
      h.X_BC = X_BR;
      tell_of(hand, tool, kPinLeft, bone, {1e3 * in_bone, 1e3 * with.cutter.size_m, 0});
    }
    return;
  }
  for (std::size_t r = 0; r < rods_.size(); ++r) {
    if (rods_[r].kind != GuideRod::Kind::kPin || rods_[r].bone >= bones.count) continue;
    const Beside at = beside(rods_[r], bones.bones[rods_[r].bone].X_WB.inverse() * tool.X_WP);
    if (at.across_m > kTakesPin_m || at.turn_rad > kCaptureTurn_rad || at.along_m < -kOutOfHole_m ||
        at.along_m > rods_[r].length_m)
      continue;
    const std::uint32_t bone = rods_[r].bone;
    const GuideRod pin = rods_[r];
    drop_rod(r);
    if (at.along_m < pin.in_bone_m && at.across_m < kIntoHole_m) {  // it is in its hole again
      h = anew(h);
      h.bone = bone;
      h.X_BC = pin.X_BR;
      h.mouth_B = pin.X_BR.p + pin.in_bone_m * outwards(pin.X_BR);
      h.drill.depth_m = pin.in_bone_m;
      h.since = steps_;
      h.in_hole = h.was_in = true;
    }
    tell_of(hand, tool, kPinTaken, bone, {});
    return;
  }
}

// Shut while it touches a bone that is carved, an aimer is fixed to it, in place of any that was
// fixed before; shut in the air it is off again.
void Carving::follow_aimer(std::size_t hand, const AimingTool& with, const ToolState& tool,
                           const BoneSnapshot& bones) {
  CarvingHand& h = hands_[hand];
  const bool was_open = h.jaw_open;
  h.jaw_open = tool.jaw > 0.5 || (h.jaw_open && tool.jaw > 0.1);
  if (h.jaw_open || !was_open) return;
  for (std::size_t r = 0; r < rods_.size(); ++r)
    if (rods_[r].kind == GuideRod::Kind::kSleeve) drop_rod(r);
  for (std::uint32_t i = 0; i < tool.contact_count; ++i) {
    const std::uint32_t bone = tool.contacts[i].bone.index;
    if (bone >= bones_.size() || !bones_[bone].field) continue;
    GuideRod* rod = free_rod();
    if (!rod) return;
    *rod = {GuideRod::Kind::kSleeve,
            bone,
            bones.bones[bone].X_WB.inverse() * tool.X_WP * with.X_TS,
            0.5 * with.bore_m,
            with.length_m,
            0};
    tell_of(hand, tool, kAimed, bone, {});
    return;
  }
}

// How far the wave that the teeth meet stands out for the hand now: it presses the teeth together,
// and no hand holds them to a wave harder than the table says. Beyond what so many steps a second
// can tell nothing is felt of it; it is still told.
double Carving::shaken_m(const CarvingHand& h) const {
  constexpr double kMostFelt_hz = 100;
  if (!(h.chatter.amplitude_m > 0) || h.chatter.frequency_hz > kMostFelt_hz) return 0;
  const double teeth = setup_->table.reamer_teeth * h.drill.turned_rev;
  const double felt_m = std::min(h.chatter.amplitude_m, most_shaken_m_);
  return felt_m * std::sin(2 * std::numbers::pi * (teeth - std::floor(teeth)));
}

// Of the hole that a drill makes: it goes on smoothly with the drill's feed. Bone goes in bites,
// and an end that went with them would strike a loose hand once a bite.
Vec3 Carving::end_of(const CarvingHand& h) const {
  return h.X_BC.p - std::max(0.0, h.due_m - h.lag_m) * carving::back_of(h.X_BC);
}

void Carving::publish(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones) {
  const CarvingHand& h = hands_[hand];
  ToolGuide& out = guides_[hand];
  const GuideRod* rod = h.rod != 0 ? &rods_[h.rod - 1] : nullptr;
  if (!rod && !h.in_hole) return;
  const Pose& X_BL = rod ? rod->X_BR : h.X_BC;
  out.on = true;
  out.instrument = tool.instrument;
  out.bone = rod ? rod->bone : h.bone;
  out.p_B = X_BL.p;
  out.nhat_B = outwards(X_BL);
  out.grip = rod ? h.grip : 1 - h.loose;
  // A hole in another bone than the rod's is met as bone is.
  const auto& with = setup_->tray[tool.instrument];
  const bool on_its_pin = rod && rod->kind == GuideRod::Kind::kPin && with && with->stays;
  out.in_hole = (h.in_hole || on_its_pin) && h.bone == out.bone;
  out.stops = out.in_hole;
  out.stop_m = out.nhat_B.dot(end_of(h) - out.p_B) - CarvingSetup::kSlack_m + shaken_m(h);
  if (!rod) return;
  const Pose X_BT = bones.bones[rod->bone].X_WB.inverse() * tool.X_WP;
  out.give_m_per_n = give_of(*rod, beside(*rod, X_BT).along_m);
}

}  // namespace osteon
