#include "osteon/mesh/tet_improve.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "tet/tet_flips.h"
#include "tet/tet_smooth.h"
#include "tet/tet_work.h"

namespace osteon {
namespace {

constexpr std::array<std::array<std::size_t, 2>, 6> kEdges = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

class Improver {
 public:
  Improver(TetWork& work, const SurfaceProjection& project, const TetImproveOptions& options)
      : work_(work),
        mover_(work, project, options.slack_m),
        goal_(std::sin(options.goal_deg * std::numbers::pi / 180)),
        slack_m_(options.slack_m) {}

  /// False when nothing could be made better.
  bool pass() {
    const std::vector<std::uint32_t> bad = bad_tets();
    if (bad.empty()) return false;
    const TetImproveReport before = report;
    smooth(bad);
    for (const std::uint32_t t : bad)
      if (work_.alive(t) && work_.worth(t) < goal_) flip(t);
    ++report.passes;
    return report.vertex_moves != before.vertex_moves ||
           report.edges_removed != before.edges_removed ||
           report.faces_removed != before.faces_removed;
  }
  TetImproveReport report;

 private:
  std::vector<std::uint32_t> bad_tets() const {
    std::vector<std::uint32_t> bad;
    for (std::uint32_t t = 0; t < work_.tet_count(); ++t)
      if (work_.alive(t) && work_.worth(t) < goal_) bad.push_back(t);
    return bad;
  }

  void smooth(const std::vector<std::uint32_t>& bad) {
    std::vector<std::uint32_t> vertices;
    for (const std::uint32_t t : bad)
      for (const std::uint32_t v : work_.tet(t)) vertices.push_back(v);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const std::uint32_t v : vertices)
      if (work_.least_worth_around(v) < goal_ && mover_.move(v)) ++report.vertex_moves;
  }

  void flip(std::uint32_t t) {
    const auto distance = [this](const Vec3& p) { return mover_.distance(p); };
    const Tetrahedron tet = work_.tet(t);
    for (const auto& [i, j] : kEdges) {
      if (!remove_edge(work_, tet[i], tet[j], distance, slack_m_)) continue;
      ++report.edges_removed;
      return;
    }
    for (std::size_t face = 0; face < 4; ++face) {
      if (!remove_face(work_, t, face)) continue;
      ++report.faces_removed;
      return;
    }
  }

  TetWork& work_;
  VertexMover mover_;
  double goal_;
  double slack_m_;
};

}  // namespace

TetImproveReport improve(TetMesh& mesh, const SurfaceProjection& project,
                         const TetImproveOptions& options) {
  TetWork work(std::move(mesh));
  Improver improver(work, project, options);
  while (improver.report.passes < options.most_passes && improver.pass()) continue;
  mesh = work.take();
  return improver.report;
}

}  // namespace osteon
