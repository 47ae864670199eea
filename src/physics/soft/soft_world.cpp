#include "osteon/physics/soft_world.h"

#include <algorithm>
#include <cmath>

#include "osteon/collide/round_box.h"
#include "osteon/physics/band_strands.h"
#include "osteon/physics/fallen_pieces.h"
#include "osteon/scene/soft_events.h"
#include "osteon/scene/tool_rods.h"
#include "skin/skin_world.h"
#include "soft/band_side.h"
#include "soft/resting_softs.h"
#include "soft/soft_grips.h"
#include "soft/soft_touch.h"
#include "soft/solid_cutting.h"
#include "soft/solid_presses.h"

namespace osteon {
namespace {

// A part so near may touch before physics has looked again, even at 1 m/s.
constexpr double kNear_m = 0.006;
// A part that has gone so deep has left the band behind.
constexpr double kDeepest_m = 0.025;
// Two parts that press a band from one side are one push: the deeper counts.
constexpr double kOneSide = 0.5;
constexpr double kFarthest_m2 = 1e12;
// A band that another hand draws onto a part shifts not at all where the two are nearer along it
// than the first, and by all of it beyond the second: two that squeeze it at one place would send
// it to and fro.
constexpr double kTogether_m = 0.003, kApart_m = 0.009;
// A blade or teeth open so much surface each second and newton (D).
constexpr double kWounds_m2_per_ns = 2e-6;
constexpr double kNick_n = 0.5;  // a lighter touch wounds nothing (D)
constexpr std::size_t kMostOpenings = 64;
// A knee's ligaments are four at most; where there are more, many are near to a tool at once.
constexpr std::size_t kFewBands = 4, kFewContacts = 6;
// A cord yields to a small dent as its surface does; shown, it goes along with a part that is
// pressed deeper than so much of its radius.
constexpr double kShownDent = 0.5;
constexpr double kBlade_m = 0.03;  // from a blade's tip: so much of it is sharp at most

bool usable(const ToolState& tool) {
  return tool.tick > 0 && is_finite(tool.X_WP) && tool.X_WP.p.squaredNorm() < kFarthest_m2;
}

}  // namespace

SoftWorld::SoftWorld(std::shared_ptr<const SoftSetup> setup,
                     std::span<const std::shared_ptr<const Tool>> tray, double coupling_n_per_m,
                     double limit_n, double step_s, std::uint32_t first_made)
    : setup_(std::move(setup)),
      coupling_n_per_m_(coupling_n_per_m),
      limit_n_(limit_n),
      step_s_(step_s) {
  for (const auto& tool : tray) {
    tray_.push_back(tool_rods(*tool));
    shapes_.push_back(soft_shapes(*tool));
    on_skin_.push_back(tool_shapes(*tool));
    uses_.push_back(tool->use);
  }
  state_.on = true;
  openings_.reserve(kMostOpenings);
  events_.reserve(kMaxHands * (kMaxBands + kMaxSolids) * 4 + 2 * kMaxHands +
                  (setup_->skins.empty() ? 0 : kMaxHands * kMaxSkins * 7) +
                  (setup_->pieces ? kMaxHands * kMaxLooseSofts : 0));
  if (!setup_->solids.empty()) solids_ = std::make_unique<SolidPresses>(*setup_, coupling_n_per_m_);
  if (solids_ && !setup_->cutters.empty())
    cutting_ = std::make_unique<SolidCutting>(*setup_, *solids_, step_s_);
  if (cutting_ && setup_->pieces) pieces_ = std::make_unique<FallenPieces>(setup_->pieces);
  resting_ = std::make_unique<RestingSofts>(*setup_, state_, solids_.get());
  if (!setup_->grippers.empty())
    grips_ = std::make_unique<SoftGrips>(*setup_, coupling_n_per_m_, step_s_);
  if (!setup_->skins.empty())
    skins_ = std::make_unique<SkinWorld>(*setup_, coupling_n_per_m_, limit_n_, step_s_, first_made);
}
SoftWorld::~SoftWorld() = default;

bool SoftWorld::is_felt(std::size_t band) const {
  return setup_->bands[band].left > 0 && !state_.bands[band].torn && !state_.bands[band].lost;
}

bool SoftWorld::is_blade(std::uint32_t instrument, std::size_t part) const {
  const auto& blades = setup_->blades;
  return std::find(blades.begin(), blades.end(), instrument) != blades.end() &&
         is_working_end(instrument, part);
}

bool SoftWorld::is_working_end(std::uint32_t instrument, std::size_t part) const {
  const Capsule& rod = tray_[instrument][part];
  return std::max(rod.p0.norm(), rod.p1.norm()) < kBlade_m;
}

void SoftWorld::wound_solids(const Hand& hand, const BoneSnapshot& bones) {
  const SolidHandState& state = state_.solid_hands[hand.index];
  for (std::uint32_t i = 0; i < state.count && hand.tool && hand.works; ++i) {
    const SolidNear& near = state.near[i];
    const SoftSolid& solid = setup_->solids[near.contact.solid];
    if (!(near.force_n > kNick_n) || !is_working_end(state.instrument, near.contact.part)) continue;
    if (!solid.bleeds || !solid.bleeds(near.contact.p_B)) continue;
    if (openings_.size() < openings_.capacity())
      openings_.push_back({solid.soft, solid.bone,
                           bones.bones[solid.bone.index].X_WB * near.contact.p_B,
                           kWounds_m2_per_ns * near.force_n * step_s_});
  }
}

void SoftWorld::place_bands(const BoneSnapshot& bones) {
  for (std::size_t b = 0; b < setup_->bands.size(); ++b) {
    const SoftBand& band = setup_->bands[b];
    spans_[b] = {bones.bones[band.from.index].X_WB * band.from_B,
                 bones.bones[band.to.index].X_WB * band.to_B};
    if (setup_->by_strands)
      sections_[b] = section_of(band, spans_[b], bones.bones[band.from.index].X_WB);
    readouts_[b] = {};
    const bool sound = is_finite(spans_[b].a_W) && is_finite(spans_[b].b_W) &&
                       (spans_[b].b_W - spans_[b].a_W).norm() > 1e-6;
    if (sound || !is_felt(b)) continue;
    state_.bands[b].lost = true;
    tell({}, kSoftLost, b, {});
  }
}

double SoftWorld::taken_by_others(const NearBand& near) const {
  double sum = taken_by_grips(state_, near.contact.band);
  for (const SoftHandState& hand : state_.hands)
    for (std::uint32_t i = 0; i < hand.count; ++i)
      if (&hand.near[i] != &near && hand.near[i].contact.band == near.contact.band)
        sum += hand.near[i].taken_m;
  return sum;
}

// Symbols: s, the part's place along the band, 0 to 1; t and b, place and bend of another hand's
// contact. A string that is bent by b at t is bent at s by b s/t before t and b (1 - s)/(1 - t)
// beyond; of several these add up, as of any string whose tension is one. `nhat_W`: from the band
// to the part, zero where it is not known yet.
Vec3 SoftWorld::shift_of(const Hand& hand, const RoundBox& part_W, const BandContact& contact,
                         const Vec3& nhat_W) const {
  const std::size_t b = contact.band;
  const BandSpan& span = spans_[b];
  Vec3 sum = Vec3::Zero();
  double s = -1;
  const auto add = [&](double t, const Vec3& bend_W) {
    if (bend_W.isZero(0) || !is_finite(bend_W) || !(t > 0 && t < 1)) return;
    if (s < 0)
      s = share_of(b, nearest_on_cores(round_box(Capsule{span.a_W, span.b_W, 0}), part_W).a);
    const double apart_m = std::abs(t - s) * (span.b_W - span.a_W).norm();
    Vec3 by = (s < t ? s / t : (1 - s) / (1 - t)) * bend_W;
    const double left = std::clamp((kApart_m - apart_m) / (kApart_m - kTogether_m), 0.0, 1.0);
    by -= left * std::max(0.0, by.dot(nhat_W)) * nhat_W;
    sum += by;
  };
  for (std::size_t h = 0; h < kMaxHands; ++h) {
    if (h == hand.index) continue;
    const SoftHandState& other = state_.hands[h];
    for (std::uint32_t i = 0; i < other.count; ++i)
      if (other.near[i].contact.band == b) add(other.near[i].at_share, other.near[i].bend_W);
    const SoftGrip& grip = state_.grips[h];
    if (grip.hold.of == SoftHold::Of::kBand && grip.hold.part == b)
      add(grip.hold.share, grip.bend_W);
  }
  if (const std::uint64_t gone = state_.bands[b].gone; gone != 0)
    sum -= hollow_m(setup_->bands[b], gone, sections_[b], nhat_W) * nhat_W;
  return sum;
}

bool SoftWorld::is_bent_far(const SoftHandState& hand, const NearBand& but) const {
  const auto far = [&](const NearBand& near) {
    return near.contact.band == but.contact.band && near.contact.part != but.contact.part &&
           near.touching && near.deep_m > 2 * setup_->bands[near.contact.band].radius_m;
  };
  return std::any_of(hand.near.begin(), hand.near.begin() + hand.count, far);
}

// Jaws that stand open, and a tool whose jaws hold the band, do not press it. What suction draws
// to the mouth does.
bool SoftWorld::presses(const Hand& hand, std::size_t band, std::size_t part) const {
  const SoftHold& hold = state_.grips[hand.index].hold;
  if (hold.of == SoftHold::Of::kBand && hold.part == band && hold.most_n == 0) return false;
  return !(hand.lifted >> part & 1);
}

// Parts that were near: those that have gone, or whose band is no more, are dropped. A band that
// one part has bent far is not where its rest place is: no other part comes to it then.
void SoftWorld::follow(const Hand& hand) {
  SoftHandState& state = state_.hands[hand.index];
  const std::vector<RoundBox>& parts = shapes_[state.instrument];
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < state.count; ++i) {
    NearBand near = state.near[i];
    const std::size_t b = near.contact.band;
    if (!is_felt(b) || !presses(hand, b, near.contact.part)) continue;
    const RoundBox part_W = placed(hand.tool->X_WP, parts[near.contact.part]);
    near.contact.off_W = shift_of(hand, part_W, near.contact, near.contact.nhat_W);
    const BandSide side =
        next_side(setup_->bands[b], span_at(spans_[b], near.contact), part_W, near.contact.nhat_W);
    if (side.gap_m > kNear_m) continue;
    const bool begins = side.gap_m < 0 && !near.touching;
    near.barred = side.gap_m < 0 &&
                  (near.barred || side.gap_m < -kDeepest_m || (begins && is_bent_far(state, near)));
    near.contact.nhat_W = side.nhat_W;
    near.touching = side.gap_m < 0;
    near.deep_m = -side.gap_m;
    state.near[kept++] = near;
  }
  state.count = kept;
}

