// Small bubbles rise as balls do at a slow flow, v = 2/9 g r^2 / nu, larger ones no faster than
// 0.2 m/s. A mouth through which water flows draws it in or drives it off as a point does,
// q / (4 pi r^2). What leaves does so as the mixture does: by an exponential at the rate at which
// the room's water is exchanged. All other figures are D, our own defaults.
#include "water/water_drift.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "osteon/physics/joint_water.h"

namespace osteon {
namespace {

constexpr double kDriftStep_s = 0.02, kDriftLeap_s = 1;
constexpr double kRoof_m = 0.06;                      // no joint is higher
constexpr double kGravity = 9.81, kViscosity = 1e-6;  // of water, m2/s
constexpr double kFastest_m_per_s = 0.2;
constexpr std::size_t kMostBubbles = 56, kMostFlakes = 56;
static_assert(kMostBubbles + kMostFlakes <= kMostWaterBits);

constexpr double kVapour_per_s = 25;  // bubbles at full power
constexpr double kVapourLeast_m = 1.2e-4, kVapourMost_m = 5e-4;
constexpr double kAirLeast_m = 3e-4, kAirMost_m = 9e-4, kMostAir_per_s = 30;
constexpr double kPlume_m = 0.004;  // across which bubbles are born
constexpr double kLargestBubble_m = 0.0015;
constexpr double kRaised_pa = 2 * kPa_per_mmHg;  // of the pump, that brings air
constexpr double kLineAir = 12, kLineAirFor_pa = 40 * kPa_per_mmHg, kLineAir_per_s = 12;

constexpr double kChip_m3 = 2e-10, kMostChips_per_s = 12, kShreds_per_s = 4, kShredsOfABite = 2;
constexpr double kFlakeLeast_m = 2.5e-4, kFlakeMost_m = 1.2e-3;
constexpr double kThrown_m_per_s = 0.03, kSlows_s = 0.25, kSinks_m_per_s = 4e-4;
constexpr double kSwirl_m_per_s = 0.0015, kFastestStream_m_per_s = 0.05;
constexpr double kTaken_m = 0.0015;  // by a mouth that sucks
constexpr double kOutOfSight_m = 0.06;
constexpr double kTouches_n = 0.2;
constexpr double kJawShuts = 0.3;  // of its way, between two steps

const Vec3 kUp = Vec3::UnitZ();  // of World

double rise_m_per_s(double radius_m) {
  return std::min(2.0 / 9 * kGravity * radius_m * radius_m / kViscosity, kFastest_m_per_s);
}

/// Takes whole ones off what is due, and adds what comes due in a step.
int whole_due(double& waiting, double per_s) {
  waiting += per_s * kDriftStep_s;
  const double whole = std::floor(waiting);
  waiting -= whole;
  return static_cast<int>(whole);
}

template <class T>
void keep_newest(std::vector<T>& all, std::size_t most) {
  if (all.size() > most)
    all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() - most));
}

WaterBit bubble_at(const Vec3& p_W, double radius_m) {
  WaterBit bit;
  bit.p_W = p_W;
  bit.radius_m = radius_m;
  return bit;
}

WaterBit flake_at(const Vec3& p_W, Random& random) {
  WaterBit bit;
  bit.is = WaterBit::Is::kFlake;
  bit.p_W = p_W;
  bit.radius_m = random.uniform(kFlakeLeast_m, kFlakeMost_m);
  bit.turn = random.rotation();
  bit.shape = random.uniform();
  return bit;
}

bool is_in_joint(const ToolState& tool, std::size_t known) {
  return tool.tick > 0 && tool.instrument < known && is_finite(tool.X_WP);
}

}  // namespace

WaterDrift::WaterDrift(const FluidJoint& joint, std::span<const std::shared_ptr<const Tool>> tray)
    : joint_(joint) {
  for (const auto& tool : tray) uses_.push_back(tool->use);
}

