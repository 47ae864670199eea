#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "osteon/base/random.h"
#include "osteon/physics/joint_fluid.h"
#include "osteon/render/water_bit.h"
#include "osteon/scene/state.h"
#include "osteon/scene/tool.h"

namespace osteon {

/// How far it is straight up from a place in World to what closes the joint there; none: nothing
/// within the length, or the place lies in tissue.
using RoofAbove = std::function<std::optional<double>(const Vec3& p_W, double most_m)>;

/// What the water of a session carries, for pictures alone: bubbles of an ablator, of air that
/// comes in, and loose tissue of what is cut. A function of the moments that it is given: the same
/// ones give the same bits. It is stepped 50 times a second of the session's time.
class WaterDrift {
 public:
  /// `tray`: the instruments by ToolState::instrument.
  WaterDrift(const FluidJoint& joint, std::span<const std::shared_ptr<const Tool>> tray);

  /// On to a later moment. Where time goes back or leaps by more than a second, or there is no
  /// water, nothing is left in it. `scope_W`: the tip that one looks from; none: nobody looks.
  void go_to(double time_s, std::span<const ToolState> tools, const BoneSnapshot& bones,
             const std::optional<Vec3>& scope_W, const RoofAbove& roof);
  std::vector<WaterBit> bits() const;

 private:
  struct Bubble {
    WaterBit bit;
    double rises_m = 0;  ///< until it clings to the roof
  };
  struct Flake {
    WaterBit bit;
    Vec3 v_W = Vec3::Zero();     ///< that cutting gave it
    Vec3 spin_W = Vec3::Zero();  ///< rad/s
  };
  /// Where water goes in or out: positive out of it.
  struct Mouth {
    Vec3 p_W = Vec3::Zero();
    double flow_m3_s = 0;
  };

  void clear();
  void step(std::span<const ToolState> tools, const BoneSnapshot& bones,
            const std::optional<Vec3>& scope_W, const RoofAbove& roof);
  void find_mouths(std::span<const ToolState> tools, const FluidFlows& flows,
                   const std::optional<Vec3>& scope_W);
  void make_bubbles(std::span<const ToolState> tools, const WaterState& water,
                    const std::optional<Vec3>& scope_W, const RoofAbove& roof);
  void make_flakes(std::span<const ToolState> tools, const WaterState& water);
  void add_bubble(const Vec3& p_W, double least_m, double most_m, const RoofAbove& roof);
  void add_flake(const Vec3& p_W);
  void move_bubbles(double leaves);
  void move_flakes(double leaves, const std::optional<Vec3>& scope_W);
  void join_bubbles();
  bool is_sucked(const Vec3& p_W) const;
  Vec3 stream(const Vec3& p_W) const;

  FluidJoint joint_;
  std::vector<ToolUse> uses_;  ///< by place in the tray
  Random random_{1};
  std::optional<std::int64_t> at_step_;
  std::vector<Bubble> bubbles_;
  std::vector<Flake> flakes_;
  std::vector<Mouth> mouths_;
  std::vector<double> jaws_;  ///< of the last step, by hand
  std::optional<double> pump_pa_;
  double vapour_ = 0, air_ = 0, chips_ = 0, shreds_ = 0;  ///< parts of one that are due
  double air_in_line_ = 0;                                ///< bubbles that the pump still brings
};

/// As many as a picture is asked for: bubbles that have risen, and flakes, strewn about `center_W`.
/// The same each time.
std::vector<WaterBit> strewn_bits(std::size_t bubbles, std::size_t flakes, const Vec3& center_W,
                                  const RoofAbove& roof);

}  // namespace osteon
