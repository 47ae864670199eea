#include "osteon/carve/removed.h"

#include <algorithm>

#include "field/node_window.h"

namespace osteon {
namespace {

constexpr int kParts = 4;  // of a cell along an axis where it is neither whole nor nothing

/// Eight values at a cell's corners, linear along each axis between them.
struct CellValues {
  std::array<double, 8> at{};
  double lowest() const { return *std::min_element(at.begin(), at.end()); }
  double highest() const { return *std::max_element(at.begin(), at.end()); }
  double value(double x, double y, double z) const {
    const auto row = [&](std::size_t n) { return (1 - x) * at[n] + x * at[n + 1]; };
    const double low = (1 - y) * row(0) + y * row(2), high = (1 - y) * row(4) + y * row(6);
    return (1 - z) * low + z * high;
  }
};

CellValues corners_of(const std::array<std::int16_t, NodeWindow::kCount>& values, int node) {
  CellValues cell;
  for (int c = 0; c < 8; ++c) {
    const int step = NodeWindow::index(c & 1, c >> 1 & 1, c >> 2) - NodeWindow::index(0, 0, 0);
    cell.at[static_cast<std::size_t>(c)] = values[static_cast<std::size_t>(node + step)];
  }
  return cell;
}

class Sum {
 public:
  explicit Sum(const CarvedField& field) : field_(field), cell_um_(1e6 * field.grid().cell_m) {}

  // `bare`: heights over the bone alone; the same as `bone` where nothing covers it.
  void add(const CellValues& bone, const CellValues& bare, const CellValues& cut) {
    if (cut.lowest() >= 0 || bone.lowest() >= 0) return;
    const BoneTissue deepest = tissue(bare.lowest()), highest = tissue(bare.highest());
    const bool one = (bare.lowest() < 0) == (bare.highest() < 0) && deepest == highest;
    if (cut.highest() < 0 && bone.highest() < 0 && one) {
      share_[static_cast<std::size_t>(bare.lowest() < 0 ? deepest : BoneTissue::kCartilage)] += 1;
      return;
    }
    for (int n = 0; n < kParts * kParts * kParts; ++n) add_part(bone, bare, cut, n);
  }

  ByTissue volumes() const {
    const double h = field_.grid().cell_m;
    ByTissue out = share_;
    for (double& v : out) v *= h * h * h;
    return out;
  }

 private:
  BoneTissue tissue(double height_um) const {
    return field_.layers().at(std::max(0.0, -1e-6 * height_um));
  }

  // A part counts by how much of it lies under each surface, as if these were planes across it.
  void add_part(const CellValues& bone, const CellValues& bare, const CellValues& cut, int n) {
    const auto middle = [](int i) { return (i + 0.5) / kParts; };
    const double x = middle(n % kParts), y = middle(n / kParts % kParts);
    const double z = middle(n / kParts / kParts);
    const double height = bare.value(x, y, z), wide = cell_um_ / kParts;
    const auto under = [&](double h) { return std::clamp(0.5 - h / wide, 0.0, 1.0); };
    const double cut_share = under(cut.value(x, y, z)) / (kParts * kParts * kParts);
    if (cut_share == 0) return;
    // Of each layer: what lies under its upper border, but not under that of the next.
    const auto& layers = field_.layers().layers;
    const double all = under(bone.value(x, y, z));
    double deeper = std::min(all, under(height));
    share_[static_cast<std::size_t>(BoneTissue::kCartilage)] += cut_share * (all - deeper);
    for (std::size_t l = 0; l < layers.size(); ++l) {
      const double from_here = deeper;
      deeper =
          l + 1 < layers.size() ? std::min(all, under(height + 1e6 * layers[l + 1].depth_m)) : 0;
      share_[static_cast<std::size_t>(layers[l].tissue)] += cut_share * (from_here - deeper);
    }
  }

  const CarvedField& field_;
  double cell_um_;
  ByTissue share_{};
};

}  // namespace

ByTissue removed_volume(const CarvedField& field) {
  std::vector<std::uint32_t> blocks;
  for (std::size_t n = 0; n < field.block_count(); ++n) blocks.push_back(field.block_at(n));
  // Sums of doubles have an order: that of the grid, not that of the cuts.
  std::sort(blocks.begin(), blocks.end());
  Sum sum(field);
  NodeWindow window;
  BareWindow bare;
  const bool covered = field.bone().bare() != nullptr;
  for (const std::uint32_t block : blocks) {
    read_window(field, field.grid().place(block), window);
    if (covered) read_bare(field, field.grid().place(block), bare);
    for (int n = 0; n < static_cast<int>(BlockGrid::kNodes); ++n) {
      const int node = NodeWindow::index(n % 8, n / 8 % 8, n / 64);
      const CellValues height = corners_of(window.height, node);
      sum.add(height, covered ? corners_of(bare, node) : height, corners_of(window.cut, node));
    }
  }
  return sum.volumes();
}

double total(const ByTissue& by_tissue) {
  double sum = 0;
  for (const double v : by_tissue) sum += v;
  return sum;
}

}  // namespace osteon
