#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "osteon/physics/carving.h"
#include "osteon/physics/soft_cut_state.h"
#include "osteon/session/session_state.h"

namespace osteon {
namespace {

// The most pairs of pieces that a state may name: bounds what a damaged file can ask for.
constexpr std::uint64_t kMostPairs = 4'000'000;
constexpr std::uint64_t kVersion = 16;
constexpr std::uint64_t kMostCutCells = 4096, kMostCutWork = 1u << 16;
constexpr std::uint64_t kMostCarvedBones = kMaxBones, kMostCarvedBlocks = 1u << 20;

// Appends words. One list of fields below serves both directions.
struct Out {
  static constexpr bool kReads = false;
  std::string bytes;
  bool ok = true;
  void word(std::uint64_t value) {
    char raw[8];
    for (int i = 0; i < 8; ++i) raw[i] = static_cast<char>((value >> (8 * i)) & 0xff);
    bytes.append(raw, sizeof raw);
  }
};

struct In {
  static constexpr bool kReads = true;
  std::string_view bytes;
  std::size_t at = 0;
  bool ok = true;
  std::uint64_t version = kVersion;
  std::uint64_t word() {
    if (bytes.size() - at < 8) {
      ok = false;
      return 0;
    }
    std::uint64_t value = 0;
    for (int i = 0; i < 8; ++i)
      value |= std::uint64_t{static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)])}
               << (8 * i);
    at += 8;
    return value;
  }
};

// Whether a state says how far the hand has turned what it carves with.
bool knows_twist(const Out&) { return true; }
bool knows_twist(const In& in) { return in.version >= 4; }

// Whether it says what leads instruments.
bool knows_guides(const Out&) { return true; }
bool knows_guides(const In& in) { return in.version >= 6; }

// Whether it says which holes were left.
bool knows_holes(const Out&) { return true; }
bool knows_holes(const In& in) { return in.version >= 9; }

// Whether it says how a reamer chatters.
bool knows_chatter(const Out&) { return true; }
bool knows_chatter(const In& in) { return in.version >= 16; }

// Whether it says what graft was handed over.
bool knows_orders(const Out&) { return true; }
bool knows_orders(const In& in) { return in.version >= 13; }

template <class A, class T>
void number(A& a, T& value, std::uint64_t most) {
  if constexpr (A::kReads) {
    const std::uint64_t word = a.word();
    a.ok = a.ok && word <= most;
    value = a.ok ? static_cast<T>(word) : T{};
  } else {
    a.word(static_cast<std::uint64_t>(value));
  }
}

template <class A>
void field(A& a, double& value) {
  if constexpr (A::kReads)
    value = std::bit_cast<double>(a.word());
  else
    a.word(std::bit_cast<std::uint64_t>(value));
}
template <class A>
void field(A& a, std::uint64_t& value) {
  number(a, value, ~std::uint64_t{0});
}
template <class A>
void field(A& a, std::uint32_t& value) {
  number(a, value, 0xffffffffu);
}
template <class A>
void field(A& a, std::uint8_t& value) {
  number(a, value, 0xff);
}
template <class A>
void field(A& a, bool& value) {
  number(a, value, 1);
}
template <class A>
void field(A& a, Vec3& v) {
  for (int i = 0; i < 3; ++i) field(a, v[i]);
}
template <class A>
void field(A& a, Pose& X) {
  field(a, X.p);
  for (int i = 0; i < 4; ++i) field(a, X.q.coeffs()[i]);
}
template <class A>
void field(A& a, BoneId& id) {
  field(a, id.index);
}

template <class A>
void field(A& a, Contact& c) {
  field(a, c.bone);
  field(a, c.piece);
  field(a, c.p_W);
  field(a, c.nhat_BT_W);
  field(a, c.depth_m);
  field(a, c.force_on_tool_W);
}

template <class A>
void field(A& a, ToolContact& c) {
  field(a, c.hand);
  field(a, c.p_W);
  field(a, c.nhat_W);
  field(a, c.force_on_tool_W);
}

template <class A, class T>
void first_of(A& a, std::uint32_t& count, T& list) {
  number(a, count, list.size());
  for (std::uint32_t i = 0; i < count; ++i) field(a, list[i]);
}

