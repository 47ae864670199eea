#include "osteon/mesh/repair.h"

#include <vector>

#include "osteon/mesh/measure.h"
#include "repair/clean.h"
#include "repair/fins.h"
#include "repair/holes.h"
#include "repair/orient.h"
#include "repair/weld.h"

namespace osteon {
namespace {

class Summary {
 public:
  void add(std::size_t count, const char* verb, const char* one, const char* many) {
    if (count == 0) return;
    if (!text_.empty()) text_ += ", ";
    text_ += verb;
    text_ += ' ';
    text_ += std::to_string(count);
    text_ += ' ';
    text_ += count == 1 ? one : many;
  }
  std::string text() const { return text_.empty() ? "nothing to repair" : text_; }

 private:
  std::string text_;
};

// Triangles that face the other way than they came; lids are not among them.
std::size_t count_turned(const std::vector<char>& alike, const std::vector<char>& outwards) {
  std::size_t count = 0;
  for (std::size_t t = 0; t < alike.size(); ++t) count += alike[t] != outwards[t];
  return count;
}

}  // namespace

std::string RepairReport::summary() const {
  Summary s;
  s.add(welded_vertices, "welded", "vertex", "vertices");
  s.add(unused_vertices, "dropped", "unused vertex", "unused vertices");
  s.add(degenerate_triangles, "dropped", "degenerate triangle", "degenerate triangles");
  s.add(duplicate_triangles, "dropped", "duplicate triangle", "duplicate triangles");
  s.add(fin_triangles, "dropped", "triangle of a fin", "triangles of fins");
  s.add(flipped_triangles, "flipped", "triangle", "triangles");
  s.add(filled_holes - capped_ends, "filled", "hole", "holes");
  s.add(capped_ends, "capped", "open end", "open ends");
  s.add(open_holes, "left", "hole open", "holes open");
  s.add(non_manifold_edges, "left", "non-manifold edge", "non-manifold edges");
  s.add(misoriented_edges, "left", "one-sided edge", "one-sided edges");
  return s.text();
}

RepairReport repair(TriMesh& mesh, const RepairOptions& options) {
  RepairReport report;
  report.unused_vertices = drop_unused_vertices(mesh);
  report.welded_vertices = weld_vertices(mesh, options.weld_distance_m);
  report.degenerate_triangles = drop_collapsed_triangles(mesh);
  report.duplicate_triangles = drop_duplicate_triangles(mesh);
  report.degenerate_triangles += mend_flat_triangles(mesh);
  report.fin_triangles = drop_fins(mesh);
  const std::vector<char> alike = orient_alike(mesh);
  const HoleCount holes = fill_holes(mesh, options.largest_hole_edges);
  report.filled_holes = holes.filled;
  report.capped_ends = holes.ends;
  report.open_holes = holes.open;
  report.flipped_triangles = count_turned(alike, orient_outwards(mesh));
  drop_unused_vertices(mesh);
  const Topology left = topology(mesh);
  report.non_manifold_edges = left.non_manifold_edges;
  report.misoriented_edges = left.misoriented_edges;
  return report;
}

}  // namespace osteon