// Parts that have come near since. Where there is no room, those that touch stay.
void SoftWorld::seek(const Hand& hand) {
  SoftHandState& state = state_.hands[hand.index];
  const std::vector<RoundBox>& parts = shapes_[state.instrument];
  const auto known = [&](std::size_t band, std::size_t part) {
    return std::any_of(state.near.begin(), state.near.begin() + state.count,
                       [&](const NearBand& near) {
                         return near.contact.band == band && near.contact.part == part;
                       });
  };
  const std::size_t room = setup_->bands.size() > kFewBands ? kMaxBandContacts : kFewContacts;
  for (std::size_t b = 0; b < setup_->bands.size(); ++b)
    for (std::size_t part = 0; part < parts.size() && is_felt(b); ++part) {
      if (state.count >= room) return;
      if (known(b, part) || !presses(hand, b, part)) continue;
      const RoundBox part_W = placed(hand.tool->X_WP, parts[part]);
      NearBand near;
      near.contact.band = static_cast<std::uint32_t>(b);
      near.contact.part = static_cast<std::uint32_t>(part);
      near.contact.off_W = shift_of(hand, part_W, near.contact, Vec3::Zero());
      const BandSide side = first_side(setup_->bands[b], span_at(spans_[b], near.contact), part_W);
      if (side.gap_m > kNear_m) continue;
      near.contact.nhat_W = side.nhat_W;
      near.touching = near.barred = side.gap_m < 0;
      near.deep_m = -side.gap_m;
      state.near[state.count++] = near;
    }
}

