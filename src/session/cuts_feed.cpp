#include "osteon/session/cuts_feed.h"

#include <algorithm>
#include <utility>

#include "osteon/physics/carving.h"

namespace osteon {
namespace {

static_assert(CutsPatch::kNodes == BlockGrid::kNodes);

// Half a picture's worth of changes and more; a bone that comes back takes a few pictures.
constexpr std::size_t kPlaces = 512;
// Physics steps between two sendings: a picture's time.
constexpr std::uint32_t kEvery = 8;

}  // namespace

CutsFeed::CutsFeed(const CarvingSetup& setup, std::optional<FluidJoint> joint)
    : heat_(setup, std::move(joint)), queue_(kPlaces) {
  for (const auto& bone : setup.bones) {
    Bone& of = bones_.emplace_back();
    of.carved = bone != nullptr;
    if (!bone) continue;
    of.waits.assign(bone->grid().count(), 0);
    of.blocks.reserve(setup.most_blocks);
  }
}

// Blocks that wait hold cuts, so that there are no more than the field may hold.
void CutsFeed::add(std::uint32_t bone, std::uint32_t block) {
  Bone& of = bones_[bone];
  if (of.waits[block] != 0) return;
  of.waits[block] = 1;
  of.blocks.push_back(block);
}

void CutsFeed::add_all(const Carving& carving) {
  pieces_.clear();
  for (const FallenPiece& piece : carving.pieces()) pieces_.push_back(piece.shape);
  for (std::uint32_t b = 0; b < bones_.size(); ++b) {
    const CarvedField* field = carving.field(b);
    if (!bones_[b].carved || !field) continue;
    Bone& of = bones_[b];
    for (const std::uint32_t block : of.blocks) of.waits[block] = 0;
    of.blocks.clear();
    of.clear = true;
    for (std::size_t n = 0; n < field->block_count(); ++n) add(b, field->block_at(n));
  }
}

bool CutsFeed::send_bone(const Carving& carving, std::uint32_t bone) {
  Bone& of = bones_[bone];
  patch_.bone = bone;
  patch_.clear = true;
  if (of.clear && !queue_.push(patch_)) return false;
  of.clear = patch_.clear = false;
  const CarvedField& field = *carving.field(bone);
  while (!of.blocks.empty()) {
    patch_.block = of.blocks.back();
    std::copy_n(field.cuts(patch_.block), CutsPatch::kNodes, patch_.cut.begin());
    if (!queue_.push(patch_)) return false;
    of.waits[patch_.block] = 0;
    of.blocks.pop_back();
  }
  return true;
}

bool CutsFeed::send_pieces() {
  CutsPatch patch;
  while (!pieces_.empty()) {
    patch.piece = pieces_.back();
    if (!queue_.push(patch)) return false;
    pieces_.pop_back();
  }
  return true;
}

void CutsFeed::send(const Carving& carving) {
  if (!send_pieces()) return;
  for (std::uint32_t b = 0; b < bones_.size(); ++b)
    if (bones_[b].carved && !send_bone(carving, b)) return;
}

void CutsFeed::note(const Carving& carving, bool all) {
  if (all) add_all(carving);
  if (!all)
    for (const Carving::Changed& changed : carving.changed()) add(changed.bone, changed.block);
  if (!all)
    for (const Carving::Fallen& fallen : carving.fallen())
      if (fallen.lies) pieces_.push_back(fallen.lies);
  if (++notes_ % kEvery == 0) send(carving);
}

// While the queue is full heat gathers in the pulse that waits.
void CutsFeed::note_heat(const Carving& carving, const BoneSnapshot& bones, const Command& command,
                         double step_s) {
  heat_.add(carving, bones, command, step_s);
  CutsPatch patch;
  while (const HeatPulse* const pulse = heat_.due()) {
    patch.heat = *pulse;
    if (!queue_.push(patch)) return;
    heat_.pop();
  }
}

void CutsFeed::note_all(const Carving& carving) {
  add_all(carving);
  send(carving);
}

}  // namespace osteon
