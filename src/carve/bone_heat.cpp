#include "osteon/carve/bone_heat.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace osteon {
namespace {

constexpr int kHeatSide = BlockGrid::kSide, kHeatWide = kHeatSide + 2;
constexpr int kNodesToACell = 2;        // nodes of the field to a cell
constexpr double kHeatStepShare = 0.8;  // of the largest stable step h^2 / (6 a)
constexpr double kGrows_k = 0.1;        // at a block's rim: the block beside it is made
constexpr double kRests_k = 0.05;       // less, here and beside it: nothing is conducted
constexpr double kRinsed_k = 0.5;       // water is followed where bone is so warm
constexpr double kWater_j_per_m3_k = 4.18e6;

std::size_t heat_cell(int i, int j, int k) {
  return static_cast<std::size_t>((k * kHeatSide + j) * kHeatSide + i);
}
std::size_t wide_cell(int i, int j, int k) {
  return static_cast<std::size_t>(((k + 1) * kHeatWide + j + 1) * kHeatWide + i + 1);
}
int heat_block(int cell) { return cell >= 0 ? cell / kHeatSide : -1; }

// Whether bone is at a node of the field now.
bool has_bone(const CarvedField& field, const std::array<int, 3>& node) {
  const BlockGrid& grid = field.grid();
  const std::array<int, 3> place{heat_block(node[0]), heat_block(node[1]), heat_block(node[2])};
  if (!grid.holds(place)) return false;
  const std::uint32_t block = grid.index(place);
  const std::size_t n = heat_cell(node[0] % kHeatSide, node[1] % kHeatSide, node[2] % kHeatSide);
  const UncutField::Place lies = field.bone().place(block);
  if (lies == UncutField::Place::kOutside) return false;
  if (lies == UncutField::Place::kStored && field.bone().stored(block)[n] >= 0) return false;
  const std::int16_t* const cuts = field.cuts(block);
  return !cuts || cuts[n] > 0;
}

// Of eight cells in a row, with those about them at the steps of a widened block; `open` gets how
// many of a cell's faces look at what is gone.
void conduct_row(const double* above, const std::uint8_t* gone, double share, double* next,
                 std::uint8_t* open) {
  constexpr std::ptrdiff_t kSteps[] = {1, kHeatWide, kHeatWide * kHeatWide};
  for (std::ptrdiff_t i = 0; i < kHeatSide; ++i) {
    double flow = 0;
    int faces = 0;
    for (const std::ptrdiff_t step : kSteps) {
      const int low = gone[i - step], high = gone[i + step];
      flow += (1 - low) * (above[i - step] - above[i]);
      flow += (1 - high) * (above[i + step] - above[i]);
      faces += low + high;
    }
    const int is = 1 - gone[i];
    next[i] = is * (above[i] + share * flow);
    open[i] = static_cast<std::uint8_t>(is * faces);
  }
}

}  // namespace

// A block with the cells beside it.
struct BoneHeat::Around {
  std::array<double, kHeatWide * kHeatWide * kHeatWide> above;
  std::array<std::uint8_t, kHeatWide * kHeatWide * kHeatWide> gone;

  Around(const BoneHeat& heat, const Block& block) {
    const std::array<int, 3> here = heat.grid_.place(block.index);
    above.fill(0);
    gone.fill(0);
    for (int k = 0; k < kHeatSide; ++k)
      for (int j = 0; j < kHeatSide; ++j) {
        std::copy_n(&block.above[heat_cell(0, j, k)], kHeatSide, &above[wide_cell(0, j, k)]);
        std::copy_n(&block.gone[heat_cell(0, j, k)], kHeatSide, &gone[wide_cell(0, j, k)]);
      }
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1}) take_side(heat, block, here, axis, side);
  }

  // The cells of the block beside it that touch it. Where none is made yet its own cells look at
  // themselves: no heat passes there, so none is lost.
  void take_side(const BoneHeat& heat, const Block& own, std::array<int, 3> place, std::size_t axis,
                 int side) {
    place[axis] += side;
    const Block* const made = heat.at(place);
    const Block* const beside = made ? made : &own;
    constexpr std::array<std::size_t, 3> kCells{1, kHeatSide, kHeatSide * kHeatSide};
    constexpr std::array<std::size_t, 3> kWides{1, kHeatWide, kHeatWide * kHeatWide};
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const std::size_t from = (side > 0) == (made != nullptr) ? 0 : (kHeatSide - 1) * kCells[axis];
    const std::size_t to = kWides[u] + kWides[v] + (side > 0 ? (kHeatWide - 1) * kWides[axis] : 0);
    for (std::size_t a = 0; a < kHeatSide; ++a)
      for (std::size_t b = 0; b < kHeatSide; ++b) {
        const std::size_t cell = from + a * kCells[u] + b * kCells[v];
        above[to + a * kWides[u] + b * kWides[v]] = beside->above[cell];
        gone[to + a * kWides[u] + b * kWides[v]] = made ? made->gone[cell] : 0;
      }
  }
};