template <class A>
void field(A& a, ToolState& t) {
  field(a, t.tick);
  field(a, t.time_s);
  field(a, t.X_WD);
  field(a, t.X_WP);
  field(a, t.v_W);
  field(a, t.force_W);
  field(a, t.buttons);
  field(a, t.status);
  first_of(a, t.contact_count, t.contacts);
  first_of(a, t.tool_contact_count, t.tool_contacts);
  field(a, t.epoch);
  field(a, t.instrument);
  field(a, t.power);
  field(a, t.jaw);
  field(a, t.portal);
}

template <class A>
void field(A& a, OtherTool& t) {
  field(a, t.tick);
  field(a, t.instrument);
  field(a, t.p_WD);
  field(a, t.X_WP);
  field(a, t.v_W);
}

template <class A>
void field(A& a, BoneMotion& b) {
  field(a, b.X_WB);
  field(a, b.v_W);
  field(a, b.w_W);
}

template <class A>
void field(A& a, ToolGuide& g) {
  field(a, g.on);
  if (!g.on) return;
  field(a, g.instrument);
  field(a, g.bone);
  field(a, g.p_B);
  field(a, g.nhat_B);
  for (double* x : {&g.grip, &g.give_m_per_n, &g.stop_m}) field(a, *x);
  for (bool* x : {&g.in_hole, &g.stops}) field(a, *x);
  if constexpr (A::kReads)
    if (a.version < 12) return;  // nothing pulled then
  field(a, g.pulls);
}

template <class A>
void field(A& a, GuideRod& r) {
  number(a, r.kind, static_cast<std::uint64_t>(GuideRod::Kind::kSleeve));
  if (r.kind == GuideRod::Kind::kNone) return;
  number(a, r.bone, kMaxBones - 1);
  field(a, r.X_BR);
  for (double* x : {&r.radius_m, &r.length_m, &r.in_bone_m}) field(a, *x);
}

template <class A>
void field(A& a, TendonOnBench& t) {
  number(a, t.bands_cut, (1u << kMostBands) - 1);
  field(a, t.front_m);
  for (bool* x : {&t.stripped, &t.amputated}) field(a, *x);
  number(a, t.folds, 4);
}

template <class A>
void field(A& a, BenchHand& h) {
  field(a, h.instrument);
  number(a, h.line, GraftBenchPlan::kLines);
  for (double* x : {&h.grip, &h.front_m}) field(a, *x);
  number(a, h.carries, kGraftTendons);
  field(a, h.shut);
  number(a, h.over, kGraftTendons * kMostBands);
  field(a, h.from_W);
  field(a, h.hangs);
}

template <class A>
void field(A& a, GraftBenchState& s) {
  if constexpr (A::kReads)
    if (a.version < 8) return;  // there was no bench then
  field(a, s.on);
  if (!s.on) return;
  for (TendonOnBench& tendon : s.tendons) field(a, tendon);
  for (BenchHand& hand : s.hands) field(a, hand);
  for (double* x : {&s.passed_m, &s.refused_m, &s.loop_m, &s.tension_n, &s.creep_s}) field(a, *x);
}

template <class A>
void field(A& a, PlacingHand& h) {
  field(a, h.instrument);
  number(a, h.line, static_cast<std::uint64_t>(PlacingLine::kScrew));
  field(a, h.grip);
  field(a, h.shut);
  field(a, h.from_m);
}

template <class A>
void field(A& a, PlacingScrew& s) {
  for (std::uint32_t* x : {&s.screws, &s.cycles}) field(a, *x);
  field(a, s.p_B);
  field(a, s.out_B);
  for (double* x : {&s.width_m, &s.length_m, &s.in_m, &s.tension_n, &s.flexion_deg}) field(a, *x);
  field(a, s.done);
}

template <class A>
void field(A& a, PlacingTunnel& t) {
  number(a, t.bone, kMaxBones - 1);
  field(a, t.mouth_B);
  field(a, t.outer_B);
  field(a, t.radius_m);
}

// What was told of a graft, and the plan of one that is there.
template <class A>
void field_order(A& a, GraftPlacingState& s) {
  field(a, s.ordered);
  number(a, s.told, kPlacingNumbers);
  for (double& x : s.numbers) field(a, x);
  if (!s.on) return;
  for (PlacingTunnel* t : {&s.plan.femur, &s.plan.tibia}) field(a, *t);
  PlacingPlan& p = s.plan;
  for (double* x : {&p.socket_m, &p.between_m, &p.tibia_bend_rad, &p.femur_bend_rad, &p.graft_m,
                    &p.graft_length_m, &p.loop_m, &p.tail_n})
    field(a, *x);
}

