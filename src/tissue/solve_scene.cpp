#include "osteon/tissue/solve_scene.h"

#include "osteon/mesh/tet_io.h"
#include "scene_reader.h"

namespace osteon {
namespace {

using Table = SceneReader::Table;

constexpr Within kPlace_mm{-1e5, 1e5};
constexpr Within kTime_s{0, 1e4};

HexGrid read_grid(SceneReader& in, const Table& grid) {
  in.only(grid, {"cells", "cell_mm", "origin_mm"});
  HexGrid out;
  const Vec3 cells = in.vec3(grid, "cells", {1, kMostCellsAlong});
  for (std::size_t k = 0; k < 3; ++k) {
    const double n = cells[static_cast<Eigen::Index>(k)];
    out.cells[k] = static_cast<std::uint32_t>(n);
    if (out.cells[k] != n) in.complain("must be three whole numbers", grid, "cells");
  }
  if (std::size_t{out.cells[0]} * out.cells[1] * out.cells[2] > kMostHexahedra)
    in.complain("are more than " + std::to_string(kMostHexahedra) + " in all", grid, "cells",
                "Use fewer, larger cells");
  out.cell_m = kMm * in.number(grid, "cell_mm", {0.001, 1000});
  if (SceneReader::has(grid, "origin_mm"))
    out.origin_W = kMm * in.vec3(grid, "origin_mm", kPlace_mm);
  return out;
}

RodShape read_rod(SceneReader& in, const Table& rod) {
  in.only(rod, {"points_mm", "radius_mm", "segments", "straight_at_rest"});
  RodShape out;
  out.points_m = in.points(rod, "points_mm", kPlace_mm);
  for (Vec3& p : out.points_m) p *= kMm;
  if (out.points_m.size() < 2) in.complain("must name two points or more", rod, "points_mm");
  out.radius_m = kMm * in.number(rod, "radius_mm", {0.001, 1000});
  out.segments = in.integer(rod, "segments", 1, 10000);
  out.straight_at_rest = in.truth_or(rod, "straight_at_rest", false);
  return out;
}

SolveBody read_body(SceneReader& in, const Table& mesh) {
  in.only(mesh, {"grid", "vtk", "rod"});
  SolveBody out;
  if (mesh.keys->size() != 1) in.complain("must hold one of grid, vtk and rod", mesh, "grid");
  if (SceneReader::has(mesh, "grid")) out.grid = read_grid(in, in.table(mesh, "grid"));
  if (SceneReader::has(mesh, "vtk")) out.vtk = in.text(mesh, "vtk");
  if (SceneReader::has(mesh, "rod")) out.rod = read_rod(in, in.table(mesh, "rod"));
  return out;
}

TissueModel read_model(SceneReader& in, const Table& material) {
  const std::string name = in.text(material, "model");
  if (name == "neo_hookean") return TissueModel::kNeoHookean;
  if (name == "linear") return TissueModel::kLinear;
  if (name == "corotated") return TissueModel::kCorotated;
  if (name == "rod") return TissueModel::kRod;
  in.complain("must be one of: neo_hookean, linear, corotated, rod", material, "model");
  return TissueModel::kNeoHookean;
}

std::vector<PronyTerm> read_prony(SceneReader& in, const Table& material) {
  std::vector<PronyTerm> out;
  double sum = 0;
  for (const Table& term : in.tables(material, "prony")) {
    in.only(term, {"g", "tau_s"});
    out.push_back({in.number(term, "g", {0, 1}), in.number(term, "tau_s", {1e-6, 1e6})});
    sum += out.back().g;
  }
  if (!(sum < 1))
    in.complain("loses all of the shear modulus: the g must be below 1 in all", material, "prony");
  if (out.size() > kMostPronyTerms)
    in.complain("must be " + std::to_string(kMostPronyTerms) + " terms at most", material, "prony");
  return out;
}

SolidMaterial read_material(SceneReader& in, const Table& material) {
  in.only(material, {"model", "young_kpa", "poisson", "density_kg_per_m3", "damping_per_s",
                     "friction", "condensed", "prony"});
  SolidMaterial out;
  out.young_pa = 1000 * in.number(material, "young_kpa", {1e-6, 1e9});
  out.poisson = in.number(material, "poisson", {0, 0.5});
  if (out.poisson > 0.4999)
    in.complain("must lie from 0 to 0.4999", material, "poisson",
                "Use 0.49 for a nearly incompressible material");
  out.density_kg_per_m3 = in.number(material, "density_kg_per_m3", {1e-3, 1e6});
  out.damping_per_s = in.number_or(material, "damping_per_s", {0, 1e6}, 0);
  out.prony = read_prony(in, material);
  return out;
}

Aabb read_box(SceneReader& in, const Table& entry) {
  Aabb box;
  const std::vector<Vec3> corners = in.points(entry, "box_mm", kPlace_mm);
  if (corners.size() != 2) in.complain("must be two opposite corners", entry, "box_mm");
  for (const Vec3& p : corners) box.include(kMm * p);
  return box;
}

HeldAxes read_axes(SceneReader& in, const Table& entry) {
  if (!SceneReader::has(entry, "axes")) return {true, true, true};
  HeldAxes out{};
  const std::string names = in.text(entry, "axes");
  bool sound = !names.empty();
  for (const char c : names) {
    const bool known = c >= 'x' && c <= 'z';
    const std::size_t k = known ? static_cast<std::size_t>(c - 'x') : 0;
    sound = sound && known && !out[k];
    out[k] = true;
  }
  if (!sound) in.complain("must be some of the letters x, y, z, each once", entry, "axes");
  return out;
}

std::optional<bool> read_clamp(SceneReader& in, const Table& entry) {
  if (!SceneReader::has(entry, "clamp")) return std::nullopt;
  return in.truth_or(entry, "clamp", false);
}

MovedBox read_moved(SceneReader& in, const Table& entry, double half_s) {
  constexpr double kDegree = 3.141592653589793 / 180;
  in.only(entry, {"box_mm", "axes", "by_mm", "over_s", "clamp", "turn_deg"});
  MovedBox out;
  out.box_m = read_box(in, entry);
  out.axes = read_axes(in, entry);
  const bool turns = SceneReader::has(entry, "turn_deg");
  if (turns) out.turn_rad = kDegree * in.vec3(entry, "turn_deg", {-1e5, 1e5});
  if (!turns || SceneReader::has(entry, "by_mm"))
    out.by_m = kMm * in.vec3(entry, "by_mm", kPlace_mm);
  out.over_s = in.number_or(entry, "over_s", kTime_s, half_s);
  out.clamp = read_clamp(in, entry);
  return out;
}

void read_supports(SceneReader& in, const Table& root, SolveScene& scene) {
  const double half = 0.5 * scene.time_s;
  for (const Table& entry : in.tables(root, "fixed")) {
    in.only(entry, {"box_mm", "axes", "clamp"});
    scene.fixed.push_back({read_box(in, entry), read_axes(in, entry), read_clamp(in, entry)});
  }
  for (const Table& entry : in.tables(root, "moved"))
    scene.moved.push_back(read_moved(in, entry, half));
  for (const Table& entry : in.tables(root, "load")) {
    in.only(entry, {"box_mm", "force_n", "over_s"});
    scene.loads.push_back({read_box(in, entry), in.vec3(entry, "force_n", {-1e9, 1e9}),
                           in.number_or(entry, "over_s", kTime_s, half)});
  }
}

// A cylinder with round ends, or a ball: [[obstacle]].
RodObstacle read_obstacle(SceneReader& in, const Table& entry) {
  in.only(entry, {"cylinder", "sphere", "friction"});
  RodObstacle out;
  const bool ball = SceneReader::has(entry, "sphere");
  if (ball == SceneReader::has(entry, "cylinder"))
    in.complain("must hold one of cylinder and sphere", entry, "cylinder");
  const Table shape = in.table(entry, ball ? "sphere" : "cylinder");
  if (ball) {
    in.only(shape, {"center_mm", "radius_mm"});
    out.from_W = out.to_W = kMm * in.vec3(shape, "center_mm", kPlace_mm);
  } else {
    in.only(shape, {"from_mm", "to_mm", "radius_mm"});
    out.from_W = kMm * in.vec3(shape, "from_mm", kPlace_mm);
    out.to_W = kMm * in.vec3(shape, "to_mm", kPlace_mm);
  }
  out.radius_m = kMm * in.number(shape, "radius_mm", {0.001, 1e5});
  out.friction = in.number_or(entry, "friction", {0, 10}, 0);
  return out;
}

RodCutPlace read_rod_cut(SceneReader& in, const Table& entry) {
  in.only(entry, {"at_mm", "at_s"});
  return {kMm * in.vec3(entry, "at_mm", kPlace_mm), in.number_or(entry, "at_s", kTime_s, 0)};
}

// Keys that only rods know.
void check_rod_keys(SceneReader& in, const Table& root, const SolveScene& scene) {
  if (scene.model == TissueModel::kRod) return;
  constexpr const char* kTodo = "Remove it, or solve a rod";
  for (const char* key : {"obstacle", "cut"})
    if (SceneReader::has(root, key)) in.complain("is for rods", root, key, kTodo);
  const Table material = in.table(root, "material");
  if (SceneReader::has(material, "friction"))
    in.complain("is for rods", material, "friction", kTodo);
  for (const char* list : {"fixed", "moved"})
    for (const Table& entry : in.tables(root, list))
      for (const char* key : {"clamp", "turn_deg"})
        if (SceneReader::has(entry, key)) in.complain("is for rods", entry, key, kTodo);
}

// Three numbers, or one: down along z.
Vec3 read_gravity(SceneReader& in, const Table& table) {
  constexpr std::string_view kKey = "gravity_m_per_s2";
  const toml::node* node = table.keys->get(kKey);
  if (node && node->is_number()) return {0, 0, -in.number(table, kKey, {-1e4, 1e4})};
  return node ? in.vec3(table, kKey, {-1e4, 1e4}) : Vec3(Vec3::Zero());
}

void read_run(SceneReader& in, const Table& run, SolveScene& scene) {
  if (SceneReader::has(run, "step_s"))
    in.complain("is chosen by the program: a longer step would not be stable", run, "step_s",
                "Leave it out; the result names the step");
  in.only(run, {"time_s", "probe_mm", "gravity_m_per_s2"});
  scene.time_s = in.number(run, "time_s", {1e-6, 1e4});
  if (!SceneReader::has(run, "probe_mm")) return;
  for (const Vec3& p : in.points(run, "probe_mm", kPlace_mm)) scene.probes_m.push_back(kMm * p);
}

SolveScene read_scene(SceneReader& in, const Table& root) {
  in.only(root, {"mesh", "material", "fixed", "moved", "load", "obstacle", "cut",
                 "gravity_m_per_s2", "run"});
  SolveScene scene;
  scene.body = read_body(in, in.table(root, "mesh"));
  const Table material = in.table(root, "material");
  scene.model = read_model(in, material);
  scene.material = read_material(in, material);
  scene.condensed = in.truth_or(material, "condensed", false);
  if (scene.condensed && scene.model != TissueModel::kLinear)
    in.complain("is for the model linear", material, "condensed", "Leave it out");
  const bool cubes = scene.model == TissueModel::kNeoHookean && scene.body.grid;
  if (!scene.material.prony.empty() && !cubes)
    in.complain("is for the model neo_hookean of a grid", material, "prony", "Leave it out");
  scene.friction = in.number_or(material, "friction", {0, 10}, scene.friction);
  const Table run = in.table(root, "run");
  read_run(in, run, scene);
  scene.gravity_m_per_s2 = read_gravity(in, root) + read_gravity(in, run);
  if (SceneReader::has(root, "gravity_m_per_s2") && SceneReader::has(run, "gravity_m_per_s2"))
    in.complain("is given twice", run, "gravity_m_per_s2", "Give it once");
  read_supports(in, root, scene);
  for (const Table& entry : in.tables(root, "obstacle"))
    scene.obstacles.push_back(read_obstacle(in, entry));
  for (const Table& entry : in.tables(root, "cut")) scene.cuts.push_back(read_rod_cut(in, entry));
  check_rod_keys(in, root, scene);
  const bool rod_model = scene.model == TissueModel::kRod;
  if (scene.body.rod.has_value() != rod_model)
    in.complain(rod_model ? "is 'rod', but the mesh is not a rod" : "does not fit a rod", material,
                "model", "Use mesh.rod with model 'rod', a grid or vtk with the others");
  return scene;
}

}  // namespace

Result<SolveScene> parse_solve_scene(std::string_view text, const std::string& name) {
  const auto root = parse_scene_toml(text, name);
  if (!root) return tl::unexpected(root.error());
  SceneReader in(name);
  SolveScene scene = read_scene(in, {&*root, ""});
  scene.name = name;
  if (in.error()) return tl::unexpected(*in.error());
  return scene;
}

Result<SolveScene> load_solve_scene(const std::filesystem::path& path) {
  const auto text = read_scene_file(path);
  if (!text) return tl::unexpected(text.error());
  auto scene = parse_solve_scene(*text, path.string());
  if (!scene || scene->body.vtk.empty()) return scene;
  auto mesh = load_vtk(path.parent_path() / scene->body.vtk, kMm);
  if (!mesh) {
    mesh.error().what = "'mesh.vtk': " + mesh.error().what;
    return tl::unexpected(mesh.error());
  }
  scene->body.tets = std::move(*mesh);
  return scene;
}

}  // namespace osteon
