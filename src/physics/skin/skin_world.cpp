#include "skin/skin_world.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "osteon/scene/soft_events.h"
#include "skin/skin_box.h"
#include "soft/soft_touch.h"

namespace osteon {
namespace {

// A part so near may touch before physics has looked again, even at 1 m/s.
constexpr double kSkinNear_m = 0.006;
constexpr double kSkinDeepest_m = 0.08;  // what is deeper is on the limb's other side
constexpr double kSkinThinnest_m = 0.0003, kSkinThickest_m = 0.006;  // of a tip that presses
constexpr double kSkinWidest_m = 0.012;    // the same of a disc that a box presses like
constexpr double kSkinFollows_s = 0.02;    // the stiffness that is felt follows the sheet's
constexpr double kSkinAcross = 0.7;        // a blade that lies flat does not cut
constexpr double kSkinScratch_m = 0.0002;  // an edge that is in by less opens nothing
constexpr double kSkinInGroove_m = 0.0006;
constexpr double kSkinDrops_m_per_s = 0.1;  // an edge falls so fast into an open groove
constexpr double kSkinGrooveShare = 2.5;    // of the thickness: how deep a hole's slit is
constexpr int kSkinSamples = 8;
constexpr double kSkinPortalCloses_s = 0.06;  // a portal has closed about a shaft after 50 ms
constexpr double kSkinOneOpening_m = 0.006;   // a shaft goes in so near: it is the same portal
constexpr double kSkinAtOnePlace_m = 0.0025;  // for two shafts at a time
constexpr double kSkinRounding = 1 + 1e-9;

bool usable_tool(const ToolState& tool) {
  return tool.tick > 0 && is_finite(tool.X_WP) && tool.X_WP.p.squaredNorm() < 1e12;
}

}  // namespace

/// Where a tool is deepest in a patch.
struct SkinWorld::Place {
  std::uint32_t part = 0;
  double along = 0, radius_m = 0, deep_m = 0;
  Vec3 core = Vec3::Zero();
  Vec3 p_S = Vec3::Zero();  ///< on the skin
  Vec3 n_S = Vec3::UnitZ();
};

SkinWorld::SkinWorld(const SoftSetup& setup, double coupling_n_per_m, double limit_n, double step_s,
                     std::uint32_t first_made)
    : setup_(setup),
      coupling_n_per_m_(coupling_n_per_m),
      limit_n_(limit_n),
      step_s_(step_s),
      first_made_(first_made) {
  patches_.resize(setup_.skins.size());
  clear();
  events_.reserve(kMaxHands * kMaxSkins * 7);
  scratch_.near.reserve(1024);
  for (const SkinPatch& patch : setup_.skins) (void)patch.whole->stiffness({}, scratch_);
}
SkinWorld::~SkinWorld() = default;

// Of a tray without names its tools press, and nothing more.
const SkinTool& SkinWorld::use_of(std::uint32_t instrument) const {
  static const SkinTool presses;
  return instrument < setup_.skin_tools.size() ? setup_.skin_tools[instrument] : presses;
}

void SkinWorld::clear() {
  for (std::size_t s = 0; s < patches_.size(); ++s) put(s, {});
  hands_ = {};
  bares_ = SkinBare::kNone;
}

std::optional<SkinWorld::Place> SkinWorld::deepest_box(std::size_t s, const RoundBox& box_S) const {
  const SkinPatch& patch = setup_.skins[s];
  if (lowest(box_S, Vec3::UnitZ()) > patch.relief.highest_m() + kSkinNear_m) return {};
  for (int k = 0; k < 2; ++k) {
    const double half = 0.5 * (k == 0 ? patch.width_m : patch.height_m);
    if (lowest(box_S, Vec3::Unit(k)) > half || highest(box_S, Vec3::Unit(k)) < -half) return {};
  }
  const auto on = box_on_skin(patch, box_S);
  if (!on) return {};
  Place place;
  place.radius_m = std::clamp(on->radius_m, kSkinThinnest_m, kSkinWidest_m);
  place.deep_m = on->deep_m;
  place.core = on->core;
  place.p_S = on->p_S;
  place.n_S = on->n_S;
  return place;
}

// The height of the axis over the skin, across it, along the part: of samples where the patch is
// under it the deepest, and between its neighbours the top of their parabola.
std::optional<SkinWorld::Place> SkinWorld::deepest(std::size_t s, const SkinToolNow& now,
                                                   double most_m) const {
  const SkinPatch& patch = setup_.skins[s];
  const Pose X_ST = patches_[s].X_WS.inverse() * now.tool->X_WP;
  const double half[2] = {0.5 * patch.width_m, 0.5 * patch.height_m};
  std::optional<Place> best;
  const auto take = [&](const Place& place) {
    if (place.deep_m < most_m && (!best || place.deep_m > best->deep_m)) best = place;
  };
  for (std::uint32_t part = 0; part < now.parts.size(); ++part) {
    if (now.parts[part].is_box) {
      const RoundBox box_S = placed(X_ST, now.parts[part]);
      const double most = patch.relief.highest_m() - lowest(box_S, Vec3::UnitZ());
      if (best && best->deep_m > 0 && most < best->deep_m) continue;  // another is deeper
      if (auto place = deepest_box(s, box_S)) {
        place->part = part;
        take(*place);
      }
      continue;
    }
    const Capsule& rod = now.parts[part].rod;
    const Vec3 a = X_ST * rod.p0, way = X_ST * rod.p1 - a;
    const double reach = patch.relief.highest_m() + rod.radius + kSkinNear_m;
    if (std::min(a.z(), a.z() + way.z()) > reach) continue;
    double from = 0, to = 1;
    for (int k = 0; k < 2; ++k) {
      if (std::abs(way[k]) < 1e-12) {
        if (std::abs(a[k]) > half[k]) to = -1;
        continue;
      }
      const double t0 = (-half[k] - a[k]) / way[k], t1 = (half[k] - a[k]) / way[k];
      from = std::max(from, std::min(t0, t1));
      to = std::min(to, std::max(t0, t1));
    }
    if (!(from <= to)) continue;
    const auto look = [&](double t) {
      const Vec3 q = a + t * way;
      const SkinRelief::Place here = patch.relief.at(q.head<2>());
      Place place;
      place.part = part;
      place.along = t;
      place.radius_m = std::clamp(rod.radius, kSkinThinnest_m, kSkinThickest_m);
      place.n_S = Vec3(-here.slope.x(), -here.slope.y(), 1).normalized();
      place.p_S = {q.x(), q.y(), here.height_m};
      place.deep_m = rod.radius - (q.z() - here.height_m) * place.n_S.z();
      return place;
    };
    const bool is_ball = way.squaredNorm() < 1e-14;
    std::array<double, kSkinSamples + 1> deep{};
    int top = 0;
    for (int i = 0; i <= (is_ball ? 0 : kSkinSamples); ++i) {
      const Place place = look(from + (to - from) * i / kSkinSamples);
      deep[static_cast<std::size_t>(i)] = place.deep_m;
      if (place.deep_m > deep[static_cast<std::size_t>(top)]) top = i;
      take(place);
    }
    if (top == 0 || top == kSkinSamples) continue;
    const auto at = static_cast<std::size_t>(top);
    const double bend = deep[at - 1] - 2 * deep[at] + deep[at + 1];
    if (!(bend < 0)) continue;
    const double off = std::clamp(0.5 * (deep[at - 1] - deep[at + 1]) / bend, -0.5, 0.5);
    take(look(from + (to - from) * (top + off) / kSkinSamples));
  }
  return best;
}

void SkinWorld::let_go(const At& at) {
  SkinHand& hand = *at.state;
  if (hand.cutting) end_stroke_of(at);
  if (hand.pierce.through)
    tell_event(at, kSkinLeft,
               {static_cast<double>(step_ - hand.since_step) * step_s_, 1e3 * hand.deepest_m,
                hand.pull_n});
  const BandTouch touch = hand.touch;
  hand = {};
  hand.touch = touch;
}

void SkinWorld::follow(const At& at) {
  SkinHand& hand = *at.state;
  const SkinPatch& patch = setup_.skins[at.patch];
  const ToolState* tool = at.now->tool;
  if (hand.near && (!tool || tool->instrument != hand.instrument)) let_go(at);
  if (!tool) return;
  const auto place = deepest(at.patch, *at.now, kSkinDeepest_m);
  if (!place || place->deep_m < -kSkinNear_m) {
    if (hand.near) let_go(at);
    return;
  }
  const bool begins = !hand.near;
  hand.near = true;
  hand.instrument = tool->instrument;
  SkinContact& c = hand.contact;
  c.patch = static_cast<std::uint32_t>(at.patch);
  c.bone = patch.bone.index;
  c.part = place->part;
  c.along = place->along;
  c.core = place->core;
  c.deep_m = place->deep_m;
  c.p_B = patch.X_BS * place->p_S;
  c.nhat_B = patch.X_BS.rotate(place->n_S);
  hand.p = place->p_S.head<2>();
  if (setup_.wounds_open && follow_wound(at, begins)) return;
  const SkinTool& use = use_of(tool->instrument);
  const double radius_m =
      use.pierces ? std::clamp(use.through_m, kSkinThinnest_m, kSkinThickest_m) : place->radius_m;
  // What of a box presses changes as it tilts: that is to be felt without a step.
  if (at.now->parts[c.part].is_box && !begins)
    hand.radius_m += std::min(1.0, step_s_ / kSkinFollows_s) * (radius_m - hand.radius_m);
  else
    hand.radius_m = radius_m;
  const double yields = patches_[at.patch].yields->stiffness({hand.p, hand.radius_m}, scratch_);
  if (begins) {
    hand.yields_n_per_m = yields;
    hand.barred = c.deep_m > 0;
  }
  hand.yields_n_per_m += std::min(1.0, step_s_ / kSkinFollows_s) * (yields - hand.yields_n_per_m);
  follow_portal(at);
  if (!(c.deep_m > 0)) hand.barred = false;
  press(at);
}

// What a portal lets through does not press the skin about it. In a hole that was made here the
// portal takes over what the rim does, while it closes about the shaft.
void SkinWorld::follow_portal(const At& at) {
  SkinHand& hand = *at.state;
  if (hand.pierce.through) hand.deepest_m = std::max(hand.deepest_m, hand.contact.deep_m);
  if (at.now->tool->portal == kNoPortal || hand.cutting) return;
  if (!hand.pierce.through)
    hand.barred = true;
  else if (hand.contact.made != kNotMade)
    hand.barred = static_cast<double>(++hand.held_steps) * step_s_ >= kSkinPortalCloses_s;
}

void SkinWorld::press(const At& at) {
  SkinHand& hand = *at.state;
  SkinContact& c = hand.contact;
  const SkinPatch& patch = setup_.skins[at.patch];
  const SkinTool& use = use_of(hand.instrument);
  c.force_n = c.stiffness_n_per_m = c.aside_n_per_m = 0;
  if (hand.barred) {
    if (hand.cutting) end_stroke_of(at);
    return;
  }
  const SheetPush usual{hand.yields_n_per_m, patch.share.at(hand.radius_m, hand.yields_n_per_m),
                        patch.sheet->material().fat_m, coupling_n_per_m_};
  const SheetPush push = over_cover(usual, patch.cover.at(hand.p).height_m);
  if (use.through_m > 0 && !(setup_.wounds_open && use.retracts))
    pass(at, push);
  else
    slice(at, push);
  if (c.through) return;
  const double share = felt_share(patch, hand.p);
  c.force_n *= share;
  c.stiffness_n_per_m *= share;
}

// F(d - e), with e how far the edge is in: where F is above what the skin bears, e grows until it
// is not.
void SkinWorld::slice(const At& at, const SheetPush& push) {
  SkinHand& hand = *at.state;
  SkinContact& c = hand.contact;
  const SkinPatch& patch = setup_.skins[at.patch];
  const SkinTool& use = use_of(hand.instrument);
  Patch& mine = patches_[at.patch];
  const Vec3 flat_B =
      patch.X_BS.rotate((mine.X_WS.inverse() * at.now->tool->X_WP).rotate(use.flat_T));
  const bool edge = (use.edge >> c.part & 1) && !(std::abs(flat_B.dot(c.nhat_B)) > kSkinAcross);
  hand.entered_m = std::clamp(hand.entered_m, 0.0, std::max(0.0, c.deep_m));
  if (edge && c.deep_m > 0) {
    const double groove = mine.slits.near(hand.p, kSkinInGroove_m).depth_m;
    if (groove > hand.entered_m)
      hand.entered_m = std::min({c.deep_m, groove, hand.entered_m + kSkinDrops_m_per_s * step_s_});
  }
  SheetTouch touch = push_sheet(push, c.deep_m - hand.entered_m);
  const bool cuts = edge && touch.force_n > patch.edge_n;
  if (cuts) {
    hand.entered_m = c.deep_m - pushed_by(push, patch.edge_n);
    touch = push_sheet(push, c.deep_m - hand.entered_m);
  }
  c.force_n = touch.force_n;
  c.stiffness_n_per_m = touch.stiffness_n_per_m;
  if (cuts && !hand.cutting && hand.entered_m > kSkinScratch_m) begin_to_cut(at, touch.force_n);
  if (!hand.cutting) return;
  if (!(hand.entered_m > kSkinScratch_m)) return end_stroke_of(at);
  hand.deepest_m = std::max(hand.deepest_m, hand.entered_m);
  const std::uint32_t was = mine.cuts.blade_at;
  const double opened_m = go_on(*patch.sheet, mine.cuts, hand.p, hand.entered_m);
  hand.stroke_m += opened_m;
  mine.cut_m += opened_m;
  if (mine.cuts.blade_at != was) changed(at.patch);
  if (!mine.cuts.blade_in) end_stroke_of(at);
}

// One blade at a time is in a sheet.
void SkinWorld::begin_to_cut(const At& at, double force_n) {
  SkinHand& hand = *at.state;
  Patch& mine = patches_[at.patch];
  if (mine.cuts.blade_in) return;
  begin_stroke(*setup_.skins[at.patch].sheet, mine.cuts, hand.p);
  if (!mine.cuts.blade_in) return;
  hand.cutting = true;
  hand.since_step = step_;
  hand.stroke_m = hand.deepest_m = 0;
  tell_event(at, kSkinCut, {force_n, 1e3 * hand.entered_m, 0});
  changed(at.patch);
}

void SkinWorld::end_stroke_of(const At& at) {
  SkinHand& hand = *at.state;
  Patch& mine = patches_[at.patch];
  const double opened_m =
      end_stroke(*setup_.skins[at.patch].sheet, mine.cuts, hand.p, hand.deepest_m);
  hand.stroke_m += opened_m;
  mine.cut_m += opened_m;
  hand.cutting = false;
  tell_event(at, kSkinCutEnd,
             {1e3 * hand.stroke_m, 1e3 * hand.deepest_m,
              static_cast<double>(step_ - hand.since_step) * step_s_});
  changed(at.patch);
}

// Elastic until it breaks or a slit lets it in; then the hole's rim holds the shaft, and the fat
// the tip.
void SkinWorld::pass(const At& at, const SheetPush& push) {
  SkinHand& hand = *at.state;
  SkinContact& c = hand.contact;
  const SkinPatch& patch = setup_.skins[at.patch];
  const SkinTool& use = use_of(hand.instrument);
  const SheetTouch touch = push_sheet(push, c.deep_m);
  if (!hand.pierce.through) {
    c.through = false;
    c.force_n = touch.force_n;
    c.stiffness_n_per_m = touch.stiffness_n_per_m;
    const double slit_m = slit_at(at);
    const PierceLaw law =
        pierce_law(patch.sheet->material(), use.through_m, slit_m, hand.yields_n_per_m);
    const bool may = use.pierces || !(law.peak_n > 0);
    if (!may || !(c.deep_m > 0)) return;
    if (!pierce_step(hand.pierce, law, c.deep_m, touch.force_n, step_s_)) return;
    hand.slit_m = slit_m;
    hand.hole = hand.p;
    hand.since_step = step_;
    hand.deepest_m = c.deep_m;
    hand.pull_n = 0;
    if (law.peak_n > 0) {
      tell_event(at, kSkinPierced, {touch.force_n, 1e3 * c.deep_m, 2e3 * law.hole_m});
      make_hole(at, law.hole_m);
    } else {
      tell_event(at, kSkinEntered, {1e3 * slit_m, 0, 0});
    }
  } else {
    const PierceLaw law =
        pierce_law(patch.sheet->material(), use.through_m, hand.slit_m, hand.yields_n_per_m);
    (void)pierce_step(hand.pierce, law, c.deep_m, touch.force_n, step_s_);
    const double held = hand.pierce.force_n - hand.pierce.excess_n;
    const bool sticks = held > -law.grip_n && held < law.grip_n + law.resist_n;
    c.force_n = hand.pierce.force_n;
    c.stiffness_n_per_m = sticks ? std::min(law.stick_n_per_m, coupling_n_per_m_) : 0;
    hand.pull_n = std::max(hand.pull_n, -c.force_n);
  }
  const bool deep = c.deep_m >= patch.sheet->material().thickness_m;
  if (c.made == kNotMade && deep && use.makes_portal) make_portal(at);
  c.through = true;
  const SkinRelief::Place here = patch.relief.at(hand.hole);
  c.hole_B = patch.X_BS * Vec3(hand.hole.x(), hand.hole.y(), here.height_m);
  c.aside_n_per_m = std::min(hand.yields_n_per_m, coupling_n_per_m_);
  if (c.deep_m > 0) return;
  tell_event(
      at, kSkinLeft,
      {static_cast<double>(step_ - hand.since_step) * step_s_, 1e3 * hand.deepest_m, hand.pull_n});
  hand.pierce = {};
  hand.slit_m = 0;
  hand.held_steps = 0;
  c.made = kNotMade;
  c.through = false;
  c.force_n = c.stiffness_n_per_m = 0;
}

// A slit along x, as long as half of the hole's circumference.
void SkinWorld::make_hole(const At& at, double radius_m) {
  Patch& mine = patches_[at.patch];
  const SkinSheet& sheet = *setup_.skins[at.patch].sheet;
  ++mine.holes;
  if (mine.cuts.blade_in) return;  // another hand cuts here: its stroke goes on
  const SheetPoint half(0.5 * std::numbers::pi * radius_m, 0);
  const double depth_m = kSkinGrooveShare * sheet.material().thickness_m;
  begin_stroke(sheet, mine.cuts, at.state->p - half);
  mine.cut_m += end_stroke(sheet, mine.cuts, at.state->p + half, depth_m);
  changed(at.patch);
}

// Length of the slit in which the tip is set. The hole of a portal is one that goes around it.
double SkinWorld::slit_at(const At& at) const {
  const Patch& mine = patches_[at.patch];
  const SheetPoint& p = at.state->p;
  const double reach_m = use_of(at.state->instrument).through_m;
  double length_m = mine.slits.near(p, reach_m).length_m;
  for (std::uint32_t i = 0; i < mine.made_count; ++i)
    if ((mine.made[i].at - p).norm() < reach_m)
      length_m = std::max(length_m, kSkinRounding * std::numbers::pi * mine.made[i].hole_m);
  return length_m;
}

// Whether the shaft of another hand is in it.
bool SkinWorld::is_taken(std::size_t s, std::uint32_t portal, std::size_t but) const {
  const std::size_t number = s * kMadePerPatch + portal;
  for (std::size_t h = 0; h < kMaxHands; ++h)
    if (h != but && hands_[h][s].pierce.through && hands_[h][s].contact.made == number) return true;
  return false;
}

// The portal of the opening that lets the tool in: the nearest.
std::optional<std::uint32_t> SkinWorld::opening_at(const At& at) const {
  const Patch& mine = patches_[at.patch];
  std::optional<std::uint32_t> best;
  double nearest = kSkinOneOpening_m;
  for (std::uint32_t i = 0; i < mine.made_count; ++i) {
    const double far = (mine.made[i].at - at.state->hole).norm();
    const double reach = is_taken(at.patch, i, at.hand) ? kSkinAtOnePlace_m : kSkinOneOpening_m;
    if (!(far < std::min(nearest, reach))) continue;
    nearest = far;
    best = i;
  }
  return best;
}

// A hole through skin is a portal once the shaft is in it as deep as the skin is thick. What goes
// in later where it is open goes through the same one: in a slit it lies where the shaft does,
// unless another holds it. Where there is no room for one more, the patch alone holds the shaft.
void SkinWorld::make_portal(const At& at) {
  SkinHand& hand = *at.state;
  Patch& mine = patches_[at.patch];
  const PierceLaw law =
      pierce_law(setup_.skins[at.patch].sheet->material(), use_of(hand.instrument).through_m,
                 hand.slit_m, hand.yields_n_per_m);
  const bool pierced = law.peak_n > 0;
  auto portal = pierced ? std::nullopt : opening_at(at);
  const bool is_new = !portal;
  if (is_new) {
    if (mine.made_count == kMadePerPatch) return;
    portal = mine.made_count++;
    mine.made[*portal] = {hand.hole, 0, pierced};
  }
  SkinPortal& made = mine.made[*portal];
  if (is_new || !is_taken(at.patch, *portal, at.hand)) made.at = hand.hole;
  made.hole_m = std::max(made.hole_m, law.hole_m);
  hand.contact.made = static_cast<std::uint32_t>(at.patch * kMadePerPatch + *portal);
  if (!is_new) return;
  const SkinRelief& relief = setup_.skins[at.patch].relief;
  const double rise_m = relief.at(hand.hole).height_m - relief.at(SheetPoint::Zero()).height_m;
  tell_event(at, kPortalMade,
             {1e3 * std::hypot(hand.hole.norm(), rise_m), pierced ? 1.0 : 0.0,
              2e3 * use_of(hand.instrument).through_m});
}

void SkinWorld::follow_stiffness(std::size_t s) {
  Patch& mine = patches_[s];
  const SkinSheet& sheet = *setup_.skins[s].sheet;
  if (!mine.work) {
    if (mine.cuts_hash == mine.felt_hash) return follow_lips(s);
    mine.next = cuts_to_keep(sheet, mine.cuts);
    mine.next_hash = mine.cuts_hash;
    mine.worked = 0;
    mine.work = std::make_unique<SheetWork>(sheet, mine.cuts);
    return;
  }
  ++mine.worked;
  if (!mine.work->step()) return;
  mine.yields = mine.work->take();
  mine.work = nullptr;
  mine.felt = std::move(mine.next);
  mine.felt_hash = mine.next_hash;
  mine.next = {};
  mine.next_hash = kSkinStill;
  mine.worked = 0;
  mine.lip_work = nullptr;
  mine.lips_worked = 0;
}

void SkinWorld::tell_touch(const At& at, std::uint64_t step) {
  SkinHand& hand = *at.state;
  const bool felt = hand.near && !hand.barred && hand.contact.deep_m > 0;
  const double force_n = felt ? std::abs(hand.contact.force_n) : 0;
  const double deep_m = !felt ? 0 : hand.in_wound ? drawn_aside_m(at) : hand.contact.deep_m;
  readouts_[at.patch].force_n[at.hand] = force_n;
  readouts_[at.patch].deep_m[at.hand] = deep_m;
  const TouchNews news = follow_touch(hand.touch, {true, force_n, deep_m}, limit_n_, step, step_s_);
  if (news.begins) tell_event(at, kSoftBegin, {});
  if (news.over) tell_event(at, kSoftOver, {force_n, limit_n_, 0});
  if (news.ends) tell_event(at, kSoftEnd, {news.since_s, news.peak_n, news.deepest_mm});
}

void SkinWorld::tell_event(const At& at, EventKind kind, const std::array<double, 3>& values) {
  if (events_.size() == events_.capacity()) return;
  const SkinHand& hand = *at.state;
  Event event;
  event.kind = kind;
  event.hand = static_cast<std::uint8_t>(at.hand);
  event.subject_kind = SubjectKind::kSoftPart;
  event.subject = setup_.skins[at.patch].soft;
  if (kind == kPortalMade) {
    event.subject_kind = SubjectKind::kPortal;
    event.subject = first_made_ + hand.contact.made;
  }
  event.values = values;
  const double h = setup_.skins[at.patch].relief.at(hand.p).height_m;
  event.p_W = patches_[at.patch].X_WS * Vec3(hand.p.x(), hand.p.y(), h);
  events_.push_back(event);
}

bool SkinWorld::is_bare(std::size_t s) const {
  if (bares_ != SkinBare::kPortals) return bares_ == SkinBare::kAll;
  if (!is_for_portal(setup_.skins[s])) return false;
  for (std::size_t i = 0; i < patches_.size(); ++i)
    if (is_for_portal(setup_.skins[i]) && patches_[i].made_count == 0) return false;
  return true;
}

void SkinWorld::step(std::span<const SkinToolNow> hands, const BoneSnapshot& bones) {
  events_.clear();
  step_ = bones.step;
  for (std::size_t s = 0; s < patches_.size(); ++s) {
    const bool bare = is_bare(s);
    const Pose& X_WB = bones.bones[setup_.skins[s].bone.index].X_WB;
    const bool lies = is_finite(X_WB);
    if (lies) patches_[s].X_WS = X_WB * setup_.skins[s].X_BS;
    readouts_[s] = {};
    std::copy(hands.begin(), hands.end(), now_.begin());
    tools_ = std::span(now_).first(hands.size());
    for (std::size_t h = 0; h < hands.size(); ++h) {
      SkinToolNow& now = now_[h];
      if (now.tool && (bare || !lies || !usable_tool(*now.tool))) now.tool = nullptr;
      const At at{h, s, &now, &hands_[h][s]};
      follow(at);
      if (!at.state->in_wound) tell_touch(at, bones.step);
    }
    if (setup_.wounds_open) hold_open(s, bones.step);
    follow_stiffness(s);
  }
}

void SkinWorld::tell(std::size_t hand, BandContacts& contacts) const {
  for (std::size_t s = 0; s < patches_.size(); ++s)
    if (hands_[hand][s].near && (!hands_[hand][s].barred || hands_[hand][s].contact.through))
      contacts.skins[contacts.skin_count++] = hands_[hand][s].contact;
  for (std::size_t s = 0; s < patches_.size(); ++s)
    for (std::uint32_t i = 0; i < patches_[s].made_count; ++i)
      contacts.made[s * kMadePerPatch + i] = made_portal(s, i);
}

MadePortal SkinWorld::made_portal(std::size_t s, std::uint32_t portal) const {
  const SkinPatch& patch = setup_.skins[s];
  const SheetPoint& p = patches_[s].made[portal].at;
  const SkinRelief::Place here = patch.relief.at(p);
  MadePortal out;
  out.open = true;
  out.pierced = patches_[s].made[portal].pierced;
  out.bare = is_bare(s);
  out.bone = patch.bone.index;
  out.p_B = patch.X_BS * Vec3(p.x(), p.y(), here.height_m);
  out.nhat_B = patch.X_BS.rotate(Vec3(-here.slope.x(), -here.slope.y(), 1).normalized());
  return out;
}

}  // namespace osteon