template <class A>
void field(A& a, GraftPlacingState& s) {
  if constexpr (A::kReads)
    if (a.version < 12) return;  // no graft was placed then
  field(a, s.on);
  const bool old = !knows_orders(a);
  if (!old) field_order(a, s);
  if (!s.on) return;
  number(a, s.phase, static_cast<std::uint64_t>(PlacingPhase::kTurned));
  for (PlacingHand& hand : s.hands) field(a, hand);
  field(a, s.end_W);
  number(a, s.holder, kPlacingHands);
  for (std::uint32_t* x : {&s.lost, &s.let_go_early}) field(a, *x);
  for (double* x : {&s.pin_m, &s.drawn_m, &s.pull_n, &s.most_pull_n, &s.gap_m}) field(a, *x);
  if (old) return;
  field(a, s.tension_n);
  field(a, s.cycles_before);
  field(a, s.screw);
}

template <class A>
void field(A& a, BendState& s) {
  if constexpr (A::kReads)
    if (a.version < 13) return;  // no joint was bent then
  field(a, s.on);
  if (!s.on) return;
  for (double* x : {&s.wanted_deg, &s.now_deg}) field(a, *x);
  field(a, s.straight);
  field(a, s.cycles);
}

template <class A>
void field(A& a, Wound& w) {
  field(a, w.soft);
  if (w.soft == kNoWound) return;
  number(a, w.bone.index, kMaxBones - 1);
  field(a, w.p_B);
  field(a, w.open_m2);
}

template <class A>
void field(A& a, WaterState& s) {
  if constexpr (A::kReads)
    if (a.version < 11) return;  // it was in no state then
  field(a, s.on);
  if (!s.on) return;
  field(a, s.hashed);
  for (double* x : {&s.pump_pa, &s.outlet_open, &s.pressure_pa, &s.blood, &s.debris, &s.suction,
                    &s.bleeding_m3_s, &s.debris_m3_s, &s.removed_m3, &s.vascular_m3, &s.opened_m3})
    field(a, *x);
  for (Wound& wound : s.wounds) field(a, wound);
}

template <class A>
void field(A& a, BoneSnapshot& s) {
  field(a, s.step);
  field(a, s.time_s);
  field(a, s.epoch);
  field(a, s.saved_step);
  first_of(a, s.count, s.bones);
  if (!knows_guides(a)) return;
  for (ToolGuide& guide : s.guides) field(a, guide);
  for (GuideRod& rod : s.rods) field(a, rod);
  field(a, s.bench);
  field(a, s.water);
  field(a, s.placing);
  field(a, s.bend);
}

template <class A>
void field(A& a, PortalHold& p) {
  field(a, p.portal);
  field(a, p.anchor_m);
  field(a, p.sliding);
  field(a, p.grip);
  field(a, p.tip_depth_m);
  field(a, p.nearest);
}

template <class A>
void field(A& a, PairMemory& pair) {
  field(a, pair.pair);
  number(a, pair.basis.count, pair.basis.rows.size());
  for (std::uint8_t i = 0; i < pair.basis.count; ++i) field(a, pair.basis.rows[i]);
  field(a, pair.known);
  if (!pair.known) return;
  field(a, pair.plane.nhat_BT_B);
  field(a, pair.plane.bone_support);
  field(a, pair.plane.gap);
  field(a, pair.plane.p_B);
}

bool is_fresh(const PairMemory& pair) { return pair.pair == PairMemory::kNone; }

// Most places are free: only the others stand in the file, by number.
template <class A>
void field(A& a, std::vector<PairMemory>& pairs) {
  std::uint64_t size = pairs.size();
  number(a, size, kMostPairs);
  std::uint64_t used = 0;
  for (const PairMemory& pair : pairs) used += is_fresh(pair) ? 0 : 1;
  number(a, used, size);
  if constexpr (A::kReads) {
    pairs.assign(a.ok ? size : 0, PairMemory{});
    for (std::uint64_t i = 0; i < used && a.ok; ++i) {
      std::uint64_t place = 0;
      number(a, place, size == 0 ? 0 : size - 1);
      if (a.ok) field(a, pairs[place]);
    }
  } else {
    for (std::uint64_t i = 0; i < size; ++i) {
      if (is_fresh(pairs[i])) continue;
      field(a, i);
      field(a, pairs[i]);
    }
  }
}

