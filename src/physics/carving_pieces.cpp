// Bone that hangs on nothing any more falls off, and what is lost has no mass.
#include <algorithm>

#include "osteon/physics/carving.h"
#include "osteon/scene/carve_events.h"

namespace osteon {

// Where a state was put back all is looked at again: with the same cuts nothing more is found.
void Carving::drop_pieces(std::span<const ToolState* const> tools, const BoneSnapshot& bones) {
  for (std::uint32_t b = 0; b < bones_.size(); ++b) {
    Bone& bone = bones_[b];
    if (!bone.field || bone.field->block_count() == 0) continue;
    if (bone.field->step() == bone.looked_step && bone.field->epoch() == bone.looked_epoch)
      continue;
    drop_pieces_of(b, tools, b < bones.count ? bones.bones[b].X_WB : Pose{});
    bone.looked_step = bone.field->step();
    bone.looked_epoch = bone.field->epoch();
  }
}

// Of a piece that is larger than dust a body is made, before it is gone from the bone.
bool Carving::drop_piece(std::uint32_t b, const LoosePiece& piece, const Pose& X_WB) {
  Bone& bone = bones_[b];
  const bool dust = piece.volume_m3 < kDust_m3;
  auto shape = dust || !pieces_ ? nullptr : PieceShape::of(*bone.field, *bone.loose, piece, b);
  if (!bone.loose->take_away(*bone.field, piece, setup_->air_m)) return false;
  if (shape && !pieces_->add(shape, X_WB)) shape = nullptr;
  fallen_.push_back({b, piece.volume_m3, dust, std::move(shape)});
  return true;
}

void Carving::drop_pieces_of(std::uint32_t b, std::span<const ToolState* const> tools,
                             const Pose& X_WB) {
  Bone& bone = bones_[b];
  std::size_t hand = 0;  // that cut it
  while (hand < count_ && hands_[hand].bone != b) ++hand;
  if (hand >= tools.size() || hand >= count_) hand = 0;
  const std::uint64_t before = bone.field->step();
  for (const LoosePiece& piece : bone.loose->find(*bone.field)) {
    if (!drop_piece(b, piece, X_WB)) {
      if (!full_ && !tools.empty()) tell_of(hand, *tools[hand], kCarvingFull, b, {});
      full_ = true;
      continue;
    }
    const bool dust = fallen_.back().dust;
    if (!dust) let_go_of(piece, b, tools);
    if (!dust && !tools.empty())
      tell_of(hand, *tools[hand], kPieceOff, b, {1e9 * piece.volume_m3, 0, 0});
  }
  for (std::size_t n = 0; n < bone.field->block_count(); ++n)
    if (bone.field->changed_at(n) > before) changed_.push_back({b, bone.field->block_at(n)});
}

// A hole that was in it holds no drill any more, and a pin that stood in it is gone with it. Dust
// about a hole leaves the hole.
void Carving::let_go_of(const LoosePiece& piece, std::uint32_t bone,
                        std::span<const ToolState* const> tools) {
  const BlockGrid& grid = bones_[bone].field->grid();
  Aabb box;
  box.include(grid.node(piece.first[0], piece.first[1], piece.first[2]));
  box.include(grid.node(piece.last[0], piece.last[1], piece.last[2]));
  const auto inside = [&](const Vec3& p) {
    return (p.array() >= box.lo.array() - grid.cell_m).all() &&
           (p.array() <= box.hi.array() + grid.cell_m).all();
  };
  for (std::size_t n = 0; n < count_; ++n) {
    CarvingHand& h = hands_[n];
    if (h.bone != bone || !h.in_hole || !inside(h.mouth_B)) continue;
    if (n < tools.size()) end_hole(n, *tools[n]);
  }
  for (LeftHole& hole : holes_)
    if (hole.bone == bone && inside(hole.mouth_B)) hole = {};
  for (std::size_t r = 0; r < rods_.size(); ++r) {
    const GuideRod& rod = rods_[r];
    const Vec3 mouth = rod.X_BR.p + rod.in_bone_m * (rod.X_BR.q * Vec3::UnitZ());
    if (rod.kind == GuideRod::Kind::kPin && rod.bone == bone && inside(rod.X_BR.p) && inside(mouth))
      drop_rod(r);
  }
}

// What rests on bone falls on when bone is cut or moves.
void Carving::step_pieces(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                          double step_s, const PieceSoftGround* softs) {
  pieces_->step(tools, bones, carved_fields_, !changed_.empty(), step_s, softs);
  for (const PieceNews& news : pieces_->news()) {
    using Is = PieceNews::Is;
    const EventKind kind = news.is == Is::kHeld     ? kPieceHeld
                           : news.is == Is::kLetGo  ? kPieceLetGo
                           : news.is == Is::kSucked ? kPieceSucked
                                                    : kPieceOut;
    const std::size_t hand = news.hand < tools.size() ? news.hand : 0;
    if (tools.empty()) continue;
    tell_of(hand, *tools[hand], kind, news.bone, {1e9 * news.volume_m3, 0, 0});
    if (!events_.empty()) events_.back().p_W = news.p_W;
  }
}

std::span<const FallenPiece> Carving::pieces() const {
  return pieces_ ? std::span<const FallenPiece>(pieces_->state().pieces)
                 : std::span<const FallenPiece>();
}

std::span<const PieceNews> Carving::piece_news() const {
  return pieces_ ? pieces_->news() : std::span<const PieceNews>();
}

double Carving::mass_kg(const FallenPiece& piece, double bone_mass_kg) const {
  const std::size_t b = piece.shape->grid().bone;
  if (b >= bones_.size() || !bones_[b].field || bones_[b].whole == 0) return 0;
  const double h = bones_[b].field->grid().cell_m;
  return bone_mass_kg * piece.shape->volume_m3() /
         (h * h * h * static_cast<double>(bones_[b].whole));
}

LooseBones Carving::loose() const { return pieces_ ? pieces_->shown() : LooseBones{}; }

void Carving::let_pieces_go() {
  if (pieces_) pieces_->let_all_go();
}

GoneBone Carving::gone() {
  GoneBone out;
  for (Bone& bone : bones_) {
    if (!bone.field) continue;
    const RemovedTissue::Counts& nodes = bone.tissue_gone->of(*bone.field);
    const double h = bone.field->grid().cell_m, each_m3 = h * h * h;
    std::int64_t all = 0;
    for (const std::int64_t of_tissue : nodes) all += of_tissue;
    const std::int64_t vascular = nodes[static_cast<std::size_t>(BoneTissue::kCancellous)] +
                                  nodes[static_cast<std::size_t>(BoneTissue::kMarrow)];
    out.all_m3 += each_m3 * static_cast<double>(all);
    out.vascular_m3 += each_m3 * static_cast<double>(vascular);
  }
  return out;
}

// Sums over nodes in whole cells, then once into metres: lo + h n.
BoneLoss Carving::loss(std::size_t b, double mass_kg) {
  BoneLoss out;
  if (b >= bones_.size() || !bones_[b].field || bones_[b].whole == 0) return out;
  const NodeMoments& gone = bones_[b].removed->of(*bones_[b].field);
  if (gone.count == 0) return out;
  const BlockGrid& grid = bones_[b].field->grid();
  const double h = grid.cell_m, each = mass_kg / static_cast<double>(bones_[b].whole);
  const auto number = [](std::int64_t n) { return static_cast<double>(n); };
  const double count = number(gone.count);
  const Vec3 sum(number(gone.first[0]), number(gone.first[1]), number(gone.first[2]));
  const auto& s = gone.second;
  Mat3 products;
  products << number(s[0]), number(s[3]), number(s[4]), number(s[3]), number(s[1]), number(s[5]),
      number(s[4]), number(s[5]), number(s[2]);
  out.mass_kg = each * count;
  out.first_B = each * (count * grid.lo + h * sum);
  out.second_B =
      each * (count * grid.lo * grid.lo.transpose() +
              h * (grid.lo * sum.transpose() + sum * grid.lo.transpose()) + h * h * products);
  return out;
}

}  // namespace osteon
