// The state of carving as a value: saved, restored, hashed.
#include "osteon/base/hash.h"
#include "osteon/physics/carving.h"

namespace osteon {

namespace {

void add_to(Hasher& hasher, const CarvingHand& hand) {
  hasher.add(hand.bone);
  hasher.add(hand.X_BC);
  hasher.add(hand.drill.depth_m);
  hasher.add(hand.drill.turned_rev);
  hasher.add(hand.drill.was_cutting);
  for (const double x : {hand.due_m, hand.angle_rad, hand.most_torque_nm, hand.plunge_m})
    hasher.add(x);
  hasher.add(hand.idle);
  hasher.add(hand.since);
  hasher.add(hand.tissue);
  hasher.add(hand.twist_rad);
  for (const bool x : {hand.was_in, hand.skives, hand.jaw_open}) hasher.add(x);
  hasher.add(hand.out);
  hasher.add(hand.p_out);
  if (hand.loose > 0) hasher.add(hand.loose);
  if (hand.chatter.amplitude_m > 0) {
    for (const double x : {hand.chatter.amplitude_m, hand.chatter.frequency_hz}) hasher.add(x);
    hasher.add(hand.chatters_since);
  }
  if (!hand.in_hole && hand.rod == 0 && hand.lag_m == 0 && hand.grip == 0) return;
  for (const bool x : {hand.in_hole, hand.open}) hasher.add(x);
  for (const double x : {hand.lag_m, hand.grip}) hasher.add(x);
  hasher.add(hand.mouth_B);
  hasher.add(hand.rod);
  hasher.add(hand.instrument);
}

void add_to(Hasher& hasher, const LeftHole& hole) {
  hasher.add(hole.bone);
  hasher.add(hole.X_BC);
  hasher.add(hole.mouth_B);
  for (const double x : {hole.diameter_m, hole.lag_m}) hasher.add(x);
  hasher.add(hole.open);
}

void add_to(Hasher& hasher, const GuideRod& rod) {
  hasher.add(static_cast<std::uint8_t>(rod.kind));
  hasher.add(rod.bone);
  hasher.add(rod.X_BR);
  for (const double x : {rod.radius_m, rod.length_m, rod.in_bone_m}) hasher.add(x);
}

}  // namespace

bool operator==(const CarvingHand& a, const CarvingHand& b) {
  Hasher x, y;
  add_to(x, a);
  add_to(y, b);
  return x.value() == y.value();
}

CarvingHand anew(const CarvingHand& hand) {
  CarvingHand out;
  out.rod = hand.rod;
  out.grip = hand.grip;
  out.jaw_open = hand.jaw_open;
  out.instrument = hand.instrument;
  return out;
}

std::uint64_t Carving::hash() {
  Hasher hasher;
  for (Bone& bone : bones_)
    if (bone.field) hasher.add(bone.field->hash());
  for (const CarvingHand& hand : hands_) add_to(hasher, hand);
  hasher.add(steps_);
  hasher.add(full_);
  for (const GuideRod& rod : rods_)
    if (rod.kind != GuideRod::Kind::kNone) add_to(hasher, rod);
  for (const LeftHole& hole : holes_)
    if (hole.bone != CarvingHand::kNoBone) add_to(hasher, hole);
  if (pieces_ && !pieces_->empty()) hasher.add(pieces_->hash());
  return hasher.value();
}

CarvingState Carving::save() const {
  CarvingState state;
  for (const Bone& bone : bones_)
    state.bones.push_back(bone.field ? bone.field->save() : CarveState{});
  state.hands = hands_;
  state.steps = steps_;
  state.full = full_;
  state.rods = rods_;
  state.holes = holes_;
  if (pieces_) state.pieces = pieces_->state();
  return state;
}

bool Carving::fits(const CarvingState& state) const {
  if (state.bones.size() != bones_.size()) return false;
  for (std::size_t b = 0; b < bones_.size(); ++b) {
    if (!bones_[b].field) continue;
    CarvedField copy = *bones_[b].field;
    if (!copy.restore(state.bones[b])) return false;
  }
  const auto is_carved = [&](std::uint32_t b) { return b < bones_.size() && bones_[b].field; };
  for (const CarvingHand& hand : state.hands)
    if (hand.bone != CarvingHand::kNoBone && !is_carved(hand.bone)) return false;
  for (const GuideRod& rod : state.rods)
    if (rod.kind != GuideRod::Kind::kNone && !is_carved(rod.bone)) return false;
  for (const LeftHole& hole : state.holes)
    if (hole.bone != CarvingHand::kNoBone && !is_carved(hole.bone)) return false;
  if (!pieces_) return state.pieces.pieces.empty();
  return FallenPieces::fits(state.pieces, bones_.size());
}

void Carving::restore(const CarvingState& state) {
  for (std::size_t b = 0; b < bones_.size(); ++b)
    if (bones_[b].field) (void)bones_[b].field->restore(state.bones[b]);
  hands_ = state.hands;
  steps_ = state.steps;
  full_ = state.full;
  rods_ = state.rods;
  holes_ = state.holes;
  if (pieces_) pieces_->restore(state.pieces);
  guides_ = {};
  changed_.clear();
  fallen_.clear();
  events_.clear();
}

}  // namespace osteon
