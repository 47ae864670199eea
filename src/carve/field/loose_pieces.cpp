// Parts of blocks are joined along the blocks' faces by union-find (Galler and Fischer 1964), each
// set named by its lowest part, so that the result does not depend on the order of joining.
#include "osteon/carve/loose_pieces.h"

#include <algorithm>

namespace osteon {
namespace {

constexpr std::uint8_t kMostLabels = 255;

// The node on one side of a block, `n` of 64: on the side beyond which a step along `axis` leads.
std::size_t face_node(int axis, int n, bool far_side) {
  const int a = n % 8, b = n / 8, c = far_side ? 7 : 0;
  const std::array<int, 3> at = axis == 0   ? std::array<int, 3>{c, a, b}
                                : axis == 1 ? std::array<int, 3>{a, c, b}
                                            : std::array<int, 3>{a, b, c};
  return static_cast<std::size_t>(64 * at[2] + 8 * at[1] + at[0]);
}

template <class Visit>
void for_neighbours_in_block(std::size_t node, const Visit& visit) {
  const std::size_t x = node % 8, y = node / 8 % 8, z = node / 64;
  if (x > 0) visit(node - 1);
  if (x < 7) visit(node + 1);
  if (y > 0) visit(node - 8);
  if (y < 7) visit(node + 8);
  if (z > 0) visit(node - 64);
  if (z < 7) visit(node + 64);
}

}  // namespace

// More parts than there are labels share the last: what is parted may then count as one, never the
// other way round.
template <class IsBone>
void LoosePieces::flood(const IsBone& is_bone, Labels& out) {
  out.of.fill(0);
  out.nodes.fill(0);
  out.count = 0;
  std::array<std::uint16_t, BlockGrid::kNodes> open;
  for (std::size_t start = 0; start < BlockGrid::kNodes; ++start) {
    if (out.of[start] != 0 || !is_bone(start)) continue;
    if (out.count < kMostLabels) ++out.count;
    std::size_t waiting = 0;
    const auto take = [&](std::size_t node) {
      if (out.of[node] != 0 || !is_bone(node)) return;
      out.of[node] = out.count;
      ++out.nodes[out.count];
      open[waiting++] = static_cast<std::uint16_t>(node);
    };
    take(start);
    while (waiting > 0) for_neighbours_in_block(open[--waiting], take);
  }
}

LoosePieces::LoosePieces(const CarvedField& field)
    : whole_nodes_(field.grid().count(), 0),
      many_(field.grid().count(), kNone),
      touches_(field.grid().count(), 0),
      slot_(field.grid().count(), kNone),
      carved_(field.most_blocks()),
      first_(field.grid().count(), 0) {
  for (std::uint32_t block = 0; block < whole_nodes_.size(); ++block) label_whole(field, block);
  note_touching(field);
  parent_.reserve(field.grid().count() + 8 * field.most_blocks());
  connect(field);
  keep_whole();
  weight_.reserve(parent_.capacity());
  home_.reserve(parent_.capacity());
  heaviest_.reserve(whole_root_.size());
  hanging_.reserve(parent_.capacity());
}

void LoosePieces::label_whole(const CarvedField& field, std::uint32_t block) {
  const UncutField::Place place = field.bone().place(block);
  if (place == UncutField::Place::kDeep) whole_nodes_[block] = BlockGrid::kNodes;
  if (place != UncutField::Place::kStored) return;
  const std::int16_t* heights = field.bone().stored(block);
  Labels labels;
  flood([&](std::size_t node) { return heights[node] < 0; }, labels);
  for (std::size_t l = 1; l <= labels.count; ++l) whole_nodes_[block] += labels.nodes[l];
  if (labels.count < 2) return;
  many_[block] = static_cast<std::uint32_t>(many_labels_.size());
  many_labels_.push_back(labels);
}

void LoosePieces::note_touching(const CarvedField& field) {
  const BlockGrid& grid = field.grid();
  for (std::uint32_t block = 0; block < touches_.size(); ++block) {
    if (whole_nodes_[block] == 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      std::array<int, 3> next = grid.place(block);
      ++next[static_cast<std::size_t>(axis)];
      if (!grid.holds(next) || whole_nodes_[grid.index(next)] == 0) continue;
      for (int n = 0; n < 64; ++n) {
        if (whole_label(field, block, face_node(axis, n, true)) == 0 ||
            whole_label(field, grid.index(next), face_node(axis, n, false)) == 0)
          continue;
        touches_[block] = static_cast<std::uint8_t>(touches_[block] | 1 << axis);
        break;
      }
    }
  }
}

// Before any cut: which parts belong together.
void LoosePieces::keep_whole() {
  whole_first_ = first_;
  whole_root_.resize(parent_.size());
  for (std::uint32_t part = 0; part < parent_.size(); ++part) whole_root_[part] = root(part);
}

std::uint8_t LoosePieces::whole_label(const CarvedField& field, std::uint32_t block,
                                      std::size_t node) const {
  if (many_[block] != kNone) return many_labels_[many_[block]].of[node];
  const std::int16_t* heights = field.bone().stored(block);
  if (!heights) return whole_nodes_[block] > 0 ? 1 : 0;
  return heights[node] < 0 ? 1 : 0;
}

const LoosePieces::Labels* LoosePieces::labels(std::uint32_t block) const {
  if (slot_[block] != kNone) return &carved_[slot_[block]];
  return many_[block] != kNone ? &many_labels_[many_[block]] : nullptr;
}

std::uint8_t LoosePieces::label_at(const CarvedField& field, std::uint32_t block,
                                   std::size_t node) const {
  const Labels* known = labels(block);
  return known ? known->of[node] : whole_label(field, block, node);
}

std::size_t LoosePieces::parts_of(std::uint32_t block) const {
  const Labels* known = labels(block);
  return known ? known->count : (whole_nodes_[block] > 0 ? 1u : 0u);
}

std::uint32_t LoosePieces::nodes_of(std::uint32_t block, std::uint8_t label) const {
  const Labels* known = labels(block);
  return known ? known->nodes[label] : whole_nodes_[block];
}

void LoosePieces::hang(const CarvedField& field,
                       const std::function<bool(const Vec3& p_B)>& holds) {
  const BlockGrid& grid = field.grid();
  hangs_ = true;
  held_.clear();
  for (std::uint32_t block = 0; block < whole_nodes_.size(); ++block) {
    if (whole_nodes_[block] == 0) continue;
    const auto at = grid.place(block);
    for (int n = 0; n < static_cast<int>(BlockGrid::kNodes); ++n) {
      const auto node = static_cast<std::size_t>(n);
      const Vec3 p_B = grid.node(8 * at[0] + n % 8, 8 * at[1] + n / 8 % 8, 8 * at[2] + n / 64);
      if (whole_label(field, block, node) != 0 && holds(p_B))
        held_.push_back({block, static_cast<std::uint16_t>(n)});
    }
  }
}

void LoosePieces::find_hanging(const CarvedField& field) {
  hanging_.assign(parent_.size(), 0);
  for (const Held& held : held_)
    if (const std::uint8_t label = label_at(field, held.block, held.node); label != 0)
      hanging_[root(first_[held.block] + label - 1u)] = 1;
}

bool LoosePieces::is_loose(std::uint32_t at) const {
  return hangs_ ? hanging_[at] == 0 : heaviest_[home_[at]] != at;
}

void LoosePieces::label_carved(const CarvedField& field) {
  const bool anew = !looked_ || field.epoch() != epoch_;
  if (anew) std::fill(slot_.begin(), slot_.end(), kNone);
  for (std::size_t n = 0; n < field.block_count(); ++n) {
    if (!anew && field.changed_at(n) <= since_) continue;
    const std::uint32_t block = field.block_at(n);
    const std::int16_t *cuts = field.cuts(block), *heights = field.heights(block);
    slot_[block] = static_cast<std::uint32_t>(n);
    flood([&](std::size_t node) { return heights[node] < 0 && cuts[node] > 0; }, carved_[n]);
  }
  since_ = field.step();
  epoch_ = field.epoch();
  looked_ = true;
}

std::uint32_t LoosePieces::root(std::uint32_t part) {
  while (parent_[part] != part) {
    parent_[part] = parent_[parent_[part]];
    part = parent_[part];
  }
  return part;
}

void LoosePieces::unite(std::uint32_t a, std::uint32_t b) {
  a = root(a);
  b = root(b);
  if (a < b) parent_[b] = a;
  if (b < a) parent_[a] = b;
}

void LoosePieces::connect_side(const CarvedField& field, std::uint32_t block, std::uint32_t beyond,
                               int axis) {
  if (!labels(block) && !labels(beyond)) {
    if ((touches_[block] >> axis & 1) != 0) unite(first_[block], first_[beyond]);
    return;
  }
  for (int n = 0; n < 64; ++n) {
    const std::uint8_t a = label_at(field, block, face_node(axis, n, true));
    if (a == 0) continue;
    const std::uint8_t b = label_at(field, beyond, face_node(axis, n, false));
    if (b != 0) unite(first_[block] + a - 1u, first_[beyond] + b - 1u);
  }
}

void LoosePieces::connect(const CarvedField& field) {
  const BlockGrid& grid = field.grid();
  parent_.clear();
  for (std::uint32_t block = 0; block < first_.size(); ++block) {
    first_[block] = static_cast<std::uint32_t>(parent_.size());
    for (std::size_t l = parts_of(block); l > 0; --l)
      parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
  }
  for (std::uint32_t block = 0; block < first_.size(); ++block) {
    if (parts_of(block) == 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      std::array<int, 3> next = grid.place(block);
      ++next[static_cast<std::size_t>(axis)];
      if (!grid.holds(next)) continue;
      const std::uint32_t beyond = grid.index(next);
      if (parts_of(beyond) > 0) connect_side(field, block, beyond, axis);
    }
  }
}

// Of the roots of one uncut bone the heaviest stays, of equals the first; where something hangs,
// all that hang. True: there are others.
bool LoosePieces::weigh(const CarvedField& field) {
  weight_.assign(parent_.size(), 0);
  home_.assign(parent_.size(), kNone);
  heaviest_.assign(whole_root_.size(), kNone);
  for (std::uint32_t block = 0; block < first_.size(); ++block)
    for (std::size_t l = 1; l <= parts_of(block); ++l) {
      const auto label = static_cast<std::uint8_t>(l);
      const std::uint32_t at = root(first_[block] + label - 1u);
      weight_[at] += nodes_of(block, label);
      if (home_[at] != kNone) continue;
      std::size_t node = 0;
      while (label_at(field, block, node) != label) ++node;
      const std::uint8_t whole = whole_label(field, block, node);
      home_[at] = whole_root_[whole_first_[block] + whole - 1u];
    }
  if (hangs_) find_hanging(field);
  for (std::uint32_t part = 0; part < parent_.size(); ++part) {
    if (home_[part] == kNone) continue;
    std::uint32_t& best = heaviest_[home_[part]];
    if (best == kNone || weight_[part] > weight_[best]) best = part;
  }
  for (std::uint32_t part = 0; part < parent_.size(); ++part)
    if (home_[part] != kNone && is_loose(part)) return true;
  return false;
}

void LoosePieces::add_part(const CarvedField& field, std::uint32_t block, std::uint8_t label,
                           LoosePiece& piece) const {
  const BlockGrid& grid = field.grid();
  const auto at = grid.place(block);
  piece.parts.push_back({block, label});
  for (int n = 0; n < static_cast<int>(BlockGrid::kNodes); ++n) {
    if (label_at(field, block, static_cast<std::size_t>(n)) != label) continue;
    const std::array<int, 3> node{8 * at[0] + n % 8, 8 * at[1] + n / 8 % 8, 8 * at[2] + n / 64};
    piece.middle_B += grid.node(node[0], node[1], node[2]);
    for (std::size_t a = 0; a < 3; ++a) {
      piece.first[a] = std::min(piece.first[a], node[a]);
      piece.last[a] = std::max(piece.last[a], node[a]);
    }
  }
}

void LoosePieces::collect(const CarvedField& field) {
  constexpr int kMost = 1 << 30;
  const double h = field.grid().cell_m;
  std::vector<std::uint32_t> piece_of(parent_.size(), kNone);
  for (std::uint32_t block = 0; block < first_.size(); ++block)
    for (std::size_t l = 1; l <= parts_of(block); ++l) {
      const auto label = static_cast<std::uint8_t>(l);
      const std::uint32_t at = root(first_[block] + label - 1u);
      if (!is_loose(at)) continue;
      if (piece_of[at] == kNone) {
        piece_of[at] = static_cast<std::uint32_t>(pieces_.size());
        LoosePiece& made = pieces_.emplace_back();
        made.volume_m3 = h * h * h * static_cast<double>(weight_[at]);
        made.first = {kMost, kMost, kMost};
        made.last = {-1, -1, -1};
      }
      add_part(field, block, label, pieces_[piece_of[at]]);
    }
  for (LoosePiece& piece : pieces_) piece.middle_B *= h * h * h / piece.volume_m3;
}

const std::vector<LoosePiece>& LoosePieces::find(const CarvedField& field) {
  pieces_.clear();
  label_carved(field);
  connect(field);
  if (weigh(field)) collect(field);
  return pieces_;
}

}  // namespace osteon