std::uint8_t HeatVolume::byte_of(double celsius) {
  return static_cast<std::uint8_t>(
      std::lround(255 * std::clamp((celsius - kFrom_c) / (kTo_c - kFrom_c), 0.0, 1.0)));
}

double HeatVolume::celsius_of(std::uint8_t byte) {
  return kFrom_c + (kTo_c - kFrom_c) * byte / 255.0;
}

double rinse_share(double w_per_k, double flow_m3_s) {
  if (!(w_per_k > 0) || !(flow_m3_s > 0)) return 0;
  const double units = w_per_k / (flow_m3_s * kWater_j_per_m3_k);
  return -std::expm1(-units) / units;
}

BoneHeat::BoneHeat(const CarvedField& field, const HeatMaterial& material)
    : material_(material),
      stride_(kNodesToACell),
      epoch_(field.epoch()),
      hottest_c_(material.body_c) {
  const BlockGrid& fine = field.grid();
  grid_.cell_m = stride_ * fine.cell_m;
  grid_.lo = fine.lo;
  for (std::size_t k = 0; k < 3; ++k) grid_.blocks[k] = (fine.blocks[k] + stride_ - 1) / stride_;
  slot_.assign(grid_.count(), -1);
}

BoneHeat::Block* BoneHeat::at(const std::array<int, 3>& place) {
  if (!grid_.holds(place)) return nullptr;
  const std::int32_t slot = slot_[grid_.index(place)];
  return slot < 0 ? nullptr : &blocks_[static_cast<std::size_t>(slot)];
}

const BoneHeat::Block* BoneHeat::at(const std::array<int, 3>& place) const {
  return const_cast<BoneHeat*>(this)->at(place);
}

BoneHeat::Block* BoneHeat::make(const CarvedField& field, const std::array<int, 3>& place) {
  if (Block* const there = at(place)) return there;
  if (!grid_.holds(place) || blocks_.size() >= kMostBlocks) return nullptr;
  slot_[grid_.index(place)] = static_cast<std::int32_t>(blocks_.size());
  Block& block = blocks_.emplace_back();
  block.index = grid_.index(place);
  look(field, block);
  return &block;
}

void BoneHeat::look(const CarvedField& field, Block& block) const {
  const std::array<int, 3> place = grid_.place(block.index);
  for (int k = 0; k < kHeatSide; ++k)
    for (int j = 0; j < kHeatSide; ++j)
      for (int i = 0; i < kHeatSide; ++i) {
        const std::size_t c = heat_cell(i, j, k);
        block.gone[c] = !has_bone(
            field, {stride_ * (kHeatSide * place[0] + i), stride_ * (kHeatSide * place[1] + j),
                    stride_ * (kHeatSide * place[2] + k)});
        if (block.gone[c]) block.above[c] = 0;
      }
}

// Only blocks that a cut has changed since are looked at.
void BoneHeat::follow(const CarvedField& field) {
  const bool all = field.epoch() != epoch_;
  if (all)
    for (Block& block : blocks_) look(field, block);
  std::vector<Block*> changed;
  for (std::size_t n = 0; !all && n < field.block_count(); ++n) {
    if (field.changed_at(n) <= seen_) continue;
    std::array<int, 3> place = field.grid().place(field.block_at(n));
    for (int& x : place) x /= stride_;
    Block* const block = at(place);
    if (block && std::find(changed.begin(), changed.end(), block) == changed.end())
      changed.push_back(block);
  }
  for (Block* block : changed) look(field, *block);
  seen_ = field.step();
  epoch_ = field.epoch();
}

template <class Each>
void BoneHeat::each_cell_within(const CarvedField& field, const Vec3& p_B, double reach_m,
                                Each each) {
  std::array<int, 3> lo{}, hi{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const double x = (p_B[axis] - grid_.lo[axis]) / grid_.cell_m, r = reach_m / grid_.cell_m;
    const double last = kHeatSide * grid_.blocks[k] - 1;
    lo[k] = static_cast<int>(std::clamp(std::ceil(x - r), 0.0, last + 1));
    hi[k] = static_cast<int>(std::clamp(std::floor(x + r), -1.0, last));
  }
  for (int k = lo[2]; k <= hi[2]; ++k)
    for (int j = lo[1]; j <= hi[1]; ++j)
      for (int i = lo[0]; i <= hi[0]; ++i) {
        if ((grid_.node(i, j, k) - p_B).norm() > reach_m) continue;
        Block* const block = make(field, {i / kHeatSide, j / kHeatSide, k / kHeatSide});
        const std::size_t c = heat_cell(i % kHeatSide, j % kHeatSide, k % kHeatSide);
        if (block && !block->gone[c]) each(*block, c, grid_.node(i, j, k));
      }
}

