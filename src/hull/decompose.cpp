#include "osteon/hull/decompose.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

#include "clip.h"
#include "excess.h"
#include "height_grid.h"
#include "osteon/mesh/joint_ends.h"
#include "osteon/mesh/measure.h"
#include "outer_surface.h"
#include "solid_part.h"

namespace osteon {
namespace {

using hull::Excess;
using hull::HeightGrid;
using hull::SolidPart;
using hull::SolidShape;

class Decomposer {
 public:
  Decomposer(const TriMesh& mesh, const DecomposeOptions& options)
      : options_(options),
        grid_(mesh, options.search_cell_m, options.most_work),
        meter_(grid_, ends_first(mesh), options.search_cell_m) {
    constexpr double kCoarser = 1.5;
    const Aabb box = bounds(mesh).grown(options.search_cell_m);
    (void)add(
        {mesh, hull::coarsened(mesh, kCoarser * options.search_cell_m), {hull::box_mesh(box)}});
  }

  /// Cuts more than is allowed and merges back: that finds better pieces than stopping in time.
  Decomposition run() {
    constexpr int kRounds = 3;
    cut_all(2 * options_.max_pieces);
    merge_within(options_.concavity_m);
    while (parts_.size() > options_.max_pieces && merge_flattest(kAnyNeed)) {
    }
    for (int round = 0; round < kRounds && !done_early(); ++round) {
      cut_all(options_.max_pieces);
      if (!merge_within(exchange_limit())) break;
    }
    cut_all(options_.max_pieces);
    if (meter_.value().on_shaft < 1 && !done_early()) refine_shaft();
    return finish();
  }

 private:
  static constexpr double kAnyNeed = 1e300;
  static constexpr std::uint64_t kWorkOfPoint = 20;  ///< clipping it and putting it into a hull

  /// The ends of a long bone come first; the shaft may stand over by four times as much.
  static hull::PlaceValue ends_first(const TriMesh& mesh) {
    constexpr double kShaftCounts = 0.25;
    const JointEnds ends(mesh);
    return {ends, ends.has_shaft() ? kShaftCounts : 1};
  }

  /// Why every loop here ends on any mesh: each round asks for heights, which are counted.
  bool done_early() const { return grid_.worn_out() || (options_.stop && options_.stop()); }

  void cut_all(std::size_t most) {
    while (parts_.size() < most && !done_early() && cut_worst()) {
    }
  }

  /// What pieces the ends have left, for the shaft.
  void refine_shaft() {
    meter_.count_all_alike();
    together_.clear();
    for (SolidPart& part : parts_) {
      part.excess = excess_of(part.hull);
      part.stuck = false;
    }
    cut_all(options_.max_pieces);
    merge_within(options_.concavity_m);
    cut_all(options_.max_pieces);
  }

  /// Exact where that may matter: what is to be cut in any case need not be.
  Excess excess_of(const Hull& hull) {
    constexpr double kSurely = 4;
    const Excess quick = meter_.sampled(hull);
    if (quick.peak.need > kSurely * options_.concavity_m) return quick;
    return meter_.exact(hull, quick, options_.concavity_m, kAnyNeed);
  }

  /// Hull of the solid in the cells: of its surface there and the cells' corners inside.
  std::optional<Hull> hull_of(const TriMesh& surface, const std::vector<TriMesh>& cells) {
    std::vector<Vec3> points = surface.vertices;
    grid_.spend(kWorkOfPoint * points.size());
    for (const TriMesh& cell : cells)
      for (const Vec3& corner : cell.vertices)
        if (grid_.at(corner) <= 0) points.push_back(corner);
    return build_hull(points).hull;
  }

  bool add(SolidShape shape) {
    SolidPart part;
    auto solid = hull_of(shape.surface, shape.cells);
    if (!solid) return false;
    part.shape = std::move(shape);
    part.hull = std::move(*solid);
    part.id = next_id_++;
    part.excess = excess_of(part.hull);
    for (const Vec3& v : part.hull.vertices) part.box.include(v);
    part.extremes = hull::extremes_of(part.hull);
    parts_.push_back(std::move(part));
    return true;
  }

  std::size_t worst() const {
    std::size_t worst = parts_.size();
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (!parts_[i].stuck &&
          (worst == parts_.size() || parts_[i].excess.peak.need > parts_[worst].excess.peak.need))
        worst = i;
    return worst;
  }

  /// Cuts the part that needs it most. False when there is nothing to cut.
  bool cut_worst() {
    const std::size_t i = worst();
    if (i == parts_.size() || parts_[i].excess.peak.need <= options_.concavity_m) return false;
    const auto plane = best_cut(parts_[i]);
    if (plane && cut(i, *plane)) return true;
    parts_[i].stuck = true;
    return true;
  }

  bool cut(std::size_t i, const Plane& plane) {
    const SolidShape& whole = parts_[i].shape;
    auto [fine_below, fine_above] = hull::clip(whole.surface, plane);
    auto [coarse_below, coarse_above] = hull::clip(whole.coarse, plane);
    SolidShape below{std::move(fine_below), std::move(coarse_below),
                     hull::cells_below(whole.cells, plane)};
    SolidShape above{std::move(fine_above), std::move(coarse_above),
                     hull::cells_above(whole.cells, plane)};
    if (!add(std::move(below))) return false;
    if (!add(std::move(above))) {
      parts_.pop_back();
      return false;
    }
    take(i);
    return true;
  }

  SolidPart take(std::size_t i) {
    SolidPart part = std::move(parts_[i]);
    parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(i));
    return part;
  }

  /// The cut that leaves least standing over the mesh.
  std::optional<Plane> best_cut(const SolidPart& part) {
    const auto cut = best_of(part, hull::notch_cuts(part, grid_));
    return cut ? cut : best_of(part, hull::halving_cuts(part));
  }

