#include "osteon/scene/felt_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "case/union_surface.h"
#include "osteon/mesh/distance.h"
#include "osteon/mesh/joint_ends.h"
#include "osteon/mesh/longest_edge.h"

namespace osteon {
namespace {

// How finely crossings of pieces are told apart, m: for figures, and for a picture, which is made
// whenever a case is opened.
constexpr double kSeam = 0.00015;
constexpr double kPictureSeam = 0.0006;

/// A point that stands for a part of a surface.
struct Sample {
  Vec3 p;
  double area = 0;
};

void add_samples(const std::array<Vec3, 3>& t, double spacing2, std::vector<Sample>& out) {
  const auto [longest, length2] = longest_edge(t);
  const Vec3& a = t[longest];
  const Vec3& b = t[(longest + 1) % 3];
  const Vec3& c = t[(longest + 2) % 3];
  if (length2 <= spacing2) {
    out.push_back({(a + b + c) / 3, 0.5 * (b - a).cross(c - a).norm()});
    return;
  }
  const Vec3 middle = 0.5 * (a + b);
  add_samples({a, middle, c}, spacing2, out);
  add_samples({middle, b, c}, spacing2, out);
}

std::vector<Sample> samples_of(const TriMesh& mesh, double spacing_m) {
  std::vector<Sample> out;
  for (const Triangle& t : mesh.triangles)
    add_samples({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]},
                spacing_m * spacing_m, out);
  return out;
}

/// Of distances with their areas.
SurfaceGap summed_up(std::vector<std::pair<double, double>> gaps) {
  SurfaceGap out;
  if (gaps.empty()) return out;
  std::sort(gaps.begin(), gaps.end());
  double area = 0;
  for (const auto& [gap, part] : gaps) {
    area += part;
    out.mean += gap * part;
  }
  out.max = gaps.back().first;
  if (!(area > 0)) return out;
  out.mean /= area;
  double below = 0;
  for (const auto& [gap, part] : gaps) {
    below += part;
    out.p95 = gap;
    if (below >= 0.95 * area) break;
  }
  return out;
}

/// Of a whole surface and of a bone's ends.
struct Gaps {
  SurfaceGap all, at_ends;
};

template <class Height>
Gaps gaps(const std::vector<Sample>& samples, const JointEnds& ends, const Height& height) {
  std::vector<std::pair<double, double>> all, at_ends;
  all.reserve(samples.size());
  for (const Sample& s : samples) {
    all.emplace_back(std::abs(height(s.p)), s.area);
    if (!ends.on_shaft(s.p)) at_ends.push_back(all.back());
  }
  return {summed_up(std::move(all)), summed_up(std::move(at_ends))};
}

FeltDistance both_ways(const Gaps& to_felt, const Gaps& to_mesh) {
  return {to_felt.all, to_mesh.all, to_felt.at_ends, to_mesh.at_ends};
}

/// The zero of a field below or above p, by Newton's method; none where the band ends.
std::optional<Vec3> foot(const DistanceField& field, Vec3 p) {
  constexpr int kSteps = 6;
  constexpr double kClose = 1e-8;
  for (int i = 0; i < kSteps; ++i) {
    const FieldSample s = field.at(p);
    const double slope2 = s.gradient.squaredNorm();
    if (!(slope2 > 0.01)) return std::nullopt;
    p -= s.distance / slope2 * s.gradient;
    if (std::abs(s.distance) < kClose) return p;
  }
  return std::abs(field.at(p).distance) < 10 * kClose ? std::optional<Vec3>(p) : std::nullopt;
}

/// Points of a field's surface: the feet of the nodes next to it. They lie about a cell apart.
std::vector<Sample> samples_of(const DistanceField& field) {
  const FieldData& d = field.data();
  std::vector<Sample> out;
  const double cell = d.cell_m;
  for (int k = 0; k < d.blocks[2] * FieldData::kSide; ++k)
    for (int j = 0; j < d.blocks[1] * FieldData::kSide; ++j)
      for (int i = 0; i < d.blocks[0] * FieldData::kSide; ++i) {
        const Vec3 node = d.lo + cell * Vec3(i, j, k);
        const FieldSample s = field.at(node);
        if (!s.near || std::abs(s.distance) > 0.5 * cell) continue;
        if (const auto p = foot(field, node)) out.push_back({*p, cell * cell});
      }
  return out;
}

FeltDistance of_field(const Bone& bone, const MeshDistance& mesh, double spacing_m) {
  const TriMesh& drawn = bone.covered ? bone.covered->touched() : bone.mesh;
  const DistanceField& field = *bone.field;
  const auto to_felt = [&](const Vec3& p) {
    const auto at = foot(field, p);
    return at ? (*at - p).norm() : std::abs(field.at(p).distance);
  };
  const auto to_mesh = [&](const Vec3& p) {
    return bone.covered ? bone.covered->closest(p).signed_distance
                        : mesh.closest(p).signed_distance;
  };
  const JointEnds ends(bone.mesh);
  return both_ways(gaps(samples_of(drawn, spacing_m), ends, to_felt),
                   gaps(samples_of(field), ends, to_mesh));
}

bool inside(const std::vector<Hull>& pieces, const Vec3& p) {
  return std::any_of(pieces.begin(), pieces.end(), [&](const Hull& piece) {
    return std::all_of(piece.planes.begin(), piece.planes.end(),
                       [&](const Plane& plane) { return plane.signed_distance(p) <= 0; });
  });
}

}  // namespace

FeltDistance felt_distance(const Bone& bone, double spacing_m) {
  if (bone.mesh.triangles.empty()) return {};
  const MeshDistance mesh(bone.mesh);
  if (bone.field) return of_field(bone, mesh, spacing_m);
  const MeshDistance felt(union_surface(bone.pieces, kSeam));
  if (felt.mesh().triangles.empty()) return {};
  const auto to_felt = [&](const Vec3& p) { return felt.closest(p).signed_distance; };
  const auto to_mesh = [&](const Vec3& p) { return mesh.closest(p).signed_distance; };
  const JointEnds ends(bone.mesh);
  return both_ways(gaps(samples_of(bone.mesh, spacing_m), ends, to_felt),
                   gaps(samples_of(felt.mesh(), spacing_m), ends, to_mesh));
}

std::vector<double> felt_heights(const Bone& bone, std::span<const Vec3> points_B) {
  std::vector<double> out;
  out.reserve(points_B.size());
  if (points_B.empty()) return out;
  if (bone.field) {
    for (const Vec3& v : points_B) out.push_back(-bone.field->at(v).distance);
    return out;
  }
  const MeshDistance felt(union_surface(bone.pieces, kPictureSeam));
  for (const Vec3& v : points_B) {
    const double gap = felt.mesh().triangles.empty() ? 0 : felt.closest(v).signed_distance;
    out.push_back(inside(bone.pieces, v) ? std::abs(gap) : -std::abs(gap));
  }
  return out;
}

}  // namespace osteon
