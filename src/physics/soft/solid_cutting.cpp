#include "soft/solid_cutting.h"

#include <algorithm>
#include <cmath>

#include "osteon/base/check.h"
#include "osteon/base/hash.h"
#include "osteon/carve/removed.h"
#include "osteon/scene/event.h"

namespace osteon {
namespace {

constexpr std::size_t kMostCutBlocks = 4096, kMostNews = 64;
constexpr double kWallSlack_m = 15e-6;  // as of bone: what cut a hole moves in it
constexpr double kSharp = 1.0 / 3;      // D: an edge needs so much of the table's force
constexpr double kLightest_n = 0.05;
constexpr double kAcross = 0.7;                         // a blade that lies flat does not cut
constexpr std::uint32_t kStrokeEnds = 100;              // steps without a cut
constexpr double kBladesOpen = 0.5, kBladesShut = 0.1;  // of the blades' way
constexpr std::uint64_t kLookForPieces = 24, kShowEvery = 20;
constexpr double kCrumb_m3 = 0.5e-9;  // less is no piece to tell of

CutGrid cut_grid(const BlockGrid& grid) { return {grid.cell_m, grid.lo, grid.blocks}; }

std::uint64_t cells_hash(const std::vector<CutCell>& cells) {
  if (cells.empty()) return 0;
  Hasher h;
  h.add(static_cast<std::uint64_t>(cells.size()));
  for (const CutCell& cell : cells) {
    h.add(cell.count);
    for (std::uint32_t a = 0; a < cell.count; ++a) {
      h.add(cell.left[a]);
      h.add(cell.middle[a]);
    }
    for (const std::uint16_t bits : cell.beyond) h.add(static_cast<std::uint32_t>(bits));
  }
  return h.value();
}

}  // namespace

// A hand's instrument on the solid that it presses most.
struct SolidCutting::Stroke {
  Stroke(SolidCutHand& of, const SolidCutter& cuts, std::size_t at)
      : hand(of), with(cuts), index(at) {}
  SolidCutHand& hand;
  const SolidCutter& with;
  SolidNear* near = nullptr;  // none: jaws that shut without pressing anything
  std::size_t index = 0;
  std::uint32_t solid = 0;
  Pose X_BT;  // where the tool would be, were the solid rigid
  Vec3 nhat_T = Vec3::UnitZ();
};

SolidCutting::SolidCutting(const SoftSetup& setup, SolidPresses& presses)
    : setup_(setup), presses_(presses) {
  for (const SoftSolid& solid : setup_.solids) {
    auto field = CarvedField::make(solid.uncut, {}, kMostCutBlocks, kSolidCutAir_m);
    demand(field.has_value(), "a soft solid has no field that can be cut");
    Solid& made = solids_.emplace_back(std::move(*field));
    made.holes =
        std::make_unique<CutField>(cut_grid(made.field.grid()), kMostCutBlocks, kWallSlack_m);
    made.loose = std::make_unique<LoosePieces>(made.field);
    made.cells = std::make_unique<SolidCells>(made.field, *solid.body);
    made.whole = made.cells->cells();
  }
  news_.reserve(kMostNews);
}

const SolidCutter* SolidCutting::cutter(std::uint32_t instrument) const {
  const auto& all = setup_.cutters;
  return instrument < all.size() && all[instrument] ? &*all[instrument] : nullptr;
}

std::uint64_t SolidCutting::lifted(const ToolState& tool) const {
  const SolidCutter* with = cutter(tool.instrument);
  return with && tool.jaw > kBladesShut ? with->lifts : 0;
}

// Of the parts that do the work.
bool SolidCutting::presses_most(const SolidHandState& state, const SolidCutter& with,
                                std::uint32_t& at) const {
  double most = kLightest_n;
  bool found = false;
  for (std::uint32_t i = 0; i < state.count; ++i) {
    const SolidNear& near = state.near[i];
    if (!(with.works >> near.contact.part & 1) || !(near.force_n > most)) continue;
    most = near.force_n;
    at = i;
    found = true;
  }
  return found;
}

void SolidCutting::step(SoftState& state, std::span<const SolidHand> hands, std::uint64_t step) {
  news_.clear();
  for (std::size_t h = 0; h < hands.size(); ++h) {
    SolidCutHand& hand = hands_[h];
    if (hand.solid != SolidCutHand::kNone && ++hand.idle > kStrokeEnds)
      hand.solid = SolidCutHand::kNone;
    if (hands[h].tool)
      cut_with(state, h, hands[h]);
    else
      hand = {};
  }
  for (std::uint32_t s = 0; s < solids_.size(); ++s) {
    if (step % kLookForPieces == 0) drop_pieces(s);
    follow_stiffness(solids_[s], s);
    Solid& solid = solids_[s];
    if (step % kShowEvery == 0 && solid.field.step() != solid.told) {
      solid.told = solid.field.step();
      solid.shown = std::make_shared<const CarveState>(solid.field.save());
    }
  }
}

void SolidCutting::cut_with(SoftState& state, std::size_t h, const SolidHand& of) {
  const ToolState& tool = *of.tool;
  const SolidCutter* with = cutter(tool.instrument);
  SolidCutHand& hand = hands_[h];
  if (!with) {
    hand = {};
    return;
  }
  SolidHandState& all = state.solid_hands[h];
  Stroke stroke(hand, *with, h);
  std::uint32_t at = 0;
  if (presses_most(all, *with, at)) {
    stroke.near = &all.near[at];
    stroke.solid = stroke.near->contact.solid;
  }
  const bool shuts = hand.jaw_open && tool.jaw <= kBladesShut;
  hand.jaw_open = tool.jaw > kBladesOpen || (hand.jaw_open && tool.jaw > kBladesShut);
  const auto place = [&](std::uint32_t solid) {
    stroke.X_BT = presses_.X_WB(solid).inverse() * tool.X_WP;
    if (!stroke.near) return;
    const SolidContact& contact = stroke.near->contact;
    stroke.nhat_T = stroke.X_BT.q.conjugate() * contact.nhat_B;
    stroke.X_BT.p += stroke.near->outside_B - presses_.middle(*stroke.near, of);
  };
  if (with->way == SolidCutter::Way::kBite) {
    if (!shuts) return;
    const std::uint32_t first = stroke.near ? stroke.solid : 0;
    const std::uint32_t last =
        stroke.near ? stroke.solid + 1 : static_cast<std::uint32_t>(solids_.size());
    for (stroke.solid = first; stroke.solid < last; ++stroke.solid) {
      if (state.solid_lost[stroke.solid]) continue;
      place(stroke.solid);
      bite(stroke);
    }
    return;
  }
  if (!stroke.near) return;
  place(stroke.solid);
  slice(stroke);
}

void SolidCutting::bite(const Stroke& stroke) {
  const double gone = remove(stroke.solid, stroke.with.cutter, stroke.X_BT, stroke.X_BT);
  if (gone > 0) tell(stroke, gone);
}

// F = k (d - e) for e, how far the edge is in; where F is above the cutting force f, e grows to
// d - f / k. The slit is what the blade passes from where it was in the last step.
void SolidCutting::slice(const Stroke& stroke) {
  SolidNear& near = *stroke.near;
  const double over = near.force_n - kSharp * setup_.solid_cutting_n;
  const bool flat = std::abs(stroke.with.flat_T.dot(stroke.nhat_T)) > kAcross;
  if (over > 0 && !flat && near.force_n > 0) {
    const double pressed = near.deep_m - near.entered_m - near.contact.others_m;
    near.entered_m += std::max(0.0, pressed) * over / near.force_n;
  }
  if (!(near.entered_m > 0)) return;
  SolidCutHand& hand = stroke.hand;
  Pose X = stroke.X_BT;
  X.p -= near.entered_m * near.contact.nhat_B;
  const bool goes_on = hand.solid == stroke.solid && hand.idle <= 2;
  const double gone = remove(stroke.solid, stroke.with.cutter, goes_on ? hand.X_BC : X, X);
  if (gone > 0 && hand.solid != stroke.solid) tell(stroke, gone);
  hand.solid = stroke.solid;
  hand.X_BC = X;
  hand.idle = 0;
}

double SolidCutting::remove(std::uint32_t s, const Cutter& cutter, const Pose& from,
                            const Pose& to) {
  const CarveStep did = solids_[s].field.cut(cutter, from, to);
  if ((did.status & CarveStep::kRemoved) == 0) return 0;
  catch_up(s);
  return total(did.removed_m3);
}

void SolidCutting::tell(const Stroke& stroke, double volume_m3) {
  if (news_.size() == kMostNews) return;
  const Vec3 p_B = stroke.near ? stroke.near->contact.p_B : stroke.X_BT.p;
  news_.push_back(
      {stroke.solid, stroke.index, false, stroke.near ? stroke.near->force_n : 0, volume_m3, p_B});
}

// The hands' holes and the cells, as the field is now.
void SolidCutting::catch_up(std::uint32_t s) {
  Solid& solid = solids_[s];
  for (std::size_t n = 0; n < solid.field.block_count(); ++n) {
    if (solid.field.changed_at(n) <= solid.seen) continue;
    const std::uint32_t block = solid.field.block_at(n);
    (void)solid.holes->set(block, CutField::Block(solid.field.cuts(block), CutField::kNodes));
  }
  solid.cells->update(solid.field, solid.seen);
  solid.seen = solid.field.step();
  presses_.set_cut(s, solid.holes.get(), solid.body);
}

// A piece that hangs on nothing is gone: out of the joint with the water.
void SolidCutting::drop_pieces(std::uint32_t s) {
  Solid& solid = solids_[s];
  if (solid.field.step() == solid.looked) return;
  const auto pieces = solid.loose->find(solid.field);
  for (const LoosePiece& piece : pieces) {
    if (!solid.loose->take_away(solid.field, piece, kSolidCutAir_m)) continue;
    if (piece.volume_m3 < kCrumb_m3) continue;
    ++solid.pieces;
    if (news_.size() < kMostNews)
      news_.push_back({s, kNoHand, true, 0, piece.volume_m3, piece.middle_B});
  }
  if (!pieces.empty()) catch_up(s);
  solid.looked = solid.field.step();
}

void SolidCutting::follow_stiffness(Solid& solid, std::uint32_t s) {
  if (!solid.work) {
    const auto& now = solid.cells->cells();
    if (now == (solid.felt.empty() ? solid.whole : solid.felt)) return;
    if (now == solid.whole) {
      set(solid.felt, solid.felt_hash, {});
      solid.body = nullptr;
      return presses_.set_cut(s, solid.holes.get(), nullptr);
    }
    set(solid.next, solid.next_hash, now);
    solid.worked = 0;
    solid.work = std::make_unique<CutSolidWork>(setup_.solids[s].body, solid.next);
    return;
  }
  ++solid.worked;
  if (!solid.work->step()) return;
  solid.body = solid.work->take();
  solid.work = nullptr;
  set(solid.felt, solid.felt_hash, std::move(solid.next));
  set(solid.next, solid.next_hash, {});
  solid.worked = 0;
  presses_.set_cut(s, solid.holes.get(), solid.body);
}

void SolidCutting::set(std::vector<CutCell>& cells, std::uint64_t& hash, std::vector<CutCell> now) {
  cells = std::move(now);
  hash = cells_hash(cells);
}

double SolidCutting::removed_m3(std::size_t solid) const {
  return total(removed_volume(solids_[solid].field));
}
std::uint32_t SolidCutting::pieces(std::size_t solid) const { return solids_[solid].pieces; }

void SolidCutting::show(std::array<std::shared_ptr<const CarveState>, kMaxSolids>& cuts) const {
  for (std::size_t s = 0; s < solids_.size(); ++s) cuts[s] = solids_[s].shown;
}

std::uint64_t SolidCutting::hash() const {
  Hasher h;
  for (const Solid& solid : solids_) {
    h.add(solid.field.hash());
    h.add(solid.felt_hash);
    h.add(solid.next_hash);
    h.add(solid.worked);
    h.add(solid.pieces);
  }
  for (const SolidCutHand& hand : hands_) {
    h.add(hand.solid);
    h.add(hand.jaw_open);
    h.add(hand.X_BC);
    h.add(hand.idle);
  }
  return h.value();
}

std::shared_ptr<const SoftCutState> SolidCutting::save() const {
  auto out = std::make_shared<SoftCutState>();
  for (const Solid& solid : solids_)
    out->solids.push_back(
        {solid.field.save(), solid.felt, solid.next, solid.worked, solid.looked, solid.pieces});
  out->hands = hands_;
  return out;
}

bool SolidCutting::fits(const SoftCutState& state) const {
  if (state.solids.size() != solids_.size()) return false;
  for (std::size_t s = 0; s < solids_.size(); ++s) {
    const SolidCutState& from = state.solids[s];
    const std::size_t cells = solids_[s].whole.size();
    if (from.cuts.bone != solids_[s].field.bone().hash()) return false;
    for (const auto* table : {&from.felt, &from.next}) {
      if (!table->empty() && table->size() != cells) return false;
      for (const CutCell& cell : *table)
        if (cell.count > CutCell::kParts) return false;
    }
  }
  for (const SolidCutHand& hand : state.hands)
    if (hand.solid != SolidCutHand::kNone && hand.solid >= solids_.size()) return false;
  return true;
}

void SolidCutting::put_cuts(std::uint32_t s, const SolidCutState& from) {
  Solid& solid = solids_[s];
  if (!solid.field.restore(from.cuts)) return;
  solid.holes->clear();
  for (std::size_t n = 0; n < solid.field.block_count(); ++n) {
    const std::uint32_t block = solid.field.block_at(n);
    (void)solid.holes->set(block, CutField::Block(solid.field.cuts(block), CutField::kNodes));
  }
  solid.cells->update_all(solid.field);
  solid.seen = solid.told = solid.field.step();
  solid.pieces = from.pieces;
  solid.looked = from.looked;
  solid.shown = from.cuts.blocks.empty() ? nullptr : std::make_shared<const CarveState>(from.cuts);
}

void SolidCutting::feel(std::uint32_t s) {
  presses_.set_cut(s, solids_[s].holes.get(), solids_[s].body);
}

void SolidCutting::restore(const SoftCutState& state) {
  for (std::uint32_t s = 0; s < solids_.size(); ++s) {
    const SolidCutState& from = state.solids[s];
    Solid& solid = solids_[s];
    put_cuts(s, from);
    if (from.felt != solid.felt) {
      set(solid.felt, solid.felt_hash, from.felt);
      solid.body = nullptr;
      if (!from.felt.empty()) {
        CutSolidWork work(setup_.solids[s].body, from.felt);
        while (!work.step()) {
        }
        solid.body = work.take();
      }
    }
    set(solid.next, solid.next_hash, from.next);
    solid.worked = from.worked;
    solid.work = nullptr;
    if (!solid.next.empty()) {
      solid.work = std::make_unique<CutSolidWork>(setup_.solids[s].body, solid.next);
      for (std::uint64_t n = 0; n < solid.worked && !solid.work->step(); ++n) {
      }
    }
    feel(s);
  }
  hands_ = state.hands;
  news_.clear();
}

void SolidCutting::go_back(const SoftCutState& state) {
  for (std::uint32_t s = 0; s < solids_.size(); ++s) {
    put_cuts(s, state.solids[s]);
    set(solids_[s].next, solids_[s].next_hash, {});
    solids_[s].work = nullptr;
    solids_[s].worked = 0;
    feel(s);
  }
  hands_ = {};
  news_.clear();
}

void SolidCutting::clear() {
  SoftCutState none;
  for (const Solid& solid : solids_) {
    none.solids.emplace_back();
    none.solids.back().cuts.bone = solid.field.bone().hash();
  }
  restore(none);
}

}  // namespace osteon
