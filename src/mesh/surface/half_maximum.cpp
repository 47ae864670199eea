#include "surface/half_maximum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "osteon/mesh/measure.h"
#include "osteon/mesh/taubin.h"

namespace osteon {
namespace {

constexpr int kInward = 14, kOutward = 12;  // steps of the profile
constexpr double kStep_m = 0.0001;
constexpr double kLeastContrast_hu = 250;
constexpr double kLongest_m = 0.001;
constexpr int kEvenRounds = 3;

using Profile = std::array<double, kInward + kOutward + 1>;

Profile profile_at(const Volume& volume, const Vec3& p_V, const Vec3& normal_V, double step_m) {
  Profile profile{};
  for (int s = -kInward; s <= kOutward; ++s) {
    const Vec3 at = p_V + s * step_m * normal_V;
    profile[static_cast<std::size_t>(s + kInward)] =
        sample_linear(volume, at.cwiseQuotient(volume.frame.spacing_m));
  }
  return profile;
}

/// Steps from the vertex outwards to the half level; none where there is no edge of bone.
std::optional<double> edge_of(const Profile& profile, double soft_hu) {
  // The peak: brightest from well inside to just outside, else the next bone would be taken.
  const auto peak = std::max_element(profile.begin(), profile.begin() + kInward + 5);
  if (*peak - soft_hu < kLeastContrast_hu) return std::nullopt;
  const double half = 0.5 * (*peak + soft_hu);
  double lowest = *peak;
  for (auto at = peak; at + 1 != profile.end(); ++at) {
    if (at[1] < half) {
      const double share = (at[0] - half) / (at[0] - at[1]);
      return static_cast<double>(at - profile.begin()) + share - kInward;
    }
    lowest = std::min(lowest, at[1]);
    // Past a valley the next bone begins: the edge lies at its bottom.
    if (at[1] > lowest + 0.1 * (*peak - soft_hu)) {
      const auto bottom = std::min_element(peak, at + 1);
      return static_cast<double>(bottom - profile.begin()) - kInward;
    }
  }
  return std::nullopt;
}

struct Moves {
  std::vector<double> length_m, weight;
};

Moves find_moves(const Volume& volume, double soft_hu, const TriMesh& mesh,
                 const std::vector<Vec3>& normals) {
  Moves moves;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto edge = edge_of(profile_at(volume, mesh.vertices[v], normals[v], kStep_m), soft_hu);
    const double length = edge ? *edge * kStep_m : 0;
    moves.length_m.push_back(std::clamp(length, -kLongest_m, kLongest_m));
    moves.weight.push_back(edge && std::abs(length) <= kLongest_m ? 1 : 0.02);
  }
  return moves;
}

/// Weighted means over the neighbours.
void even_out(const VertexRings& rings, Moves& moves) {
  for (int round = 0; round < kEvenRounds; ++round) {
    Moves old = moves;
    for (std::size_t v = 0; v < old.weight.size(); ++v) {
      double sum = 2 * old.weight[v] * old.length_m[v], weight = 2 * old.weight[v], count = 2;
      for (std::uint32_t n = rings.first[v]; n < rings.first[v + 1]; ++n) {
        const std::uint32_t other = rings.neighbour[n];
        sum += old.weight[other] * old.length_m[other];
        weight += old.weight[other];
        count += 1;
      }
      moves.length_m[v] = sum / weight;
      moves.weight[v] = weight / count;
    }
  }
}

}  // namespace

void snap_to_half_maximum(const Volume& volume, double soft_hu, TriMesh& mesh_V) {
  const std::vector<Vec3> normals = vertex_normals(mesh_V);
  Moves moves = find_moves(volume, soft_hu, mesh_V, normals);
  even_out(vertex_rings(mesh_V), moves);
  for (std::size_t v = 0; v < mesh_V.vertices.size(); ++v)
    mesh_V.vertices[v] += moves.length_m[v] * normals[v];
}

}  // namespace osteon