bool BoneHeat::spread(const CarvedField& field, const HeatSource& source) {
  const double least = source.ball ? 0 : source.radius_m - 1.5 * grid_.cell_m;
  const double most = source.radius_m + 1.5 * grid_.cell_m;
  // Of what turns about its axis, bone beside the tip's height; of a ball what lies before it.
  const auto takes = [&](const Vec3& p_B) {
    const Vec3 d = p_B - source.tip_B;
    const double along = d.dot(source.axis_B);
    if (source.ball) return along < 0.5 * source.radius_m + 1.5 * grid_.cell_m;
    return std::abs(along) < 0.75 * grid_.cell_m && (d - along * source.axis_B).norm() > least;
  };
  std::size_t count = 0;
  each_cell_within(field, source.tip_B, most,
                   [&](const Block&, std::size_t, const Vec3& p_B) { count += takes(p_B); });
  if (count == 0) return false;
  const double cell3 = grid_.cell_m * grid_.cell_m * grid_.cell_m;
  const double rise = source.joules / static_cast<double>(count) /
                      (material_.density_kg_per_m3 * material_.heat_capacity_j_per_kg_k * cell3);
  each_cell_within(field, source.tip_B, most, [&](Block& block, std::size_t c, const Vec3& p_B) {
    if (takes(p_B)) block.above[c] += rise;
  });
  return true;
}

void BoneHeat::add(const CarvedField& field, const HeatSource& source) {
  const bool finite = is_finite(source.tip_B) && is_finite(source.axis_B) &&
                      std::isfinite(source.radius_m) && std::isfinite(source.joules);
  if (!finite || !(source.joules > 0) || !(source.radius_m >= 0)) return;
  follow(field);
  if (spread(field, source)) return;
  HeatSource around = source;
  around.ball = true;
  (void)spread(field, around);
}

// Blocks at whose rim it is warm get a neighbour there.
void BoneHeat::grow(const CarvedField& field) {
  std::vector<std::array<int, 3>> wanted;
  for (const Block& block : blocks_) {
    if (block.hottest < kGrows_k) continue;
    const std::array<int, 3> here = grid_.place(block.index);
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1}) {
        std::array<int, 3> there = here;
        there[static_cast<std::size_t>(axis)] += side;
        if (!grid_.holds(there) || slot_[grid_.index(there)] >= 0) continue;
        bool warm = false;
        for (int a = 0; a < kHeatSide * kHeatSide && !warm; ++a) {
          std::array<int, 3> cell{a / kHeatSide, a / kHeatSide, a / kHeatSide};
          cell[static_cast<std::size_t>((axis + 2) % 3)] = a % kHeatSide;
          cell[static_cast<std::size_t>(axis)] = side > 0 ? kHeatSide - 1 : 0;
          warm = block.above[heat_cell(cell[0], cell[1], cell[2])] >= kGrows_k;
        }
        if (warm) wanted.push_back(there);
      }
  }
  for (const auto& place : wanted) (void)make(field, place);
}

bool BoneHeat::rests(const Block& block) const {
  if (block.hottest >= kRests_k) return false;
  const std::array<int, 3> here = grid_.place(block.index);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1}) {
      std::array<int, 3> there = here;
      there[axis] += side;
      const Block* const beside = at(there);
      if (beside && beside->hottest >= kRests_k) return false;
    }
  return true;
}

// What is gone takes no part.
void BoneHeat::conduct(Block& block, const Around& around, double share) const {
  for (int k = 0; k < kHeatSide; ++k)
    for (int j = 0; j < kHeatSide; ++j)
      conduct_row(&around.above[wide_cell(0, j, k)], &around.gone[wide_cell(0, j, k)], share,
                  &block.next[heat_cell(0, j, k)], &block.open[heat_cell(0, j, k)]);
}

void BoneHeat::conduct(double dt_s) {
  const double share = material_.diffusivity_m2_per_s() * dt_s / (grid_.cell_m * grid_.cell_m);
  std::vector<Block*> moved;
  for (Block& block : blocks_) {
    if (rests(block)) continue;
    conduct(block, Around(*this, block), share);
    moved.push_back(&block);
  }
  for (Block* block : moved) {
    block->above = block->next;
    block->hottest = *std::max_element(block->above.begin(), block->above.end());
  }
}