template <class A>
void field(A& a, SoftRub& s) {
  if constexpr (A::kReads)
    if (a.version < 9) return;  // soft parts did not rub then
  field(a, s.lag_W);
  field(a, s.sliding);
}

template <class A>
void field(A& a, HapticState& s) {
  field(a, s.tool);
  field(a, s.armed);
  field(a, s.sliding);
  field(a, s.carrier);
  field(a, s.grabbing);
  field(a, s.p_WG);
  field(a, s.rub);
  field(a, s.portal);
  field(a, s.fade_n);
  for (OtherTool& other : s.others) field(a, other);
  first_of(a, s.bone_count, s.X_WB);
  field(a, s.pairs);
}

template <class A>
void field(A& a, HapticParams& p) {
  for (double* value : {&p.tick_s, &p.stiffness_n_per_m, &p.damping_n_s_per_m, &p.friction_scale,
                        &p.max_force_n, &p.max_slew_n_per_s, &p.max_turn_rad_per_tick})
    field(a, *value);
  field(a, p.force_on);
  field(a, p.grab_n_per_m);
}

template <class A>
void field(A& a, WatchState& w) {
  field(a, w.touched);
  for (std::size_t i = 0; i < w.touches.size(); ++i) {
    if ((w.touched >> i & 1u) == 0) continue;
    Touch& touch = w.touches[i];
    field(a, touch.first_tick);
    field(a, touch.last_tick);
    field(a, touch.peak_force_n);
    field(a, touch.deepest_m);
  }
  field(a, w.over_since);
  field(a, w.over_bone);
}

template <class A>
void field(A& a, HandMark& m) {
  field(a, m.set);
  if (!m.set) return;
  field(a, m.instrument);
  field(a, m.power);
  field(a, m.jaw);
}

template <class A>
void field(A& a, HandState& h) {
  field(a, h.haptic);
  field(a, h.params);
  field(a, h.bone_step);
  field(a, h.first_tick);
  field(a, h.before);
  for (OtherTool& other : h.seen) field(a, other);
  field(a, h.watch);
  for (HandMark& mark : h.marks) field(a, mark);
}

// Most words of a block are alike: each stands with how often it comes.
template <class A>
void field(A& a, CarveState::Block& b) {
  field(a, b.block);
  constexpr std::size_t kWords = BlockGrid::kNodes / 4;
  std::array<std::uint64_t, kWords> words{};
  if constexpr (!A::kReads) std::memcpy(words.data(), b.cut.data(), sizeof words);
  for (std::size_t n = 0; n < kWords && a.ok;) {
    std::uint64_t count = 1;
    if constexpr (!A::kReads)
      while (n + count < kWords && words[n + count] == words[n]) ++count;
    number(a, count, kWords - n);
    if (count == 0) a.ok = false;
    field(a, words[n]);
    for (std::size_t i = 1; i < count; ++i) words[n + i] = words[n];
    n += count;
  }
  if constexpr (A::kReads) std::memcpy(b.cut.data(), words.data(), sizeof words);
}

template <class A>
void field(A& a, CarveState& s) {
  field(a, s.bone);
  field(a, s.step);
  std::uint64_t blocks = s.blocks.size();
  number(a, blocks, kMostCarvedBlocks);
  for (std::uint64_t n = 0; n < blocks && a.ok; ++n) {
    if constexpr (A::kReads) s.blocks.emplace_back();
    field(a, s.blocks[n]);
  }
}

