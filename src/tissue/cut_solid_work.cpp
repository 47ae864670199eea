#include "osteon/tissue/cut_solid_work.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "envelope.h"
#include "hex/hex_stiffness.h"
#include "osteon/base/check.h"
#include "osteon/base/union_find.h"
#include "pressed_solid_impl.h"

namespace osteon {
namespace {

constexpr double kLeastPart = 0.02;  // of a cell: less has no stiffness
constexpr double kGround = 1e-4;     // holds what hangs on nothing: times the stiffness of a cell
constexpr int kRowsAStep = 40;

// Corners of a cell on its side beyond axis k, and those of the other cell that they fall on.
bool is_upper(int corner, int axis) { return (corner >> axis & 1) != 0; }

}  // namespace

struct CutSolidWork::Impl {
  std::unique_ptr<PressedSolid::Impl> made = std::make_unique<PressedSolid::Impl>();
  std::shared_ptr<const PressedSolid> done;
  std::unique_ptr<Envelope> matrix;
  Envelope::Columns columns;
  bool lies = false;
  std::size_t rows = 0, solved = 0;

  void find_parts(const PressedSolid::Impl& whole, const std::vector<CutCell>& cells);
  void number_nodes(const PressedSolid::Impl& whole, const std::vector<std::uint32_t>& from);
  void begin_matrix();
  void assemble();
  void solve_some();
};

// Every part brings eight corners; parts that go on in one another share the four of that side.
void CutSolidWork::Impl::find_parts(const PressedSolid::Impl& whole,
                                    const std::vector<CutCell>& cells) {
  FilledCells& out = made->cells;
  std::vector<std::array<std::uint32_t, CutCell::kParts>> part_of(cells.size());
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> from;
  for (std::uint32_t e = 0; e < cells.size(); ++e) {
    part_of[e].fill(kNone);
    for (std::uint32_t a = 0; a < cells[e].count; ++a) {
      if (cells[e].left[a] < kLeastPart) continue;
      part_of[e][a] = static_cast<std::uint32_t>(from.size());
      from.push_back(e);
      out.fill.push_back(whole.cells.fill[e] * cells[e].left[a]);
      if (!whole.cells.pull.empty()) out.pull.push_back(whole.cells.pull[e]);
      made->middles.push_back(cells[e].middle[a]);
    }
  }
  made->links.resize(from.size());
  UnionFind nodes(8 * from.size());
  std::map<std::uint32_t, std::uint32_t> by_low;  // a cell by its lowest node
  for (std::uint32_t e = 0; e < cells.size(); ++e) by_low[whole.cells.corners[e][0]] = e;
  for (std::uint32_t e = 0; e < cells.size(); ++e)
    for (int axis = 0; axis < 3; ++axis) {
      const auto there = by_low.find(whole.cells.corners[e][std::size_t{1} << axis]);
      if (there == by_low.end()) continue;
      for (std::uint32_t a = 0; a < CutCell::kParts; ++a)
        for (std::uint32_t b = 0; b < CutCell::kParts; ++b) {
          const std::uint32_t p = part_of[e][a], q = part_of[there->second][b];
          const bool goes_on =
              (cells[e].beyond[static_cast<std::size_t>(axis)] >> (4 * a + b) & 1) != 0;
          if (!goes_on || p == kNone || q == kNone) continue;
          made->links[p].push_back(q);
          made->links[q].push_back(p);
          for (int c = 0; c < 8; ++c)
            if (is_upper(c, axis))
              nodes.join(8 * p + static_cast<std::uint32_t>(c),
                         8 * q + static_cast<std::uint32_t>(c & ~(1 << axis)));
        }
    }
  out.corners.resize(from.size());
  for (std::uint32_t p = 0; p < from.size(); ++p)
    for (std::uint32_t c = 0; c < 8; ++c) out.corners[p][c] = nodes.find(8 * p + c);
  number_nodes(whole, from);
}

// From part to part, breadth first, which keeps rows short (Cuthill and McKee 1969): first to find
// a part that is far off, then from there.
void CutSolidWork::Impl::number_nodes(const PressedSolid::Impl& whole,
                                      const std::vector<std::uint32_t>& from) {
  FilledCells& out = made->cells;
  const auto walk = [&](std::uint32_t start) {
    std::vector<std::uint32_t> order;
    std::vector<bool> seen(from.size(), false);
    for (std::size_t n = 0; n <= from.size(); ++n) {
      const auto next = n == 0 ? start : static_cast<std::uint32_t>(n - 1);
      if (next >= from.size() || seen[next]) continue;
      seen[next] = true;
      order.push_back(next);
      for (std::size_t at = order.size() - 1; at < order.size(); ++at)
        for (const std::uint32_t to : made->links[order[at]])
          if (!seen[to]) {
            seen[to] = true;
            order.push_back(to);
          }
    }
    return order;
  };
  if (from.empty()) return;
  std::map<std::uint32_t, std::uint32_t> number;
  for (const std::uint32_t p : walk(walk(0).back()))
    for (std::uint32_t c = 0; c < 8; ++c) {
      const auto [it, is_new] =
          number.emplace(out.corners[p][c], static_cast<std::uint32_t>(out.nodes.size()));
      out.corners[p][c] = it->second;
      if (!is_new) continue;
      const std::uint32_t was = whole.cells.corners[from[p]][c];
      out.nodes.push_back(whole.cells.nodes[was]);
      made->held.push_back(whole.held[was]);
      made->rests.push_back(whole.rests[was]);
    }
}

void CutSolidWork::Impl::begin_matrix() {
  const auto& corners = made->cells.corners;
  std::vector<std::size_t> low(made->cells.nodes.size());
  std::iota(low.begin(), low.end(), std::size_t{0});
  for (const auto& part : corners) {
    const std::uint32_t least = *std::min_element(part.begin(), part.end());
    for (const std::uint32_t n : part) low[n] = std::min<std::size_t>(low[n], least);
  }
  std::vector<std::size_t> first;
  for (const std::size_t n : low)
    for (int r = 0; r < 3; ++r) first.push_back(3 * n);
  matrix = std::make_unique<Envelope>(std::move(first));
  columns.resize(matrix->size());
  const auto size = static_cast<Eigen::Index>(matrix->size());
  made->lifted.resize(size, size);
  made->lying.resize(size, size);
  assemble();
}

void CutSolidWork::Impl::assemble() {
  matrix->clear();
  const FilledCells& cells = made->cells;
  const Eigen::Matrix<double, 24, 24> cube = cells.cell_m * unit_cube_stiffness(made->poisson);
  for (std::size_t e = 0; e < cells.corners.size(); ++e)
    for (int a = 0; a < 24; ++a)
      for (int b = 0; b < 24; ++b) {
        const std::size_t i = 3 * std::size_t{cells.corners[e][static_cast<std::size_t>(a / 3)]} +
                              static_cast<std::size_t>(a % 3);
        const std::size_t j = 3 * std::size_t{cells.corners[e][static_cast<std::size_t>(b / 3)]} +
                              static_cast<std::size_t>(b % 3);
        if (j > i) continue;
        matrix->at(i, j) += cells.fill[e] * cube(a, b);
        if (a % 3 == b % 3)
          matrix->at(i, j) += pulled_stiffness(cells, e, static_cast<std::size_t>(a / 3),
                                               static_cast<std::size_t>(b / 3));
      }
  const double hold = kSupportHolds * cells.cell_m, ground = kGround * cells.cell_m;
  for (std::size_t n = 0; n < cells.nodes.size(); ++n)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c <= r; ++c) {
        double k = r == c ? ground : 0;
        if (made->held[n])
          k += r == c ? hold : 0;
        else if (lies && made->rests[n])
          k += hold * made->up[r] * made->up[c];
        matrix->at(3 * n + static_cast<std::size_t>(r), 3 * n + static_cast<std::size_t>(c)) += k;
      }
  rows = solved = 0;
}