void WaterDrift::clear() {
  bubbles_.clear();
  flakes_.clear();
  jaws_.clear();
  pump_pa_.reset();
  vapour_ = air_ = chips_ = shreds_ = air_in_line_ = 0;
  random_ = Random(1);
}

void WaterDrift::go_to(double time_s, std::span<const ToolState> tools, const BoneSnapshot& bones,
                       const std::optional<Vec3>& scope_W, const RoofAbove& roof) {
  if (!std::isfinite(time_s)) return;
  const auto step_then = static_cast<std::int64_t>(std::floor(time_s / kDriftStep_s));
  const double passed_s = at_step_ ? kDriftStep_s * static_cast<double>(step_then - *at_step_) : -1;
  if (!bones.water.on || passed_s < 0 || passed_s > kDriftLeap_s) {
    clear();
    at_step_ = step_then;
  }
  if (!bones.water.on) return;
  for (; *at_step_ < step_then; ++*at_step_) step(tools, bones, scope_W, roof);
}

void WaterDrift::step(std::span<const ToolState> tools, const BoneSnapshot& bones,
                      const std::optional<Vec3>& scope_W, const RoofAbove& roof) {
  const WaterState& water = bones.water;
  const FluidFlows flows = fluid_flows(joint_, drive_of(water), water.pressure_pa);
  const double exchanged_per_s = (flows.out + flows.leaked + flows.sucked) / joint_.room_m3;
  const double leaves = -std::expm1(-exchanged_per_s * kDriftStep_s);
  find_mouths(tools, flows, scope_W);
  make_bubbles(tools, water, scope_W, roof);
  make_flakes(tools, water);
  move_bubbles(leaves);
  join_bubbles();
  move_flakes(leaves, scope_W);
}

// Water comes in beside the scope's window, and leaves through what sucks.
void WaterDrift::find_mouths(std::span<const ToolState> tools, const FluidFlows& flows,
                             const std::optional<Vec3>& scope_W) {
  mouths_.clear();
  if (scope_W) mouths_.push_back({*scope_W, flows.in});
  double power = 0;
  for (const ToolState& tool : tools)
    if (is_in_joint(tool, uses_.size()) && uses_[tool.instrument].sucks && tool.power > 0)
      power += tool.power;
  for (const ToolState& tool : tools)
    if (is_in_joint(tool, uses_.size()) && uses_[tool.instrument].sucks && tool.power > 0)
      mouths_.push_back({tool.X_WP.p, -flows.sucked * tool.power / power});
}

bool WaterDrift::is_sucked(const Vec3& p_W) const {
  return std::any_of(mouths_.begin(), mouths_.end(), [&](const Mouth& mouth) {
    return mouth.flow_m3_s < 0 && (p_W - mouth.p_W).norm() < kTaken_m;
  });
}

Vec3 WaterDrift::stream(const Vec3& p_W) const {
  Vec3 v = Vec3::Zero();
  for (const Mouth& mouth : mouths_) {
    const Vec3 away = p_W - mouth.p_W;
    const double r = std::max(away.norm(), kTaken_m);
    v += mouth.flow_m3_s / (4 * std::numbers::pi * r * r * r) * away;
  }
  const double speed = v.norm();
  return speed > kFastestStream_m_per_s ? Vec3(v * (kFastestStream_m_per_s / speed)) : v;
}

// Where nothing closes above, it is no joint: a bubble there leaves.
void WaterDrift::add_bubble(const Vec3& p_W, double least_m, double most_m, const RoofAbove& roof) {
  const double radius_m = random_.uniform(least_m, most_m);
  const double off_m = random_.uniform(0, kPlume_m);
  const Vec3 at_W = p_W + off_m * random_.direction();
  const auto above = roof(at_W, kRoof_m);
  if (!above) return;
  bubbles_.push_back({bubble_at(at_W, radius_m), std::max(0.0, *above - radius_m)});
  keep_newest(bubbles_, kMostBubbles);
}

