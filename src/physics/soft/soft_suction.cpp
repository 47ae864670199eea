// Suction that draws soft parts to its mouth and holds them there.
#include <algorithm>
#include <cmath>

#include "osteon/physics/band_strands.h"
#include "soft/soft_grips.h"

namespace osteon {
namespace {

constexpr double kLeastPower = 0.05;
constexpr double kBefore = 0.3;    // cosine: what is drawn lies so far before the mouth at least
constexpr double kComesIn = 0.05;  // of the way that the stiffness goes in a step
constexpr double kAtEnds = 0.03;   // of a band's length: what is bone, and is not held

}  // namespace

// The mouth slides along: of a string the place nearest to it is drawn.
bool SoftGrips::draws_band(const SoftState& state, std::size_t h, const ToolState& tool,
                           const Parts& parts, SoftHold& hold, Drawn& out) const {
  const SoftBand& band = setup_.bands[hold.part];
  const BandSpan& span = parts.spans[hold.part];
  const Vec3 mouth_W = tool.X_WP * hold.p_T;
  hold.share = share_along(span, mouth_W);
  const Vec3 apart = mouth_W - (span.a_W + hold.share * (span.b_W - span.a_W));
  const double distance = apart.norm();
  if (!(hold.share > kAtEnds && hold.share < 1 - kAtEnds) || !(distance > 0)) return false;
  if (!(apart.dot(tool.X_WP.rotate(Vec3::UnitZ())) > kBefore * distance)) return false;
  hold.others_taken_m = others_taken_m(state, h, hold.part);
  hold.left = strands_left(state.bands[hold.part].gone);
  const BandPress press =
      draw_band(band, span, mouth_W, hold.others_taken_m, hold.stiffness_n_per_m, hold.left);
  out.gap_m = distance - band.radius_m;
  out.target_n_per_m = spring_n_per_m_;
  if (press.presses) out.bend_W = across(span, press.p_W);
  out.pull.p_W = press.presses ? press.p_W : mouth_W;
  out.pull.force_n = press.force_n;
  out.pull.tension_n = press.tension_n;
  out.pull.taken_m = press.taken_m;
  return true;
}

bool SoftGrips::draws_solid(const ToolState& tool, const Parts& parts, SoftHold& hold,
                            Drawn& out) const {
  const Pose X_BT = parts.solids->X_WB(hold.part).inverse() * tool.X_WP;
  const Vec3 mouth_B = X_BT * hold.p_T;
  const FieldSample at = parts.solids->view(hold.part).at(mouth_B);
  const double slope = at.gradient.norm();
  if (!at.near || !(slope > 1e-6)) return false;
  hold.nhat_B = at.gradient / slope;
  hold.p_B = mouth_B - at.distance * hold.nhat_B;
  if (!(hold.nhat_B.dot(X_BT.rotate(Vec3::UnitZ())) > kBefore)) return false;
  const PressedSolid& body = parts.solids->body(hold.part);
  out.against_B = -hold.nhat_B;
  const SolidPush push = body.push_at(hold.p_B, out.against_B);
  const double yields = body.compliance(push, push) + 1 / spring_n_per_m_;
  if (!(yields > 0) || !std::isfinite(yields)) return false;
  out.gap_m = at.distance;
  out.target_n_per_m = 1 / yields;
  out.pull.p_W = tool.X_WP * hold.p_T;
  out.pull.force_n = hold.stiffness_n_per_m * std::max(0.0, at.distance);
  return true;
}

// False where what is held does not lie before the mouth.
bool SoftGrips::draws(const SoftState& state, std::size_t h, const SoftGripper& mouth,
                      const ToolState& tool, const Parts& parts, SoftHold& hold, Drawn& out) const {
  out = {};
  out.pull.of = hold.of;
  out.pull.part = hold.part;
  hold.p_T = mouth.bore_T;
  const bool drawn = hold.of == SoftHold::Of::kBand ? draws_band(state, h, tool, parts, hold, out)
                                                    : draws_solid(tool, parts, hold, out);
  out.pull.pulled_m = std::max(0.0, out.gap_m);
  return drawn;
}

// What gives way by the whole gap before it pulls back harder than the suction draws it there: it
// comes to the mouth. Of several the nearest.
bool SoftGrips::find_drawn(const SoftState& state, std::size_t h, const SoftGripper& mouth,
                           const ToolState& tool, const Parts& parts, SoftHold& hold) const {
  double nearest_m = 2 * mouth.bore_m;
  bool found = false;
  const auto look = [&](SoftHold::Of of, std::uint32_t part) {
    SoftHold one;
    one.of = of;
    one.part = part;
    if (of == SoftHold::Of::kSolid) one.bone = setup_.solids[part].bone.index;
    Drawn drawn;
    if (!is_felt(state, one, parts) || !draws(state, h, mouth, tool, parts, one, drawn)) return;
    one.stiffness_n_per_m = drawn.target_n_per_m;
    if (!draws(state, h, mouth, tool, parts, one, drawn) || !(drawn.gap_m < nearest_m)) return;
    if (drawn.pull.force_n > std::min(tool.power, 1.0) * suction_at(mouth, drawn.gap_m)) return;
    nearest_m = drawn.gap_m;
    hold = one;
    hold.stiffness_n_per_m = 0;
    found = true;
  };
  for (std::uint32_t b = 0; b < parts.spans.size(); ++b) look(SoftHold::Of::kBand, b);
  for (std::uint32_t s = 0; parts.solids && s < setup_.solids.size(); ++s)
    look(SoftHold::Of::kSolid, s);
  return found;
}

// The stiffness of what is held comes in over some steps, so that the hand feels no step.
GripNews SoftGrips::suck(SoftState& state, std::size_t h, const SoftGripper& mouth,
                         const ToolState& tool, const Parts& parts, std::uint64_t step,
                         GripPull& pull) const {
  SoftGrip& grip = state.grips[h];
  GripNews news;
  const double power = std::min(tool.power, 1.0), most_n = power * mouth.holds_n;
  const bool on = power > kLeastPower;
  if (grip.hold.of == SoftHold::Of::kNothing) {
    SoftHold hold;
    if (!on || !find_drawn(state, h, mouth, tool, parts, hold)) return news;
    grip = {};
    grip.hold = hold;
    grip.first_step = step;
    news.held = true;
    news.holds_n = most_n;
    news.hold = hold;
    news.p_W = tool.X_WP * mouth.bore_T;
  }
  grip.hold.most_n = most_n;
  Drawn drawn;
  if (!on || !draws(state, h, mouth, tool, parts, grip.hold, drawn)) {
    news = leave(grip, &tool, step);
    news.freed = true;
    return news;
  }
  pull = drawn.pull;
  hold_on(grip, pull);
  grip.bend_W = drawn.bend_W;
  grip.against_B = drawn.against_B;
  grip.hold.stiffness_n_per_m += kComesIn * (drawn.target_n_per_m - grip.hold.stiffness_n_per_m);
  if (pull.force_n > most_n || !std::isfinite(pull.force_n)) {
    news = leave(grip, &tool, step);
    news.slipped = true;
    news.force_n = pull.force_n;
    news.holds_n = most_n;
    pull = {};
  }
  return news;
}

}  // namespace osteon