// Of two parts on one side of a band the deeper one counts.
void SoftWorld::choose(SoftHandState& hand) const {
  const auto deeper = [&](std::uint32_t i, std::uint32_t j) {
    const NearBand &a = hand.near[i], &b = hand.near[j];
    if (i == j || b.barred || a.contact.band != b.contact.band ||
        !(a.contact.nhat_W.dot(b.contact.nhat_W) > kOneSide))
      return false;
    return b.deep_m > a.deep_m || (b.deep_m == a.deep_m && j < i);
  };
  for (std::uint32_t i = 0; i < hand.count; ++i) {
    hand.near[i].behind = false;
    for (std::uint32_t j = 0; j < hand.count; ++j)
      hand.near[i].behind = hand.near[i].behind || deeper(i, j);
  }
}

// The path that a part takes of the string is what other parts and hands reckon with.
void SoftWorld::press(Hand& hand) {
  SoftHandState& state = state_.hands[hand.index];
  choose(state);
  for (std::uint32_t i = 0; i < state.count; ++i) {
    NearBand& near = state.near[i];
    const std::size_t b = near.contact.band;
    const SoftBand& band = setup_->bands[b];
    near.taken_m = 0;
    near.bend_W = Vec3::Zero();
    const RoundBox part_W = placed(hand.tool->X_WP, shapes_[state.instrument][near.contact.part]);
    near.contact.off_W = shift_of(hand, part_W, near.contact, near.contact.nhat_W);
    near.contact.others_taken_m = taken_by_others(near);
    near.contact.left = strands_left(state_.bands[b].gone);
    if (near.barred || near.behind) continue;
    const double surface = band.surface_n_per_m / std::sqrt(std::sqrt(near.contact.left));
    const BandPress press = press_band(band, span_at(spans_[b], near.contact), part_W, near.contact,
                                       std::min(coupling_n_per_m_, surface));
    if (!press.presses) continue;
    near.taken_m = press.taken_m;
    near.bend_W = -press.bent_m * near.contact.nhat_W;
    near.at_share = share_of(b, press.p_W);
    keep_bend(near.contact, press, part_W.rod.radius);
    const bool sliced =
        press.force_n > setup_->cutting_n && is_blade(state.instrument, near.contact.part);
    if (sliced || (press.force_n > kNick_n && clears_now(hand, near.contact))) {
      hand.cuts[b] = true;
      hand.edge_W[b] = near.contact.nhat_W;
    }
    if (press.force_n > kNick_n && hand.works &&
        is_working_end(state.instrument, near.contact.part))
      wound(b, press.p_W, kWounds_m2_per_ns * press.force_n * step_s_);
    hand.force_n[b] += press.force_n;
    hand.deep_m[b] = std::max(hand.deep_m[b], press.deep_m);
    hand.p_W[b] = press.p_W;
  }
}

