#include "osteon/tissue/skin_sheet.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace osteon {
namespace {

constexpr double kFewest = 4, kMost = 400;  // triangles along a side

bool within(double x, double lo, double hi) { return x >= lo && x <= hi; }

Result<void> check(double width_m, double height_m, double edge_m, const SheetMaterial& m) {
  for (const double side : {width_m, height_m})
    if (!(edge_m > 0) || !within(side / edge_m, kFewest, kMost))
      return fail("a side of the sheet is not 4 to 400 triangles long", "skin sheet",
                  "Give other sizes");
  const bool sound = within(m.stretch_n_per_m, 1e-3, 1e9) && within(m.poisson, 0, 0.4999) &&
                     within(m.tension_n_per_m, 1e-6, 1e6) &&
                     within(m.foundation_n_per_m3, 1, 1e12) && within(m.fat_m, 1e-5, 100) &&
                     within(m.tether_n_per_m3, 1, 1e12) && within(m.thickness_m, 0, 1) &&
                     within(m.friction, 0, 100) && within(m.pierce_pa, 0, 1e12) &&
                     within(m.fat_pierce_pa, 0, 1e12);
  if (!sound)
    return fail("the material of the sheet is out of range", "skin sheet",
                "Stretch, tension and tether must be above 0, Poisson's ratio below 0.5");
  return {};
}

// For each vertex the list of what is at it, one after another.
template <typename Items, typename Ends>
void list_at(std::size_t vertices, const Items& items, Ends ends, std::vector<std::uint32_t>& first,
             std::vector<std::uint32_t>& list) {
  first.assign(vertices + 1, 0);
  for (const auto& item : items)
    for (const std::uint32_t v : ends(item)) ++first[v + 1];
  for (std::size_t v = 0; v < vertices; ++v) first[v + 1] += first[v];
  list.resize(first.back());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::uint32_t i = 0; i < items.size(); ++i)
    for (const std::uint32_t v : ends(items[i])) list[next[v]++] = i;
}

}  // namespace

// Rows of vertices: in every second row they stand between those of the rows beside it, with one
// more at each end, so that the rim is straight.
Result<SkinSheet> SkinSheet::make(double width_m, double height_m, double edge_m,
                                  const SheetMaterial& material) {
  if (auto sound = check(width_m, height_m, edge_m, material); !sound)
    return tl::unexpected(sound.error());
  SkinSheet out;
  out.material_ = material;
  out.width_m_ = width_m;
  out.height_m_ = height_m;
  out.edge_m_ = edge_m;
  const auto nx = static_cast<std::uint32_t>(std::lround(width_m / edge_m));
  const auto ny = static_cast<std::uint32_t>(
      2 * std::max(1L, std::lround(height_m / (edge_m * std::sqrt(3.0)))));
  std::vector<std::uint32_t> row(ny + 1);
  for (std::uint32_t j = 0; j <= ny; ++j) {
    row[j] = static_cast<std::uint32_t>(out.points_.size());
    const std::uint32_t last = nx + j % 2;
    for (std::uint32_t i = 0; i <= last; ++i) {
      const double along = j % 2 ? std::clamp(i - 0.5, 0.0, double(nx)) : double(i);
      out.points_.emplace_back(width_m * (along / nx - 0.5), height_m * (double(j) / ny - 0.5));
      out.rim_.push_back(i == 0 || i == last || j == 0 || j == ny);
    }
  }
  for (std::uint32_t j = 0; j < ny; ++j) {
    const bool up = j % 2 == 0;  // the row with fewer vertices is below
    const std::uint32_t few = up ? row[j] : row[j + 1], many = up ? row[j + 1] : row[j];
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      out.triangles_.push_back(up ? Triangle{a, b, c} : Triangle{b, a, c});
    };
    for (std::uint32_t i = 0; i <= nx; ++i) {
      add(many + i + 1, many + i, few + i);
      if (i < nx) add(few + i, few + i + 1, many + i + 1);
    }
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, SheetEdge> edges;
  for (std::uint32_t t = 0; t < out.triangles_.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = out.triangles_[t][k], b = out.triangles_[t][(k + 1) % 3];
      SheetEdge& edge = edges[std::minmax(a, b)];
      edge.a = std::min(a, b);
      edge.b = std::max(a, b);
      edge.triangle[edge.triangles++] = t;
    }
  for (const auto& [ends, edge] : edges) out.edges_.push_back(edge);
  list_at(
      out.points_.size(), out.edges_,
      [](const SheetEdge& e) {
        return std::array{e.a, e.b};
      },
      out.edge_first_, out.edge_list_);
  list_at(
      out.points_.size(), out.triangles_, [](const Triangle& t) { return t; }, out.triangle_first_,
      out.triangle_list_);
  return out;
}

std::span<const std::uint32_t> SkinSheet::edges_at(std::uint32_t v) const {
  return std::span(edge_list_).subspan(edge_first_[v], edge_first_[v + 1] - edge_first_[v]);
}

std::span<const std::uint32_t> SkinSheet::triangles_at(std::uint32_t v) const {
  return std::span(triangle_list_)
      .subspan(triangle_first_[v], triangle_first_[v + 1] - triangle_first_[v]);
}

}  // namespace osteon
