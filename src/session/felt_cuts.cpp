#include "felt_cuts.h"

#include <algorithm>

namespace osteon {
namespace {

CutGrid grid_of(const BlockGrid& grid) { return {grid.cell_m, grid.lo, grid.blocks}; }

constexpr std::size_t kOfSomeSteps = 128;  // of a wide drill two, of most instruments more

void fill(CarvePatch& patch, const CarvedField& field, std::uint32_t block) {
  patch.kind = CarvePatch::Kind::kBlock;
  patch.block = block;
  std::copy_n(field.cuts(block), CutField::kNodes, patch.cut.begin());
}

void tell_all(const CarvePatch& patch, std::vector<FeltCuts*>& hands) {
  for (FeltCuts* hand : hands) hand->tell(patch);
}

void tell_whole(const Carving& carving, CarvePatch& patch, std::vector<FeltCuts*>& hands) {
  for (std::uint32_t b = 0; b < carving.setup().bones.size(); ++b) {
    const CarvedField* field = carving.field(b);
    if (!field) continue;
    patch.bone = b;
    patch.kind = CarvePatch::Kind::kClear;
    tell_all(patch, hands);
    for (std::size_t n = 0; n < field->block_count(); ++n) {
      fill(patch, *field, field->block_at(n));
      tell_all(patch, hands);
    }
  }
}

}  // namespace

std::size_t channel_places(const CarvingSetup& setup) {
  constexpr std::size_t kSecondOfDrilling = 4096;
  if (setup.channel_places > 0) return setup.channel_places;
  std::size_t carved = 0;
  for (const auto& bone : setup.bones) carved += bone ? 1 : 0;
  return kSecondOfDrilling + carved * setup.most_blocks;
}

FeltCuts::FeltCuts(const CarvingSetup& setup, std::size_t places)
    : channel_(std::min(places, kOfSomeSteps), places - std::min(places, kOfSomeSteps)) {
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

const CarvePatch* FeltCuts::next() const {
  return early_.empty() ? channel_.front() : &early_.front();
}

void FeltCuts::drop_next() {
  if (early_.empty())
    channel_.drop();
  else
    early_.pop_front();
}

// A patch is a kilobyte, and a step of a drill has dozens: each is copied once, from where it lies.
void FeltCuts::take_until(std::uint64_t step, std::uint64_t tick, EventList& events) {
  for (const CarvePatch* patch = next(); patch && patch->step <= step; patch = next()) {
    apply(*patch, tick, events);
    drop_next();
  }
}

// What waits goes first.
void FeltCuts::tell(const CarvePatch& patch) {
  if (behind() || !channel_.push(patch)) late_.push_back(patch);
}

void FeltCuts::send_late() {
  while (behind() && channel_.push(late_.front())) late_.pop_front();
}

// Each round sends as much as the channel holds.
void FeltCuts::catch_up() {
  while (behind()) {
    for (const CarvePatch* next = channel_.front(); next; next = channel_.front()) {
      early_.push_back(*next);
      channel_.drop();
    }
    send_late();
  }
}

void FeltCuts::copy(const Carving& carving) {
  late_.clear();
  early_.clear();
  CarvePatch patch;
  while (channel_.front()) channel_.drop();
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

void publish(const Carving& carving, std::uint64_t step, bool all, std::vector<FeltCuts*>& hands) {
  CarvePatch patch;
  patch.step = step;
  for (FeltCuts* hand : hands) hand->send_late();
  if (all) tell_whole(carving, patch, hands);
  if (!all)
    for (const Carving::Changed& changed : carving.changed()) {
      patch.bone = changed.bone;
      fill(patch, *carving.field(changed.bone), changed.block);
      tell_all(patch, hands);
    }
  patch.kind = CarvePatch::Kind::kEvent;
  for (const Event& event : carving.events()) {
    if (event.hand >= hands.size()) continue;
    patch.event = event;
    hands[event.hand]->tell(patch);
  }
}

}  // namespace osteon
