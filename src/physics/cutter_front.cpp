#include "cutter_front.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "osteon/carve/grid_nodes.h"

namespace osteon {
namespace {

constexpr std::size_t kRings = 3, kAround = 8;
constexpr double kAheadCells = 0.6;  // how far before the front one looks

// A sliver that no point meets still holds a little.
constexpr double kLeastShare = 0.02;

// Height over what is left of the bone, between the nodes about a place: of the uncut bone and of
// the cuts each by itself, for both are smooth where they meet. Far outside of the grid: 1 m.
double height_over_rest_m(const CarvedField& field, const Vec3& p_B) {
  const auto nodes = nodes_about(field.grid(), p_B);
  if (!nodes) return 1;
  double bone = 0, cut = 0;
  for (const auto& [at, share] : *nodes) {
    const std::int16_t* cuts = field.cuts(at.block);
    bone += share * field.height_m(at.block, at.node);
    cut += share * 1e-6 * (cuts ? cuts[at.node] : CarvedField::kUncut);
  }
  return std::max(bone, -cut);
}

// Height of the cutter's front over its origin at a distance from the axis.
double front_z(const Cutter& cutter, double rho) {
  double z = -1e300;
  for (const TurnedFace& face : cutter.parts.front().faces)
    if (face.n_z < 0) z = std::max(z, (face.n_rho * rho - face.offset) / -face.n_z);
  return z;
}

// Points of equal area over the front of a cutter that is turned, beyond its pilot's radius.
template <class Look>
void for_front_points(const Cutter& cutter, double pilot_m, const Look& look) {
  const double inner2 = 0.25 * pilot_m * pilot_m, outer2 = 0.25 * cutter.size_m * cutter.size_m;
  for (std::size_t ring = 0; ring < kRings; ++ring) {
    const double part = (static_cast<double>(ring) + 0.5) / kRings;
    const double rho = std::sqrt(inner2 + part * (outer2 - inner2));
    for (std::size_t i = 0; i < kAround; ++i) {
      const double a = 2 * std::numbers::pi * (static_cast<double>(i) + 0.5) / kAround;
      look(Vec3(rho * std::cos(a), rho * std::sin(a), front_z(cutter, rho)));
    }
  }
}

std::optional<BoneTissue> tissue_at_node(const CarvedField& field, const GridNode& node) {
  if (field.height_m(node.block, node.node) >= 0) return std::nullopt;
  const double bare = field.bare_height_m(node.block, node.node);
  return bare < 0 ? field.layers().at(-bare) : BoneTissue::kCartilage;
}

std::optional<BoneTissue> uncut_tissue(const CarvedField& field, const Vec3& p_B) {
  const auto node = nearest_node(field.grid(), p_B);
  return node ? tissue_at_node(field, *node) : std::nullopt;
}

void look_at(const CarvedField& field, const Vec3& p_B, FrontShare& share, std::size_t counts = 1) {
  share.looked += counts;
  if (const auto tissue = tissue_at(field, p_B))
    share.found[static_cast<std::size_t>(*tissue)] += counts;
}

const DrillMaterial* material_of(const DrillTable& table, std::size_t tissue) {
  const bool hard = static_cast<BoneTissue>(tissue) == BoneTissue::kCortical;
  return table.find(to_text(hard ? BoneTissue::kCortical : BoneTissue::kCancellous));
}

}  // namespace

std::size_t FrontShare::left() const {
  std::size_t sum = 0;
  for (const std::size_t n : found) sum += n;
  return sum;
}

bool FrontShare::meets_bone() const {
  return found[static_cast<std::size_t>(BoneTissue::kCortical)] > 0 ||
         found[static_cast<std::size_t>(BoneTissue::kCancellous)] > 0;
}

std::optional<BoneTissue> FrontShare::most() const {
  const auto largest = std::max_element(found.begin(), found.end());
  if (*largest == 0) return std::nullopt;
  return static_cast<BoneTissue>(largest - found.begin());
}

std::optional<BoneTissue> tissue_at(const CarvedField& field, const Vec3& p_B) {
  const auto node = nearest_node(field.grid(), p_B);
  if (!node) return std::nullopt;
  const std::int16_t* cuts = field.cuts(node->block);
  if (cuts && cuts[node->node] < 0) return std::nullopt;
  return tissue_at_node(field, *node);
}

bool was_outside(const CarvedField& field, const Vec3& p_B) {
  const auto node = nearest_node(field.grid(), p_B);
  return !node || field.height_m(node->block, node->node) >= 0;
}

double way_in_bone(const CarvedField& field, const Vec3& from_B, const Vec3& way_B) {
  constexpr double kMost_m = 0.2, kToSurface_m = 0.003;
  const double step = field.grid().cell_m;
  bool in = false;
  for (double s = 0; s < kMost_m; s += step) {
    const bool outside = was_outside(field, from_B + s * way_B);
    if (in && outside) return s;
    if (!in && outside && s > kToSurface_m) return 0;
    in = in || !outside;
  }
  return kMost_m;
}

FrontShare look_before(const CarvedField& field, const Cutter& cutter, double pilot_m,
                       const Pose& X_BC) {
  const Vec3 ahead(0, 0, -kAheadCells * field.grid().cell_m);
  FrontShare share;
  for_front_points(cutter, pilot_m,
                   [&](const Vec3& p_C) { look_at(field, X_BC * Vec3(p_C + ahead), share); });
  return share;
}

bool front_is_free(const CarvedField& field, const Cutter& cutter, double pilot_m,
                   const Pose& X_BC) {
  bool free = true;
  for_front_points(cutter, pilot_m, [&](const Vec3& p_C) {
    free = free && height_over_rest_m(field, X_BC * p_C) >= 0;
  });
  return free;
}

double cut_a_side(const CarvedField& field, const Cutter& cutter, const Pose& X_BC) {
  constexpr std::size_t kSteps = 20;
  constexpr double kStep_m = 1e-4;
  const double radius = 0.5 * cutter.size_m;
  std::size_t cortex = 0;
  for (std::size_t i = 0; i < kAround; ++i) {
    const double a = 2 * std::numbers::pi * (static_cast<double>(i) + 0.5) / kAround;
    for (std::size_t n = 0; n < kSteps; ++n) {
      const double rho = radius - (static_cast<double>(n) + 0.5) * kStep_m;
      if (!(rho > 0)) break;
      const double z = front_z(cutter, rho) - kAheadCells * field.grid().cell_m;
      const Vec3 p_B = X_BC * Vec3(rho * std::cos(a), rho * std::sin(a), z);
      if (height_over_rest_m(field, p_B) < 0 && uncut_tissue(field, p_B) == BoneTissue::kCortical)
        ++cortex;
    }
  }
  return kStep_m * static_cast<double>(cortex) / kAround;
}

// Rings of equal width, each counted by its area.
FrontShare look_before_point(const CarvedField& field, const Cutter& cutter, const Pose& X_BC) {
  constexpr std::size_t kFineRings = 10;
  FrontShare share;
  for (std::size_t ring = 0; ring < kFineRings; ++ring) {
    const double rho = (static_cast<double>(ring) + 0.5) / kFineRings * 0.5 * cutter.size_m;
    const double z = front_z(cutter, rho) - kAheadCells * field.grid().cell_m;
    for (std::size_t i = 0; i < kAround; ++i) {
      const double a = 2 * std::numbers::pi * (static_cast<double>(i) + 0.5) / kAround;
      look_at(field, X_BC * Vec3(rho * std::cos(a), rho * std::sin(a), z), share, 2 * ring + 1);
    }
  }
  return share;
}

FrontShare look_before_edge(const CarvedField& field, double width_m, const Pose& X_BC) {
  constexpr std::size_t kAlong = 16;
  FrontShare share;
  for (std::size_t i = 0; i < kAlong; ++i) {
    const double x = ((static_cast<double>(i) + 0.5) / kAlong - 0.5) * width_m;
    look_at(field, X_BC * Vec3(x, 0, -kAheadCells * field.grid().cell_m), share);
  }
  return share;
}

FrontShare look_under_ball(const CarvedField& field, double radius_m, const Vec3& p_B,
                           const Vec3& nhat_B) {
  const double reach = radius_m + kAheadCells * field.grid().cell_m;
  const Vec3 x = nhat_B.unitOrthogonal(), y = nhat_B.cross(x);
  FrontShare share;
  for (std::size_t ring = 0; ring < kRings; ++ring) {
    // Of equal area on the half ball.
    const double down = 1 - (static_cast<double>(ring) + 0.5) / kRings;
    const double side = std::sqrt(1 - down * down);
    for (std::size_t i = 0; i < kAround; ++i) {
      const double a = 2 * std::numbers::pi * (static_cast<double>(i) + 0.5) / kAround;
      const Vec3 way = -down * nhat_B + side * (std::cos(a) * x + std::sin(a) * y);
      look_at(field, p_B + reach * way, share);
    }
  }
  return share;
}

DrillMaterial mixed(const DrillTable& table, const FrontShare& share) {
  DrillMaterial out;
  double edge = 0;
  const auto add = [&](std::size_t tissue, double part) {
    const DrillMaterial* material = material_of(table, tissue);
    if (!material) return;
    out.thrust_n += part * material->thrust_n;
    out.specific_energy_j_per_m3 += part * material->specific_energy_j_per_m3;
    edge += part * material->edge_share * material->thrust_n;
  };
  constexpr auto kMarrow = static_cast<std::size_t>(BoneTissue::kMarrow);
  for (std::size_t t = 0; t < kBoneTissues; ++t)
    if (t != kMarrow && share.found[t] > 0)
      add(t, static_cast<double>(share.found[t]) / static_cast<double>(share.looked));
  if (!(out.thrust_n > 0)) add(static_cast<std::size_t>(BoneTissue::kCancellous), kLeastShare);
  out.name = "mixed";
  out.edge_share = out.thrust_n > 0 ? edge / out.thrust_n : 0;
  return out;
}

}  // namespace osteon
