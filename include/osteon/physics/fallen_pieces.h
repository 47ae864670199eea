#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "osteon/carve/piece_shape.h"
#include "osteon/physics/pieces_setup.h"
#include "osteon/scene/event.h"
#include "osteon/scene/loose_bone.h"
#include "osteon/scene/state.h"

namespace osteon {

class CarvedField;
class PieceSoftGround;
struct PieceSurroundings;

/// A piece of bone, or of a soft part on it, that was cut off: a rigid body.
struct FallenPiece {
  enum class Is : std::uint8_t { kMoving = 0, kResting = 1, kHeld = 2 };
  std::shared_ptr<const PieceShape> shape;  ///< never null
  Is is = Is::kMoving;
  Pose X_WB;                ///< of its bone's frame, as the piece carries it along
  Vec3 v_W = Vec3::Zero();  ///< of its middle, m/s
  Vec3 w_W = Vec3::Zero();  ///< rad/s
  std::uint8_t hand = kNoHand;
  bool drawn = false;                ///< suction holds it, not jaws
  Pose X_PB;                         ///< in the tool of `hand`, while it is held
  std::uint32_t still = 0;           ///< steps in which it hardly moved
  std::uint32_t soft = kNoSoftPart;  ///< of the case, that it was part of
};

/// All that a step of the pieces leaves to the next: a value.
struct FallenPiecesState {
  std::vector<FallenPiece> pieces;     ///< kMaxLooseBones at most
  std::array<bool, kMaxHands> open{};  ///< by hand: its jaws have been open since they were shut
  std::array<std::uint32_t, kMaxHands> instrument{};
};

/// What became of a piece in a step.
struct PieceNews {
  enum class Is : std::uint8_t { kHeld, kLetGo, kSucked, kOut };
  Is is = Is::kHeld;
  std::uint32_t bone = 0, soft = kNoSoftPart;
  std::uint8_t hand = kNoHand;  ///< kNoHand: none had to do with it
  double volume_m3 = 0;
  Vec3 p_W = Vec3::Zero();  ///< of its middle
};

/// Pieces that lie loose: in a limb soft parts hold them where they are, in air they
/// fall and come to rest on bone; instruments push them, jaws hold them, suction draws them. A
/// function of its state and of what is given to it. No hand feels a piece: one of a cubic
/// centimetre weighs 20 mN. Pieces do not meet each other; soft parts only where they are told of
/// them.
///
/// Each step moves a piece freely and then out of what it stands in, point by point of its surface,
/// with friction; its speed follows from where it has come to (position based dynamics of rigid
/// bodies, Mueller and others 2020).
class FallenPieces {
 public:
  static constexpr double kFriction = 0.3;  ///< of wet bone on bone; own default

  explicit FallenPieces(std::shared_ptr<const PiecesSetup> setup);

  /// `stirred`: bone was cut in this step, so that what rests may rest no more; so it may where a
  /// bone moves.
  /// `carved`: of each bone; null where it is as it was.
  /// `softs`: soft parts that they meet; null: none.
  void step(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
            std::span<const CarvedField* const> carved, bool stirred, double step_s,
            const PieceSoftGround* softs = nullptr);
  /// What rests may rest no more: something under it has changed.
  void stir();
  /// The same of what an instrument comes near: it may have cut the ground away.
  void stir_by(std::span<const ToolState* const> tools, const BoneSnapshot& bones);
  /// False: there is no room for one more.
  bool add(std::shared_ptr<const PieceShape> shape, const Pose& X_WB,
           std::uint32_t soft = kNoSoftPart);
  /// Shut jaws that held at `p_W` what came off there last have it from then on.
  /// Without effect where the piece is farther from that place than 3 mm, or held.
  void take_last(std::uint8_t hand, const ToolState& tool, const Vec3& p_W);

  /// Of the last step.
  std::span<const PieceNews> news() const { return news_; }
  LooseBones shown() const;
  const FallenPiecesState& state() const { return state_; }
  bool empty() const { return state_.pieces.empty(); }
  std::uint64_t hash() const;
  /// Whether it can be a state of a case with so many bones.
  static bool fits(const FallenPiecesState& state, std::size_t bones);
  void restore(const FallenPiecesState& state);
  /// What hands held falls: they are elsewhere.
  void let_all_go();

 private:
  const PieceTool* tool_of(const ToolState& tool) const;
  void heed_jaws(std::uint8_t hand, const ToolState& tool);
  void heed_suction(std::uint8_t hand, const ToolState& tool, const PieceSurroundings& around,
                    double step_s);
  void take(std::uint8_t hand, const ToolState& tool, const SoftGripper& jaws);
  void let_go(std::uint8_t hand, bool drawn);
  void begin_to_fall(FallenPiece& piece);
  void carry(FallenPiece& piece, const ToolState& tool, const PieceSurroundings& around);
  bool is_touched(const FallenPiece& piece, const PieceSurroundings& around) const;
  void move(FallenPiece& piece, const PieceSurroundings& around, double step_s) const;
  void hold(FallenPiece& piece, std::uint8_t hand, const ToolState& tool, bool drawn);
  void tell(PieceNews::Is is, const FallenPiece& piece, std::uint8_t hand);
  void drop_gone();

  std::shared_ptr<const PiecesSetup> setup_;
  FallenPiecesState state_;
  std::vector<PieceNews> news_;
  std::vector<std::uint8_t> gone_;  // of each piece, in this step
};

}  // namespace osteon
