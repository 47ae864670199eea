#include "soft/solid_cutting.h"

#include <algorithm>
#include <cmath>

#include "osteon/base/check.h"
#include "osteon/base/hash.h"
#include "osteon/carve/removed.h"
#include "osteon/scene/event.h"

namespace osteon {
namespace {

constexpr std::size_t kMostNews = 64;
constexpr double kWallSlack_m = 15e-6;  // as of bone: what cut a hole moves in it
constexpr double kSharp = 1.0 / 3;      // D: an edge needs so much of the table's force
constexpr double kLightest_n = 0.05;
constexpr double kAcross = 0.7;                         // a blade that lies flat does not cut
constexpr std::uint32_t kStrokeEnds = 100;              // steps without a cut
constexpr double kBladesOpen = 0.5, kBladesShut = 0.1;  // of the blades' way
constexpr std::uint64_t kShowEvery = 20;
constexpr double kCrumb_m3 = 0.5e-9;  // less is no piece to tell of
constexpr double kRipped_m = 0.0007;  // width of what a tear takes: both nodes of each pair

CutGrid cut_grid(const BlockGrid& grid) { return {grid.cell_m, grid.lo, grid.blocks}; }

// The step in which what is left of it last changed; a cut that meets nothing changes nothing.
std::uint64_t last_change(const CarvedField& field) {
  std::uint64_t last = 0;
  for (std::size_t n = 0; n < field.block_count(); ++n) last = std::max(last, field.changed_at(n));
  return last;
}

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

// Whether what clears has hardly moved since it last did.
bool is_short(const SolidCutHand& hand, const Pose& X_WB, const Pose& X_WC,
              const SolidCutter& with) {
  constexpr double kStride_m = 10e-6;
  const Pose from_WC = X_WB * hand.X_BC;
  const Vec3 tip = X_WC.p - from_WC.p;
  const Vec3 end = X_WC * with.to_T - from_WC * with.to_T;
  return tip.squaredNorm() < kStride_m * kStride_m && end.squaredNorm() < kStride_m * kStride_m;
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

SolidCutting::SolidCutting(const SoftSetup& setup, SolidPresses& presses, double step_s)
    : setup_(setup), presses_(presses), step_s_(step_s) {
  for (const SoftSolid& solid : setup_.solids) {
    auto field = CarvedField::make(solid.uncut, {}, kMostCutBlocks, kSolidCutAir_m);
    demand(field.has_value(), "a soft solid has no field that can be cut");
    Solid& made = solids_.emplace_back(std::move(*field));
    made.holes =
        std::make_unique<CutField>(cut_grid(made.field.grid()), kMostCutBlocks, kWallSlack_m);
    made.loose = std::make_unique<LoosePieces>(made.field);
    // Where pieces are gone at once the largest part of a meniscus stays, as it always has.
    if (solid.hangs && (solid.to_clear || setup_.pieces)) made.loose->hang(made.field, solid.hangs);
    if (solid.to_clear) find_to_clear(made, solid);
    if (setup_.bridges_tear && solid.hangs)
      made.bridges = std::make_unique<BridgeSearch>(made.field);
    made.cells = std::make_unique<SolidCells>(made.field, *solid.body);
    made.whole = made.cells->cells();
  }
  news_.reserve(kMostNews);
  auto rip = make_cutter("burr", kRipped_m);
  demand(rip.has_value(), "a tear has no cutter");
  rip_ = std::move(*rip);
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
    if (step % kSolidLookEvery == 0) {
      drop_pieces(s);
      tell_cleared(s);
      sum_gone(s);
    }
    follow_stiffness(solids_[s], s);
    Solid& solid = solids_[s];
    look_ahead(solid);
    if (step % kShowEvery == 0 && solid.field.step() != solid.told) {
      if (last_change(solid.field) > solid.told)
        solid.shown = std::make_shared<const CarveState>(solid.field.save());
      solid.told = solid.field.step();
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
  if (with->way == SolidCutter::Way::kClear) return clear_away(state, h, of, *with);
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

// The slit is what the blade passes from where it was in the last step.
void SolidCutting::slice(const Stroke& stroke) {
  SolidNear& near = *stroke.near;
  // What pushes the blade's flat side does not cut.
  const double across = stroke.with.flat_T.dot(stroke.nhat_T);
  const double upright = std::sqrt(std::max(0.0, 1 - across * across));
  if (std::abs(across) <= kAcross && near.force_n > 0) {
    const double own_n = setup_.solids[stroke.solid].cutting_n;
    const Vec3 edge_B = stroke.X_BT.rotate(stroke.with.flat_T.cross(stroke.nhat_T)).normalized();
    near.entered_m +=
        edge_goes_in(near.deep_m - near.entered_m - near.contact.others_m, upright * near.force_n,
                     kSharp * (own_n > 0 ? own_n : setup_.solid_cutting_n),
                     std::abs(edge_B.dot(near.slid_B)), stroke.with.drawn_share);
  }
  if (!(near.entered_m > 0)) return;
  SolidCutHand& hand = stroke.hand;
  Pose X = stroke.X_BT;
  // In its own plane: a blade that is pushed aslant does not plough a wider slit.
  const Vec3 flat_B = X.rotate(stroke.with.flat_T);
  X.p -= near.entered_m * (near.contact.nhat_B - across * flat_B);
  const bool goes_on = hand.solid == stroke.solid && hand.idle <= 2;
  const double gone = remove(stroke.solid, stroke.with.cutter, goes_on ? hand.X_BC : X, X);
  if (gone > 0 && hand.solid != stroke.solid) tell(stroke, gone);
  hand.solid = stroke.solid;
  hand.X_BC = X;
  hand.idle = 0;
}

// The place of the part that is pressed must lie by the rod that clears, on the side that does.
bool SolidCutting::clears_at(const SolidNear& near, const SolidHand& of,
                             const SolidCutter& with) const {
  constexpr double kBeside_m = 0.0015;
  // Teeth and current take what hardly resists, and what another part presses deeper.
  constexpr double kLeast_m = 20e-6;
  if (!(with.works >> near.contact.part & 1) || near.barred || !(near.deep_m > kLeast_m))
    return false;
  const Vec3 at_T = pressed_place(near.contact, of.parts[near.contact.part]);
  const Vec3 way = with.to_T - with.from_T;
  const double square = way.squaredNorm();
  const double along =
      square > 0 ? std::clamp((at_T - with.from_T).dot(way) / square, 0.0, 1.0) : 0;
  if ((at_T - with.from_T - along * way).norm() > kBeside_m) return false;
  const Pose X_BT = presses_.X_WB(near.contact.solid).inverse() * of.tool->X_WP;
  const Vec3 nhat_T = X_BT.q.conjugate() * near.contact.nhat_B;
  return with.face_T.isZero() || with.face_T.dot(nhat_T) < 0;
}

// The tool's place c that is cleared begins where the tool touches, were the solid rigid, less what
// its rod and a cut wall are felt farther out, so that a new beginning gains nothing. It follows
// the hand's place straight, by a step's way at most: what it passes is gone, of every solid. While
// nothing presses it does not move, and the next push begins anew.
void SolidCutting::clear_away(SoftState& state, std::size_t h, const SolidHand& of,
                              const SolidCutter& with) {
  SolidHandState& all = state.solid_hands[h];
  SolidNear* near = nullptr;
  for (std::uint32_t i = 0; i < all.count && of.tool->power > 0; ++i)
    if (clears_at(all.near[i], of, with) && (!near || all.near[i].deep_m > near->deep_m))
      near = &all.near[i];
  if (!near) return;
  SolidCutHand& hand = hands_[h];
  const Pose& X_WT = of.tool->X_WP;
  const bool goes_on = hand.solid != SolidCutHand::kNone && hand.idle <= 2;
  const Vec3 from_W =
      goes_on ? Vec3(presses_.X_WB(hand.solid) * hand.X_BC.p) : touching_W(*near, of);
  const Vec3 way_W = X_WT.p - from_W;
  const double length = way_W.norm();
  const double most = with.speed_m_per_s * std::min(of.tool->power, 1.0) * step_s_;
  if (!(length > 0) || with.face_T.dot(X_WT.q.conjugate() * way_W) < 0) return;
  const Pose X_WC{from_W + std::min(1.0, most / length) * way_W, X_WT.q};
  if (goes_on && setup_.clears_by_strides &&
      is_short(hand, presses_.X_WB(hand.solid), X_WC, with)) {
    hand.idle = 0;
    return;
  }
  Stroke stroke(hand, with, h);
  stroke.near = near;
  for (std::uint32_t s = 0; s < solids_.size(); ++s) {
    if (state.solid_lost[s]) continue;
    stroke.solid = s;
    stroke.X_BT = presses_.X_WB(s).inverse() * X_WC;
    const double gone = remove(s, with.cutter, stroke.X_BT, stroke.X_BT);
    if (gone > 0 && s == near->contact.solid && hand.solid == SolidCutHand::kNone)
      tell(stroke, gone);
  }
  hand.solid = near->contact.solid;
  hand.X_BC = presses_.X_WB(hand.solid).inverse() * X_WC;
  hand.idle = 0;
}

bool SolidCutting::cuts_now() const {
  const auto cuts = [](const SolidCutHand& hand) {
    return hand.solid != SolidCutHand::kNone && hand.idle == 0;
  };
  return !news_.empty() || std::any_of(hands_.begin(), hands_.end(), cuts);
}

// Where the tool is outside of what it presses. It may have been led a stride deep into a wall
// beside it: it is led out of that.
Vec3 SolidCutting::touching_W(const SolidNear& near, const SolidHand& of) const {
  const Vec3 o = near.outside_B - presses_.middle(near, of);
  const Vec3& n = near.contact.nhat_B;
  Vec3 back = o - (n.dot(o) - near.deep_m) * n;
  back += (kClearRoom_m + kWallSlack_m) * back.normalized();
  return of.tool->X_WP.p + presses_.X_WB(near.contact.solid).rotate(back);
}

void SolidCutting::find_to_clear(Solid& solid, const SoftSolid& of) const {
  const BlockGrid& grid = solid.field.grid();
  solid.to_clear.assign(grid.count(), ClearBits{});
  solid.gone.assign(grid.count(), 0);
  std::array<std::int16_t, BlockGrid::kNodes> heights{};
  for (std::uint32_t b = 0; b < grid.count(); ++b) {
    solid.field.bone().heights(b, heights);
    const auto at = grid.place(b);
    for (int n = 0; n < static_cast<int>(BlockGrid::kNodes); ++n) {
      const auto node = static_cast<std::size_t>(n);
      const Vec3 p_B = grid.node(8 * at[0] + n % 8, 8 * at[1] + n / 8 % 8, 8 * at[2] + n / 64);
      if (heights[node] >= 0 || !of.to_clear(p_B)) continue;
      solid.to_clear[b][node / 64] |= std::uint64_t{1} << (node % 64);
      ++solid.to_clear_nodes;
    }
  }
}

void SolidCutting::count_gone(Solid& solid, std::uint32_t block) const {
  if (solid.to_clear.empty()) return;
  std::uint16_t gone = 0;
  if (const std::int16_t* cuts = solid.field.cuts(block))
    for (std::size_t n = 0; n < BlockGrid::kNodes; ++n)
      if (cuts[n] <= 0 && (solid.to_clear[block][n / 64] >> (n % 64) & 1) != 0) ++gone;
  solid.gone_nodes = solid.gone_nodes + gone - solid.gone[block];
  solid.gone[block] = gone;
}

double SolidCutting::cleared_percent(std::size_t s) const {
  const Solid& solid = solids_[s];
  if (solid.to_clear_nodes == 0) return 0;
  return 100 * static_cast<double>(solid.gone_nodes) / static_cast<double>(solid.to_clear_nodes);
}

double SolidCutting::all_cleared_percent() const {
  std::uint64_t gone = 0, all = 0;
  for (const Solid& solid : solids_) {
    gone += solid.gone_nodes;
    all += solid.to_clear_nodes;
  }
  return all > 0 ? 100 * static_cast<double>(gone) / static_cast<double>(all) : -1;
}

// By whole percents of the solid.
void SolidCutting::tell_cleared(std::uint32_t s) {
  Solid& solid = solids_[s];
  const auto now = static_cast<std::uint32_t>(cleared_percent(s));
  if (now <= solid.told_percent || news_.size() == kMostNews) return;
  solid.told_percent = now;
  News news;
  news.solid = s;
  news.cleared = true;
  news.p_B = setup_.solids[s].field->box().center();
  news_.push_back(news);
}

double SolidCutting::remove(std::uint32_t s, const Cutter& cutter, const Pose& from,
                            const Pose& to) {
  const CarveStep did = solids_[s].field.cut(cutter, from, to);
  if (did.blocks > 0) catch_up(s);  // room beside the solid as well, as a state says it
  return (did.status & CarveStep::kRemoved) != 0 ? total(did.removed_m3) : 0;
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
    count_gone(solid, block);
  }
  solid.seen = solid.field.step();
  presses_.set_cut(s, solid.holes.get(), solid.body);
}

void SolidCutting::sum_gone(std::uint32_t s) {
  Solid& solid = solids_[s];
  if (setup_.solids[s].to_clear || solid.summed == solid.field.step()) return;
  if (last_change(solid.field) > solid.summed) solid.gone_m3 = removed_m3(s);
  solid.summed = solid.field.step();
}

// A piece that hangs on nothing lies loose; crumbs are gone, out of the joint with the water.
void SolidCutting::drop_pieces(std::uint32_t s) {
  Solid& solid = solids_[s];
  if (solid.field.step() == solid.looked) return;
  if (last_change(solid.field) <= solid.looked) {
    solid.looked = solid.field.step();
    return;
  }
  const auto pieces = solid.loose->find(solid.field);
  for (const LoosePiece& piece : pieces) {
    const bool lies = setup_.pieces && !(piece.volume_m3 < kCrumb_m3);
    auto shape = lies
                     ? PieceShape::of(solid.field, *solid.loose, piece, setup_.solids[s].bone.index)
                     : nullptr;
    if (!solid.loose->take_away(solid.field, piece, kSolidCutAir_m)) continue;
    if (piece.volume_m3 < kCrumb_m3) continue;
    ++solid.pieces;
    if (news_.size() < kMostNews)
      news_.push_back(
          {s, kNoHand, true, 0, piece.volume_m3, piece.middle_B, false, std::move(shape)});
  }
  if (!pieces.empty()) catch_up(s);
  solid.looked = solid.field.step();
}

void SolidCutting::follow_stiffness(Solid& solid, std::uint32_t s) {
  if (!solid.work) {
    if (solid.followed == solid.field.step()) return;
    // Cells are looked at when they are asked for: cuts of many steps at once.
    solid.cells->update(solid.field, solid.celled);
    solid.celled = solid.field.step();
    const auto& now = solid.cells->cells();
    if (now == (solid.felt.empty() ? solid.whole : solid.felt)) {
      solid.followed = solid.celled;
      return;
    }
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
    if (solid.to_clear_nodes > 0) h.add(solid.told_percent);
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
    out->solids.push_back({solid.field.save(), solid.felt, solid.next, solid.worked, solid.looked,
                           solid.pieces, solid.told_percent});
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
  solid.gone.assign(solid.gone.size(), 0);
  solid.gone_nodes = 0;
  for (std::size_t n = 0; n < solid.field.block_count(); ++n) {
    const std::uint32_t block = solid.field.block_at(n);
    (void)solid.holes->set(block, CutField::Block(solid.field.cuts(block), CutField::kNodes));
    count_gone(solid, block);
  }
  solid.told_percent = from.told_percent;
  solid.cells->update_all(solid.field);
  solid.seen = solid.told = solid.celled = solid.field.step();
  solid.bridged = solid.ahead_of = Solid::kNever;
  if (solid.bridges) solid.bridges->forget();
  solid.followed = Solid::kNever;
  solid.gone_m3 = removed_m3(s);
  solid.summed = solid.field.step();
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