void SoftWorld::keep_bend(const BandContact& contact, const BandPress& press,
                          double part_radius_m) {
  if (bend_count_ == bends_.size()) return;
  const BandSpan& span = spans_[contact.band];
  const Vec3 way = span.b_W - span.a_W;
  StringBend& bend = bends_[bend_count_++];
  bend.band = contact.band;
  bend.share = std::clamp((press.p_W - span.a_W).dot(way) / way.squaredNorm(), 0.0, 1.0);
  const double dent_m = press.deep_m - press.bent_m;
  bend.dent_m = std::min(dent_m, kShownDent * setup_->bands[contact.band].radius_m);
  bend.bent_m = press.bent_m + dent_m - bend.dent_m;
  bend.round_m = setup_->bands[contact.band].radius_m + part_radius_m;
  bend.nhat_W = contact.nhat_W;
  bend.along_W = way.normalized();
}

double SoftWorld::share_of(std::size_t b, const Vec3& p_W) const {
  const Vec3 way = spans_[b].b_W - spans_[b].a_W;
  const double share = (p_W - spans_[b].a_W).dot(way) / way.squaredNorm();
  return std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.5;
}

// Parts are followed for all hands first: what one presses away another one meets.
void SoftWorld::step_solids(std::span<const Hand> hands, const BoneSnapshot& bones) {
  for (std::size_t s = 0; s < setup_->solids.size(); ++s) {
    solid_readouts_[s] = {};
    if (solids_->place(s, bones) || state_.solid_lost[s]) continue;
    state_.solid_lost[s] = true;
    Event event;
    event.kind = kSoftLost;
    event.subject = setup_->solids[s].soft;
    tell(event, Vec3::Zero());
  }
  std::array<SolidHand, kMaxHands> all{};
  for (const Hand& hand : hands) {
    SolidHandState& state = state_.solid_hands[hand.index];
    SolidHand& with = all[hand.index];
    with.tool = hand.tool;
    if (!hand.tool || hand.tool->instrument != state.instrument) state.count = 0;
    if (!hand.tool) continue;
    state.instrument = hand.tool->instrument;
    with.parts = shapes_[state.instrument];
    with.lifted = hand.lifted;
    if (cutting_) with.lifted |= cutting_->lifted(*hand.tool);
    const SoftHold& hold = state_.grips[hand.index].hold;
    if (hold.of == SoftHold::Of::kSolid && hold.most_n == 0) with.held = hold.part;
    solids_->follow(state, with, state_);
  }
  for (const Hand& hand : hands) {
    SolidHand& with = all[hand.index];
    if (hand.tool) solids_->press(state_.solid_hands[hand.index], with, state_);
    for (std::size_t s = 0; s < setup_->solids.size(); ++s) {
      if (!(hand.pull_n[s] > 0)) continue;
      with.force_n[s] += hand.pull_n[s];
      with.deep_m[s] = std::max(with.deep_m[s], hand.pull_m[s]);
      with.p_W[s] = hand.tool->X_WP * state_.grips[hand.index].hold.p_T;
    }
    for (std::size_t s = 0; s < setup_->solids.size(); ++s) {
      solid_readouts_[s].force_n[hand.index] = with.force_n[s];
      solid_readouts_[s].deep_m[hand.index] = with.deep_m[s];
    }
    tell_solid_touches(with, hand, bones.step);
    wound_solids(hand, bones);
  }
  if (cutting_) cut_solids(all, bones);
}