// A cell loses h (T - water) through each face towards what is open; solved implicitly, so that a
// large step ends at the water's temperature, not beyond it.
void BoneHeat::rinse(double dt_s, const Irrigation& water, double flow_m3_s) {
  const auto wet = [](const Block& block) { return block.hottest >= kRinsed_k; };
  double faces = 0;
  for (const Block& block : blocks_)
    if (wet(block))
      for (const std::uint8_t open : block.open) faces += open;
  const double per_face = water.transfer_w_per_m2_k * grid_.cell_m * grid_.cell_m;
  const double transfer = water.transfer_w_per_m2_k * rinse_share(per_face * faces, flow_m3_s);
  const double capacity =
      material_.density_kg_per_m3 * material_.heat_capacity_j_per_kg_k * grid_.cell_m;
  const double cold = water.water_c - material_.body_c;
  for (Block& block : blocks_) {
    if (!wet(block)) continue;
    for (std::size_t c = 0; c < BlockGrid::kNodes; ++c) {
      if (block.open[c] == 0) continue;
      const double rate = transfer * block.open[c] / capacity * dt_s;
      block.above[c] = (block.above[c] + rate * cold) / (1 + rate);
    }
  }
}

void BoneHeat::note(double dt_s) {
  double most = 0;
  for (Block& block : blocks_) {
    if (block.hottest < kRests_k) continue;
    for (std::size_t c = 0; c < BlockGrid::kNodes; ++c)
      block.most[c] = std::max(block.most[c], static_cast<float>(block.above[c]));
    most = std::max(most, block.hottest);
    for (std::size_t r = 0; r < block.hot_s.size(); ++r) {
      const double limit = material_.necrosis[r].above_c - material_.body_c;
      if (block.hottest < limit) continue;
      for (std::size_t c = 0; c < BlockGrid::kNodes; ++c)
        if (block.above[c] >= limit) block.hot_s[r][c] += static_cast<float>(dt_s);
    }
  }
  hottest_c_ = std::max(hottest_c_, material_.body_c + most);
}

void BoneHeat::step(const CarvedField& field, double dt_s, const Irrigation& water,
                    double flow_m3_s) {
  if (!(dt_s > 0) || !std::isfinite(dt_s)) return;
  follow(field);
  for (Block& block : blocks_)
    block.hottest = *std::max_element(block.above.begin(), block.above.end());
  const double largest =
      kHeatStepShare * grid_.cell_m * grid_.cell_m / (6 * material_.diffusivity_m2_per_s());
  const int steps = std::max(1, static_cast<int>(std::ceil(std::min(dt_s / largest, 1e5))));
  for (int i = 0; i < steps; ++i) {
    grow(field);
    conduct(dt_s / steps);
    if (flow_m3_s > 0) rinse(dt_s / steps, water, flow_m3_s);
  }
  note(dt_s);
}

double BoneHeat::temperature_at(const Vec3& p_B) const {
  const Vec3 u = (p_B - grid_.lo) / grid_.cell_m;
  if (!is_finite(u) || u.cwiseAbs().maxCoeff() > 1e6) return material_.body_c;
  std::array<int, 3> cell{};
  for (std::size_t k = 0; k < 3; ++k)
    cell[k] = static_cast<int>(std::lround(u[static_cast<Eigen::Index>(k)]));
  const Block* const block = at({heat_block(cell[0]), heat_block(cell[1]), heat_block(cell[2])});
  if (!block) return material_.body_c;
  return material_.body_c +
         block->above[heat_cell(cell[0] % kHeatSide, cell[1] % kHeatSide, cell[2] % kHeatSide)];
}

double BoneHeat::hottest_at(const Vec3& p_B) const {
  const Vec3 u = (p_B - grid_.lo) / grid_.cell_m;
  if (!is_finite(u) || u.cwiseAbs().maxCoeff() > 1e6) return material_.body_c;
  // The most of the eight cells about the place: some of them lie outside of the bone.
  float most = 0;
  for (int n = 0; n < 8; ++n) {
    std::array<int, 3> cell{};
    for (std::size_t k = 0; k < 3; ++k)
      cell[k] = static_cast<int>(std::floor(u[static_cast<Eigen::Index>(k)])) +
                (n >> static_cast<int>(k) & 1);
    if (const Block* const block =
            at({heat_block(cell[0]), heat_block(cell[1]), heat_block(cell[2])}))
      most = std::max(
          most,
          block->most[heat_cell(cell[0] % kHeatSide, cell[1] % kHeatSide, cell[2] % kHeatSide)]);
  }
  return material_.body_c + static_cast<double>(most);
}

