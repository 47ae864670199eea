#include "soft/soft_grips.h"

#include <algorithm>
#include <cmath>

#include "jaws.h"
#include "osteon/physics/band_strands.h"

namespace osteon {
namespace {

constexpr double kDraws_m_per_s = 0.05;  // how fast shutting jaws draw a place between them
constexpr double kEnd = 0.03;            // of a band's length: what is bone, and is not held
constexpr double kFarthest_m = 0.025;    // a solid that was drawn so far has slipped
constexpr int kSideways = 3, kTurns = 9, kOutwards = 8;  // places of the mouth that are looked at
constexpr double kFollows = 0.05;  // of the way that a solid's stiffness goes in a step
constexpr double kDirection_m = 1e-4;

}  // namespace

std::array<double, 2> inside_of(std::span<const Plane> planes, const Vec3& a, const Vec3& b) {
  std::array<double, 2> in{0, 1};
  for (const Plane& plane : planes) {
    const double at_a = plane.signed_distance(a), at_b = plane.signed_distance(b);
    if (at_a > 0 && at_b > 0) return {1, 0};
    if (at_a > 0) in[0] = std::max(in[0], at_a / (at_a - at_b));
    if (at_b > 0) in[1] = std::min(in[1], at_a / (at_a - at_b));
  }
  return in;
}

Vec3 across(const BandSpan& span, const Vec3& p_W) {
  const Vec3 way = span.b_W - span.a_W, off = p_W - span.a_W;
  return off - off.dot(way) / way.squaredNorm() * way;
}

double share_along(const BandSpan& span, const Vec3& p_W) {
  const Vec3 way = span.b_W - span.a_W;
  const double share = (p_W - span.a_W).dot(way) / way.squaredNorm();
  return std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.5;
}

double taken_by_grips(const SoftState& state, std::size_t band, std::size_t but_hand) {
  double sum = 0;
  for (std::size_t h = 0; h < kMaxHands; ++h) {
    const SoftGrip& grip = state.grips[h];
    if (h != but_hand && grip.hold.of == SoftHold::Of::kBand && grip.hold.part == band)
      sum += grip.taken_m;
  }
  return sum;
}

const SoftGripper* SoftGrips::gripper(std::uint32_t instrument) const {
  const auto& all = setup_.grippers;
  return instrument < all.size() && all[instrument] ? &*all[instrument] : nullptr;
}

std::uint64_t SoftGrips::lifted(const ToolState& tool) const {
  const SoftGripper* jaws = gripper(tool.instrument);
  return jaws && tool.jaw > kJawsShut ? jaws->jaws : 0;
}

// Jaws that bite a solid do not hold it.
bool SoftGrips::bites(std::uint32_t instrument) const {
  const auto& all = setup_.cutters;
  return instrument < all.size() && all[instrument] &&
         all[instrument]->way == SolidCutter::Way::kBite;
}

bool SoftGrips::bites_bands(std::uint32_t instrument) const {
  const auto& all = setup_.biters;
  return setup_.punches_bite && instrument < all.size() && all[instrument] &&
         all[instrument]->way == SolidCutter::Way::kBite;
}

bool SoftGrips::is_felt(const SoftState& state, const SoftHold& hold, const Parts& parts) const {
  if (hold.of == SoftHold::Of::kSolid)
    return !state.solid_lost[hold.part] && is_finite(parts.solids->X_WB(hold.part));
  const BandState& band = state.bands[hold.part];
  return setup_.bands[hold.part].left > 0 && !band.torn && !band.lost;
}

// What jaws hold of a solid has come off it: they have the piece, and pull at the rest no more.
bool SoftGrips::is_cut_away(const SoftHold& hold, const Parts& parts) const {
  if (hold.of != SoftHold::Of::kSolid || hold.most_n > 0 || !parts.solids) return false;
  return setup_.solids[hold.part].field->at(hold.p_B).distance < 0 &&
         parts.solids->view(hold.part).at(hold.p_B).distance > 0;
}

// Of several bands the one with most of its way in the mouth.
bool SoftGrips::take_band(const SoftState& state, const SoftGripper& jaws, const Pose& X_WT,
                          const Parts& parts, SoftHold& hold) const {
  const Pose X_TW = X_WT.inverse();
  double most_m = 0;
  for (std::uint32_t b = 0; b < parts.spans.size(); ++b) {
    SoftHold one;
    one.of = SoftHold::Of::kBand;
    one.part = b;
    if (!is_felt(state, one, parts)) continue;
    const BandSpan& span = parts.spans[b];
    const Vec3 a_T = X_TW * span.a_W, b_T = X_TW * span.b_W;
    const auto in = inside_of(jaws.mouth_T, a_T, b_T);
    const double length = (b_T - a_T).norm(), middle = 0.5 * (in[0] + in[1]);
    if (!((in[1] - in[0]) * length > most_m) || !(middle > kEnd && middle < 1 - kEnd)) continue;
    most_m = (in[1] - in[0]) * length;
    one.p_T = a_T + middle * (b_T - a_T);
    // Shares are of the fibres' whole length, which at rest is as taut everywhere.
    one.share = middle * length / (length + setup_.bands[b].over_m);
    hold = one;
  }
  return most_m > 0;
}

// Symbols: places of the mouth at x along the hinge, out to r, at the angle t. The held place is
// the mean of those that are inside of the solid, or the one nearest to it where that is a slit.
bool SoftGrips::take_solid(const SoftState& state, const SoftGripper& jaws, const Pose& X_WT,
                           const Parts& parts, SoftHold& hold) const {
  int most = 0;
  for (std::uint32_t s = 0; parts.solids && s < setup_.solids.size(); ++s) {
    if (state.solid_lost[s] || !is_finite(parts.solids->X_WB(s))) continue;
    const FieldView field = parts.solids->view(s);
    const Pose X_BT = parts.solids->X_WB(s).inverse() * X_WT;
    Aabb reach;
    reach.include(X_BT * jaws.hinge_T);
    if (!field.box().overlaps(reach.grown(jaws.length_m + jaws.half_width_m))) continue;
    int inside = 0;
    Vec3 sum = Vec3::Zero();
    std::array<Vec3, kSideways * kTurns * kOutwards> found;
    for (int i = 0; i < kSideways * kTurns * kOutwards; ++i) {
      const int across = i % kSideways, turn = i / kSideways % kTurns,
                out = i / (kSideways * kTurns);
      const double x = jaws.half_width_m * 0.9 * (across - 1),
                   r = jaws.length_m * (out + 1) / kOutwards;
      const double t = jaws.low_rad + (jaws.high_rad - jaws.low_rad) * turn / (kTurns - 1);
      const Vec3 p_B = X_BT * (jaws.hinge_T + x * jaws.axis_T +
                               r * (std::cos(t) * jaws.along_T + std::sin(t) * jaws.rise_T));
      if (!(field.at(p_B).distance < 0)) continue;
      sum += p_B;
      found[static_cast<std::size_t>(inside++)] = p_B;
    }
    if (inside <= most) continue;
    most = inside;
    hold = {};
    hold.of = SoftHold::Of::kSolid;
    hold.part = s;
    hold.bone = setup_.solids[s].bone.index;
    hold.p_B = sum / inside;
    if (setup_.bridges_tear && !(field.at(hold.p_B).distance < 0))
      hold.p_B = *std::min_element(found.begin(), found.begin() + inside,
                                   [&, middle = Vec3(hold.p_B)](auto& a, auto& b) {
                                     return (a - middle).squaredNorm() < (b - middle).squaredNorm();
                                   });
    hold.p_T = X_BT.inverse() * hold.p_B;
  }
  return most > 0;
}

// The place goes to where the jaws meet, no faster than they shut.
void SoftGrips::draw_in(const SoftGripper& jaws, SoftHold& hold) const {
  const double off = jaws.rise_T.dot(hold.p_T - jaws.hinge_T);
  const double most = kDraws_m_per_s * step_s_;
  hold.p_T -= std::clamp(off, -most, most) * jaws.rise_T;
}

double SoftGrips::others_taken_m(const SoftState& state, std::size_t h, std::size_t band) const {
  double sum = taken_by_grips(state, band, h);
  for (const SoftHandState& hand : state.hands)
    for (std::uint32_t i = 0; i < hand.count; ++i)
      if (hand.near[i].contact.band == band) sum += hand.near[i].taken_m;
  return sum;
}

GripPull SoftGrips::pull_of(SoftState& state, std::size_t h, const ToolState& tool,
                            const Parts& parts) const {
  SoftHold& hold = state.grips[h].hold;
  GripPull out;
  out.of = hold.of;
  out.part = hold.part;
  out.p_W = tool.X_WP * hold.p_T;
  if (hold.of == SoftHold::Of::kBand) {
    const BandSpan& span = parts.spans[hold.part];
    hold.others_taken_m = others_taken_m(state, h, hold.part);
    hold.left = strands_left(state.bands[hold.part].gone);
    const HeldBand held = hold_band(setup_.bands[hold.part], span, out.p_W, hold, spring_n_per_m_);
    out.force_n = held.force_W.norm();
    out.tension_n = held.tension_n;
    out.taken_m = std::max(0.0, held.taken_m);
    state.grips[h].bend_W = across(span, held.held_W);
    const double whole = (span.b_W - span.a_W).norm() + setup_.bands[hold.part].over_m;
    const Vec3 rest_W = span.a_W + hold.share * whole * (span.b_W - span.a_W).normalized();
    out.pulled_m = (out.p_W - rest_W).norm();
    return out;
  }
  const Vec3 rest_W = parts.solids->X_WB(hold.part) * hold.p_B;
  const Vec3 way_B = parts.solids->X_WB(hold.part).inverse() * out.p_W - hold.p_B;
  out.pulled_m = way_B.norm();
  if (hold.stiffness_n_per_m == 0 || out.pulled_m > kDirection_m) {
    const PressedSolid& body = parts.solids->body(hold.part);
    if (out.pulled_m > kDirection_m) state.grips[h].against_B = -way_B / out.pulled_m;
    const SolidPush push = body.push_at(hold.p_B, state.grips[h].against_B);
    const double yields = body.compliance(push, push);
    const double k = yields > 0 && std::isfinite(yields) ? 1 / yields : 0;
    const bool first = hold.stiffness_n_per_m == 0;
    hold.stiffness_n_per_m =
        first ? k : hold.stiffness_n_per_m + kFollows * (k - hold.stiffness_n_per_m);
  }
  out.force_n = hold_solid(hold, rest_W, out.p_W, spring_n_per_m_).norm();
  return out;
}

GripNews SoftGrips::step(SoftState& state, std::size_t h, const ToolState* tool, const Parts& parts,
                         std::uint64_t step, GripPull& pull) const {
  SoftGrip& grip = state.grips[h];
  GripNews news;
  const SoftGripper* jaws = tool ? gripper(tool->instrument) : nullptr;
  const bool sucks = jaws && jaws->bore_m > 0;
  const bool holds = grip.hold.of != SoftHold::Of::kNothing;
  const bool gone = holds && !is_felt(state, grip.hold, parts);
  if (!jaws || (holds && (is_cut_away(grip.hold, parts) || sucks != (grip.hold.most_n > 0)))) {
    news = leave(grip, tool, step);
    news.freed = holds && !gone;
    return news;
  }
  if (gone) grip = {};
  if (sucks) return suck(state, h, *jaws, *tool, parts, step, pull);
  const bool shuts = grip.jaw_open && tool->jaw <= kJawsShut;
  const bool open = tool->jaw > kJawsOpen || (grip.jaw_open && tool->jaw > kJawsShut);
  if (grip.hold.of != SoftHold::Of::kNothing && tool->jaw > kJawsShut) {
    news = leave(grip, tool, step);
    news.freed = true;
  }
  grip.jaw_open = open;
  news.bit = shuts && bites_bands(tool->instrument);
  if (shuts && !news.bit &&
      (take_band(state, *jaws, tool->X_WP, parts, grip.hold) ||
       (!bites(tool->instrument) && take_solid(state, *jaws, tool->X_WP, parts, grip.hold)))) {
    grip.first_step = step;
    news.held = true;
    news.hold = grip.hold;
    news.holds_n = jaws->holds_n;
    news.p_W = tool->X_WP * grip.hold.p_T;
  }
  if (grip.hold.of == SoftHold::Of::kNothing) return news;
  draw_in(*jaws, grip.hold);
  pull = pull_of(state, h, *tool, parts);
  hold_on(grip, pull);
  const bool far = grip.hold.of == SoftHold::Of::kSolid && pull.pulled_m > kFarthest_m;
  if (pull.force_n > jaws->holds_n || far || !std::isfinite(pull.force_n)) {
    const bool held = news.held;
    news = leave(grip, tool, step);
    news.held = held;
    news.slipped = true;
    news.force_n = pull.force_n;
    news.holds_n = jaws->holds_n;
  }
  return news;
}

void SoftGrips::hold_on(SoftGrip& grip, const GripPull& pull) const {
  grip.force_n = pull.force_n;
  grip.taken_m = pull.taken_m;
  grip.peak_n = std::max(grip.peak_n, pull.force_n);
  grip.most_m = std::max(grip.most_m, pull.pulled_m);
}

GripNews SoftGrips::leave(SoftGrip& grip, const ToolState* tool, std::uint64_t step) const {
  GripNews news;
  news.hold = grip.hold;
  news.since_s = static_cast<double>(step - grip.first_step) * step_s_;
  news.peak_n = grip.peak_n;
  news.pulled_mm = 1e3 * grip.most_m;
  news.p_W = tool ? tool->X_WP * grip.hold.p_T : Vec3(Vec3::Zero());
  grip = {};
  return news;
}

bool SoftGrips::fits(const SoftState& state) const {
  for (const SoftGrip& grip : state.grips) {
    const SoftHold& hold = grip.hold;
    if (!is_finite(hold.p_T) || !is_finite(hold.p_B) || !(hold.most_n >= 0)) return false;
    if (hold.of == SoftHold::Of::kBand &&
        (hold.part >= setup_.bands.size() || !(hold.share > 0 && hold.share < 1)))
      return false;
    if (hold.of == SoftHold::Of::kSolid &&
        (hold.part >= setup_.solids.size() || hold.bone != setup_.solids[hold.part].bone.index ||
         !(hold.stiffness_n_per_m >= 0)))
      return false;
  }
  return true;
}

}  // namespace osteon