// An ablator makes vapour. Below the air's pressure air comes in where water leaves otherwise,
// beside the shafts; a pump that is set higher brings the air that stood in its line.
void WaterDrift::make_bubbles(std::span<const ToolState> tools, const WaterState& water,
                              const std::optional<Vec3>& scope_W, const RoofAbove& roof) {
  for (const ToolState& tool : tools) {
    if (!is_in_joint(tool, uses_.size()) || !uses_[tool.instrument].burns) continue;
    const double power = std::clamp(tool.power, 0.0, 1.0);
    for (int n = whole_due(vapour_, kVapour_per_s * power); n > 0; --n)
      add_bubble(tool.X_WP.p, kVapourLeast_m, kVapourMost_m, roof);
  }
  if (pump_pa_ && water.pump_pa > *pump_pa_ + kRaised_pa)
    air_in_line_ = std::min(air_in_line_ + kLineAir * (water.pump_pa - *pump_pa_) / kLineAirFor_pa,
                            2 * kLineAir);
  pump_pa_ = water.pump_pa;
  if (!scope_W) return;
  double air_per_s = 0;
  if (water.pressure_pa < 0) {
    const double mean_m = 0.5 * (kAirLeast_m + kAirMost_m);
    const double air_m3_s = (joint_.outflow * water.outlet_open + joint_.leak) * -water.pressure_pa;
    air_per_s = air_m3_s / (4.0 / 3 * std::numbers::pi * mean_m * mean_m * mean_m);
  }
  if (air_in_line_ > 0) {
    air_per_s += kLineAir_per_s;
    air_in_line_ -= kLineAir_per_s * kDriftStep_s;
  }
  for (int n = whole_due(air_, std::min(air_per_s, kMostAir_per_s)); n > 0; --n)
    add_bubble(*scope_W, kAirLeast_m, kAirMost_m, roof);
}

void WaterDrift::add_flake(const Vec3& p_W) {
  Flake flake;
  flake.bit = flake_at(p_W, random_);
  const double speed = random_.uniform(0.3, 1) * kThrown_m_per_s;
  flake.v_W = speed * random_.direction();
  const double spin = random_.uniform(0.2, 2);
  flake.spin_W = spin * random_.direction();
  flakes_.push_back(flake);
  keep_newest(flakes_, kMostFlakes);
}

// Chips of bone come with the slurry. What removes soft tissue tells of none: while it runs and is
// pressed against something it tears shreds, and jaws do when they bite.
void WaterDrift::make_flakes(std::span<const ToolState> tools, const WaterState& water) {
  if (jaws_.size() != tools.size()) {
    jaws_.clear();
    for (const ToolState& tool : tools) jaws_.push_back(tool.jaw);
  }
  const double chips_per_s = std::min(water.debris_m3_s / kChip_m3, kMostChips_per_s);
  for (std::size_t h = 0; h < tools.size(); ++h) {
    const ToolState& tool = tools[h];
    const bool bites = jaws_[h] - tool.jaw > kJawShuts;
    if (bites || tool.jaw > jaws_[h]) jaws_[h] = tool.jaw;
    if (!is_in_joint(tool, uses_.size())) continue;
    const ToolUse& use = uses_[tool.instrument];
    const bool presses = tool.force_W.norm() > kTouches_n;
    const bool runs = use.removes && tool.power > 0;
    int count = runs ? whole_due(chips_, chips_per_s) : 0;
    if (runs && presses && !(chips_per_s > 0)) count += whole_due(shreds_, kShreds_per_s);
    if ((use.cuts || use.removes) && bites && presses)
      count += whole_due(shreds_, kShredsOfABite / kDriftStep_s);
    for (; count > 0; --count) add_flake(tool.X_WP.p);
  }
}

void WaterDrift::move_bubbles(double leaves) {
  for (Bubble& bubble : bubbles_) {
    const Vec3 v = stream(bubble.bit.p_W);
    const double up = std::min(rise_m_per_s(bubble.bit.radius_m) * kDriftStep_s, bubble.rises_m);
    bubble.bit.p_W += up * kUp;
    if (bubble.rises_m > 0) bubble.bit.p_W += kDriftStep_s * Vec3(v.x(), v.y(), 0);
    bubble.rises_m -= up;
  }
  std::erase_if(bubbles_, [&](const Bubble& bubble) {
    const bool goes = random_.uniform() < leaves;
    return goes || is_sucked(bubble.bit.p_W);
  });
}