template <class A>
void field(A& a, CarvingHand& h) {
  field(a, h.bone);
  field(a, h.X_BC);
  field(a, h.drill.depth_m);
  field(a, h.drill.turned_rev);
  field(a, h.drill.was_cutting);
  for (double* x : {&h.due_m, &h.angle_rad, &h.most_torque_nm, &h.plunge_m}) field(a, *x);
  field(a, h.idle);
  field(a, h.since);
  field(a, h.tissue);
  if (knows_twist(a)) field(a, h.twist_rad);
  for (bool* x : {&h.was_in, &h.skives, &h.jaw_open}) field(a, *x);
  field(a, h.out);
  field(a, h.p_out);
  if (!knows_guides(a)) {
    h.instrument = CarvingHand::kAnyInstrument;  // that which the hand holds
    return;
  }
  for (double* x : {&h.lag_m, &h.grip}) field(a, *x);
  field(a, h.mouth_B);
  for (bool* x : {&h.in_hole, &h.open}) field(a, *x);
  number(a, h.rod, kMaxGuideRods);
  field(a, h.instrument);
  if (knows_holes(a)) field(a, h.loose);
  if (!knows_chatter(a)) return;
  for (double* x : {&h.chatter.amplitude_m, &h.chatter.frequency_hz}) field(a, *x);
  field(a, h.chatters_since);
}

template <class A>
void field(A& a, LeftHole& hole) {
  field(a, hole.bone);
  field(a, hole.X_BC);
  field(a, hole.mouth_B);
  for (double* x : {&hole.diameter_m, &hole.lag_m}) field(a, *x);
  field(a, hole.open);
}

template <class A>
void field(A& a, std::shared_ptr<const CarvingState>& carved) {
  if constexpr (A::kReads)
    if (a.version < 2) return;  // bones could not be carved then
  bool there = carved != nullptr;
  field(a, there);
  if (!there) return;
  CarvingState state = carved ? *carved : CarvingState{};
  std::uint64_t bones = state.bones.size();
  number(a, bones, kMostCarvedBones);
  if constexpr (A::kReads) state.bones.resize(bones);
  for (CarveState& bone : state.bones) field(a, bone);
  for (CarvingHand& hand : state.hands) field(a, hand);
  field(a, state.steps);
  field(a, state.full);
  if (knows_guides(a))
    for (GuideRod& rod : state.rods) field(a, rod);
  if (knows_holes(a))
    for (LeftHole& hole : state.holes) field(a, hole);
  if constexpr (A::kReads) carved = std::make_shared<const CarvingState>(std::move(state));
}

template <class A>
void field(A& a, NearBand& n) {
  field(a, n.contact.band);
  field(a, n.contact.part);
  field(a, n.contact.nhat_W);
  field(a, n.contact.others_taken_m);
  for (bool* x : {&n.touching, &n.barred, &n.behind}) field(a, *x);
  field(a, n.deep_m);
  field(a, n.taken_m);
}

template <class A>
void field(A& a, BandTouch& t) {
  field(a, t.on);
  field(a, t.over);
  field(a, t.first_step);
  field(a, t.last_step);
  field(a, t.peak_n);
  field(a, t.deepest_m);
}

template <class A>
void field(A& a, SolidNear& n) {
  SolidContact& c = n.contact;
  for (std::uint32_t* x : {&c.solid, &c.bone, &c.part}) field(a, *x);
  for (double* x : {&c.along, &c.stiffness_n_per_m, &c.others_m, &n.deep_m, &n.force_n})
    field(a, *x);
  for (Vec3* x : {&c.p_B, &c.nhat_B, &n.outside_B}) field(a, *x);
  for (bool* x : {&n.touching, &n.barred, &n.behind}) field(a, *x);
  if constexpr (A::kReads)
    if (a.version < 14) return;  // nothing cut solids then
  field(a, n.entered_m);
}

template <class A>
void field(A& a, std::vector<CutCell>& cells) {
  std::uint64_t count = cells.size();
  number(a, count, kMostCutCells);
  if constexpr (A::kReads) cells.resize(count);
  for (CutCell& cell : cells) {
    number(a, cell.count, static_cast<std::uint32_t>(CutCell::kParts));
    for (std::uint32_t p = 0; p < cell.count && p < CutCell::kParts; ++p) {
      field(a, cell.left[p]);
      field(a, cell.middle[p]);
    }
    for (std::uint16_t& bits : cell.beyond) {
      std::uint32_t wide = bits;
      number(a, wide, 0xffffu);
      bits = static_cast<std::uint16_t>(wide);
    }
  }
}