void SoftWorld::cut_solids(std::span<const SolidHand> hands, const BoneSnapshot& bones) {
  const std::uint64_t step = bones.step;
  cutting_->step(state_, hands, step);
  for (std::size_t h = 0; h < hands.size(); ++h) {
    const SoftHold& hold = state_.grips[h].hold;
    if (hands[h].tool && hold.of == SoftHold::Of::kSolid && hold.most_n == 0)
      cutting_->pull(hold.part, h, hold.p_B, state_.grips[h].force_n, step);
    if (hands[h].tool && setup_->hooks_tear) hook_solids(h, hands[h], bones);
  }
  for (const SolidCutting::News& news : cutting_->news()) {
    constexpr double kMm3 = 1e9;
    Event event;
    event.hand = news.piece || news.cleared ? kNoHand : static_cast<std::uint8_t>(news.hand);
    event.kind = news.cleared ? kSoftCleared
                 : news.piece ? kSoftPiece
                 : news.torn  ? kSoftTorn
                              : kSoftCut;
    event.subject = setup_->solids[news.solid].soft;
    if (news.cleared)
      event.values = {cutting_->cleared_percent(news.solid), cutting_->all_cleared_percent(), 0};
    else if (news.torn)
      event.values = {news.holds_n, news.force_n, 0};
    else if (news.piece)
      event.values = {kMm3 * news.volume_m3, 0, 0};
    else
      event.values = {news.force_n, 0, kMm3 * news.volume_m3};
    tell(event, solids_->X_WB(news.solid) * news.p_B);
    if (news.piece) lay_down(news.solid, news.shape, hands);
  }
}