// The inverse is symmetric: of a column, what lies below the diagonal is solved for and put beside
// it as well. What cannot lie has the same ways there: put down column by column, since a copy of
// all of them would take more than a step may.
void CutSolidWork::Impl::solve_some() {
  Eigen::MatrixXd& ways = lies ? made->lying : made->lifted;
  const bool both = !made->can_lie();
  const std::size_t wide = std::min(Envelope::kWide, matrix->size() - solved);
  for (std::size_t i = solved; i < columns.size(); ++i) columns[i].fill(0);
  for (std::size_t c = 0; c < wide; ++c) columns[solved + c][c] = 1;
  matrix->solve(columns, solved);
  for (std::size_t c = 0; c < wide; ++c) {
    const auto column = static_cast<Eigen::Index>(solved + c);
    for (std::size_t i = solved + c; i < columns.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      ways(row, column) = ways(column, row) = columns[i][c];
      if (both) made->lying(row, column) = made->lying(column, row) = columns[i][c];
    }
  }
  solved += wide;
}

CutSolidWork::CutSolidWork(std::shared_ptr<const PressedSolid> whole,
                           const std::vector<CutCell>& cells)
    : impl_(std::make_unique<Impl>()) {
  demand(whole && !whole->impl_->whole && cells.size() == whole->cells(),
         "a solid is cut from a whole one, cell by cell");
  PressedSolid::Impl& made = *impl_->made;
  made.up = whole->impl_->up;
  made.stiffness_n_per_m = whole->impl_->stiffness_n_per_m;
  made.poisson = whole->impl_->poisson;
  made.cells.cell_m = whole->impl_->cells.cell_m;
  made.cells.fibres = whole->impl_->cells.fibres;
  impl_->find_parts(*whole->impl_, cells);
  made.whole = std::move(whole);
  if (!made.middles.empty()) impl_->begin_matrix();
}
CutSolidWork::~CutSolidWork() = default;

bool CutSolidWork::step() {
  Impl& work = *impl_;
  if (work.done) return true;
  if (!work.matrix) {  // nothing is left: it is pressed as if it were whole, and never met
    work.done = work.made->whole;
    return true;
  }
  if (work.rows < work.matrix->size()) {
    for (int n = 0; n < kRowsAStep && work.rows < work.matrix->size(); ++n)
      work.matrix->factor_row(work.rows++);
    return false;
  }
  work.solve_some();
  if (work.solved < work.matrix->size()) return false;
  if (!work.lies && work.made->can_lie()) {
    work.lies = true;
    work.assemble();
    return false;
  }
  work.done = std::shared_ptr<const PressedSolid>(new PressedSolid(std::move(work.made)));
  return true;
}

std::shared_ptr<const PressedSolid> CutSolidWork::take() { return impl_->done; }

}  // namespace osteon
