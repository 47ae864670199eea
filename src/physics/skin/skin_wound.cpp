// A cut that is held open: what stands between its lips pushes them aside and is pushed back, and
// whatever else goes in there is free as far as they stand apart.
#include <algorithm>
#include <cmath>

#include "skin/skin_box.h"
#include "skin/skin_world.h"
#include "skin/wound_section.h"

namespace osteon {
namespace {

constexpr double kLipSurface_n_per_m = 5000;  // of a lip's own skin under a disc; own default
constexpr double kWoundFits_n = 3;    // what the lips press on it with, in all, where it goes in
constexpr double kLightly_n = 1;      // who presses the skin harder does not slip into a cut
constexpr double kJustIn_m = 0.001;   // who was not near before, and is deeper, came from below
constexpr double kLipsSlip_n = 20;    // lips are drawn aside with so much, and slip past then
constexpr double kStaysIn_m = 0.010;  // what slips past has the same force so far about its place
constexpr double kLipSlope_m = 1e-5;  // by so much deeper, to find how stiff they are

SheetPoint push_on(const LipPushes& pushes, std::size_t hand) {
  SheetPoint sum = SheetPoint::Zero();
  for (const LipPush& push : pushes.list())
    if (push.hand == hand) sum -= push.force_n * push.out;
  return sum;
}

// How far the lips stand apart at the place of a push.
double gap_at(const SheetLips& lips, const LipPushes& pushes, const LipPush& push) {
  const SheetLips::Edge* best = nullptr;
  double nearest = 1e300, at = 0;
  for (const SheetLips::Edge& edge : lips.edges()) {
    const double t =
        std::clamp((push.at - edge.a).dot(edge.way) / edge.way.squaredNorm(), 0.0, 1.0);
    const double far = (push.at - edge.a - t * edge.way).squaredNorm();
    if (!(far < nearest)) continue;
    nearest = far;
    best = &edge;
    at = t;
  }
  if (!best) return 0;
  const auto place = [&](const SheetLips::Side& side) {
    const auto of = [&](std::uint32_t lip) -> SheetPoint {
      return lips.rest(lip) + lip_way(lips, pushes, lip);
    };
    return SheetPoint((1 - at) * of(side.lip[0]) + at * of(side.lip[1]));
  };
  return (place(best->sides[0]) - place(best->sides[1])).norm();
}

}  // namespace

// One solution a step, once the sheet's own balance is there.
void SkinWorld::follow_lips(std::size_t s) {
  Patch& mine = patches_[s];
  if (!setup_.wounds_open) return;
  if (mine.yields->split().walls.empty()) {
    mine.lips = nullptr;
    return;
  }
  if (mine.lips && mine.lips_hash == mine.felt_hash) return;
  if (!mine.lip_work) mine.lip_work = std::make_unique<LipWork>(mine.yields);
  ++mine.lips_worked;
  if (!mine.lip_work->step()) return;
  mine.lips = mine.lip_work->take();
  mine.lips_of = mine.felt;
  mine.lips_hash = mine.felt_hash;
  mine.lip_work = nullptr;
  mine.lips_worked = 0;
}

void SkinWorld::put_lips(std::size_t s, const SkinPatchState& from) {
  Patch& mine = patches_[s];
  mine.lips = nullptr;
  mine.lip_work = nullptr;
  mine.lips_of = {};
  mine.lips_hash = mine.lips_worked = 0;
  mine.pushes.count = 0;
  if (from.has_lips) {
    const SkinSheet& sheet = *setup_.skins[s].sheet;
    const SheetCuts cuts = kept_cuts(sheet, from.lips_of);
    SheetWork work(sheet, cuts);
    while (!work.step()) {
    }
    LipWork lips(work.take());
    while (!lips.step()) {
    }
    mine.lips = lips.take();
    mine.lips_of = from.lips_of;
    mine.lips_hash = hash_of_cuts(cuts);
  }
  if (from.lips_worked == 0 || mine.yields->split().walls.empty()) return;
  mine.lip_work = std::make_unique<LipWork>(mine.yields);
  for (; mine.lips_worked < from.lips_worked; ++mine.lips_worked)
    if (mine.lip_work->step()) break;
}

// A retractor goes into any cut that has room for it, other tools where one holds it open.
bool SkinWorld::may_enter(const At& at, bool begins) const {
  const SkinHand& hand = *at.state;
  if (hand.barred || hand.cutting || hand.pierce.through) return false;
  if (!(hand.contact.deep_m > 0) || (begins && hand.contact.deep_m > kJustIn_m)) return false;
  if (!begins && hand.contact.force_n > kLightly_n) return false;
  if (use_of(hand.instrument).retracts) return true;
  for (std::size_t h = 0; h < kMaxHands; ++h) {
    const SkinHand& other = hands_[h][at.patch];
    if (h != at.hand && other.in_wound && use_of(other.instrument).retracts) return true;
  }
  return false;
}

// True: it stands in the wound, and the skin does nothing else with it.
bool SkinWorld::follow_wound(const At& at, bool begins) {
  SkinHand& hand = *at.state;
  const Patch& mine = patches_[at.patch];
  if (!mine.lips || !(hand.in_wound || may_enter(at, begins))) {
    hand.in_wound = false;
    return false;
  }
  const Pose X_ST = mine.X_WS.inverse() * at.now->tool->X_WP;
  const auto section = wound_section(setup_.skins[at.patch], at.now->parts, X_ST,
                                     static_cast<std::uint32_t>(at.hand));
  if (hand.in_wound) {
    hand.in_wound = section.has_value();
    if (!section) hand.barred = hand.contact.deep_m > 0;
    return hand.in_wound;
  }
  if (!section) return false;
  DiscsInWound in = discs_in_wound(at.patch);
  for (std::uint32_t i = 0; i < section->count; ++i) in.all[in.count++] = section->discs[i];
  press_lips(*mine.lips, in.list(), kLipSurface_n_per_m, tried_);
  double pressed_n = 0;
  for (const LipPush& push : tried_.list())
    if (push.hand == at.hand) pressed_n += push.force_n;
  hand.in_wound = pressed_n < kWoundFits_n;
  return hand.in_wound;
}

SkinWorld::DiscsInWound SkinWorld::discs_in_wound(std::size_t s) const {
  DiscsInWound out;
  const Pose X_SW = patches_[s].X_WS.inverse();
  for (std::size_t h = 0; h < tools_.size(); ++h) {
    const SkinHand& hand = hands_[h][s];
    if (!hand.in_wound || !tools_[h].tool || tools_[h].tool->instrument != hand.instrument)
      continue;
    const auto section = wound_section(setup_.skins[s], tools_[h].parts,
                                       X_SW * tools_[h].tool->X_WP, static_cast<std::uint32_t>(h));
    for (std::uint32_t i = 0; section && i < section->count; ++i)
      out.all[out.count++] = section->discs[i];
  }
  return out;
}

// All hands in one balance.
void SkinWorld::hold_open(std::size_t s, std::uint64_t step) {
  Patch& mine = patches_[s];
  mine.pushes.count = 0;
  readouts_[s].open_m = 0;
  const auto stands = [&](std::size_t h) { return hands_[h][s].in_wound && tools_[h].tool; };
  bool any = false;
  for (std::size_t h = 0; h < tools_.size(); ++h) any = any || stands(h);
  if (!any || !mine.lips) return;
  const DiscsInWound in = discs_in_wound(s);
  press_lips(*mine.lips, in.list(), kLipSurface_n_per_m, mine.pushes);
  for (std::size_t h = 0; h < tools_.size(); ++h)
    if (stands(h)) feel_lips({h, s, &tools_[h], &hands_[h][s]}, in);
  for (const LipPush& push : mine.pushes.list())
    if (push.force_n > 0 && use_of(hands_[push.hand][s].instrument).retracts)
      readouts_[s].open_m = std::max(readouts_[s].open_m, gap_at(*mine.lips, mine.pushes, push));
  for (std::size_t h = 0; h < tools_.size(); ++h)
    if (stands(h)) tell_touch({h, s, &tools_[h], &hands_[h][s]}, step);
}

double SkinWorld::drawn_aside_m(const At& at) const {
  double most = 0;
  for (const LipPush& push : patches_[at.patch].pushes.list())
    if (push.hand == at.hand && push.force_n > 0) most = std::max(most, push.moved_m);
  return most;
}

// The force of the step, and how it goes on: by the balance of a tool that is pressed a little
// deeper. Where the lips are drawn aside with more than they hold, they slip past it.
void SkinWorld::feel_lips(const At& at, const DiscsInWound& in) {
  Patch& mine = patches_[at.patch];
  SkinContact& c = at.state->contact;
  const SkinPatch& patch = setup_.skins[at.patch];
  c.force_n = c.stiffness_n_per_m = c.aside_n_per_m = 0;
  const SheetPoint push_S = push_on(mine.pushes, at.hand);
  const double force_n = push_S.norm();
  const auto section = wound_section(patch, at.now->parts, mine.X_WS.inverse() * at.now->tool->X_WP,
                                     static_cast<std::uint32_t>(at.hand));
  if (!section || !(force_n > 0)) {
    c.deep_m = 0;
    return;
  }
  const SheetPoint out = push_S / force_n;
  DiscsInWound deeper = in;
  for (std::uint32_t i = 0; i < deeper.count; ++i)
    if (deeper.all[i].hand == at.hand) deeper.all[i].at -= kLipSlope_m * out;
  press_lips(*mine.lips, deeper.list(), kLipSurface_n_per_m, tried_);
  const double more_n = push_on(tried_, at.hand).dot(out) - force_n;
  c.stiffness_n_per_m = std::clamp(more_n / kLipSlope_m, 1.0, coupling_n_per_m_);
  c.force_n = force_n;
  if (force_n > kLipsSlip_n) {
    c.force_n = kLipsSlip_n;
    c.stiffness_n_per_m = 0;
    for (LipPush& push : mine.pushes.all)
      if (push.hand == at.hand) push.force_n *= kLipsSlip_n / force_n;
  }
  // The plane from which this force rises by that slope.
  c.deep_m = c.stiffness_n_per_m > 0 ? c.force_n / c.stiffness_n_per_m : kStaysIn_m;
  const double share = felt_share(patch, section->middle_S.head<2>());
  c.force_n *= share;
  c.stiffness_n_per_m *= share;
  c.part = section->part;
  c.along = section->along;
  c.core = section->core;
  const Vec3 n_S(out.x(), out.y(), 0);
  c.nhat_B = patch.X_BS.rotate(n_S);
  c.p_B = patch.X_BS * Vec3(section->middle_S + (c.deep_m - section->radius_m) * n_S);
}

}  // namespace osteon
