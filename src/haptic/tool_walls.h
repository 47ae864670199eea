#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "nearest_point.h"
#include "osteon/collide/round_box.h"
#include "osteon/scene/state.h"
#include "osteon/scene/tool.h"

namespace osteon {

/// The tools of the other hands near this one, in one tick.
///
/// Two proxies that were walls for each other could not share a push: each would stand still for
/// its own hand alone. So the wall between two parts stands in the middle between where both hands
/// want them, along the line that parts the proxies: of balls, rods and boxes alike. Each hand's
/// spring is then stretched by half of the overlap, and the two forces are equal and opposite but
/// for the tick by which each knows the other late.
class ToolWalls {
 public:
  static constexpr std::size_t kMostPlanes = 6;

  /// `tray`: the tools that other hands may hold, by OtherTool::instrument.
  ToolWalls(const Tool& own, std::span<const std::shared_ptr<const Tool>> tray);

  /// Planes for this tool at X_WT, whose hand wants it `to_hand_W` farther. The line between two
  /// proxies is that of the other's place `before` where it has one: neither may pass through the
  /// other in a tick.
  void start(const OtherTools& before, const OtherTools& now, const Pose& X_WT,
             const Vec3& to_hand_W);
  /// The planes again, with this tool at X_WT.
  void look(const OtherTools& now, const Pose& X_WT, const Vec3& to_hand_W);

  void clear() { count_ = 0; }
  std::uint32_t count() const { return count_; }
  std::uint32_t hand(std::uint32_t i) const { return walls_[i].hand; }
  const Vec3& point_W(std::uint32_t i) const { return walls_[i].p_W; }
  void raise(const Quat& q_WT, std::span<FreeHalfSpace> out) const;

 private:
  struct Part {
    RoundBox box;
    Vec3 middle_T = Vec3::Zero();
    double reach_m = 0;  ///< of all of it about its middle
  };
  struct Wall {
    std::uint32_t hand = 0;
    std::uint32_t part = 0;  // of this tool
    double gap = 0;          // between the proxies, m
    double level = 0;        // of the wall along n_W, m
    Vec3 n_W = Vec3::UnitZ();
    Vec3 p_W = Vec3::Zero();
  };
  void find(const OtherTools& line_from, const OtherTools& now, const Pose& X_WT,
            const Vec3& to_hand_W);
  void meet(std::uint32_t hand, const OtherTool& line_from, const OtherTool& now, const Pose& X_WT,
            const Vec3& to_hand_W);
  void keep(const Wall& wall);

  static std::vector<Part> parts_of(const Tool& tool);

  std::vector<Part> own_;
  std::vector<std::vector<Part>> tray_;
  std::vector<Vec3> middles_W_;  ///< of the other's parts, while one is met
  std::array<Wall, kMostPlanes> walls_{};
  std::uint32_t count_ = 0;
};

}  // namespace osteon
