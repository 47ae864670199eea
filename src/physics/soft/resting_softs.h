#pragma once

#include <array>

#include "osteon/physics/soft_setup.h"
#include "osteon/physics/soft_state.h"
#include "osteon/scene/state.h"
#include "pieces/piece_surroundings.h"

namespace osteon {

class SolidPresses;

/// Soft parts as they are at rest, less what was cut out of them: what hands bend or press in a
/// step counts for little under what weighs next to nothing.
class RestingSofts : public PieceSoftGround {
 public:
  /// All must outlive it. `solids`: null: there are none.
  RestingSofts(const SoftSetup& setup, const SoftState& state, const SolidPresses* solids)
      : setup_(setup), state_(state), solids_(solids) {}

  /// To where the bones are; before anything is asked.
  void place(const BoneSnapshot& bones);
  bool may_meet(const Vec3& center_W, double radius_m) const override;
  PiecePush at(const Vec3& p_W) const override;
  bool stops_carried() const override { return setup_.pieces_are_stopped; }
  bool thin_ones_stop() const override { return setup_.thin_ones_stop; }
  bool suction_heeds_thin() const override { return setup_.suction_heeds_thin; }

 private:
  bool is_there(std::size_t solid) const;
  bool is_whole(std::size_t band) const;
  void in_solid(std::size_t solid, const Vec3& p_W, PiecePush& out) const;
  Vec3 off_band(std::size_t band, const Vec3& p_W) const;
  void in_band(std::size_t band, const Vec3& p_W, PiecePush& out) const;

  const SoftSetup& setup_;
  const SoftState& state_;
  const SolidPresses* solids_;
  std::array<BandSpan, kMaxBands> spans_;
  std::array<Pose, kMaxSolids> X_WB_, X_BW_;
};

}  // namespace osteon