bool BoneHeat::dead(const Block& block, std::size_t cell) const {
  for (std::size_t r = 0; r < block.hot_s.size(); ++r)
    if (static_cast<double>(block.hot_s[r][cell]) >= material_.necrosis[r].for_s - 1e-3)
      return true;
  return false;
}

double BoneHeat::necrosis_m3(std::size_t rule) const {
  if (rule >= material_.necrosis.size()) return 0;
  const double for_s = material_.necrosis[rule].for_s - 1e-3;  // sums of steps are not whole
  std::size_t count = 0;
  for (const Block& block : blocks_)
    for (std::size_t c = 0; c < BlockGrid::kNodes; ++c)
      count += !block.gone[c] && static_cast<double>(block.hot_s[rule][c]) >= for_s ? 1 : 0;
  return static_cast<double>(count) * grid_.cell_m * grid_.cell_m * grid_.cell_m;
}

double BoneHeat::energy_j() const {
  double sum = 0;
  for (const Block& block : blocks_)
    for (const double rise : block.above) sum += rise;
  return sum * material_.density_kg_per_m3 * material_.heat_capacity_j_per_kg_k * grid_.cell_m *
         grid_.cell_m * grid_.cell_m;
}

HeatVolume BoneHeat::volume() const {
  HeatVolume out;
  if (blocks_.empty()) return out;
  std::array<int, 3> lo = grid_.blocks, hi{};
  for (const Block& block : blocks_) {
    const std::array<int, 3> place = grid_.place(block.index);
    for (std::size_t k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], place[k]);
      hi[k] = std::max(hi[k], place[k] + 1);
    }
  }
  for (std::size_t k = 0; k < 3; ++k) out.count[k] = kHeatSide * (hi[k] - lo[k]);
  out.cell_m = grid_.cell_m;
  out.lo_B = grid_.node(kHeatSide * lo[0], kHeatSide * lo[1], kHeatSide * lo[2]);
  out.cells.assign(static_cast<std::size_t>(out.count[0]) * static_cast<std::size_t>(out.count[1]) *
                       static_cast<std::size_t>(out.count[2]),
                   {0, 0});
  const auto cell_of = [&](int i, int j, int k) -> std::array<std::uint8_t, 2>& {
    return out.cells[static_cast<std::size_t>((k * out.count[1] + j) * out.count[0] + i)];
  };
  std::vector<std::array<int, 3>> warm;
  for (const Block& block : blocks_) {
    const std::array<int, 3> place = grid_.place(block.index);
    for (std::size_t c = 0; c < BlockGrid::kNodes; ++c) {
      if (block.gone[c] || !(block.most[c] > 0)) continue;
      const int n = static_cast<int>(c);
      const std::array<int, 3> cell{kHeatSide * (place[0] - lo[0]) + n % kHeatSide,
                                    kHeatSide * (place[1] - lo[1]) + n / kHeatSide % kHeatSide,
                                    kHeatSide * (place[2] - lo[2]) + n / kHeatSide / kHeatSide};
      const std::uint8_t byte =
          HeatVolume::byte_of(material_.body_c + static_cast<double>(block.most[c]));
      if (byte == 0) continue;
      cell_of(cell[0], cell[1], cell[2]) = {byte,
                                            static_cast<std::uint8_t>(dead(block, c) ? 255 : 0)};
      warm.push_back(cell);
    }
  }
  // The surface lies between bone and what is gone: there it shows the bone's.
  const std::vector<std::array<std::uint8_t, 2>> bone = out.cells;
  for (const auto& [x, y, z] : warm) {
    const std::array<std::uint8_t, 2> from =
        bone[static_cast<std::size_t>((z * out.count[1] + y) * out.count[0] + x)];
    for (int n = 0; n < 27; ++n) {
      const int i = x + n % 3 - 1, j = y + n / 3 % 3 - 1, k = z + n / 9 - 1;
      if (i < 0 || j < 0 || k < 0 || i >= out.count[0] || j >= out.count[1] || k >= out.count[2])
        continue;
      const Block* const there =
          at({lo[0] + i / kHeatSide, lo[1] + j / kHeatSide, lo[2] + k / kHeatSide});
      if (!there || !there->gone[heat_cell(i % kHeatSide, j % kHeatSide, k % kHeatSide)]) continue;
      std::array<std::uint8_t, 2>& cell = cell_of(i, j, k);
      cell = {std::max(cell[0], from[0]), std::max(cell[1], from[1])};
    }
  }
  return out;
}

}  // namespace osteon
