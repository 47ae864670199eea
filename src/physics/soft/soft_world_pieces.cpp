// Pieces of menisci and stumps that were cut off.
#include <algorithm>
#include <array>
#include <span>

#include "osteon/physics/fallen_pieces.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/soft_events.h"
#include "pieces/piece_surroundings.h"
#include "soft/resting_softs.h"
#include "soft/soft_grips.h"
#include "soft/solid_cutting.h"
#include "soft/solid_presses.h"

namespace osteon {
namespace {

constexpr double kMm3_per_m3 = 1e9;

}  // namespace

std::span<const FallenPiece> SoftWorld::lying() const {
  return pieces_ ? std::span<const FallenPiece>(pieces_->state().pieces)
                 : std::span<const FallenPiece>();
}

// Jaws that held the solid where it is no more have the piece. Where no room is left it is gone,
// as crumbs are.
void SoftWorld::lay_down(std::uint32_t solid, std::shared_ptr<const PieceShape> shape,
                         std::span<const SolidHand> hands) {
  if (!pieces_ || !shape || pieces_->state().pieces.size() >= kMaxLooseSofts) return;
  if (!pieces_->add(std::move(shape), solids_->X_WB(solid), setup_->solids[solid].soft)) return;
  const std::span<const BandSpan> spans(spans_.data(), setup_->bands.size());
  for (std::size_t h = 0; h < hands.size() && grips_; ++h) {
    const SoftHold& hold = state_.grips[h].hold;
    if (!hands[h].tool || hold.of != SoftHold::Of::kSolid || hold.part != solid) continue;
    if (!grips_->is_cut_away(hold, {spans, solids_.get()})) continue;
    pieces_->take_last(static_cast<std::uint8_t>(h), *hands[h].tool,
                       solids_->X_WB(solid) * hold.p_B);
  }
}

// Before the cuts of the step: what comes off in it moves in the next.
void SoftWorld::step_pieces(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                            std::span<const CarvedField* const> carved) {
  if (!setup_->pieces_meet_softs) return pieces_->step(tools, bones, carved, false, step_s_);
  resting_->place(bones);
  const RestingSofts& softs = *resting_;
  pieces_->step(tools, bones, carved, false, step_s_, &softs);
}

// Where something was cut or has torn in this step, what lay on it falls from the next on.
void SoftWorld::stir_pieces(std::span<const ToolState* const> tools, const BoneSnapshot& bones) {
  if (!setup_->pieces_meet_softs) return;
  if (ground_parts()) return pieces_->stir();
  if (ground_is_cut()) pieces_->stir_by(tools, bones);
}

const PieceSoftGround* SoftWorld::ground(const BoneSnapshot& bones) const {
  if (!setup_->pieces_are_stopped) return nullptr;
  resting_->place(bones);
  return resting_.get();
}

bool SoftWorld::ground_parts() const {
  return std::any_of(events_.begin(), events_.end(), [](const Event& event) {
    return event.kind == kSoftTorn || event.kind == kSoftCut || event.kind == kSoftPiece;
  });
}

bool SoftWorld::ground_is_cut() const { return cutting_ && cutting_->cuts_now(); }

void SoftWorld::tell_pieces() {
  using Is = PieceNews::Is;
  for (const PieceNews& news : pieces_->news()) {
    Event event;
    event.hand = news.hand;
    event.kind = news.is == Is::kHeld     ? kSoftPieceHeld
                 : news.is == Is::kLetGo  ? kSoftPieceLetGo
                 : news.is == Is::kSucked ? kSoftPieceSucked
                                          : kSoftPieceOut;
    event.subject = news.soft;
    event.values = {kMm3_per_m3 * news.volume_m3, 0, 0};
    tell(event, news.p_W);
  }
}

// A state from before pieces lay loose has none.
void SoftWorld::restore_pieces(const SoftState& state, bool let_go) {
  state_.pieces = nullptr;
  if (!pieces_) return;
  pieces_->restore(state.pieces ? *state.pieces : FallenPiecesState{});
  if (let_go) pieces_->let_all_go();
}

bool SoftWorld::fits_pieces(const FallenPiecesState& state) const {
  const auto is_ours = [&](const FallenPiece& piece) {
    return std::any_of(setup_->solids.begin(), setup_->solids.end(), [&](const SoftSolid& solid) {
      return solid.soft == piece.soft && solid.bone.index == piece.shape->grid().bone;
    });
  };
  return pieces_ && state.pieces.size() <= kMaxLooseSofts &&
         FallenPieces::fits(state, setup_->pieces->bones.size()) &&
         std::all_of(state.pieces.begin(), state.pieces.end(), is_ours);
}

}  // namespace osteon
