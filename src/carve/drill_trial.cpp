#include "osteon/carve/drill_trial.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace osteon {
namespace {

constexpr double kTick_s = 1e-3;
constexpr double kContact_n_per_m = 2e5;  // of the tip on bone
constexpr double kHandTime_s = 0.25;      // in which the hand finds its thrust
constexpr double kBeside_m = 0.2e-3;
constexpr double kHeatCell_m = 0.5e-3;
constexpr double kHeatStep_s = 0.05;

struct Way {
  std::vector<double> ends_m;  ///< of each layer
  std::vector<const DrillMaterial*> materials;
  double end() const { return ends_m.back(); }
  std::size_t layer_at(double depth) const {
    return static_cast<std::size_t>(std::upper_bound(ends_m.begin(), ends_m.end(), depth) -
                                    ends_m.begin());
  }
};

Result<Way> way_through(const DrillTable& table, const std::vector<DrillLayer>& layers) {
  if (layers.empty()) return fail("has no layer", "the trial", "Give at least one");
  Way way;
  double depth = 0;
  for (const DrillLayer& layer : layers) {
    const DrillMaterial* material = table.find(layer.material);
    if (!material)
      return fail("there is no material '" + layer.material + "'", "the trial",
                  "Name one of assets/materials/drilling.toml");
    if (!(layer.thickness_m > 0) || !std::isfinite(layer.thickness_m))
      return fail("has a layer without thickness", "the trial", "Give millimetres above zero");
    depth += layer.thickness_m;
    way.ends_m.push_back(depth);
    way.materials.push_back(material);
  }
  return way;
}

Result<void> check(const DrillTool& tool, const DrillHand& hand) {
  const bool good = tool.diameter_m > 0 && std::isfinite(tool.speed_rev_per_s) &&
                    tool.pilot_diameter_m >= 0 && tool.pilot_diameter_m < tool.diameter_m &&
                    tool.bluntness >= 0 && tool.bluntness <= 1 && hand.thrust_n > 0 &&
                    hand.mass_kg > 0 && hand.stiffness_n_per_m > 0 && hand.damping_ratio >= 0 &&
                    std::isfinite(hand.drop_n) && std::isfinite(hand.thrust_n);
  if (good) return {};
  return fail(
      "has a number out of range", "the trial",
      "Thrust and diameter above zero, a pilot hole thinner than the drill, bluntness 0 to 1");
}

/// The hand at one end of its muscles, the drill at the other.
class HandMotion {
 public:
  explicit HandMotion(const DrillHand& hand)
      : hand_(hand),
        damping_(2 * hand.damping_ratio * std::sqrt(hand.stiffness_n_per_m * hand.mass_kg)),
        contact_damping_(2 * std::sqrt(kContact_n_per_m * hand.mass_kg)) {}

  /// The bone's answer at `floor_m`, deeper than which nothing is removed, N.
  double push(double floor_m) const {
    const double in = tip_m - floor_m;
    return in > 0 ? std::max(0.0, kContact_n_per_m * in + contact_damping_ * speed_) : 0;
  }

  void move(double resistance_n, double wanted_n) {
    const double pull = hand_.stiffness_n_per_m * (wants_m_ - tip_m);
    // In air the hand has no time to change its mind.
    if (resistance_n > 0 || !touched_)
      wants_m_ += (wanted_n - pull) / hand_.stiffness_n_per_m / kHandTime_s * kTick_s;
    touched_ = touched_ || resistance_n > 0;
    speed_ += (pull - damping_ * speed_ - resistance_n) / hand_.mass_kg * kTick_s;
    tip_m += speed_ * kTick_s;
  }

  double speed() const { return speed_; }
  double tip_m = 0;

 private:
  DrillHand hand_;
  double damping_, contact_damping_;
  double speed_ = 0, wants_m_ = 0;
  bool touched_ = false;
};

/// Heat about the hole, whose axis is z from the surface down.
class HoleHeat {
 public:
  HoleHeat(HeatGrid grid, const DrillTable& table, const DrillTool& tool)
      : grid_(std::move(grid)), table_(table), radius_(0.5 * tool.diameter_m) {
    if (tool.pilot_diameter_m > 0) pilot_ = 0.5 * tool.pilot_diameter_m;
  }

  void begin(double end_m) {
    if (pilot_ > 0) grid_.open(Vec3(0, 0, -1e-3), Vec3(0, 0, end_m + 1e-3), pilot_);
  }

