#include "osteon/physics/fallen_pieces.h"

#include <algorithm>
#include <cmath>

#include "osteon/base/hash.h"
#include "pieces/piece_motion.h"
#include "pieces/piece_surroundings.h"

namespace osteon {
namespace {

constexpr double kOpenForPiece = 0.5, kShutOnPiece = 0.15;  // of their way
constexpr double kPieceSlips_m = 0.002;    // what is held slips out where it stands so deep in bone
constexpr double kPieceInSoft_m = 0.003;   // and where a soft part is to yield by so much
constexpr double kPieceInThin = 0.8;       // of half a part's thickness: it is as good as through
constexpr double kPieceInside_m = 3e-4;    // so deep a point counts as inside of a soft part
constexpr double kPieceTaken_m = 0.001;    // and suction takes none that stands deeper than that
constexpr double kHeldNear_m = 0.003;      // what jaws held, they have
constexpr double kSuctionReach_m = 0.006;  // before a bore: how far it draws
constexpr double kPull_m_per_s2 = 60;      // at the bore, with full power
constexpr double kLeastSuction = 0.05;
constexpr double kFarOut_m = 0.05;      // beyond all bones: nobody looks for it there
constexpr double kCutBeside_m = 0.005;  // a cut takes ground no farther from its instrument
constexpr std::uint32_t kNoInstrument = 0xffffffffu;

bool is_sound(const FallenPiece& piece, std::size_t bones) {
  const bool held = piece.is == FallenPiece::Is::kHeld;
  return piece.shape && piece.shape->grid().bone < bones && piece.is <= FallenPiece::Is::kHeld &&
         is_finite(piece.X_WB) && is_finite(piece.v_W) && is_finite(piece.w_W) &&
         is_finite(piece.X_PB) && held == (piece.hand < kMaxHands);
}

bool any_moves(const BoneSnapshot& bones) {
  const auto moves = [](const BoneMotion& bone) {
    return !bone.v_W.isZero(0) || !bone.w_W.isZero(0);
  };
  return std::any_of(bones.bones.begin(), bones.bones.begin() + bones.count, moves);
}

/// How deep the deepest of a piece's points stands in bone and in soft parts; these by half of
/// their thickness, too; and how many stand in them.
struct StandsIn {
  double bone_m = 0, soft_m = 0, of_half = 0;
  std::size_t inside = 0;
};

StandsIn stands_in(const FallenPiece& piece, const PieceSurroundings& around) {
  const PieceNeighbours near(around, piece.X_WB * piece.shape->middle_B(), piece.shape->reach_m());
  const bool softs = around.softs && around.softs->stops_carried();
  StandsIn out;
  for (const Vec3& p_B : piece.shape->points_B()) {
    out.bone_m = std::max(out.bone_m, near.in_bone(piece.X_WB * p_B).depth_m);
    if (!softs) continue;
    const PiecePush soft = near.in_soft(piece.X_WB * p_B);
    out.soft_m = std::max(out.soft_m, soft.depth_m);
    out.of_half = std::max(out.of_half, soft.of_half);
    if (soft.depth_m > kPieceInside_m) ++out.inside;
  }
  return out;
}

// What is thin is left behind before anything stands deep in it: a piece that lies about its
// middle, or whose greater half lies in it, does not go through.
bool is_through_thin(const StandsIn& in, const FallenPiece& piece,
                     const PieceSurroundings& around) {
  if (!around.softs || !around.softs->thin_ones_stop()) return false;
  return in.of_half > kPieceInThin || 2 * in.inside > piece.shape->points_B().size();
}

}  // namespace

FallenPieces::FallenPieces(std::shared_ptr<const PiecesSetup> setup) : setup_(std::move(setup)) {
  state_.instrument.fill(kNoInstrument);
}

bool FallenPieces::add(std::shared_ptr<const PieceShape> shape, const Pose& X_WB,
                       std::uint32_t soft) {
  if (!shape || state_.pieces.size() == kMaxLooseBones || !is_finite(X_WB)) return false;
  FallenPiece piece;
  piece.shape = std::move(shape);
  piece.X_WB = X_WB;
  piece.soft = soft;
  state_.pieces.push_back(std::move(piece));
  gone_.resize(state_.pieces.size(), 0);
  return true;
}

void FallenPieces::tell(PieceNews::Is is, const FallenPiece& piece, std::uint8_t hand) {
  news_.push_back({is, piece.shape->grid().bone, piece.soft, hand, piece.shape->volume_m3(),
                   piece.X_WB * piece.shape->middle_B()});
}

const PieceTool* FallenPieces::tool_of(const ToolState& tool) const {
  return tool.instrument < setup_->tray.size() ? &setup_->tray[tool.instrument] : nullptr;
}

void FallenPieces::begin_to_fall(FallenPiece& piece) {
  piece.is = FallenPiece::Is::kMoving;
  piece.v_W = piece.w_W = Vec3::Zero();
  piece.hand = kNoHand;
  piece.drawn = false;
  piece.still = 0;
}

void FallenPieces::let_go(std::uint8_t hand, bool drawn) {
  for (FallenPiece& piece : state_.pieces) {
    if (piece.is != FallenPiece::Is::kHeld || piece.hand != hand || piece.drawn != drawn) continue;
    tell(PieceNews::Is::kLetGo, piece, hand);
    begin_to_fall(piece);
  }
}

void FallenPieces::let_all_go() {
  for (FallenPiece& piece : state_.pieces)
    if (piece.is == FallenPiece::Is::kHeld) begin_to_fall(piece);
  state_.open.fill(false);
  state_.instrument.fill(kNoInstrument);
}

void FallenPieces::stir() {
  for (FallenPiece& piece : state_.pieces)
    if (piece.is == FallenPiece::Is::kResting) begin_to_fall(piece);
}

void FallenPieces::stir_by(std::span<const ToolState* const> tools, const BoneSnapshot& bones) {
  const std::size_t hands = std::min<std::size_t>(tools.size(), kMaxHands);
  const PieceSurroundings around{*setup_, tools.first(hands), bones, {}};
  for (FallenPiece& piece : state_.pieces) {
    if (piece.is != FallenPiece::Is::kResting) continue;
    const Vec3 middle_W = piece.X_WB * piece.shape->middle_B();
    if (around.tool_near(middle_W, piece.shape->reach_m() + kCutBeside_m)) begin_to_fall(piece);
  }
}

// The piece with most of its points in the mouth that the jaws sweep when they shut.
void FallenPieces::take(std::uint8_t hand, const ToolState& tool, const SoftGripper& jaws) {
  FallenPiece* best = nullptr;
  std::ptrdiff_t most = 0;
  const Pose X_TW = tool.X_WP.inverse();
  for (std::size_t i = 0; i < state_.pieces.size(); ++i) {
    FallenPiece& piece = state_.pieces[i];
    if (piece.is == FallenPiece::Is::kHeld || gone_[i] != 0) continue;
    const Pose X_TB = X_TW * piece.X_WB;
    const auto& points = piece.shape->points_B();
    const auto inside = std::count_if(points.begin(), points.end(), [&](const Vec3& p_B) {
      const Vec3 p_T = X_TB * p_B;
      return std::all_of(jaws.mouth_T.begin(), jaws.mouth_T.end(),
                         [&](const Plane& plane) { return plane.signed_distance(p_T) <= 0; });
    });
    if (inside <= most) continue;
    most = inside;
    best = &piece;
  }
  if (!best) return;
  hold(*best, hand, tool, false);
}

void FallenPieces::hold(FallenPiece& piece, std::uint8_t hand, const ToolState& tool, bool drawn) {
  piece.is = FallenPiece::Is::kHeld;
  piece.hand = hand;
  piece.drawn = drawn;
  piece.X_PB = tool.X_WP.inverse() * piece.X_WB;
  piece.v_W = piece.w_W = Vec3::Zero();
  tell(PieceNews::Is::kHeld, piece, hand);
}

void FallenPieces::take_last(std::uint8_t hand, const ToolState& tool, const Vec3& p_W) {
  if (state_.pieces.empty() || hand >= kMaxHands || !is_finite(tool.X_WP)) return;
  FallenPiece& piece = state_.pieces.back();
  if (piece.is == FallenPiece::Is::kHeld || nearest_point_m(piece, p_W) > kHeldNear_m) return;
  state_.instrument[hand] = tool.instrument;
  state_.open[hand] = false;
  hold(piece, hand, tool, false);
}

// Jaws must have been open before they can shut; who takes another instrument lets go.
void FallenPieces::heed_jaws(std::uint8_t hand, const ToolState& tool) {
  const bool same = state_.instrument[hand] == tool.instrument;
  state_.instrument[hand] = tool.instrument;
  const PieceTool* const with = tool_of(tool);
  if (!same || !with || !with->jaws) {
    let_go(hand, false);
    state_.open[hand] = false;
    return;
  }
  if (tool.jaw > kOpenForPiece) {
    let_go(hand, false);
    state_.open[hand] = true;
  }
  if (tool.jaw < kShutOnPiece && state_.open[hand]) {
    state_.open[hand] = false;
    take(hand, tool, *with->jaws);
  }
}

// A small piece goes through the bore, a larger one sticks to it.
void FallenPieces::heed_suction(std::uint8_t hand, const ToolState& tool,
                                const PieceSurroundings& around, double step_s) {
  const PieceTool* const with = tool_of(tool);
  if (!with || !(with->bore_m > 0) || !(tool.power > kLeastSuction)) return let_go(hand, true);
  const Vec3 bore_W = tool.X_WP * with->bore_T;
  for (std::size_t i = 0; i < state_.pieces.size(); ++i) {
    FallenPiece& piece = state_.pieces[i];
    if (piece.is == FallenPiece::Is::kHeld || gone_[i] != 0) continue;
    const Vec3 middle_W = piece.X_WB * piece.shape->middle_B();
    const Vec3 to_bore = bore_W - middle_W;
    const double gap = to_bore.norm() - piece.shape->reach_m();
    if (gap > kSuctionReach_m) continue;
    const bool fits = 2 * piece.shape->reach_m() <= with->bore_m;
    if (fits && gap < 0.5 * with->bore_m) {
      tell(PieceNews::Is::kSucked, piece, hand);
      gone_[i] = 1;
    } else if (!fits && nearest_point_m(piece, bore_W) < 0.5 * with->bore_m) {
      // What would soon slip off lies where bone or a soft part has it.
      const StandsIn in = stands_in(piece, around);
      const bool slips =
          around.softs && around.softs->suction_heeds_thin() && is_through_thin(in, piece, around);
      if (in.bone_m <= kPieceTaken_m && in.soft_m <= kPieceTaken_m && !slips)
        hold(piece, hand, tool, true);
    } else if (to_bore.norm() > 1e-9) {
      const double share = 1 - std::max(gap, 0.0) / kSuctionReach_m;
      piece.v_W += step_s * kPull_m_per_s2 * tool.power * share * to_bore.normalized();
      if (piece.is == FallenPiece::Is::kResting) piece.is = FallenPiece::Is::kMoving;
      piece.still = 0;
    }
  }
}

void FallenPieces::carry(FallenPiece& piece, const ToolState& tool,
                         const PieceSurroundings& around) {
  piece.X_WB = tool.X_WP * piece.X_PB;
  const StandsIn in = stands_in(piece, around);
  if (!(in.bone_m > kPieceSlips_m) && !(in.soft_m > kPieceInSoft_m) &&
      !is_through_thin(in, piece, around))
    return;
  tell(PieceNews::Is::kLetGo, piece, piece.hand);
  begin_to_fall(piece);
}

bool FallenPieces::is_touched(const FallenPiece& piece, const PieceSurroundings& around) const {
  const Vec3 middle_W = piece.X_WB * piece.shape->middle_B();
  if (!around.tool_near(middle_W, piece.shape->reach_m())) return false;
  const auto& points = piece.shape->points_B();
  return std::any_of(points.begin(), points.end(),
                     [&](const Vec3& p_B) { return around.in_tool(piece.X_WB * p_B).depth_m > 0; });
}

void FallenPieces::move(FallenPiece& piece, const PieceSurroundings& around, double step_s) const {
  const PieceStep did = move_piece(piece, around, step_s);
  piece.still = did.touches && did.slow ? piece.still + 1 : 0;
  if (piece.still < kRestAfterSteps) return;
  piece.is = FallenPiece::Is::kResting;
  piece.v_W = piece.w_W = Vec3::Zero();
}

void FallenPieces::drop_gone() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < state_.pieces.size(); ++i) {
    if (gone_[i] != 0) continue;
    if (kept != i) state_.pieces[kept] = std::move(state_.pieces[i]);
    ++kept;
  }
  state_.pieces.resize(kept);
}

