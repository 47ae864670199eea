// The inner loops of a cut: rows of 8 nodes side by side in vector registers. Each lane computes
// what scalar code would, so the bits do not depend on the registers.
#include "field/cut_rows.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr int kRow = BlockGrid::kSide;
constexpr float kLowest = -32767.0f;

struct Float3 {
  float x, y, z;
  explicit Float3(const Vec3& v)
      : x(static_cast<float>(v.x())), y(static_cast<float>(v.y())), z(static_cast<float>(v.z())) {}
};

template <class RowWork>
void for_rows(const BlockRows& rows, float cell, float* out, const RowWork& work) {
  const auto row = [&](int j, int k) {
    work(static_cast<float>(j) * cell, static_cast<float>(k) * cell, out + 64 * k + kRow * j);
  };
  for (int k = rows.k0; k <= rows.k1; ++k) {
    // Without a question in between, the compiler joins a whole layer's rows.
    if (rows.has_all())
      for (int j = rows.j0; j <= rows.j1; ++j) row(j, k);
    else
      for (int j = rows.j0; j <= rows.j1; ++j)
        if (rows.has(j, k)) row(j, k);
  }
}

// Mean of what chords of length `cell` cut off a circle of that radius: cell^2 / 12 radius; times
// the count of directions in which the face is curved.
double cut_off(double cell_m, double radius_m, double directions) {
  return directions * cell_m * cell_m / (12 * radius_m);
}

void rod_rows(const PlacedPart& placed, const RoundRod& rod, const Vec3& lo, double cell_m,
              const BlockRows& rows, float* out) {
  const Vec3 start = placed.rod_start(rod), along = placed.rod_end(rod) - start;
  const double long_m = along.norm();
  // A ball is curved both ways, its way one; a way of many short steps has something of both.
  const double directions = long_m > 0 ? 1.5 : 2;
  const float r = static_cast<float>(1e6 * (rod.radius + cut_off(cell_m, rod.radius, directions)));
  const float length = static_cast<float>(1e6 * long_m), cell = static_cast<float>(1e6 * cell_m);
  const Float3 s(1e6 * (start - lo)), u(long_m > 0 ? Vec3(along / long_m) : Vec3(Vec3::UnitX()));
  for_rows(rows, cell, out, [&](float y0, float z0, float* row) {
    const float y = y0 - s.y, z = z0 - s.z, beside = y * u.y + z * u.z;
    for (int i = 0; i < kRow; ++i) {
      const float x = static_cast<float>(i) * cell - s.x;
      float t = x * u.x + beside;
      t = t < 0 ? 0 : t;
      t = t > length ? length : t;
      const float qx = x - t * u.x, qy = y - t * u.y, qz = z - t * u.z;
      const float d = std::sqrt(qx * qx + qy * qy + qz * qz) - r;
      row[i] = d > row[i] ? d : row[i];
    }
  });
}

// How much farther out a turned face is put: a cone's radius counts by where its area lies.
double turned_extra(const TurnedFace& face, double widest_m, double cell_m) {
  if (face.n_rho == 0 || !(widest_m > 0)) return 0;
  return face.n_rho * cut_off(cell_m, widest_m, face.n_z == 0 ? 1 : 2);
}

void turned_rows(const PlacedPart& placed, const Vec3& lo, double cell_m, const BlockRows& rows,
                 float* out) {
  const float cell = static_cast<float>(1e6 * cell_m);
  const Float3 s(1e6 * (placed.X_BT.p - lo)), u(placed.X_BT.rotate(Vec3::UnitZ()));
  const double widest = placed.part->box.hi.x();
  for (const TurnedFace& face : placed.part->faces) {
    const float n_rho = static_cast<float>(face.n_rho), n_z = static_cast<float>(face.n_z);
    const float offset =
        static_cast<float>(1e6 * (face.offset + turned_extra(face, widest, cell_m)));
    for_rows(rows, cell, out, [&](float y0, float z0, float* row) {
      const float y = y0 - s.y, z = z0 - s.z, beside = y * u.y + z * u.z;
      for (int i = 0; i < kRow; ++i) {
        const float x = static_cast<float>(i) * cell - s.x;
        const float t = x * u.x + beside;
        const float qx = x - t * u.x, qy = y - t * u.y, qz = z - t * u.z;
        const float d = std::sqrt(qx * qx + qy * qy + qz * qz) * n_rho + t * n_z - offset;
        row[i] = d > row[i] ? d : row[i];
      }
    });
  }
}

void plane_rows(const PlacedPart& placed, const Plane& plane, const Vec3& lo, double cell_m,
                const BlockRows& rows, float* out) {
  const float cell = static_cast<float>(1e6 * cell_m);
  const Vec3 n_B = placed.X_BT.rotate(plane.n);
  const Float3 n(n_B);
  const float offset = static_cast<float>(1e6 * (plane.d + n_B.dot(placed.X_BT.p - lo)));
  for_rows(rows, cell, out, [&](float y, float z, float* row) {
    const float beside = y * n.y + z * n.z - offset;
    for (int i = 0; i < kRow; ++i) {
      const float d = static_cast<float>(i) * cell * n.x + beside;
      row[i] = d > row[i] ? d : row[i];
    }
  });
}

std::int32_t occupied(std::int32_t height, std::int32_t cell) {
  const std::int32_t share = cell / 2 - height;
  return share < 0 ? 0 : share > cell ? cell : share;
}

