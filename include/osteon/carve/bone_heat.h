#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "osteon/carve/block_grid.h"
#include "osteon/carve/carved_field.h"
#include "osteon/carve/heat.h"

namespace osteon {

/// Heat that an instrument leaves in a bone within a moment. In Bone.
struct HeatSource {
  Vec3 tip_B = Vec3::Zero(), axis_B = Vec3::UnitZ();  ///< the axis points back, along the shaft
  double radius_m = 0;
  double joules = 0;
  bool ball = false;  ///< it cuts all over a ball about the tip; else by the rim about it
};

/// How warm a bone became, on cells of a box: for who draws it.
struct HeatVolume {
  Vec3 lo_B = Vec3::Zero();  ///< middle of the first cell
  double cell_m = 0;
  std::array<int, 3> count{};
  /// Of each cell, x fastest: what byte_of says of its hottest temperature, and 255 where a rule
  /// calls it dead. A cell beside bone has the most of its neighbours.
  std::vector<std::array<std::uint8_t, 2>> cells;

  static constexpr double kFrom_c = 37, kTo_c = 69;
  static std::uint8_t byte_of(double celsius);
  static double celsius_of(std::uint8_t byte);
};

/// Temperature of a bone about all places where it is cut. It is known in blocks of cells that are
/// made where heat arises and where it spreads to; elsewhere bone is as warm as the body. What is
/// gone, or never was bone, conducts nothing: the carved field says so. A value, the same bits from
/// every compiler.
class BoneHeat {
 public:
  /// Beyond so many blocks none is made: heat that comes to their rim stays within it.
  static constexpr std::size_t kMostBlocks = 4096;  ///< 15 kB each

  /// Cells are twice those of the field.
  BoneHeat(const CarvedField& field, const HeatMaterial& material);

  /// Heat goes to bone at the rim about the tip; where there is none, or of a ball, to all that
  /// lies within 1.5 cells of its surface.
  void add(const CarvedField& field, const HeatSource& source);
  /// Looks up what is gone since the last call, conducts, and lets water that flows over the bone
  /// carry heat off; `flow_m3_s` 0: it is dry.
  void step(const CarvedField& field, double dt_s, const Irrigation& water, double flow_m3_s);

  double temperature_at(const Vec3& p_B) const;  ///< C, of the nearest cell; the body's where none
  double hottest_at(const Vec3& p_B) const;      ///< the same since the begin
  double hottest_c() const { return hottest_c_; }  ///< anywhere since the begin
  double necrosis_m3(std::size_t rule) const;      ///< of the bone that is left
  double energy_j() const;                         ///< above the body's
  std::size_t blocks() const { return blocks_.size(); }
  double cell_m() const { return grid_.cell_m; }
  double body_c() const { return material_.body_c; }
  /// Of all blocks; no cells where none is made.
  HeatVolume volume() const;

 private:
  struct Block {
    std::uint32_t index = 0;
    std::array<double, BlockGrid::kNodes> above{};  ///< K, over the body
    std::array<double, BlockGrid::kNodes> next{};
    std::array<float, BlockGrid::kNodes> most{};                  ///< the hottest so far
    std::array<std::array<float, BlockGrid::kNodes>, 2> hot_s{};  ///< above each rule's limit
    std::array<std::uint8_t, BlockGrid::kNodes> gone{};
    std::array<std::uint8_t, BlockGrid::kNodes>
        open{};          ///< of its faces: those towards what is gone
    double hottest = 0;  ///< K, now
  };
  struct Around;

  bool dead(const Block& block, std::size_t cell) const;
  Block* at(const std::array<int, 3>& place);
  const Block* at(const std::array<int, 3>& place) const;
  Block* make(const CarvedField& field, const std::array<int, 3>& place);
  void look(const CarvedField& field, Block& block) const;
  void follow(const CarvedField& field);
  void grow(const CarvedField& field);
  bool rests(const Block& block) const;
  void conduct(double dt_s);
  void conduct(Block& block, const Around& around, double share) const;
  void rinse(double dt_s, const Irrigation& water, double flow_m3_s);
  void note(double dt_s);
  template <class Each>
  void each_cell_within(const CarvedField& field, const Vec3& p_B, double reach_m, Each each);
  bool spread(const CarvedField& field, const HeatSource& source);

  HeatMaterial material_;
  BlockGrid grid_;
  int stride_;                      ///< nodes of the field to a cell
  std::vector<std::int32_t> slot_;  ///< of each block of the grid; -1: none
  std::vector<Block> blocks_;
  std::uint64_t seen_ = 0, epoch_ = 0;  ///< of the field
  double hottest_c_;
};

/// What flowing water takes from a surface through which `w_per_k` watts pass for each kelvin, as a
/// share of that: a stream that warms on its way takes C (1 - exp(-w/C)), C = flow times its heat
/// capacity (one fluid of a heat exchanger; Incropera, chapter 11).
double rinse_share(double w_per_k, double flow_m3_s);

}  // namespace osteon