double SoftWorld::removed_m3(std::size_t solid) const {
  return cutting_ ? cutting_->removed_m3(solid) : 0;
}
std::uint32_t SoftWorld::pieces(std::size_t solid) const {
  return cutting_ ? cutting_->pieces(solid) : 0;
}

double SoftWorld::cleared_percent(std::size_t solid) const {
  return cutting_ ? cutting_->cleared_percent(solid) : 0;
}

double SoftWorld::all_cleared_percent() const {
  return cutting_ ? cutting_->all_cleared_percent() : -1;
}

bool SoftWorld::is_asleep(std::size_t solid) const {
  return !solids_ || solids_->is_asleep(solid, state_);
}

// A band that has torn in the step is bent by nobody.
SoftPushes SoftWorld::pushes() const {
  SoftPushes out = solids_ ? solids_->pushes(state_) : SoftPushes{};
  for (std::uint32_t i = 0; i < bend_count_; ++i)
    if (is_felt(bends_[i].band)) out.bends[out.bend_count++] = bends_[i];
  for (std::uint32_t b = 0; b < setup_->bands.size(); ++b)
    if (const BandState& band = state_.bands[b]; band.torn)
      out.breaks[out.break_count++] = {b, band.torn_share};
    else if (band.gone != 0)
      out.notches[out.notch_count++] = {b, band.torn_share, band.gone};
  show_loads(out);
  if (cutting_) cutting_->show(out.cuts);
  for (const FallenPiece& piece : lying()) out.pieces[out.piece_count++] = piece.shape;
  if (skins_) skins_->show(out);
  return out;
}

void SoftWorld::take(Hand& hand, const ToolState& tool, std::uint32_t epoch) {
  SoftHandState& state = state_.hands[hand.index];
  const bool here = usable(tool) && tool.epoch == epoch && tool.instrument < tray_.size();
  if (!here || tool.instrument != state.instrument) state.count = 0;
  if (!here) return;
  state.instrument = tool.instrument;
  hand.tool = &tool;
  const ToolUse& use = uses_[tool.instrument];
  hand.works = use.cuts || (use.removes && tool.power > 0);
  if (grips_) hand.lifted = grips_->lifted(tool);
  follow(hand);
  seek(hand);
}

// What jaws hold, they pull before other parts press it in this step.
void SoftWorld::grip(Hand& hand, const BoneSnapshot& bones) {
  if (!grips_) return;
  GripPull pull;
  const std::span<const BandSpan> spans(spans_.data(), setup_->bands.size());
  const GripNews news =
      grips_->step(state_, hand.index, hand.tool, {spans, solids_.get()}, bones.step, pull);
  tell_grip(hand, news);
  if (news.bit) bite_bands(hand);
  if (pull.of == SoftHold::Of::kSolid) {
    hand.pull_n[pull.part] = pull.force_n;
    hand.pull_m[pull.part] = pull.pulled_m;
  } else if (pull.of == SoftHold::Of::kBand) {
    hand.force_n[pull.part] = pull.force_n;
    hand.deep_m[pull.part] = pull.pulled_m;
    hand.p_W[pull.part] = pull.p_W;
    hand.leg_n = pull.tension_n;
    keep_hold(pull);
  }
}

