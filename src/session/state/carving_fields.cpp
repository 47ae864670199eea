#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "state/fields.h"

namespace osteon::stored {
namespace {

constexpr std::uint64_t kMostCarvedBones = kMaxBones, kMostCarvedBlocks = 1u << 20;

// The versions that say how far the hand has turned what it carves with, what leads instruments,
// which holes were left, and how a reamer chatters.
constexpr std::uint64_t kTwist = 4, kGuides = 6, kHoles = 9, kChatter = 16;

// The versions that say what lies loose, and of which soft part.
constexpr std::uint64_t kLoose = 28, kLooseOfSofts = 33;

}  // namespace

// Most words of a block are alike: each stands with how often it comes.
template <class A>
void field(A& a, CarveState::Block& b) {
  field(a, b.block);
  constexpr std::size_t kWords = BlockGrid::kNodes / 4;
  std::array<std::uint64_t, kWords> words{};
  if constexpr (!A::kReads) std::memcpy(words.data(), b.cut.data(), sizeof words);
  for (std::size_t n = 0; n < kWords && a.ok;) {
    std::uint64_t count = 1;
    if constexpr (!A::kReads)
      while (n + count < kWords && words[n + count] == words[n]) ++count;
    number(a, count, kWords - n);
    if (count == 0) a.ok = false;
    field(a, words[n]);
    for (std::size_t i = 1; i < count; ++i) words[n + i] = words[n];
    n += count;
  }
  if constexpr (A::kReads) std::memcpy(b.cut.data(), words.data(), sizeof words);
}

template <class A>
void field(A& a, CarveState& s) {
  field(a, s.bone);
  field(a, s.step);
  std::uint64_t blocks = s.blocks.size();
  number(a, blocks, kMostCarvedBlocks);
  for (std::uint64_t n = 0; n < blocks && a.ok; ++n) {
    if constexpr (A::kReads) s.blocks.emplace_back();
    field(a, s.blocks[n]);
  }
}

template <class A>
void field(A& a, CarvingHand& h) {
  field(a, h.bone);
  field(a, h.X_BC);
  field(a, h.drill.depth_m);
  field(a, h.drill.turned_rev);
  field(a, h.drill.was_cutting);
  for (double* x : {&h.due_m, &h.angle_rad, &h.most_torque_nm, &h.plunge_m}) field(a, *x);
  field(a, h.idle);
  field(a, h.since);
  field(a, h.tissue);
  if (since(a, kTwist)) field(a, h.twist_rad);
  for (bool* x : {&h.was_in, &h.skives, &h.jaw_open}) field(a, *x);
  field(a, h.out);
  field(a, h.p_out);
  if (!since(a, kGuides)) {
    h.instrument = CarvingHand::kAnyInstrument;  // that which the hand holds
    return;
  }
  for (double* x : {&h.lag_m, &h.grip}) field(a, *x);
  field(a, h.mouth_B);
  for (bool* x : {&h.in_hole, &h.open}) field(a, *x);
  number(a, h.rod, kMaxGuideRods);
  field(a, h.instrument);
  if (since(a, kHoles)) field(a, h.loose);
  if (!since(a, kChatter)) return;
  for (double* x : {&h.chatter.amplitude_m, &h.chatter.frequency_hz}) field(a, *x);
  field(a, h.chatters_since);
}

template <class A>
void field(A& a, LeftHole& hole) {
  field(a, hole.bone);
  field(a, hole.X_BC);
  field(a, hole.mouth_B);
  for (double* x : {&hole.diameter_m, &hole.lag_m}) field(a, *x);
  field(a, hole.open);
}

// Four heights make a word, and each word stands with how often it comes.
template <class A>
void heights_field(A& a, std::vector<std::int16_t>& heights) {
  std::uint64_t count = heights.size();
  number(a, count, PieceShape::kMostNodes);
  if constexpr (A::kReads) heights.assign(a.ok ? count : 0, 0);
  const auto word_at = [&](std::size_t n) {
    std::uint64_t word = 0;
    std::memcpy(&word, &heights[n], std::min<std::size_t>(4, heights.size() - n) * 2);
    return word;
  };
  for (std::size_t n = 0; n < heights.size() && a.ok;) {
    std::uint64_t times = 1, word = 0;
    if constexpr (!A::kReads) {
      word = word_at(n);
      while (n + 4 * times < heights.size() && word_at(n + 4 * times) == word) ++times;
    }
    number(a, times, PieceShape::kMostNodes);
    field(a, word);
    if (times == 0) a.ok = false;
    for (; times > 0 && n < heights.size(); --times, n += 4)
      if constexpr (A::kReads)
        std::memcpy(&heights[n], &word, std::min<std::size_t>(4, heights.size() - n) * 2);
  }
}

template <class A>
void field(A& a, std::shared_ptr<const PieceShape>& shape) {
  PieceGrid grid;
  if constexpr (!A::kReads) grid = shape->grid();
  field(a, grid.bone);
  field(a, grid.cell_m);
  field(a, grid.lo_B);
  for (int& n : grid.nodes) number(a, n, PieceShape::kMostNodes);
  heights_field(a, grid.heights);
  if constexpr (A::kReads) {
    if (a.ok) shape = PieceShape::from(std::move(grid));
    a.ok = a.ok && shape;
  }
}

template <class A>
void field(A& a, FallenPiece& piece) {
  field(a, piece.shape);
  auto is = static_cast<std::uint8_t>(piece.is);
  number(a, is, static_cast<std::uint64_t>(FallenPiece::Is::kHeld));
  piece.is = static_cast<FallenPiece::Is>(is);
  for (Pose* X : {&piece.X_WB, &piece.X_PB}) field(a, *X);
  for (Vec3* v : {&piece.v_W, &piece.w_W}) field(a, *v);
  field(a, piece.hand);
  field(a, piece.drawn);
  field(a, piece.still);
  if (since(a, kLooseOfSofts)) field(a, piece.soft);
}

template <class A>
void field(A& a, FallenPiecesState& s) {
  std::uint64_t count = s.pieces.size();
  number(a, count, kMaxLooseBones);
  if constexpr (A::kReads) s.pieces.resize(a.ok ? count : 0);
  for (FallenPiece& piece : s.pieces)
    if (a.ok) field(a, piece);
  for (bool& open : s.open) field(a, open);
  for (std::uint32_t& instrument : s.instrument) field(a, instrument);
}

template <class A>
void field(A& a, std::shared_ptr<const CarvingState>& carved) {
  if (!since(a, 2)) return;  // bones could not be carved then
  bool there = carved != nullptr;
  field(a, there);
  if (!there) return;
  CarvingState state = carved ? *carved : CarvingState{};
  std::uint64_t bones = state.bones.size();
  number(a, bones, kMostCarvedBones);
  if constexpr (A::kReads) state.bones.resize(bones);
  for (CarveState& bone : state.bones) field(a, bone);
  for (CarvingHand& hand : state.hands) field(a, hand);
  field(a, state.steps);
  field(a, state.full);
  if (since(a, kGuides))
    for (GuideRod& rod : state.rods) field(a, rod);
  if (since(a, kHoles))
    for (LeftHole& hole : state.holes) field(a, hole);
  if (since(a, kLoose)) field(a, state.pieces);
  if constexpr (A::kReads) carved = std::make_shared<const CarvingState>(std::move(state));
}

template void field(Out&, CarveState&);
template void field(In&, CarveState&);
template void field(Out&, FallenPiecesState&);
template void field(In&, FallenPiecesState&);
template void field(Out&, std::shared_ptr<const CarvingState>&);
template void field(In&, std::shared_ptr<const CarvingState>&);

}  // namespace osteon::stored
