#include "scene_painter.h"

#include "force_arrow.h"

#include <algorithm>
#include <cmath>

#include "osteon/scene/soft_motion.h"
#include "surface/cut_light.h"
#include "surface/moved_light.h"
#include "surface/shapes.h"

namespace osteon {
namespace {

using Color = Eigen::Vector4f;

constexpr std::array<float, 3> kSteel{0.86f, 0.88f, 0.91f};

constexpr float kSeenThrough = 0.02f;  // below this opacity a bone is not drawn

Color with_alpha(const std::array<float, 3>& rgb, float alpha) {
  return {rgb[0], rgb[1], rgb[2], alpha};
}

/// Lines of a fine hull are fainter, so that they do not close over the bone.
float line_opacity(std::size_t edges) {
  const double share = std::sqrt(400.0 / static_cast<double>(std::max<std::size_t>(edges, 1)));
  return static_cast<float>(std::clamp(0.75 * share, 0.10, 0.75));
}

/// Mean of the mesh in x and y behind its tip: a hook stands beside its shaft.
Vec3 shaft_line(const TriMesh& mesh, double length_m) {
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (const Vec3& p : mesh.vertices) {
    if (!is_finite(p) || p.z() < 0.05 * length_m) continue;
    sum += p;
    count += 1;
  }
  return count > 0 ? Vec3(sum.x() / count, sum.y() / count, 0) : Vec3::Zero();
}

}  // namespace

const BoneAppearance& appearance(const ViewState& view, std::size_t bone) {
  static const BoneAppearance plain;
  return bone < view.bones.size() ? view.bones[bone] : plain;
}

bool is_shown(const RenderSnapshot& snapshot, const ViewState& view, std::size_t bone) {
  const BoneAppearance& look = appearance(view, bone);
  return bone < std::min<std::size_t>(snapshot.bones.count, kMaxBones) && look.visible &&
         look.opacity >= kSeenThrough && is_finite(snapshot.bones.bones[bone].X_WB);
}

ScenePainter ScenePainter::another() const {
  ScenePainter painter;
  painter.shared_ = shared_;
  return painter;
}

const GpuMesh& ScenePainter::exact_surface(std::size_t k) const {
  static const GpuMesh nothing;
  const std::vector<BoneModel>& models = shared_->bones;
  return k < models.size() && !models[k].levels.empty() ? models[k].levels.front().surface
                                                        : nothing;
}

const GpuMesh& ScenePainter::surface_within(std::size_t k, double error_m) const {
  if (k >= shared_->bones.size()) return exact_surface(k);
  const std::vector<Level>& levels = shared_->bones[k].levels;
  std::size_t level = 0;
  while (level + 1 < levels.size() && levels[level + 1].error_m <= error_m) ++level;
  return levels.empty() ? exact_surface(k) : levels[level].surface;
}

void ScenePainter::set_surfaces(const PreparedCase& prepared) {
  static const ShadedMesh nothing;
  shared_->changes.anywhere();
  for (std::size_t k = 0; k < shared_->bones.size(); ++k) {
    const std::size_t bones = shared_->rest_X_WB.size();
    const auto& meshes = k < bones ? prepared.bones : prepared.softs;
    const std::size_t at = k < bones ? k : k - bones;
    const ShadedMesh& mesh = at < meshes.size() ? meshes[at] : nothing;
    shared_->bones[k].closed = mesh.closed;
    if (k < bones || !prepared.softs.empty()) shared_->bones[k].changed.set_base(mesh);
    if (k >= bones) shared_->bones[k].light = {mesh.shades, mesh.roots};
    shared_->bones[k].moved = {};
    shared_->bones[k].levels.clear();
    shared_->bones[k].levels.push_back({GpuMesh(mesh), 0});
    for (const ShadedMesh::Level& level : mesh.coarser)
      shared_->bones[k].levels.push_back({GpuMesh(mesh, level.triangles), level.error_m});
  }
}

ScenePainter::BoneModel ScenePainter::make_bone(const Bone& bone) {
  BoneModel model;
  make_pieces(model, bone);
  set_extent(model, bone.mesh);
  return model;
}

void ScenePainter::make_pieces(BoneModel& model, const Bone& bone) {
  model.pieces.clear();
  std::size_t edges = 0;
  for (const Hull& piece : bone.pieces) {
    const auto ends = facet_edges({&piece, 1});
    model.pieces.push_back({GpuMesh(faceted({&piece, 1})), GpuMesh::lines(ends)});
    edges += ends.size() / 2;
  }
  model.line_opacity = line_opacity(edges);
}

void ScenePainter::set_pieces(const Case& the_case) {
  for (std::size_t k = 0; k < std::min(shared_->rest_X_WB.size(), the_case.bones.size()); ++k)
    make_pieces(shared_->bones[k], the_case.bones[k]);
}

void ScenePainter::set_extent(BoneModel& model, const TriMesh& mesh) {
  const Aabb box = finite_bounds(mesh);
  if (box.empty()) return;
  model.center_B = box.center();
  model.radius_m = 0.5 * box.extent().norm();
  model.boxes = extent_boxes(mesh);
  model.around = capsule_around(box);
}

void ScenePainter::set_surface(std::size_t k, const TriMesh& mesh_B) {
  if (k >= shared_->bones.size()) return;
  shared_->changes.anywhere();
  BoneModel& model = shared_->bones[k];
  model.moved = {};
  model.levels.clear();
  model.levels.push_back({GpuMesh(plain_shaded(mesh_B)), 0});
  set_extent(model, mesh_B);
}

Aabb ScenePainter::extent_of(const BoneModel& model) {
  Aabb box;
  for (const Vec3& end : {model.around.a, model.around.b}) box.include(end);
  return model.radius_m > 0 ? box.grown(model.around.radius_m) : Aabb{};
}

void ScenePainter::move_surface(std::size_t k, const TriMesh& rest_W, const TriMesh& moved_W,
                                std::span<const float> depth_m) {
  if (k >= shared_->bones.size()) return;
  RestLight& light = shared_->bones[k].light;
  ShadedMesh lit = depth_m.empty() ? shown_light(rest_W, light, moved_W)
                                   : opened_light(rest_W, light, moved_W, depth_m);
  if (lit.positions.empty()) return set_surface(k, moved_W);
  BoneModel& model = shared_->bones[k];
  const bool alike = !model.moved.positions.empty() && model.closed == lit.closed &&
                     model.wounded == !depth_m.empty();
  Aabb box = alike ? changed_box(model.moved, lit) : extent_of(model);
  model.closed = lit.closed;
  model.wounded = !depth_m.empty();
  model.levels.clear();
  model.levels.push_back({GpuMesh(lit), 0});
  set_extent(model, moved_W);
  if (!alike) {
    for (const Vec3& p : moved_W.vertices)
      if (is_finite(p)) box.include(p);
  }
  model.moved = std::move(lit);
  shared_->changes.within(k, box);
}

void ScenePainter::set_cubes(std::size_t bone, const CubeGrid& grid,
                             std::span<const SurfaceCube> cubes) {
  if (bone >= shared_->bones.size()) return;
  const bool soft = bone >= shared_->rest_X_WB.size();
  ChangedCubes& changed = shared_->bones[bone].changed;
  const bool first = !changed.is_on(grid);
  changed.set(grid, cubes, soft ? ChangedCubes::kSoft : bone);
  if (first) return shared_->changes.anywhere();
  Aabb box;
  for (const SurfaceCube& cube : cubes) {
    const Aabb one = changed.box_of(cube.cube);
    box.include(one.lo);
    box.include(one.hi);
  }
  shared_->changes.within(bone, box);
}

void ScenePainter::clear_cubes() {
  for (BoneModel& bone : shared_->bones) {
    bone.changed.clear();
    bone.heat.set({});
  }
  shared_->changes.anywhere();
}

void ScenePainter::set_heat(std::size_t bone, const HeatCells& heat) {
  if (bone >= shared_->rest_X_WB.size()) return;
  shared_->bones[bone].heat.set(heat);
  shared_->changes.anywhere();
}

bool ScenePainter::any_heat(const ViewState& view) const {
  return view.show_heat && std::any_of(shared_->bones.begin(), shared_->bones.end(),
                                       [](const BoneModel& bone) { return !bone.heat.empty(); });
}

bool ScenePainter::any_changed() const {
  return std::any_of(shared_->bones.begin(), shared_->bones.end(),
                     [](const BoneModel& bone) { return !bone.changed.empty(); });
}

ScenePainter::BoneModel ScenePainter::make_soft(const Case& the_case, const SoftPart& soft) {
  BoneModel model;
  model.outermost = soft.kind == "skin";
  for (const BoneId bone : soft.bones) model.rides_on.push_back(bone.index);
  if (model.outermost) model.cover = LimbCover::over(the_case);
  set_extent(model, soft.mesh_W);
  model.middle_B = model.center_B;
  return model;
}

const BoneAppearance& ScenePainter::look_of(const ViewState& view, std::size_t k) const {
  static const BoneAppearance hidden{.visible = false};
  if (k < shared_->rest_X_WB.size()) return appearance(view, k);
  const std::size_t soft = k - shared_->rest_X_WB.size();
  return soft < view.softs.size() ? view.softs[soft] : hidden;
}

bool ScenePainter::shows(const RenderSnapshot& snapshot, const ViewState& view,
                         std::size_t k) const {
  // What stands for a graft on a bench is felt where it will be; what is made is drawn there.
  const std::optional<GraftBenchPlan>& bench = shared_->bench;
  if (bench && snapshot.bones.bench.on && k == bench->bones[GraftBenchPlan::kGraft]) return false;
  if (k < shared_->rest_X_WB.size()) return is_shown(snapshot, view, k);
  const BoneAppearance& look = look_of(view, k);
  return look.visible && look.opacity >= kSeenThrough && is_finite(pose(snapshot, k));
}

/// A soft part follows the mean motion of its bones away from rest, skin that bends the upper bone.
Pose ScenePainter::pose(const RenderSnapshot& snapshot, std::size_t k) const {
  if (k < shared_->rest_X_WB.size()) return snapshot.bones.bones[k].X_WB;
  if (const auto& cover = shared_->bones[k].cover)
    return cover->motion(snapshot.bones, shared_->rest_X_WB).upper;
  return mean_motion(snapshot.bones, shared_->rest_X_WB, shared_->bones[k].rides_on,
                     shared_->bones[k].middle_B);
}

Result<ScenePainter> ScenePainter::create(const Case& the_case, const Tool& tool,
                                          const std::filesystem::path& shader_dir,
                                          const PreparedCase& prepared) {
  ScenePainter painter;
  const struct {
    Program* program;
    const char *vert, *frag;
  } programs[] = {{&painter.shared_->bone, "surface", "bone"},
                  {&painter.shared_->depth, "surface", "depth"},
                  {&painter.shared_->metal, "surface", "metal"},
                  {&painter.shared_->mark, "surface", "mark"},
                  {&painter.shared_->ground, "screen", "ground"}};
  for (const auto& p : programs) {
    auto loaded = Program::load(shader_dir, p.vert, p.frag);
    if (!loaded) return tl::unexpected(loaded.error());
    *p.program = std::move(*loaded);
  }
  auto changed = Program::load_changed(shader_dir, "surface", "bone");
  if (!changed) return tl::unexpected(changed.error());
  painter.shared_->changed_bone = std::move(*changed);
  for (const bool is_changed : {false, true}) {
    auto heated = Program::load_with(shader_dir, "surface", "bone", "#define HEATED\n", is_changed);
    if (!heated) return tl::unexpected(heated.error());
    (is_changed ? painter.shared_->changed_heated_bone : painter.shared_->heated_bone) =
        std::move(*heated);
  }
  const std::pair<Program*, const char*> covers[] = {{&painter.shared_->cover_bone, "bone"},
                                                     {&painter.shared_->cover_depth, "depth"},
                                                     {&painter.shared_->cover_mark, "mark"}};
  for (const auto& [program, frag] : covers) {
    auto loaded = Program::load_with(shader_dir, "surface", frag, "#define COVERS\n");
    if (!loaded) return tl::unexpected(loaded.error());
    *program = std::move(*loaded);
  }
  for (const Bone& bone : the_case.bones) {
    painter.shared_->bones.push_back(make_bone(bone));
    painter.shared_->rest_X_WB.push_back(bone.X_WB);
  }
  for (const SoftPart& soft : the_case.softs)
    painter.shared_->bones.push_back(make_soft(the_case, soft));
  painter.shared_->bench = find_graft_bench(the_case);
  painter.set_surfaces(prepared);
  painter.shared_->tools.push_back(make_tool_model(tool));
  painter.shared_->shaft = GpuMesh(plain_shaded(cylinder(20)));
  painter.shared_->head = GpuMesh(plain_shaded(cone(24)));
  painter.shared_->ball = GpuMesh(plain_shaded(ball(12, 20)));
  painter.shared_->no_vertices = make_vertex_array();
  return painter;
}

ScenePainter::ToolModel ScenePainter::make_tool_model(const Tool& tool) {
  ToolModel model = make_tool_model(tool.mesh, tool.tip_radius_m);
  for (const TriMesh& mesh : tool.opened)
    model.opened.push_back(make_tool_model(mesh, tool.tip_radius_m));
  return model;
}

ScenePainter::ToolModel ScenePainter::make_tool_model(const TriMesh& mesh, double tip_radius_m) {
  ToolModel model;
  model.mesh = GpuMesh(plain_shaded(mesh));
  model.capsules = capsules_along_z(mesh);
  model.length_m = std::max(0.0, finite_bounds(mesh).hi.z());
  model.shaft_T = shaft_line(mesh, model.length_m);
  model.tip_radius_m = tip_radius_m;
  return model;
}

void ScenePainter::set_tray(std::span<const std::shared_ptr<const Tool>> tray) {
  if (tray.empty()) return;
  shared_->changes.anywhere();
  shared_->tools.clear();
  for (const auto& tool : tray) shared_->tools.push_back(make_tool_model(*tool));
}

Aabb ScenePainter::content(const RenderSnapshot& snapshot, const ViewState& view) const {
  Aabb box;
  const auto include = [&box](const Vec3& p, double radius) {
    if (!is_finite(p) || !std::isfinite(radius)) return;
    box.include(p - Vec3::Constant(radius));
    box.include(p + Vec3::Constant(radius));
  };
  for (std::size_t k = 0; k < shared_->bones.size(); ++k)
    if (shows(snapshot, view, k))
      for (const Pose& X_WB : end_poses(snapshot, k))
        include(X_WB * shared_->bones[k].center_B, shared_->bones[k].radius_m);
  const auto include_tool = [&](const ToolState& state, const Pose& X) {
    if (!is_finite(X) || !view.show_proxy) return;
    const ToolModel& tool = model_of(state);
    include(X.p, 2 * tool.tip_radius_m);
    include(X * Vec3(0, 0, tool.length_m), 0.01);
  };
  include_tool(snapshot.tool, snapshot.tool.X_WP);
  include_tool(snapshot.tool, snapshot.tool.X_WD);
  for (const ToolState& other : others_) include_tool(other, other.X_WP);
  for (const GhostTool& ghost : ghosts_) {
    if (!view.show_proxy) break;
    const ToolModel& tool = model_at(ghost.instrument);
    include(ghost.X_WT.p, 2 * tool.tip_radius_m);
    include(ghost.X_WT * Vec3(0, 0, tool.length_m), 0.01);
  }
  for (const Capsule& c : loose_capsules(snapshot, view)) {
    include(c.a, c.radius_m);
    include(c.b, c.radius_m);
  }
  if (const auto arrow = force_arrow(snapshot.tool); arrow && view.show_force)
    include(arrow->from_W + arrow->dir_W * arrow->length_m, 0.01);
  const auto include_solids = [&](const std::vector<Solid>& solids) {
    for (const Solid& solid : solids) {
      if (solid.box_W.empty()) continue;
      box.include(solid.box_W.lo);
      box.include(solid.box_W.hi);
    }
  };
  include_solids(solids_);
  if (view.show_proxy) include_solids(moving_solids_);
  if (box.empty()) box.include(view.camera.target_W);
  return box;
}

void ScenePainter::set_shared(const Program& program, const ViewState& view,
                              const Frame& frame) const {
  program.use();
  program.set("u_clip_from_view", frame.clip_from_view);
  program.set("u_key_dir", frame.key_dir_C);
  program.set("u_key_strength", view.light_brightness);
  program.set("u_occlusion", std::clamp(view.ambient_occlusion, 0.0f, 1.0f));
  program.set("u_orthographic", view.camera.orthographic ? 1 : 0);
  program.set("u_outline", Eigen::Vector2f(0, 0));
}

void ScenePainter::set_tool_shade(const Program& program, const RenderSnapshot& snapshot,
                                  const ViewState& view, const Frame& frame) const {
  const Pose& X_WP = snapshot.tool.X_WP;
  const ToolModel& tool = model_of(snapshot.tool);
  const bool shades = view.show_proxy && !tool.mesh.empty() && is_finite(X_WP) && tool.length_m > 0;
  const Pose X_CP = frame.X_CW * X_WP;
  const Eigen::Vector3f tip = X_CP.p.cast<float>();
  const auto radius = static_cast<float>(shades ? tool.tip_radius_m : 0.0);
  program.set("u_tool_tip", shades ? Color(tip.x(), tip.y(), tip.z(), radius) : Color(0, 0, 0, 0));
  const auto point = [&](double z, const Vec3& fallback) -> Eigen::Vector3f {
    const Vec3 p = shades ? X_CP * Vec3(tool.shaft_T.x(), tool.shaft_T.y(), z) : fallback;
    return p.cast<float>();
  };
  program.set("u_tool_start",
              point(std::min(3 * tool.tip_radius_m, 0.5 * tool.length_m), Vec3::Zero()));
  program.set("u_tool_reach", Eigen::Vector2f(static_cast<float>(shade_reach(tool).near_m),
                                              static_cast<float>(shade_reach(tool).shadow_m)));
  program.set("u_tool_end", point(tool.length_m, Vec3::UnitZ()));
}

void ScenePainter::paint(const RenderSnapshot& snapshot, const ViewState& wanted,
                         const Frame& frame) const {
  const ViewState view = with_far_covers_clear(snapshot, wanted);
  if (any_changed()) {
    set_shared(shared_->changed_bone, view, frame);
    set_tool_shade(shared_->changed_bone, snapshot, view, frame);
  }
  if (any_heat(view))
    for (const Program* p : {&shared_->heated_bone, &shared_->changed_heated_bone}) {
      set_shared(*p, view, frame);
      set_tool_shade(*p, snapshot, view, frame);
      HeatTexture::set_colors(*p);
    }
  for (const Program* p : {&shared_->metal, &shared_->mark, &shared_->depth, &shared_->bone,
                           &shared_->cover_mark, &shared_->cover_depth, &shared_->cover_bone})
    set_shared(*p, view, frame);
  set_tool_shade(shared_->cover_bone, snapshot, view, frame);
  shared_->bone.use();
  set_tool_shade(shared_->bone, snapshot, view, frame);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  paint_opaque_bones(snapshot, view, frame);
  paint_loose(snapshot, view, frame);
  if (view.show_proxy) {
    const Color steel = with_alpha(kSteel, 1);
    paint_tool(model_of(snapshot.tool), snapshot.tool.X_WP, steel, frame);
    for (const ToolState& other : others_) paint_tool(model_of(other), other.X_WP, steel, frame);
  }
  paint_rods(snapshot, frame);
  paint_placing(snapshot, frame);
  paint_outlines(snapshot, view, frame, false);
  glEnable(GL_BLEND);
  // Colour is mixed; alpha stays that of a solid picture.
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  paint_clear_bones(snapshot, view, frame);
  // Now that their depth stands, only the line around them is left of what is pushed outwards.
  paint_outlines(snapshot, view, frame, true);
  if (view.show_hulls) paint_hulls(snapshot, view, frame);
  paint_solid_marks(solids_, frame);
  if (view.show_proxy) paint_solid_marks(moving_solids_, frame);
  paint_lines(snapshot, frame);
  if (shows_hand(snapshot, view))
    paint_tool(model_of(snapshot.tool), snapshot.tool.X_WD, with_alpha(kSteel, 0.30f), frame);
  if (view.show_proxy) paint_ghosts(frame);
  if (view.show_force) paint_marks(snapshot, frame);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glUseProgram(0);
}

void ScenePainter::paint_ground(const PictureWindow& w) const {
  shared_->ground.use();
  shared_->ground.set("u_window",
                      Eigen::Vector4d(w.x, w.y, w.width, w.height).cast<float>().eval());
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glBindVertexArray(shared_->no_vertices.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
}

void ScenePainter::paint_tool(const ToolModel& tool, const Pose& X_WT, const Color& color,
                              const Frame& frame) const {
  if (tool.mesh.empty() || !is_finite(X_WT)) return;
  shared_->metal.use();
  shared_->metal.set("u_view_from_model", to_matrix(frame.X_CW * X_WT));
  shared_->metal.set("u_color", color);
  if (color.w() >= 1) return tool.mesh.draw();
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glDepthMask(GL_FALSE);
  tool.mesh.draw();
  glDepthMask(GL_TRUE);
  glDisable(GL_CULL_FACE);
}

}  // namespace osteon
