#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "osteon/carve/carved_field.h"
#include "osteon/carve/loose_pieces.h"
#include "osteon/carve/piece_shape.h"
#include "osteon/collide/cut_field.h"
#include "osteon/physics/soft_cut_state.h"
#include "osteon/physics/soft_setup.h"
#include "osteon/physics/soft_state.h"
#include "osteon/tissue/cut_solid_work.h"
#include "soft/solid_bridge.h"
#include "soft/solid_cells.h"
#include "soft/solid_presses.h"

namespace osteon {

/// Cuts are known so far outside of a solid: further than the middle of any cutter's axis is from
/// what it presses.
inline constexpr double kSolidCutAir_m = 0.004;
/// Of a solid that hold cuts, at most.
inline constexpr std::size_t kMostCutBlocks = 4096;
/// Steps from one look for what has come off, or tears off, to the next.
inline constexpr std::uint64_t kSolidLookEvery = 24;

/// Soft solids that instruments cut, at the physics' rate. What is left is a carved field: hands
/// feel a hole in the next step. The solid's stiffness is that of the cells that are left, made
/// anew over some hundred steps after a cut; how far that work is belongs to the state. A function
/// of the state and of the tools, bit by bit.
///
/// An edge goes in where it is pressed harder than the solid's cutting force, by as much as holds
/// the push at that force. What is between jaws is gone when they shut. What clears follows the
/// hand through the solid as fast as it can. Allocates in steps in which something changes, not in
/// others.
class SolidCutting {
 public:
  /// A cut into a solid, or a piece that has come off.
  struct News {
    std::uint32_t solid = 0;
    std::size_t hand = 0;
    bool piece = false;
    double force_n = 0, volume_m3 = 0;
    Vec3 p_B = Vec3::Zero();
    bool cleared = false;  ///< so much of what is to be cleared is gone: cleared_percent()
    /// Of a piece, in Bone; null where pieces are gone at once.
    std::shared_ptr<const PieceShape> shape = nullptr;
    bool torn = false;   ///< what jaws pull has torn
    double holds_n = 0;  ///< what it bore
  };

  SolidCutting(const SoftSetup& setup, SolidPresses& presses, double step_s);

  /// Parts of the tool that are out of the way.
  std::uint64_t lifted(const ToolState& tool) const;
  /// After all hands have pressed.
  void step(SoftState& state, std::span<const SolidHand> hands, std::uint64_t step);
  std::span<const News> news() const { return news_; }
  /// What jaws pull at `p_B` with that force tears where what is left bears less. After step(), and
  /// once in kSolidLookEvery steps, since the search takes some milliseconds.
  void pull(std::uint32_t solid, std::size_t hand, const Vec3& p_B, double force_n,
            std::uint64_t step);
  bool is_cut(std::size_t solid) const { return solids_[solid].field.block_count() > 0; }
  /// Something was cut in the last step.
  bool cuts_now() const;
  double removed_m3(std::size_t solid) const;
  /// The same as it was when it was last looked at, at most kSolidLookEvery steps ago.
  double gone_m3(std::size_t solid) const { return solids_[solid].gone_m3; }
  std::uint32_t pieces(std::size_t solid) const;
  /// Of what is to be cleared; 0 where nothing is.
  double cleared_percent(std::size_t solid) const;
  double all_cleared_percent() const;  ///< of all solids together; -1: nothing is to be cleared
  void show(std::array<std::shared_ptr<const CarveState>, kMaxSolids>& cuts) const;

  std::uint64_t hash() const;
  std::shared_ptr<const SoftCutState> save() const;
  bool fits(const SoftCutState& state) const;
  void restore(const SoftCutState& state);
  /// As restore, but the stiffness follows in the next steps, so that it takes no time now.
  void go_back(const SoftCutState& state);
  void clear();

 private:
  using ClearBits = std::array<std::uint64_t, BlockGrid::kNodes / 64>;
  struct Solid {
    explicit Solid(CarvedField carved) : field(std::move(carved)) {}
    mutable CarvedField field;  ///< it keeps the hashes of its blocks
    std::unique_ptr<CutField> holes;
    std::unique_ptr<LoosePieces> loose;
    std::unique_ptr<SolidCells> cells;
    std::shared_ptr<const PressedSolid> body;  ///< null: whole
    std::vector<CutCell> felt, next, whole;
    std::unique_ptr<CutSolidWork> work;
    std::uint64_t felt_hash = 0, next_hash = 0;
    std::uint64_t worked = 0, seen = 0, looked = 0, told = 0;
    static constexpr std::uint64_t kNever = ~std::uint64_t{0};
    /// The field's steps when cells were looked at, and when they were found to be what is felt.
    std::uint64_t celled = 0, followed = kNever;
    std::uint32_t pieces = 0;
    std::shared_ptr<const CarveState> shown;
    std::vector<ClearBits> to_clear;  ///< of each block; empty: nothing is
    std::vector<std::uint16_t> gone;  ///< of each block, of those
    std::uint64_t to_clear_nodes = 0, gone_nodes = 0;
    std::uint32_t told_percent = 0;
    double gone_m3 = 0;
    std::uint64_t summed = 0;               ///< the field's step when that was found
    std::unique_ptr<BridgeSearch> bridges;  ///< null: nothing tears
    /// The last search, of the field after which step and from where: not part of the state.
    std::optional<SolidBridge> bridge;
    std::uint64_t bridged = kNever;
    Vec3 bridged_B = Vec3::Zero();
    double bridged_n = 0;                        ///< it looked for what this force tears
    std::uint64_t ahead_of = kNever, ahead = 0;  ///< the field's step, and steps since
  };
  struct Stroke;

  const SolidCutter* cutter(std::uint32_t instrument) const;
  bool presses_most(const SolidHandState& state, const SolidCutter& with, std::uint32_t& at) const;
  void cut_with(SoftState& state, std::size_t hand, const SolidHand& with);
  void slice(const Stroke& stroke);
  void bite(const Stroke& stroke);
  void clear_away(SoftState& state, std::size_t hand, const SolidHand& of, const SolidCutter& with);
  Vec3 touching_W(const SolidNear& near, const SolidHand& of) const;
  bool clears_at(const SolidNear& near, const SolidHand& of, const SolidCutter& with) const;
  void find_to_clear(Solid& solid, const SoftSolid& of) const;
  void count_gone(Solid& solid, std::uint32_t block) const;
  void tell_cleared(std::uint32_t solid);
  double remove(std::uint32_t solid, const Cutter& cutter, const Pose& from, const Pose& to);
  void tell(const Stroke& stroke, double volume_m3);
  void catch_up(std::uint32_t solid);
  void sum_gone(std::uint32_t solid);
  void drop_pieces(std::uint32_t solid);
  void follow_stiffness(Solid& solid, std::uint32_t index);
  void put_cuts(std::uint32_t solid, const SolidCutState& from);
  const std::optional<SolidBridge>& bridge_at(std::uint32_t solid, const Vec3& p_B, double force_n);
  static void look_ahead(Solid& solid);
  void feel(std::uint32_t solid);
  static void set(std::vector<CutCell>& cells, std::uint64_t& hash, std::vector<CutCell> now);

  const SoftSetup& setup_;
  SolidPresses& presses_;
  std::vector<Solid> solids_;
  std::array<SolidCutHand, kMaxHands> hands_{};
  std::vector<News> news_;
  Cutter rip_;  ///< what a tear takes about each pair of nodes that it parts
  double step_s_ = 0.002;
};

}  // namespace osteon
