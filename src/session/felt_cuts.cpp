#include "felt_cuts.h"

#include <algorithm>

namespace osteon {
namespace {

CutGrid grid_of(const BlockGrid& grid) { return {grid.cell_m, grid.lo, grid.blocks}; }

void fill(CarvePatch& patch, const CarvedField& field, std::uint32_t block) {
  patch.kind = CarvePatch::Kind::kBlock;
  patch.block = block;
  std::copy_n(field.cuts(block), CutField::kNodes, patch.cut.begin());
}

bool push_to_all(const CarvePatch& patch, std::vector<FeltCuts*>& hands) {
  bool all = true;
  for (FeltCuts* hand : hands) all = hand->channel().push(patch) && all;
  return all;
}

bool push_whole(const Carving& carving, CarvePatch& patch, std::vector<FeltCuts*>& hands) {
  bool done = true;
  for (std::uint32_t b = 0; b < carving.setup().bones.size(); ++b) {
    const CarvedField* field = carving.field(b);
    if (!field) continue;
    patch.bone = b;
    patch.kind = CarvePatch::Kind::kClear;
    done = push_to_all(patch, hands) && done;
    for (std::size_t n = 0; n < field->block_count(); ++n) {
      fill(patch, *field, field->block_at(n));
      done = push_to_all(patch, hands) && done;
    }
  }
  return done;
}

}  // namespace

FeltCuts::FeltCuts(const CarvingSetup& setup) {
  for (const auto& bone : setup.bones) {
    bones_.emplace_back();
    if (bone)
      bones_.back() = std::make_unique<CutField>(grid_of(bone->grid()), setup.most_blocks,
                                                 CarvingSetup::kSlack_m);
  }
}

std::vector<const CutField*> FeltCuts::by_bone() const {
  std::vector<const CutField*> out;
  for (const auto& bone : bones_) out.push_back(bone.get());
  return out;
}

void FeltCuts::apply(const CarvePatch& patch, std::uint64_t tick, EventList& events) {
  if (patch.kind == CarvePatch::Kind::kEvent) {
    Event event = patch.event;
    event.tick = tick;
    events.add(event);
  } else if (patch.kind == CarvePatch::Kind::kClear) {
    bones_[patch.bone]->clear();
  } else {
    (void)bones_[patch.bone]->set(patch.block, patch.cut);
  }
}

void FeltCuts::take_until(std::uint64_t step, std::uint64_t tick, EventList& events) {
  while (waiting_ || channel_.pop(next_)) {
    waiting_ = next_.step > step;
    if (waiting_) return;
    apply(next_, tick, events);
  }
}

void FeltCuts::copy(const Carving& carving) {
  while (channel_.pop(next_)) {
  }
  waiting_ = false;
  CarvePatch patch;
  for (std::uint32_t b = 0; b < bones_.size(); ++b) {
    const CarvedField* field = carving.field(b);
    if (!field || !bones_[b]) continue;
    bones_[b]->clear();
    for (std::size_t n = 0; n < field->block_count(); ++n) {
      fill(patch, *field, field->block_at(n));
      (void)bones_[b]->set(patch.block, patch.cut);
    }
  }
}

bool publish(const Carving& carving, std::uint64_t step, bool all, std::vector<FeltCuts*>& hands) {
  CarvePatch patch;
  patch.step = step;
  bool done = !all || push_whole(carving, patch, hands);
  if (!all)
    for (const Carving::Changed& changed : carving.changed()) {
      patch.bone = changed.bone;
      fill(patch, *carving.field(changed.bone), changed.block);
      done = push_to_all(patch, hands) && done;
    }
  patch.kind = CarvePatch::Kind::kEvent;
  for (const Event& event : carving.events()) {
    if (event.hand >= hands.size()) continue;
    patch.event = event;
    done = hands[event.hand]->channel().push(patch) && done;
  }
  return done;
}

}  // namespace osteon
