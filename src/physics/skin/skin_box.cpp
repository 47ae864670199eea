#include "skin/skin_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace osteon {
namespace {

constexpr double kFadesOver_m = 0.003;      // the patch fades into skin that is not felt
constexpr double kYieldsAtOnce_m = 0.0001;  // so much higher counts though nothing is dented yet
constexpr int kNodes = 9;   // of a face, along each side: there the skin is looked up
constexpr int kWithin = 3;  // pieces of the way between two nodes

double eased(double x) {
  const double s = std::clamp(x, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

using FaceGrid = std::array<std::array<double, kNodes>, kNodes>;

// A face that looks down: of the core, in the box's axes, with what each node is deep.
struct Face {
  Eigen::Index k = 0, i = 1, j = 2;  // across it, along it
  double side = 1;
  double shadow_m2 = 0;  // of the whole face of the box, from above
  FaceGrid deep_m{}, felt{};
};

// Faces of the box that look down; at least one, at most three.
struct FacesDown {
  std::array<Face, 3> all;
  std::size_t count = 0;
};

Vec3 core_at(const RoundBox& box, const Face& face, double u, double v) {
  Vec3 core;
  core[face.k] = face.side * box.half[face.k];
  core[face.i] = (2 * u - 1) * box.half[face.i];
  core[face.j] = (2 * v - 1) * box.half[face.j];
  return core;
}

struct Under {
  double deep_m = 0;
  Vec3 p_S = Vec3::Zero(), n_S = Vec3::UnitZ();
};

Under under(const SkinPatch& patch, const Vec3& q_S, double radius) {
  const SkinRelief::Place here = patch.relief.at(q_S.head<2>());
  Under out;
  out.n_S = Vec3(-here.slope.x(), -here.slope.y(), 1).normalized();
  out.p_S = {q_S.x(), q_S.y(), here.height_m};
  out.deep_m = radius - (q_S.z() - here.height_m) * out.n_S.z();
  return out;
}

// The deepest node that is felt at all; none: the box is beside the patch.
std::optional<double> look_under(const SkinPatch& patch, const RoundBox& box, Face& face) {
  std::optional<double> deepest;
  for (std::size_t a = 0; a < kNodes; ++a)
    for (std::size_t b = 0; b < kNodes; ++b) {
      const double u = static_cast<double>(a) / (kNodes - 1);
      const double v = static_cast<double>(b) / (kNodes - 1);
      const Vec3 q_S = box.X * core_at(box, face, u, v);
      face.felt[a][b] = felt_share(patch, q_S.head<2>());
      face.deep_m[a][b] = under(patch, q_S, box.rod.radius).deep_m;
      if (face.felt[a][b] > 0 && !(deepest && *deepest >= face.deep_m[a][b]))
        deepest = face.deep_m[a][b];
    }
  return deepest;
}

FacesDown faces_down(const RoundBox& box) {
  const Vec3 down_B = box.X.q.conjugate() * Vec3(0, 0, -1);
  FacesDown out;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double looks = std::abs(down_B[k]);
    if (!(looks > 1e-9)) continue;
    Face& face = out.all[out.count++];
    face.k = k;
    face.i = (k + 1) % 3;
    face.j = (k + 2) % 3;
    face.side = down_B[k] < 0 ? -1 : 1;
    face.shadow_m2 =
        looks * 4 * (box.half[face.i] + box.rod.radius) * (box.half[face.j] + box.rod.radius);
  }
  return out;
}

double between_nodes(const FaceGrid& grid, double u, double v) {
  const double x = u * (kNodes - 1), y = v * (kNodes - 1);
  const auto a = std::min(static_cast<std::size_t>(x), std::size_t{kNodes - 2});
  const auto b = std::min(static_cast<std::size_t>(y), std::size_t{kNodes - 2});
  const double s = x - static_cast<double>(a), t = y - static_cast<double>(b);
  return (1 - s) * ((1 - t) * grid[a][b] + t * grid[a][b + 1]) +
         s * ((1 - t) * grid[a + 1][b] + t * grid[a + 1][b + 1]);
}

struct Pressing {
  double area_m2 = 0, felt_m2 = 0;
  Vec3 moment = Vec3::Zero();  // places in the box's axes, by what is felt of them
};

void add_face(const RoundBox& box, const Face& face, double deepest_m, Pressing& sum) {
  constexpr int kPieces = kWithin * (kNodes - 1);
  const double scale = std::max(deepest_m, 0.0) + kYieldsAtOnce_m;
  const double piece_m2 = face.shadow_m2 / (kPieces * kPieces);
  for (int a = 0; a < kPieces; ++a)
    for (int b = 0; b < kPieces; ++b) {
      const double u = (a + 0.5) / kPieces, v = (b + 0.5) / kPieces;
      const double deep = between_nodes(face.deep_m, u, v);
      const double area = piece_m2 * (1 - eased(2 * (deepest_m - deep) / scale - 0.5));
      const double felt = area * between_nodes(face.felt, u, v);
      sum.area_m2 += area;
      sum.felt_m2 += felt;
      sum.moment += felt * core_at(box, face, u, v);
    }
}

}  // namespace

double felt_share(const SkinPatch& patch, const SheetPoint& p) {
  const double inside =
      std::min(0.5 * patch.width_m - std::abs(p.x()), 0.5 * patch.height_m - std::abs(p.y()));
  return eased(inside / kFadesOver_m);
}

// Symbols: d_i, depth of piece i of the faces that look down; d, of the deepest node; a_i, its area
// from above; f_i, how much is felt there. Piece i presses by a_i (1 - s), where s goes from 0 to 1
// while d - d_i goes from a quarter of d to three quarters: about half of d, without a step as the
// box tilts. The place is the mean of the pieces by f_i a_i (1 - s), let down along the normal
// until it is as deep as d.
std::optional<BoxOnSkin> box_on_skin(const SkinPatch& patch, const RoundBox& box_S) {
  FacesDown faces = faces_down(box_S);
  std::optional<double> deepest;
  for (std::size_t n = 0; n < faces.count; ++n) {
    const auto here = look_under(patch, box_S, faces.all[n]);
    if (here && !(deepest && *deepest >= *here)) deepest = here;
  }
  if (!deepest) return {};
  Pressing sum;
  for (std::size_t n = 0; n < faces.count; ++n) add_face(box_S, faces.all[n], *deepest, sum);
  if (!(sum.felt_m2 > 0)) return {};
  BoxOnSkin out;
  out.deep_m = *deepest;
  out.radius_m = std::sqrt(sum.area_m2 / std::numbers::pi);
  const Vec3 place_S = box_S.X * Vec3(sum.moment / sum.felt_m2);
  const Under at = under(patch, place_S, box_S.rod.radius);
  out.p_S = at.p_S;
  out.n_S = at.n_S;
  out.core = box_S.X.inverse() * Vec3(place_S - (out.deep_m - at.deep_m) * at.n_S);
  return out;
}

}  // namespace osteon