// Those that cling to the roof run together where they meet.
void WaterDrift::join_bubbles() {
  for (std::size_t a = 0; a < bubbles_.size(); ++a)
    for (std::size_t b = a + 1; b < bubbles_.size();) {
      WaterBit &one = bubbles_[a].bit, &other = bubbles_[b].bit;
      const bool cling = bubbles_[a].rises_m <= 0 && bubbles_[b].rises_m <= 0;
      const double joined_m = std::cbrt(std::pow(one.radius_m, 3) + std::pow(other.radius_m, 3));
      const bool meet = (one.p_W - other.p_W).norm() < one.radius_m + other.radius_m;
      if (!cling || !meet || joined_m > kLargestBubble_m) {
        ++b;
        continue;
      }
      const WaterBit& larger = one.radius_m >= other.radius_m ? one : other;
      const Vec3 p_W = larger.p_W - (joined_m - larger.radius_m) * kUp;
      one.p_W = p_W;
      one.radius_m = joined_m;
      bubbles_.erase(bubbles_.begin() + static_cast<std::ptrdiff_t>(b));
    }
}

void WaterDrift::move_flakes(double leaves, const std::optional<Vec3>& scope_W) {
  const double slower = std::exp(-kDriftStep_s / kSlows_s);
  for (Flake& flake : flakes_) {
    WaterBit& bit = flake.bit;
    const Vec3 swirl(std::sin(400 * bit.p_W.y() + 6 * bit.shape),
                     std::sin(400 * bit.p_W.z() + 9 * bit.shape),
                     std::sin(400 * bit.p_W.x() + 12 * bit.shape));
    const Vec3 v = flake.v_W + stream(bit.p_W) + kSwirl_m_per_s * swirl - kSinks_m_per_s * kUp;
    bit.p_W += kDriftStep_s * v;
    flake.v_W *= slower;
    const double angle = kDriftStep_s * flake.spin_W.norm();
    bit.turn = Quat(Eigen::AngleAxisd(angle, flake.spin_W.normalized())) * bit.turn;
    bit.turn.normalize();
  }
  std::erase_if(flakes_, [&](const Flake& flake) {
    const Vec3& p_W = flake.bit.p_W;
    const bool goes = random_.uniform() < leaves;
    return goes || is_sucked(p_W) || (scope_W && (p_W - *scope_W).norm() > kOutOfSight_m);
  });
}

std::vector<WaterBit> WaterDrift::bits() const {
  std::vector<WaterBit> out;
  for (const Bubble& bubble : bubbles_) out.push_back(bubble.bit);
  for (const Flake& flake : flakes_) out.push_back(flake.bit);
  return out;
}

std::vector<WaterBit> strewn_bits(std::size_t bubbles, std::size_t flakes, const Vec3& center_W,
                                  const RoofAbove& roof) {
  constexpr double kAround_m = 0.008;
  Random random(1);
  std::vector<WaterBit> out;
  // A place in tissue is tried again, but not for ever.
  for (std::size_t tries = 8 * bubbles; tries > 0 && out.size() < bubbles; --tries) {
    const double radius_m = random.uniform(kVapourLeast_m, kAirMost_m);
    const double off_m = kAround_m * std::cbrt(random.uniform());
    const Vec3 p_W = center_W + off_m * random.direction();
    const auto above = roof(p_W, kRoof_m);
    if (above) out.push_back(bubble_at(p_W + std::max(0.0, *above - radius_m) * kUp, radius_m));
  }
  for (std::size_t k = 0; k < flakes; ++k) {
    const double off_m = kAround_m * std::cbrt(random.uniform());
    const Vec3 p_W = center_W + off_m * random.direction();
    out.push_back(flake_at(p_W, random));
  }
  return out;
}

}  // namespace osteon