// Shares of the row's cells that were taken, by layer.
void add_removed(const std::int32_t* before, const std::int16_t* after, const UncutHeights& height,
                 int first, const CutScale& scale, Lowered& out) {
  const std::int16_t *all = height.all + first, *bare = height.bare + first;
  const bool covered = height.all != height.bare;
  std::int32_t taken[kRow];
  for (int i = 0; i < kRow; ++i)
    taken[i] = (occupied(after[i], scale.cell) - occupied(before[i], scale.cell)) *
               occupied(all[i], scale.cell);
  for (std::size_t l = 0; l < scale.layers; ++l) {
    const std::int32_t border = l > 0 ? scale.layer[l] : covered ? 0 : -32768;
    std::int32_t sum = 0;
    for (int i = 0; i < kRow; ++i) sum += -bare[i] >= border ? taken[i] : 0;
    out.removed[l] += sum;
  }
  if (!covered) return;
  std::int32_t cartilage = 0;
  for (int i = 0; i < kRow; ++i) cartilage += bare[i] > 0 ? taken[i] : 0;
  out.cartilage += cartilage;
}

}  // namespace

// A row is as far from the way as from its start, less the way's length. Rounding is far below the
// margin.
BlockRows near_ball(const PlacedPart& ball, const Vec3& lo_B, double cell_m, double reach_m,
                    const BlockRows& rows) {
  constexpr double kMargin_m = 2e-6;
  const RoundRod& rod = ball.part->rods[0];
  const Vec3 start = ball.rod_start(rod) - lo_B;
  const double far = rod.radius + cut_off(cell_m, rod.radius, 2) + ball.way.norm() + reach_m;
  const double beside = std::max({-start.x(), start.x() - (kRow - 1) * cell_m, 0.0});
  const double left = (far + kMargin_m) * (far + kMargin_m) - beside * beside;
  BlockRows out = rows;
  out.asked = 0;
  for (int k = rows.k0; k <= rows.k1; ++k)
    for (int j = rows.j0; j <= rows.j1; ++j) {
      const double y = j * cell_m - start.y(), z = k * cell_m - start.z();
      if (y * y + z * z <= left) out.asked |= std::uint64_t{1} << (8 * k + j);
    }
  return out;
}

void part_distances(const PlacedPart& placed, const Vec3& lo_B, double cell_m,
                    const BlockRows& rows, float* out_um) {
  for_rows(rows, 0, out_um, [](float, float, float* row) {
    for (int i = 0; i < kRow; ++i) row[i] = kLowest;
  });
  for (const RoundRod& rod : placed.part->rods) rod_rows(placed, rod, lo_B, cell_m, rows, out_um);
  if (!placed.part->faces.empty()) turned_rows(placed, lo_B, cell_m, rows, out_um);
  for (const Plane& plane : placed.part->planes)
    plane_rows(placed, plane, lo_B, cell_m, rows, out_um);
}

Lowered lower_cuts(const float* distance_um, const CutScale& scale, const BlockRows& rows,
                   const UncutHeights& height, std::int16_t* cut) {
  Lowered out;
  std::int32_t near_lane[kRow] = {};
  const float reach = static_cast<float>(scale.reach);
  for (int k = rows.k0; k <= rows.k1; ++k)
    for (int j = rows.j0; j <= rows.j1; ++j) {
      if (!rows.has(j, k)) continue;
      const int first = 64 * k + kRow * j;
      const float* d = distance_um + first;
      std::int16_t* c = cut + first;
      std::int32_t before[kRow], near[kRow], any = 0, any_near = 0;
      for (int i = 0; i < kRow; ++i) {
        const float x = d[i] < kLowest ? kLowest : d[i];
        const std::int32_t um = x < reach ? static_cast<std::int32_t>(x + 32768.5f) - 32768 : 32767;
        before[i] = c[i];
        const std::int32_t lower = um < before[i] ? 1 : 0;
        c[i] = static_cast<std::int16_t>(um < before[i] ? um : before[i]);
        near[i] = lower & (before[i] > -scale.reach ? 1 : 0);
        any |= lower;
        any_near |= near[i];
      }
      if (any == 0) continue;
      out.any = true;
      if (any_near == 0) continue;
      out.near = true;
      for (int i = 0; i < kRow; ++i) near_lane[i] |= near[i];
      out.sides = static_cast<std::uint8_t>(out.sides | (j < 2 ? 4 : 0) | (j > 5 ? 8 : 0) |
                                            (k < 2 ? 16 : 0) | (k > 5 ? 32 : 0));
      add_removed(before, c, height, first, scale, out);
    }
  const bool low = (near_lane[0] | near_lane[1]) != 0, high = (near_lane[6] | near_lane[7]) != 0;
  out.sides = static_cast<std::uint8_t>(out.sides | (low ? 1 : 0) | (high ? 2 : 0));
  return out;
}

bool reaches(const float* distance_um, const CutScale& scale, const BlockRows& rows) {
  const float reach = static_cast<float>(scale.reach);
  int any = 0;
  for (int k = rows.k0; k <= rows.k1; ++k)
    for (int j = rows.j0; j <= rows.j1; ++j)
      for (int i = 0; rows.has(j, k) && i < kRow; ++i)
        any |= distance_um[64 * k + kRow * j + i] < reach ? 1 : 0;
  return any != 0;
}

}  // namespace osteon
