// Pieces of menisci and stumps that were cut off.
#include <algorithm>
#include <array>
#include <span>

#include "osteon/physics/fallen_pieces.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/soft_events.h"
#include "pieces/piece_surroundings.h"
#include "soft/soft_grips.h"
#include "soft/solid_cutting.h"
#include "soft/solid_presses.h"

namespace osteon {
namespace {

constexpr double kMm3_per_m3 = 1e9;

/// Soft parts as they are at rest, less what was cut out of them: what hands bend or press in a
/// step counts for little under what weighs next to nothing.
class RestingSofts : public PieceSoftGround {
 public:
  RestingSofts(const SoftSetup& setup, const SoftState& state, std::span<const BandSpan> spans,
               const SolidPresses* solids)
      : setup_(setup), state_(state), spans_(spans), solids_(solids) {
    for (std::size_t s = 0; solids_ && s < setup_.solids.size(); ++s)
      X_BW_[s] = solids_->X_WB(s).inverse();
  }

  bool may_meet(const Vec3& center_W, double radius_m) const override {
    for (std::size_t s = 0; solids_ && s < setup_.solids.size(); ++s)
      if (is_there(s) && is_in(solids_->view(s).box().grown(radius_m), X_BW_[s] * center_W))
        return true;
    for (std::size_t b = 0; b < spans_.size(); ++b)
      if (is_whole(b) && off_band(b, center_W).norm() <= setup_.bands[b].radius_m + radius_m)
        return true;
    return false;
  }
  PiecePush at(const Vec3& p_W) const override {
    PiecePush out;
    for (std::size_t s = 0; solids_ && s < setup_.solids.size(); ++s) in_solid(s, p_W, out);
    for (std::size_t b = 0; b < spans_.size(); ++b) in_band(b, p_W, out);
    return out;
  }

 private:
  static bool is_in(const Aabb& box, const Vec3& p) {
    return (p - box.lo).minCoeff() >= 0 && (box.hi - p).minCoeff() >= 0;
  }
  bool is_there(std::size_t s) const {
    return !state_.solid_lost[s] && is_finite(solids_->X_WB(s));
  }
  bool is_whole(std::size_t b) const {
    return setup_.bands[b].left > 0 && !state_.bands[b].torn && !state_.bands[b].lost;
  }

  void in_solid(std::size_t s, const Vec3& p_W, PiecePush& out) const {
    if (!is_there(s)) return;
    const FieldView field = solids_->view(s);
    const Vec3 p_B = X_BW_[s] * p_W;
    if (!is_in(field.box(), p_B)) return;
    const FieldSample at = field.at(p_B);
    const double slope = at.gradient.norm();
    if (!(-at.distance > out.depth_m) || !(slope > 0)) return;
    out = {-at.distance, solids_->X_WB(s).rotate(at.gradient / slope)};
  }

  // From the string's middle line, straight from bone to bone.
  Vec3 off_band(std::size_t b, const Vec3& p_W) const {
    const Vec3 way = spans_[b].b_W - spans_[b].a_W;
    const double share = std::clamp((p_W - spans_[b].a_W).dot(way) / way.squaredNorm(), 0.0, 1.0);
    return p_W - (spans_[b].a_W + share * way);
  }

  void in_band(std::size_t b, const Vec3& p_W, PiecePush& out) const {
    if (!is_whole(b)) return;
    const double radius_m = setup_.bands[b].radius_m;
    const Vec3 off = off_band(b, p_W);
    const double away = off.norm();
    if (radius_m - away > out.depth_m && away > 1e-9) out = {radius_m - away, off / away};
  }

  const SoftSetup& setup_;
  const SoftState& state_;
  std::span<const BandSpan> spans_;
  const SolidPresses* solids_;
  std::array<Pose, kMaxSolids> X_BW_;
};

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
  const RestingSofts softs(*setup_, state_, {spans_.data(), setup_->bands.size()}, solids_.get());
  pieces_->step(tools, bones, carved, false, step_s_, &softs);
}

// Where something was cut or has torn in this step, what lay on it falls from the next on.
void SoftWorld::stir_pieces(std::span<const ToolState* const> tools, const BoneSnapshot& bones) {
  if (!setup_->pieces_meet_softs) return;
  const auto parts = [](const Event& event) {
    return event.kind == kSoftTorn || event.kind == kSoftCut || event.kind == kSoftPiece;
  };
  if (std::any_of(events_.begin(), events_.end(), parts)) return pieces_->stir();
  if (cutting_ && cutting_->cuts_now()) pieces_->stir_by(tools, bones);
}

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