// For pictures: the string leads to the jaws.
void SoftWorld::keep_hold(const GripPull& pull) {
  if (bend_count_ == bends_.size()) return;
  const BandSpan& span = spans_[pull.part];
  const Vec3 along_W = (span.b_W - span.a_W).normalized();
  const Vec3 off = pull.p_W - span.a_W;
  const Vec3 aside = off - along_W.dot(off) * along_W;
  if (!(aside.norm() > 1e-6)) return;
  StringBend& bend = bends_[bend_count_++];
  bend = {};
  bend.band = static_cast<std::uint32_t>(pull.part);
  bend.share = share_of(pull.part, pull.p_W);
  bend.bent_m = aside.norm();
  bend.round_m = setup_->bands[pull.part].radius_m;
  bend.nhat_W = -aside / bend.bent_m;
  bend.along_W = along_W;
}

void SoftWorld::step(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                     std::span<const CarvedField* const> carved) {
  events_.clear();
  openings_.clear();
  bend_count_ = 0;
  epoch_ = bones.epoch;
  step_ = bones.step;
  place_bands(bones);
  std::array<Hand, kMaxHands> all{};
  const std::span<Hand> hands(all.data(), std::min(tools.size(), kMaxHands));
  for (std::size_t i = 0; i < hands.size(); ++i) {
    hands[i].index = i;
    take(hands[i], *tools[i], bones.epoch);
  }
  for (std::size_t s = 0; s < setup_->solids.size(); ++s) (void)solids_->place(s, bones);
  for (Hand& hand : hands) grip(hand, bones);
  for (Hand& hand : hands)
    if (hand.tool) press(hand);
  tear(hands);
  for (const Hand& hand : hands) tell_touches(hand, bones.step);
  if (pieces_) step_pieces(tools, bones, carved);
  if (solids_) step_solids(hands, bones);
  if (pieces_) tell_pieces();
  if (pieces_) stir_pieces(tools, bones);
  if (skins_) step_skins(hands, bones);
}

void SoftWorld::step_skins(std::span<const Hand> hands, const BoneSnapshot& bones) {
  std::array<SkinToolNow, kMaxHands> now{};
  for (const Hand& hand : hands)
    if (hand.tool) now[hand.index] = {hand.tool, on_skin_[hand.tool->instrument]};
  skins_->step(std::span(now).first(hands.size()), bones);
  for (const Event& event : skins_->events()) tell(event, event.p_W);
}

SkinReadout SoftWorld::skin_readout(std::size_t patch) const { return skins_->readout(patch); }

void SoftWorld::bare_skin(SkinBare bares) {
  if (skins_) skins_->bare(bares);
}

BandContacts SoftWorld::contacts(std::size_t hand) const {
  const SoftHandState& state = state_.hands[hand];
  BandContacts out;
  out.instrument = state.instrument;
  out.epoch = epoch_;
  for (std::uint32_t i = 0; i < state.count; ++i) {
    const NearBand& near = state.near[i];
    if (near.barred || near.behind || !is_felt(near.contact.band)) continue;
    BandContact& told = out.all[out.count++];
    told = near.contact;
    told.left = strands_left(state_.bands[told.band].gone);
  }
  out.hold = state_.grips[hand].hold;
  if (out.hold.of == SoftHold::Of::kBand)
    out.hold.left = strands_left(state_.bands[out.hold.part].gone);
  if (solids_) solids_->tell(state_.solid_hands[hand], out);
  if (skins_) skins_->tell(hand, out);
  return out;
}

}  // namespace osteon