void FallenPieces::step(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                        std::span<const CarvedField* const> carved, bool stirred, double step_s,
                        const PieceSoftGround* softs) {
  news_.clear();
  const std::size_t hands = std::min<std::size_t>(tools.size(), kMaxHands);
  gone_.assign(state_.pieces.size(), 0);
  const PieceSurroundings around{*setup_, tools.first(hands), bones, carved, softs};
  for (std::size_t h = 0; h < hands; ++h) {
    if (tools[h]->epoch != bones.epoch || !is_finite(tools[h]->X_WP)) continue;
    heed_jaws(static_cast<std::uint8_t>(h), *tools[h]);
    heed_suction(static_cast<std::uint8_t>(h), *tools[h], around, step_s);
  }
  if (state_.pieces.empty()) return;
  stirred = stirred || any_moves(bones);
  const Aabb seen = setup_->box_W.grown(kFarOut_m);
  for (std::size_t i = 0; i < state_.pieces.size(); ++i) {
    FallenPiece& piece = state_.pieces[i];
    if (gone_[i] != 0) continue;
    if (piece.is == FallenPiece::Is::kHeld) {
      const bool there = piece.hand < hands && is_finite(tools[piece.hand]->X_WP);
      if (there) carry(piece, *tools[piece.hand], around);
      continue;
    }
    if (piece.is == FallenPiece::Is::kResting) {
      if (!stirred && !is_touched(piece, around)) continue;
      begin_to_fall(piece);
    }
    move(piece, around, step_s);
    const Vec3 middle_W = piece.X_WB * piece.shape->middle_B();
    if (((middle_W - seen.lo).array() >= 0).all() && ((seen.hi - middle_W).array() >= 0).all())
      continue;
    tell(PieceNews::Is::kOut, piece, kNoHand);
    gone_[i] = 1;
  }
  drop_gone();
}