  std::optional<Plane> best_of(const SolidPart& part, const std::vector<Plane>& cuts) {
    std::optional<Plane> best;
    double least = 1e300;
    for (const Plane& plane : cuts) {
      const auto cost = cost_below(least, part, plane);
      if (!cost) continue;
      least = *cost;
      best = plane;
    }
    return best;
  }

  /// None where it is `least` or more.
  std::optional<double> cost_below(double least, const SolidPart& part, const Plane& plane) {
    const auto [below, above] = hull::clip(part.shape.coarse, plane);
    const auto a = moment_of(below, hull::cells_below(part.shape.cells, plane), 0, least);
    if (!a) return std::nullopt;
    const auto b = moment_of(above, hull::cells_above(part.shape.cells, plane), *a, least);
    if (!b) return std::nullopt;
    return *a + *b;
  }

  std::optional<double> moment_of(const TriMesh& coarse, const std::vector<TriMesh>& cells,
                                  double base, double limit) {
    const auto solid = hull_of(coarse, cells);
    if (!solid) return std::nullopt;
    return meter_.moment_below(*solid, base, limit);
  }

  /// With all pieces in use those may be joined too that then need far less than the worst piece
  /// does, so that it can be cut further.
  double exchange_limit() const {
    constexpr double kWorthIt = 0.6;
    const std::size_t w = worst();
    if (parts_.size() < options_.max_pieces || w == parts_.size()) return options_.concavity_m;
    return std::max(options_.concavity_m, kWorthIt * parts_[w].excess.peak.need);
  }

  /// Joins the pairs that need no more than the limit together, the flattest first. False without
  /// any.
  bool merge_within(double limit) {
    bool merged = false;
    while (!done_early() && merge_flattest(limit)) merged = true;
    return merged;
  }

  bool merge_flattest(double limit) {
    std::size_t a = 0, b = 0;
    double flattest = limit;
    for (std::size_t i = 0; i < parts_.size(); ++i)
      for (std::size_t j = i + 1; j < parts_.size(); ++j) {
        if (std::max(parts_[i].excess.peak.need, parts_[j].excess.peak.need) > flattest) continue;
        if (!parts_[i].box.overlaps(parts_[j].box)) continue;
        if (rises_above(parts_[i], parts_[j], limit)) continue;
        const double need = need_together(parts_[i], parts_[j], flattest);
        if (need > flattest || (need == flattest && b > 0)) continue;
        flattest = need;
        a = i;
        b = j;
      }
    if (b == 0) return false;
    SolidShape joined = parts_[a].shape;
    const SolidShape& other = parts_[b].shape;
    hull::append(joined.surface, other.surface);
    hull::append(joined.coarse, other.coarse);
    joined.cells.insert(joined.cells.end(), other.cells.begin(), other.cells.end());
    if (!add(std::move(joined))) return false;
    take(b);
    take(a);
    return true;
  }

  /// True when a straight line between the two stands higher than that: so does their hull then.
  /// Settles most pairs without one.
  bool rises_above(const SolidPart& a, const SolidPart& b, double limit) {
    for (const Vec3& p : a.extremes)
      for (const Vec3& q : b.extremes)
        for (const double share : {0.5, 0.25, 0.75}) {
          const Vec3 x = p + share * (q - p);
          if (grid_.at(x) * meter_.value().at(x) > limit) return true;
        }
    return false;
  }

  /// Need of the hull of both; where it is above the limit only known to be so.
  double need_together(const SolidPart& a, const SolidPart& b, double limit) {
    const auto [at, fresh] = together_.try_emplace({a.id, b.id}, Known{kAnyNeed, false});
    Known& known = at->second;
    if (!fresh && (known.exact || known.need > limit)) return known.need;
    std::vector<Vec3> points = a.hull.vertices;
    points.insert(points.end(), b.hull.vertices.begin(), b.hull.vertices.end());
    const HullOutcome outcome = build_hull(points);
    if (!outcome.hull) return known.need;
    const Excess quick = meter_.sampled(*outcome.hull);
    known = {quick.peak.need, false};
    if (known.need > limit) return known.need;
    known.need = meter_.exact(*outcome.hull, quick, options_.concavity_m, limit).peak.need;
    known.exact = known.need <= limit;
    return known.need;
  }

  Decomposition finish() {
    Decomposition out;
    out.coarser = grid_.worn_out();
    for (SolidPart& part : parts_) {
      out.concavity_m = std::max(out.concavity_m, part.excess.peak.height);
      // From its corners alone: so it can be built again without the mesh, bit for bit.
      HullOutcome piece = build_hull(part.hull.vertices);
      assert(piece.hull);
      out.pieces.push_back(std::move(*piece.hull));
    }
    return out;
  }

  DecomposeOptions options_;
  HeightGrid grid_;
  hull::ExcessMeter meter_;
  std::vector<SolidPart> parts_;
  struct Known {
    double need;
    bool exact;  ///< else it is at least about that
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Known> together_;
  std::uint32_t next_id_ = 0;
};

}  // namespace

bool can_decompose(const TriMesh& mesh) { return topology(mesh).closed(); }

std::optional<Decomposition> decompose(const TriMesh& mesh, const DecomposeOptions& options) {
  assert(options.max_pieces > 0);
  HullOutcome whole = build_hull(mesh.vertices);
  if (!whole.hull) return std::nullopt;
  if (options.max_pieces == 1 || !can_decompose(mesh))
    return Decomposition{{std::move(*whole.hull)}, 0};
  return Decomposer(hull::outer_surface(mesh), options).run();
}

}  // namespace osteon