template <class A>
void field(A& a, std::shared_ptr<const SoftCutState>& cut) {
  if constexpr (A::kReads)
    if (a.version < 14) return;  // nothing cut solids then
  bool there = cut != nullptr;
  field(a, there);
  if (!there) return;
  SoftCutState state = cut ? *cut : SoftCutState{};
  std::uint64_t solids = state.solids.size();
  number(a, solids, std::uint64_t{kMaxSolids});
  if constexpr (A::kReads) state.solids.resize(solids);
  for (SolidCutState& solid : state.solids) {
    field(a, solid.cuts);
    field(a, solid.felt);
    field(a, solid.next);
    number(a, solid.worked, kMostCutWork);
    field(a, solid.looked);
    field(a, solid.pieces);
  }
  for (SolidCutHand& hand : state.hands) {
    field(a, hand.solid);
    field(a, hand.jaw_open);
    field(a, hand.X_BC);
    field(a, hand.idle);
  }
  if constexpr (A::kReads) cut = std::make_shared<const SoftCutState>(std::move(state));
}

template <class A>
void solids_field(A& a, SoftState& s) {
  if constexpr (A::kReads)
    if (a.version < 7) return;  // no solid was soft then
  for (bool& lost : s.solid_lost) field(a, lost);
  for (SolidHandState& hand : s.solid_hands) {
    field(a, hand.instrument);
    first_of(a, hand.count, hand.near);
    for (BandTouch& touch : hand.touches) field(a, touch);
  }
  field(a, s.cut);
}

template <class A>
void field(A& a, SoftState& s) {
  if constexpr (A::kReads)
    if (a.version < 3) return;  // nothing was soft then
  field(a, s.on);
  if (!s.on) return;
  for (BandState& band : s.bands) {
    field(a, band.torn);
    field(a, band.lost);
    if (!band.torn) continue;
    if constexpr (A::kReads)
      if (a.version < 10) continue;  // where it tore was not kept then
    field(a, band.torn_share);
  }
  for (SoftHandState& hand : s.hands) {
    field(a, hand.instrument);
    first_of(a, hand.count, hand.near);
    for (BandTouch& touch : hand.touches) field(a, touch);
  }
  solids_field(a, s);
}

template <class A>
void field(A& a, LooseRing& r) {
  number(a, r.is, static_cast<std::uint64_t>(LooseRing::Is::kFalling));
  field(a, r.X_WB);
  field(a, r.hand);
  field(a, r.second);
  field(a, r.X_PB);
  field(a, r.falls_m_per_s);
}

template <class A>
void field(A& a, RingsState& s) {
  if constexpr (A::kReads)
    if (a.version < 5) return;  // nothing lay loose then
  field(a, s.on);
  if (!s.on) return;
  first_of(a, s.count, s.rings);
  for (bool& shut : s.shut) field(a, shut);
  for (std::uint32_t& instrument : s.instrument) field(a, instrument);
}

template <class A>
void field(A& a, WorldState& w) {
  field(a, w.bones);
  field(a, w.hold);
  field(a, w.carved);
  field(a, w.softs);
  field(a, w.rings);
  for (WorldMark& mark : w.marks) {
    field(a, mark.set);
    if (!mark.set) continue;
    field(a, mark.hold);
    field(a, mark.bones);
    field(a, mark.carved);
    field(a, mark.softs);
    field(a, mark.rings);
  }
}

template <class A>
void field(A& a, SessionState& s) {
  std::uint64_t version = kVersion;
  field(a, version);
  if (version < 1 || version > kVersion) a.ok = false;
  if constexpr (A::kReads) a.version = version;
  std::uint64_t hands = s.hands.size();
  number(a, hands, kMaxHands);
  if constexpr (A::kReads) s.hands.resize(hands);
  for (HandState& hand : s.hands) field(a, hand);
  field(a, s.world);
  auto kind = static_cast<std::uint32_t>(s.for_next_step.kind);
  number(a, kind, static_cast<std::uint32_t>(kLastCommandKind));
  s.for_next_step.kind = static_cast<CommandKind>(kind);
  field(a, s.for_next_step.value);
}

}  // namespace

std::string to_bytes(const SessionState& state) {
  SessionState copy = state;
  Out out;
  field(out, copy);
  return std::move(out.bytes);
}

Result<SessionState> state_from_bytes(std::string_view bytes) {
  In in{bytes};
  SessionState state;
  field(in, state);
  if (!in.ok || in.at != bytes.size())
    return fail("a stored state is damaged", "state", "Use another copy of the file");
  return state;
}

}  // namespace osteon