LooseBones FallenPieces::shown() const {
  LooseBones out;
  for (const FallenPiece& piece : state_.pieces)
    out.bones[out.count++] = {piece.shape->hash(), piece.shape->grid().bone, piece.X_WB,
                              piece.soft};
  return out;
}

std::uint64_t FallenPieces::hash() const {
  Hasher hasher;
  for (const FallenPiece& piece : state_.pieces) {
    hasher.add(piece.shape->hash());
    hasher.add(static_cast<std::uint8_t>(piece.is));
    hasher.add(piece.X_WB);
    hasher.add(piece.v_W);
    hasher.add(piece.w_W);
    hasher.add(piece.hand);
    hasher.add(piece.drawn);
    hasher.add(piece.X_PB);
    hasher.add(piece.still);
    if (piece.soft != kNoSoftPart) hasher.add(piece.soft);
  }
  return hasher.value();
}

bool FallenPieces::fits(const FallenPiecesState& state, std::size_t bones) {
  return state.pieces.size() <= kMaxLooseBones &&
         std::all_of(state.pieces.begin(), state.pieces.end(),
                     [&](const FallenPiece& piece) { return is_sound(piece, bones); });
}

void FallenPieces::restore(const FallenPiecesState& state) {
  state_ = state;
  news_.clear();
}

}  // namespace osteon
