#include "osteon/carve/carved_field.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace osteon {
namespace {

constexpr std::int16_t kNoCut = CarvedField::kUncut;

// A permutation of 64 bits (the finaliser of SplitMix64; Steele, Lea, Flood 2014).
std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

bool holds_cut(const std::array<std::int16_t, BlockGrid::kNodes>& cut) {
  return std::any_of(cut.begin(), cut.end(), [](std::int16_t c) { return c != kNoCut; });
}

// Of one block: 8 bytes at a time. Sums of these over blocks do not depend on their order.
std::uint64_t block_hash(std::uint32_t block,
                         const std::array<std::int16_t, BlockGrid::kNodes>& cut) {
  if (!holds_cut(cut)) return 0;
  std::uint64_t h = mix(block + 0x9e3779b97f4a7c15ull);
  for (std::size_t n = 0; n < cut.size(); n += 4) {
    std::uint64_t word;
    std::memcpy(&word, cut.data() + n, sizeof word);
    h = (h ^ word) * 0x100000001b3ull;
    h ^= h >> 29;
  }
  return mix(h);
}

}  // namespace

Result<CarvedField> CarvedField::make(std::shared_ptr<const UncutField> bone,
                                      const BoneLayers& layers, std::size_t most_blocks,
                                      double air_m) {
  if (auto sound = check(layers); !sound) return tl::unexpected(sound.error());
  constexpr std::size_t kMost = 1u << 22;
  if (most_blocks < 1 || most_blocks > kMost)
    return fail("the number of blocks must be 1 to 4 million", "carving");
  if (!(air_m >= 0 && air_m <= 0.05))
    return fail("cuts must be kept 0 to 50 mm outside of the bone", "carving");
  CarvedField made;
  made.air_m_ = air_m;
  made.layers_ = layers;
  for (std::size_t l = 0; l < layers.layers.size(); ++l)
    made.layer_um_[l] = static_cast<std::int32_t>(std::round(1e6 * layers.layers[l].depth_m));
  made.slot_.assign(bone->grid().count(), kNone);
  made.marks_.resize(most_blocks);
  made.nodes_.resize(most_blocks);
  if (bone->bare()) made.bare_.resize(most_blocks);
  made.bone_ = std::move(bone);
  return made;
}

bool CarvedField::may_hold_cuts(std::uint32_t block) const {
  return bone_->place(block) != UncutField::Place::kOutside ||
         bone_->middle_m(block) - grid().reach_m() < air_m_;
}

std::uint32_t CarvedField::take(std::uint32_t block) {
  const auto slot = static_cast<std::uint32_t>(used_++);
  slot_[block] = slot;
  marks_[slot] = {};
  marks_[slot].block = block;
  nodes_[slot].cut.fill(kUncut);
  bone_->heights(block, nodes_[slot].height);
  if (!bare_.empty()) bone_->bare()->heights(block, bare_[slot]);
  return slot;
}

const std::int16_t* CarvedField::cuts(std::uint32_t block) const {
  return slot_[block] == kNone ? nullptr : nodes_[slot_[block]].cut.data();
}

const std::int16_t* CarvedField::heights(std::uint32_t block) const {
  return slot_[block] == kNone ? nullptr : nodes_[slot_[block]].height.data();
}

const std::int16_t* CarvedField::bare_heights(std::uint32_t block) const {
  if (bare_.empty()) return heights(block);
  return slot_[block] == kNone ? nullptr : bare_[slot_[block]].data();
}

double CarvedField::height_m(std::uint32_t block, std::size_t node) const {
  const std::int16_t* known = heights(block);
  if (!known) known = bone_->stored(block);
  return known ? 1e-6 * known[node] : bone_->middle_m(block);
}

double CarvedField::bare_height_m(std::uint32_t block, std::size_t node) const {
  const UncutField& alone = bone_->bare() ? *bone_->bare() : *bone_;
  const std::int16_t* known = bare_heights(block);
  if (!known) known = alone.stored(block);
  return known ? 1e-6 * known[node] : alone.middle_m(block);
}

bool CarvedField::surface_changed(std::uint32_t block, std::uint64_t since) const {
  const auto at = grid().place(block);
  for (int n = 0; n < 27; ++n) {
    const std::array<int, 3> step{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
    const std::array<int, 3> near{at[0] + step[0], at[1] + step[1], at[2] + step[2]};
    if (!grid().holds(near) || slot_[grid().index(near)] == kNone) continue;
    const Mark& mark = marks_[slot_[grid().index(near)]];
    bool changed = mark.surface > since;
    // Of a block beyond x, what lies at its lower side counts.
    for (std::size_t a = 0; a < 3; ++a)
      if (step[a] != 0) changed = changed && mark.side[2 * a + (step[a] < 0 ? 1 : 0)] > since;
    if (changed) return true;
  }
  return false;
}

bool CarvedField::apply(std::uint32_t block, std::span<const std::int16_t, BlockGrid::kNodes> cut,
                        std::uint64_t step) {
  if (block >= slot_.size() || !may_hold_cuts(block)) return false;
  if (slot_[block] == kNone && used_ == marks_.size()) return false;
  const std::uint32_t slot = slot_[block] == kNone ? take(block) : slot_[block];
  std::copy(cut.begin(), cut.end(), nodes_[slot].cut.begin());
  Mark& mark = marks_[slot];
  mark.hashed = false;
  mark.changed = mark.surface = step;
  mark.side.fill(step);
  step_ = std::max(step_, step);
  return true;
}

void CarvedField::clear() {
  for (std::size_t n = 0; n < used_; ++n) slot_[marks_[n].block] = kNone;
  used_ = 0;
}

CarveState CarvedField::save() const {
  CarveState state;
  state.bone = bone_->hash();
  state.step = step_;
  for (std::size_t n = 0; n < used_; ++n)
    if (holds_cut(nodes_[n].cut)) state.blocks.push_back({marks_[n].block, nodes_[n].cut});
  std::sort(state.blocks.begin(), state.blocks.end(),
            [](const auto& a, const auto& b) { return a.block < b.block; });
  return state;
}

Result<void> CarvedField::restore(const CarveState& state) {
  constexpr const char* kWhere = "state of a carved bone";
  if (state.bone != bone_->hash()) return fail("belongs to another bone", kWhere);
  if (state.blocks.size() > marks_.size()) return fail("holds more blocks than exist", kWhere);
  for (std::size_t n = 0; n < state.blocks.size(); ++n) {
    const std::uint32_t block = state.blocks[n].block;
    if (block >= slot_.size() || !may_hold_cuts(block) ||
        (n > 0 && block <= state.blocks[n - 1].block))
      return fail("holds an impossible block", kWhere);
  }
  clear();
  ++epoch_;
  step_ = state.step;
  for (const CarveState::Block& b : state.blocks) apply(b.block, b.cut, state.step);
  return {};
}

std::uint64_t CarvedField::hash() {
  std::uint64_t sum = bone_->hash();
  for (std::size_t n = 0; n < used_; ++n) {
    Mark& mark = marks_[n];
    if (!mark.hashed) mark.hash = block_hash(mark.block, nodes_[n].cut);
    mark.hashed = true;
    sum += mark.hash;
  }
  return sum;
}

}  // namespace osteon
