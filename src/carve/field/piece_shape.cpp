#include "osteon/carve/piece_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "osteon/base/hash.h"
#include "osteon/mesh/isosurface.h"

namespace osteon {
namespace {

// Room about a piece in which its surface closes.
constexpr int kRoomNodes = 2;
// As far from its surface heights are asked for.
constexpr double kAskedCells = 3;

std::size_t count_of(const std::array<int, 3>& nodes) {
  return static_cast<std::size_t>(nodes[0]) * static_cast<std::size_t>(nodes[1]) *
         static_cast<std::size_t>(nodes[2]);
}

std::array<int, 3> place_of_node(const std::array<int, 3>& nodes, std::size_t n) {
  const int i = static_cast<int>(n);
  return {i % nodes[0], i / nodes[0] % nodes[1], i / nodes[0] / nodes[1]};
}

bool fits_together(const PieceGrid& grid) {
  const auto good = [](int n) { return n >= 2 && n <= (1 << 20); };
  if (!good(grid.nodes[0]) || !good(grid.nodes[1]) || !good(grid.nodes[2])) return false;
  const double product = 1.0 * grid.nodes[0] * grid.nodes[1] * grid.nodes[2];
  if (product > static_cast<double>(PieceShape::kMostNodes)) return false;
  return grid.cell_m > 1e-6 && grid.cell_m < 1 && is_finite(grid.lo_B) &&
         grid.heights.size() == count_of(grid.nodes);
}

}  // namespace

std::shared_ptr<const PieceShape> PieceShape::of(const CarvedField& field, const LoosePieces& found,
                                                 const LoosePiece& piece, std::uint32_t bone) {
  PieceGrid grid;
  grid.bone = bone;
  std::array<int, 3> first{}, last{};
  int stride = 1;
  for (;; ++stride) {
    for (std::size_t a = 0; a < 3; ++a) {
      first[a] = piece.first[a] - kRoomNodes * stride;
      grid.nodes[a] = (piece.last[a] + kRoomNodes * stride - first[a]) / stride + 2;
      last[a] = first[a] + stride * (grid.nodes[a] - 1);
    }
    if (1.0 * grid.nodes[0] * grid.nodes[1] * grid.nodes[2] <= static_cast<double>(kMostNodes))
      break;
  }
  grid.cell_m = stride * field.grid().cell_m;
  grid.lo_B = field.grid().node(first[0], first[1], first[2]);
  grid.heights = found.heights_of(field, piece, first, last, stride);
  return from(std::move(grid));
}

std::shared_ptr<const PieceShape> PieceShape::from(PieceGrid grid) {
  if (!fits_together(grid)) return nullptr;
  const std::shared_ptr<PieceShape> made(new PieceShape);
  made->grid_ = std::move(grid);
  if (!made->measure()) return nullptr;
  made->find_points();
  return made->points_B_.empty() ? nullptr : made;
}

double PieceShape::height_m(const std::array<int, 3>& at) const {
  const std::array<int, 3>& n = grid_.nodes;
  const auto index = (static_cast<std::size_t>(at[2]) * static_cast<std::size_t>(n[1]) +
                      static_cast<std::size_t>(at[1])) *
                         static_cast<std::size_t>(n[0]) +
                     static_cast<std::size_t>(at[0]);
  return 1e-6 * grid_.heights[index];
}

// Linear between nodes, whose heights are no larger than `most_m`.
double PieceShape::height_at(const Vec3& p_B, double most_m) const {
  std::array<int, 3> low{};
  std::array<double, 3> share{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const double x = (p_B[axis] - grid_.lo_B[axis]) / grid_.cell_m;
    low[a] = static_cast<int>(std::clamp(std::floor(x), 0.0, grid_.nodes[a] - 2.0));
    share[a] = std::clamp(x - low[a], 0.0, 1.0);
  }
  double sum = 0;
  for (int c = 0; c < 8; ++c) {
    const std::array<int, 3> up{c & 1, c >> 1 & 1, c >> 2};
    double weight = 1;
    std::array<int, 3> at = low;
    for (std::size_t a = 0; a < 3; ++a) {
      weight *= up[a] != 0 ? share[a] : 1 - share[a];
      at[a] += up[a];
    }
    sum += weight * std::clamp(height_m(at), -most_m, most_m);
  }
  return sum;
}

// Every node inside stands for a cube of one cell.
bool PieceShape::measure() {
  Hasher hasher;
  hasher.add(grid_.bone);
  hasher.add(grid_.cell_m);
  hasher.add(grid_.lo_B);
  for (const int n : grid_.nodes) hasher.add(n);
  hasher.bytes(grid_.heights.data(), grid_.heights.size() * sizeof(std::int16_t));
  hash_ = hasher.value();
  double count = 0;
  Vec3 sum = Vec3::Zero();
  Mat3 squares = Mat3::Zero();
  const Vec3 about = 0.5 * Vec3(grid_.nodes[0], grid_.nodes[1], grid_.nodes[2]);
  for (std::size_t n = 0; n < grid_.heights.size(); ++n) {
    if (grid_.heights[n] >= 0) continue;
    const auto at = place_of_node(grid_.nodes, n);
    const Vec3 p = Vec3(at[0], at[1], at[2]) - about;
    count += 1;
    sum += p;
    squares += p * p.transpose();
  }
  if (!(count > 0)) return false;
  const double h = grid_.cell_m;
  const Vec3 mean = sum / count;
  volume_m3_ = h * h * h * count;
  middle_B_ = grid_.lo_B + h * (about + mean);
  spread_m2_ = h * h * (squares / count - mean * mean.transpose() + Mat3::Identity() / 12);
  return true;
}

// Where the surface crosses the edges between nodes; of these the farthest first (Gonzalez 1985).
void PieceShape::find_points() {
  std::vector<Vec3> all;
  for (std::size_t n = 0; n < grid_.heights.size(); ++n) {
    const auto at = place_of_node(grid_.nodes, n);
    const double here = height_m(at);
    for (std::size_t a = 0; a < 3; ++a) {
      std::array<int, 3> next = at;
      if (++next[a] == grid_.nodes[a]) continue;
      const double there = height_m(next);
      if ((here < 0) == (there < 0)) continue;
      Vec3 p(at[0], at[1], at[2]);
      p[static_cast<Eigen::Index>(a)] += here / (here - there);
      all.push_back(grid_.lo_B + grid_.cell_m * p);
    }
  }
  std::vector<double> away(all.size(), std::numeric_limits<double>::infinity());
  for (const Vec3& p : all) reach_m_ = std::max(reach_m_, (p - middle_B_).norm());
  std::size_t next = 0;
  while (!all.empty() && points_B_.size() < kMostPoints && away[next] > 0) {
    const Vec3 taken = all[next];
    points_B_.push_back(taken);
    for (std::size_t k = 0; k < all.size(); ++k)
      away[k] = std::min(away[k], (all[k] - taken).squaredNorm());
    next = static_cast<std::size_t>(std::max_element(away.begin(), away.end()) - away.begin());
  }
}

Result<TriMesh> PieceShape::surface() const {
  Aabb box;
  box.include(grid_.lo_B);
  box.include(grid_.lo_B +
              grid_.cell_m * Vec3(grid_.nodes[0] - 1, grid_.nodes[1] - 1, grid_.nodes[2] - 1));
  IsosurfaceOptions options;
  options.cell_m = grid_.cell_m;
  options.relax_steps = 1;
  // Of a node deep inside it is not known how deep: heights say nothing beyond a few cells.
  const double known = kAskedCells * grid_.cell_m;
  options.slack_m = known;
  return isosurface([&](const Vec3& p) { return height_at(p, known); }, box, options);
}

}  // namespace osteon
