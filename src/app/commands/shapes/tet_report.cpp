#include "commands/shapes/tet_report.h"

#include <nlohmann/json.hpp>
#include <numbers>

#include "commands/support/text_table.h"

namespace osteon {
namespace {

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

std::string mm(double metres, int digits) { return fixed(1000 * metres, digits) + " mm"; }

std::string range_text(const TetQuality& q) {
  return fixed(degrees(q.min_dihedral_rad), 2) + " to " + fixed(degrees(q.max_dihedral_rad), 2);
}

std::string bin_text(std::size_t bin) {
  const std::size_t width = 180 / kDihedralBins;
  return std::to_string(bin * width) + " - " + std::to_string((bin + 1) * width);
}

std::string signed_percent(double share) {
  return (share < 0 ? "" : "+") + fixed(100 * share, 3) + " %";
}

nlohmann::json to_json(const TetQuality& q) {
  return {{"min_dihedral_deg", degrees(q.min_dihedral_rad)},
          {"max_dihedral_deg", degrees(q.max_dihedral_rad)},
          {"mean_smallest_dihedral_deg", degrees(q.mean_smallest_rad)},
          {"inverted", q.inverted},
          {"dihedral_histogram_10_deg", q.histogram}};
}

// Names of files may be any bytes; JSON is UTF-8.
std::string dump(const nlohmann::json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string elements_text(const TetMesh& mesh) {
  return std::to_string(mesh.tets.size()) + " tetrahedra, " + std::to_string(mesh.vertices.size()) +
         " vertices";
}

}  // namespace

std::string tet_report_text(const MeshSource& source, const Tetrahedra& made) {
  const TetrahedraReport& r = made.report;
  std::string out = source.name + ": " + std::to_string(source.mesh.triangles.size()) +
                    " triangles, " + source.repair.summary() + "\n";
  const auto line = [&out](const std::string& what, const std::string& text) {
    out += "  " + what + std::string(18 - what.size(), ' ') + text + "\n";
  };
  line("cell", mm(r.cell_m, 3) + ", thinnest part " + mm(r.thickness_m, 3));
  line("elements",
       elements_text(made.mesh) + ", " + std::to_string(r.after.inverted) + " inverted");
  line("dihedral angle", range_text(r.before) + " degrees as stuffed");
  line("", range_text(r.after) +
               " degrees improved: " + std::to_string(r.improvement.vertex_moves) + " moves, " +
               std::to_string(r.improvement.edges_removed) + " edges and " +
               std::to_string(r.improvement.faces_removed) + " faces removed");
  line("volume", fixed(1e6 * r.volume_m3, 4) + " cm3, " + signed_percent(r.volume_error()) +
                     " of the surface's");
  line("boundary vertices", mm(r.vertex_distance_m, 6) + " from the surface at most");
  line("boundary faces", mm(r.face_distance_m, 3) + " at most");
  line("surface", mm(r.surface_distance_m, 3) + " from the mesh at most\n");
  TextTable table({"degrees", "as stuffed", "improved"});
  for (std::size_t bin = 0; bin < kDihedralBins; ++bin)
    table.add({bin_text(bin), std::to_string(r.before.histogram[bin]),
               std::to_string(r.after.histogram[bin])});
  out += table.text();
  for (const std::string& warning : r.warnings) out += "warning: " + warning + "\n";
  return out;
}

std::string tet_report_json(const MeshSource& source, const Tetrahedra& made) {
  const TetrahedraReport& r = made.report;
  return dump({{"source", source.name},
               {"mended", source.repair.summary()},
               {"triangles", source.mesh.triangles.size()},
               {"cell_m", r.cell_m},
               {"thickness_m", r.thickness_m},
               {"tetrahedra", made.mesh.tets.size()},
               {"vertices", made.mesh.vertices.size()},
               {"before", to_json(r.before)},
               {"after", to_json(r.after)},
               {"passes", r.improvement.passes},
               {"vertex_moves", r.improvement.vertex_moves},
               {"edges_removed", r.improvement.edges_removed},
               {"faces_removed", r.improvement.faces_removed},
               {"surface_volume_m3", r.surface_volume_m3},
               {"volume_m3", r.volume_m3},
               {"volume_error", r.volume_error()},
               {"vertex_distance_m", r.vertex_distance_m},
               {"face_distance_m", r.face_distance_m},
               {"surface_distance_m", r.surface_distance_m},
               {"boundary_closed", r.boundary.closed()},
               {"boundary_parts", r.boundary.components},
               {"warnings", r.warnings}});
}

std::string tet_quality_text(const std::string& name, const TetMesh& mesh) {
  const TetQuality q = quality(mesh);
  std::string out = name + ": " + elements_text(mesh) + ", " + std::to_string(q.inverted) +
                    " inverted\n  dihedral angle  " + range_text(q) +
                    " degrees\n  volume          " + fixed(1e6 * volume(mesh), 4) + " cm3\n\n";
  TextTable table({"degrees", "angles"});
  for (std::size_t bin = 0; bin < kDihedralBins; ++bin)
    table.add({bin_text(bin), std::to_string(q.histogram[bin])});
  return out + table.text();
}

std::string tet_quality_json(const std::string& name, const TetMesh& mesh) {
  nlohmann::json json = to_json(quality(mesh));
  json["source"] = name;
  json["tetrahedra"] = mesh.tets.size();
  json["vertices"] = mesh.vertices.size();
  json["volume_m3"] = volume(mesh);
  return dump(json);
}

}  // namespace osteon
