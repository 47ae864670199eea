#include <memory>
#include <utility>
#include <vector>

#include "osteon/physics/soft_cut_state.h"
#include "state/fields.h"

namespace osteon::stored {
namespace {

constexpr std::uint64_t kMostCutCells = 4096, kMostCutWork = 1u << 16;
constexpr std::uint64_t kCleared = 30;  // the version that says what was told of stumps

}  // namespace

template <class A>
void field(A& a, std::vector<CutCell>& cells) {
  std::uint64_t count = cells.size();
  number(a, count, kMostCutCells);
  if constexpr (A::kReads) cells.resize(count);
  for (CutCell& cell : cells) {
    number(a, cell.count, static_cast<std::uint32_t>(CutCell::kParts));
    for (std::uint32_t p = 0; p < cell.count && p < CutCell::kParts; ++p) {
      field(a, cell.left[p]);
      field(a, cell.middle[p]);
    }
    for (std::uint16_t& bits : cell.beyond) {
      std::uint32_t wide = bits;
      number(a, wide, 0xffffu);
      bits = static_cast<std::uint16_t>(wide);
    }
  }
}

template <class A>
void field(A& a, std::shared_ptr<const SoftCutState>& cut) {
  if (!since(a, 14)) return;  // nothing cut solids then
  bool there = cut != nullptr;
  field(a, there);
  if (!there) return;
  SoftCutState state = cut ? *cut : SoftCutState{};
  std::uint64_t solids = state.solids.size();
  number(a, solids, std::uint64_t{kMaxSolids});
  if constexpr (A::kReads) state.solids.resize(solids);
  for (SolidCutState& solid : state.solids) {
    field(a, solid.cuts);
    field(a, solid.felt);
    field(a, solid.next);
    number(a, solid.worked, kMostCutWork);
    field(a, solid.looked);
    field(a, solid.pieces);
    if (since(a, kCleared)) number(a, solid.told_percent, 100u);
  }
  for (SolidCutHand& hand : state.hands) {
    field(a, hand.solid);
    field(a, hand.jaw_open);
    field(a, hand.X_BC);
    field(a, hand.idle);
  }
  if constexpr (A::kReads) cut = std::make_shared<const SoftCutState>(std::move(state));
}

template void field(Out&, std::shared_ptr<const SoftCutState>&);
template void field(In&, std::shared_ptr<const SoftCutState>&);

}  // namespace osteon::stored
