#include "osteon/physics/graft_bench_work.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "graft/tendon_finding.h"
#include "jaws.h"

namespace osteon {
namespace {

using BenchKind = BenchTool::Kind;

constexpr std::uint32_t kNoTool = 0xffffffffu;
constexpr double kTakeOn_m = 0.005;    // so near a line an instrument is taken on
constexpr double kTakeOnTurn = 0.82;   // least cosine between the axes then
constexpr double kAhead_m = 0.02;      // and so far before the begin
constexpr double kOffEnd_m = 0.0015;   // drawn back so far before the begin it is off again
constexpr double kGripStep = 0.02;     // a line holds within 50 steps
constexpr double kNearBand_m = 0.006;  // a blade meets a band
constexpr double kDrawn_m = 0.004;     // it is through when drawn so far
constexpr double kPressed_n = 0.15;    // with so much force
constexpr double kBeforeEnd_m = 0.002, kMuscle_m = 0.034, kBeside_m = 0.016;  // where muscle is
constexpr double kNearStitch_m = 0.003;
constexpr double kNearEnd_m = 0.010;   // jaws take a tendon's end
constexpr double kNearPost_m = 0.012;  // and leave it at a post
constexpr double kNearHook_m = 0.006;
constexpr std::uint32_t kHangSteps = 250;
constexpr double kPassed_m = 0.001, kRefused_m = 0.0006;

bool is_tendon(std::uint32_t line) { return line <= GraftBenchPlan::kGracilis; }

}  // namespace

GraftBenchWork::GraftBenchWork(GraftBenchPlan plan, std::vector<BenchTool> tray, double step_s)
    : plan_(std::move(plan)), tray_(std::move(tray)), step_s_(step_s) {}

GraftBenchState GraftBenchWork::gone_back(const GraftBenchState& kept) {
  GraftBenchState state = kept;
  state.hands = {};
  return state;
}

const BenchTool& GraftBenchWork::held(const ToolState& tool) const {
  static const BenchTool kNothing;
  return tool.instrument < tray_.size() ? tray_[tool.instrument] : kNothing;
}

bool GraftBenchWork::may_lead(const GraftBenchState& state, std::uint32_t line,
                              const BenchTool& tool) const {
  if (is_tendon(line))
    return tool.kind == BenchKind::kStripper && state.tendons[line].found &&
           !state.tendons[line].stripped;
  const bool folded = !in_knee_ && graft_on(plan_, state).has_value();
  if (line == GraftBenchPlan::kGraft) return tool.kind == BenchKind::kSizer && folded;
  return tool.kind == BenchKind::kClamp && folded;
}

double GraftBenchWork::resistance_n(const GraftBenchState& state, std::uint32_t line,
                                    double front_m, const BenchTool& tool) const {
  if (is_tendon(line)) {
    if (state.tendons[line].stripped) return kCutOff_n;
    const TendonMeasures& is = plan_.tendons[line].measures;
    double r = kStrip_n + (kMuscle_n - kStrip_n) * std::clamp(front_m / is.length_m, 0.0, 1.0);
    for (std::uint32_t b = 0; b < is.bands; ++b) {
      const double before = is.bands_m[b] - front_m;
      const bool cut = (state.tendons[line].bands_cut & (1u << b)) != 0;
      if (!cut && before < kBandReach_m)
        r += (kBand_n - r) * std::clamp(1 - before / kBandReach_m, 0.0, 1.0);
    }
    return r;
  }
  if (line == GraftBenchPlan::kBoard) {
    // The slide's whole way is a tension of 120 N.
    const double way = (plan_.board_to_W - plan_.board_from_W).norm();
    return 1.5 * kPretension_n / kLever * front_m / way;
  }
  const auto graft = graft_on(plan_, state);
  if (!graft) return 0;
  const double room = tool.size_m - graft->diameter_m;
  if (room < 0) return kTight_n + kWedge_n_per_m * front_m;
  return kTight_n * std::clamp(1 - room / kSizerStep_m, 0.05, 1.0);
}

double& GraftBenchWork::front_of(GraftBenchState& state, std::size_t hand,
                                 std::uint32_t line) const {
  return is_tendon(line) ? state.tendons[line].front_m : state.hands[hand].front_m;
}

// Taken on at the line's begin, along it; off again when it is drawn back before the begin.
void GraftBenchWork::follow_line(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones,
                                 GraftBenchState& state) {
  BenchHand& h = state.hands[hand];
  const BenchTool& with = held(tool);
  const auto along_of = [&](std::uint32_t line) {
    return Vec3((plan_.end_W(line) - plan_.begin_W(line)).normalized());
  };
  const auto in_rest = [&](std::uint32_t line, const Vec3& p_W) {
    // Bones of a bench stand still; what a pushed one gives way is left out.
    (void)bones;
    return Vec3(p_W - plan_.begin_W(line));
  };
  if (h.line != 0) {
    const std::uint32_t line = h.line - 1;
    const double along = along_of(line).dot(in_rest(line, tool.X_WP.p));
    const double wanted = along_of(line).dot(in_rest(line, tool.X_WD.p));
    h.grip = std::min(1.0, h.grip + kGripStep);
    if (std::min(along, wanted) < -kOffEnd_m) h.line = 0;
    return;
  }
  for (std::uint32_t line = 0; line < GraftBenchPlan::kLines; ++line) {
    if (!may_lead(state, line, with)) continue;
    const Vec3 along = along_of(line), off = in_rest(line, tool.X_WP.p);
    const double s = along.dot(off);
    const Vec3 axis = tool.X_WP.q * Vec3::UnitZ();
    if (s < -kOffEnd_m || s > kAhead_m || (off - s * along).norm() > kTakeOn_m ||
        -axis.dot(along) < kTakeOnTurn)
      continue;
    h.line = line + 1;
    h.grip = 0;
    if (line == GraftBenchPlan::kBoard) {
      const double way = (plan_.board_to_W - plan_.board_from_W).norm();
      h.front_m = way * state.tension_n / (1.5 * kPretension_n);
    } else {
      h.front_m = 0;
    }
    return;
  }
}

// What the front has come to.
void GraftBenchWork::reach(std::size_t hand, const BenchTool& tool, GraftBenchState& state) const {
  const std::uint32_t line = state.hands[hand].line - 1;
  const double way = (plan_.end_W(line) - plan_.begin_W(line)).norm();
  double& front = front_of(state, hand, line);
  if (is_tendon(line)) {
    TendonOnBench& tendon = state.tendons[line];
    const TendonMeasures& is = plan_.tendons[line].measures;
    for (std::uint32_t b = 0; b < is.bands && !tendon.stripped; ++b)
      if (front > is.bands_m[b] && (tendon.bands_cut & (1u << b)) == 0)
        tendon.amputated = tendon.stripped = true;
    if (front >= way) tendon.stripped = true;
    front = std::min(front, way);
    return;
  }
  front = std::min(front, way);
  if (line == GraftBenchPlan::kBoard) {
    const double holds_n = kStitchHolds_n * fewest_passes(state);
    state.tension_n = std::min(1.5 * kPretension_n * front / way, holds_n);
    return;
  }
  const auto graft = graft_on(plan_, state);
  if (!graft) return;
  const bool fits = tool.size_m >= graft->diameter_m;
  if (fits && front >= way - kPassed_m)
    state.passed_m = state.passed_m > 0 ? std::min(state.passed_m, tool.size_m) : tool.size_m;
  if (!fits) {
    front = std::min(front, kWedge_m);
    if (front > kRefused_m) state.refused_m = std::max(state.refused_m, tool.size_m);
  }
}

void GraftBenchWork::push(std::size_t hand, const ToolState& tool, GraftBenchState& state) {
  BenchHand& h = state.hands[hand];
  const std::uint32_t line = h.line - 1;
  const Vec3 along = (plan_.end_W(line) - plan_.begin_W(line)).normalized();
  double& front = front_of(state, hand, line);
  const double s = along.dot(tool.X_WP.p - plan_.begin_W(line));
  // Only what stands at the front pushes it.
  const double force = is_finite(tool.force_W) ? -along.dot(tool.force_W) : 0;
  const double over = force - resistance_n(state, line, front, held(tool));
  if (s > front - 0.002 && over > 0)
    front += step_s_ * std::min(over / kSlow_n_s_per_m, kFastest_m_per_s);
  // The board's slide does not go back by itself: open jaws let it follow them.
  if (line == GraftBenchPlan::kBoard && tool.jaw >= kJawsShut) front = std::clamp(s, 0.0, front);
  reach(hand, held(tool), state);
}

// A blade that is pressed on beside a band and drawn over it cuts it.
void GraftBenchWork::draw_blade(std::size_t hand, const ToolState& tool,
                                GraftBenchState& state) const {
  BenchHand& h = state.hands[hand];
  if (tool.contact_count == 0 || !is_finite(tool.force_W) || tool.force_W.norm() < kPressed_n) {
    h.over = 0;
    return;
  }
  for (std::uint32_t t = 0; t < kGraftTendons; ++t)
    for (std::uint32_t b = 0; b < plan_.tendons[t].bands_W.size(); ++b) {
      const Vec3 off = tool.X_WP.p - plan_.tendons[t].bands_W[b];
      const std::uint32_t name = 1 + t * static_cast<std::uint32_t>(kMostBands) + b;
      if (!state.tendons[t].found || off.norm() > kNearBand_m) {
        if (h.over == name) h.over = 0;
        continue;
      }
      if (h.over == 0) {
        h.over = name;
        h.from_W = tool.X_WP.p;
      }
      if (h.over == name && (tool.X_WP.p - h.from_W).norm() > kDrawn_m)
        state.tendons[t].bands_cut |= 1u << b;
    }
}

// A blade that is pressed on beside a stripped tendon's free end, and drawn.
void GraftBenchWork::scrape(std::size_t hand, const ToolState& tool, GraftBenchState& state) const {
  BenchHand& h = state.hands[hand];
  const std::uint32_t before = std::exchange(h.scrapes, 0);
  if (tool.contact_count == 0 || !is_finite(tool.force_W) || tool.force_W.norm() < kPressed_n)
    return;
  for (std::uint32_t t = 0; t < kGraftTendons; ++t) {
    TendonOnBench& tendon = state.tendons[t];
    const GraftBenchPlan::Tendon& lies = plan_.tendons[t];
    if (!tendon.stripped || tendon.folds > 0) continue;
    const Vec3 off = tool.X_WP.p - lies.free_W;
    const double along = off.dot(lies.lies_W);
    if (along < -kBeforeEnd_m || along > kMuscle_m ||
        (off - along * lies.lies_W).norm() > kBeside_m)
      continue;
    h.scrapes = t + 1;
    if (before == h.scrapes)
      tendon.scraped_m += std::min(kFastest_m_per_s * step_s_, (tool.X_WP.p - h.from_W).norm());
    h.from_W = tool.X_WP.p;
    return;
  }
}

// A needle holder that shuts at a place of a tendon's end has put thread through it.
void GraftBenchWork::stitch(std::size_t hand, const ToolState& tool, GraftBenchState& state) const {
  BenchHand& h = state.hands[hand];
  const bool shut = tool.jaw < kJawsShut, shuts = shut && !h.shut;
  h.shut = shut;
  if (!shuts) return;
  for (std::uint32_t t = 0; t < kGraftTendons; ++t) {
    if (!state.tendons[t].stripped || state.tendons[t].folds > 0) continue;
    for (std::uint32_t k = 0; k < kMostStitches; ++k)
      if ((tool.X_WP.p - stitch_W(plan_, t, k)).norm() < kNearStitch_m)
        state.tendons[t].stitches |= 1u << k;
  }
}

// Jaws shut about the free end of a stripped tendon take it; opened at a post they leave it there,
// folded as the post says.
void GraftBenchWork::carry(std::size_t hand, const ToolState& tool, GraftBenchState& state) const {
  BenchHand& h = state.hands[hand];
  if (in_knee_) h.carries = 0;
  const bool shut = tool.jaw < kJawsShut;
  const bool shuts = shut && !h.shut, opens = !shut && h.shut;
  h.shut = shut;
  if (shuts) take_tendon(plan_, tool, state, h);
  if (opens) h.lifts = 0;
  if (h.lifts != 0) lift_tendon(plan_, tool, step_s_, state, h);
  if (shuts && !in_knee_)
    for (std::uint32_t t = 0; t < kGraftTendons; ++t)
      if (state.tendons[t].stripped && (tool.X_WP.p - plan_.tendons[t].free_W).norm() < kNearEnd_m)
        h.carries = 1 + t;
  if (!opens || h.carries == 0) return;
  for (std::uint32_t i = 0; i < plan_.posts_W.size(); ++i)
    if ((tool.X_WP.p - plan_.posts_W[i]).norm() < kNearPost_m)
      state.tendons[h.carries - 1].folds = i + 2;
  h.carries = 0;
}

void GraftBenchWork::hang(std::size_t hand, const ToolState& tool, GraftBenchState& state) const {
  BenchHand& h = state.hands[hand];
  const bool near = (tool.X_WP.p - plan_.hook_W).norm() < kNearHook_m;
  h.hangs = near ? std::min(h.hangs + 1, kHangSteps) : 0;
  if (h.hangs == kHangSteps && !in_knee_ && graft_on(plan_, state))
    state.loop_m = held(tool).size_m;
}

void GraftBenchWork::publish(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones,
                             const GraftBenchState& state) {
  const BenchHand& h = state.hands[hand];
  ToolGuide& out = guides_[hand];
  out = {};
  if (h.lifts != 0) {
    const std::uint32_t thigh = plan_.bones[GraftBenchPlan::kSemitendinosus];
    out = guide_of_lift(plan_, h, thigh, bones.bones[thigh].X_WB);
    out.instrument = tool.instrument;
    return;
  }
  if (h.line == 0) return;
  const std::uint32_t line = h.line - 1, bone = plan_.bones[line];
  const Pose X_BW = bones.bones[bone].X_WB.inverse();
  const Vec3 back_W = (plan_.begin_W(line) - plan_.end_W(line)).normalized();
  out.on = true;
  out.instrument = tool.instrument;
  out.bone = bone;
  out.p_B = X_BW * plan_.begin_W(line);
  out.nhat_B = X_BW.rotate(back_W);
  out.grip = h.grip;
  out.in_hole = true;
  out.stops = true;
  out.stop_m = is_tendon(line) ? -state.tendons[line].front_m : -h.front_m;
}

void GraftBenchWork::step(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                          GraftBenchState& state) {
  in_knee_ = bones.placing.on && bones.placing.phase >= PlacingPhase::kThreadOut;
  if (in_knee_) state.tension_n = 0;
  for (std::size_t hand = 0; hand < std::min(tools.size(), kMaxHands); ++hand) {
    const ToolState& tool = *tools[hand];
    BenchHand& h = state.hands[hand];
    if (h.instrument != tool.instrument || tool.epoch != bones.epoch || !is_finite(tool.X_WP)) {
      h = {};
      h.instrument = tool.epoch == bones.epoch ? tool.instrument : kNoTool;
      guides_[hand] = {};
      continue;
    }
    follow_line(hand, tool, bones, state);
    if (h.line != 0) push(hand, tool, state);
    const BenchKind kind = held(tool).kind;
    if (kind == BenchKind::kBlade) {
      draw_blade(hand, tool, state);
      if (state.hands[hand].over == 0) scrape(hand, tool, state);
      if (h.over == 0 && h.scrapes == 0)
        open_fascia(plan_, tool, state, h);
      else
        h.slits = 0;
    }
    if (kind == BenchKind::kNeedle) stitch(hand, tool, state);
    if (kind == BenchKind::kClamp) carry(hand, tool, state);
    if (kind == BenchKind::kButton) hang(hand, tool, state);
    publish(hand, tool, bones, state);
  }
  state.creep_s += kClock * step_s_ * state.tension_n / kPretension_n;
}

}  // namespace osteon