  void add(const DrillStep& step, double depth_m) {
    // The bone before the drill is cut away with the heat in it, unless the drill is slow.
    const double stays = 1 / (1 + step.advance_m / kTick_s / table_.outrun_m_per_s);
    const double joules =
        stays *
        (table_.chips_heat_share * step.cutting_w + table_.rubbing_heat_share * step.rubbing_w) *
        kTick_s;
    constexpr int kAround = 8;
    for (int i = 0; i < kAround; ++i) {
      const double a = 2 * M_PI * (i + 0.5) / kAround;
      grid_.add_heat(Vec3(radius_ * std::cos(a), radius_ * std::sin(a), depth_m), joules / kAround);
    }
  }

  void step(double depth_m, bool water) {
    grid_.open(Vec3(0, 0, -1e-3), Vec3(0, 0, depth_m - kHeatCell_m), radius_ - 0.5 * kHeatCell_m);
    grid_.step(kHeatStep_s);
    if (water) grid_.irrigate(table_.water, kHeatStep_s);
  }

  double hottest_beside(double end_m) const {
    double most = 0;
    for (double z = 0.5e-3; z < end_m; z += 0.5e-3)
      for (const double a : {0.4, 2.0, 3.6, 5.2})
        most = std::max(most, grid_.temperature_at(Vec3((radius_ + kBeside_m) * std::cos(a),
                                                        (radius_ + kBeside_m) * std::sin(a), z)));
    return most;
  }
  const HeatGrid& grid() const { return grid_; }

 private:
  HeatGrid grid_;
  const DrillTable& table_;
  double radius_, pilot_ = 0;
};

Result<std::optional<HoleHeat>> heat_for(const DrillTable& table, const DrillTool& tool, double end,
                                         bool wanted) {
  if (!wanted) return std::optional<HoleHeat>();
  const double half = 0.5 * tool.diameter_m + 6e-3;
  Aabb box;
  box.include(Vec3(-half, -half, -2e-3));
  box.include(Vec3(half, half, end + 4e-3));
  auto grid = HeatGrid::make(box, kHeatCell_m, table.heat);
  if (!grid) return tl::unexpected(grid.error());
  std::optional<HoleHeat> heat(std::in_place, std::move(*grid), table, tool);
  heat->begin(end);
  return heat;
}

}  // namespace

// Each tick: the tip presses on what is left, that takes away what the thrust can, and the hand
// moves against the rest. Ends when the hand has stopped beyond the bone, or when the time is over.
Result<DrillTrial> run_drill_trial(const DrillTable& table, const std::vector<DrillLayer>& layers,
                                   const DrillTool& tool, const DrillHand& hand,
                                   const DrillTrialOptions& options) {
  const auto way = way_through(table, layers);
  if (!way) return tl::unexpected(way.error());
  if (const auto good = check(tool, hand); !good) return tl::unexpected(good.error());
  auto heat = heat_for(table, tool, way->end(), options.heat);
  if (!heat) return tl::unexpected(heat.error());
  DrillTrial trial;
  DrillState drill;
  HandMotion motion(hand);
  const auto every = std::max(1L, std::lround(options.sample_s / kTick_s));
  const auto heat_every = std::lround(kHeatStep_s / kTick_s);
  double furthest = 0, hottest = table.heat.body_c;
  for (long tick = 0; static_cast<double>(tick) * kTick_s < options.longest_s; ++tick) {
    const std::size_t layer = way->layer_at(drill.depth_m);
    const bool in_bone = layer < way->materials.size();
    const double thrust = in_bone ? motion.push(drill.depth_m) : 0;
    const DrillBite bite{in_bone ? way->materials[layer] : nullptr, 0};
    const DrillStep step = step_drill(drill, table, tool, bite, thrust, kTick_s);
    const bool last = layer + 1 >= way->materials.size() && layers.size() > 1;
    motion.move(step.resistance_n, hand.thrust_n - (last ? hand.drop_n : 0));
    if (*heat) {
      (*heat)->add(step, drill.depth_m);
      if (tick % heat_every == 0) {
        (*heat)->step(drill.depth_m, options.water);
        hottest = std::max(hottest, (*heat)->hottest_beside(way->end()));
      }
    }
    furthest = std::max(furthest, motion.tip_m);
    if (tick % every == 0)
      trial.samples.push_back({static_cast<double>(tick) * kTick_s, motion.tip_m, drill.depth_m,
                               step.resistance_n, step.torque_nm, step.feed_m_per_rev, hottest});
    trial.through = !in_bone;
    if (!in_bone && motion.speed() <= 0) break;
  }
  if (trial.through) trial.plunge_m = std::max(0.0, furthest - way->end());
  trial.hottest_c = hottest;
  if (*heat)
    for (std::size_t r = 0; r < 2; ++r) trial.necrosis_m3[r] = (*heat)->grid().necrosis_m3(r);
  return trial;
}

}  // namespace osteon
