#include "osteon/render/scope_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "gl/flush_now_and_then.h"
#include "gl/frame.h"
#include "gl/gl_objects.h"
#include "gl/gpu_mesh.h"
#include "gl/light_target.h"
#include "gl/render_target.h"
#include "osteon/scene/soft_motion.h"
#include "read_picture.h"
#include "renderer_impl.h"
#include "scope_bits.h"
#include "scope_lens.h"
#include "scope_painted.h"
#include "scope_parts.h"
#include "scope_programs.h"
#include "surface/changed_cubes.h"
#include "surface/cut_light.h"
#include "surface/loose_surface.h"
#include "surface/shapes.h"
#include "surface/tissue_part.h"
#include "view/scope_field.h"

namespace osteon {
namespace {

constexpr double kNear_m = 0.0003, kFar_m = 0.15;

Eigen::Matrix4f flat_projection(double half) { return pinhole(half, kNear_m, kFar_m); }

/// How far a coarser surface may lie off in a moving picture of a window, in pixels of the flat
/// picture, which has 0.7 of the window's.
constexpr double kScopeLevelError_px = 1.4;

constexpr float kScopeGhostSeen = 0.02f, kScopeGhostMost = 0.8f;  // opacity
}  // namespace

struct ScopeRenderer::Impl {
  ScopePrograms programs;
  ScopeLens lens;
  ScopeBits bits;
  std::optional<ScenePainter> scene;  ///< that the surfaces belong to; none: they are the parts'
  std::vector<TissuePart> parts;
  TissuePart wall;
  std::uint64_t walls = 0;  ///< that there have been
  ScopeWater water;
  Vec3 white = Vec3::Ones();  ///< see shown_white
  std::vector<Pose> rest_X_WB;
  TissuePart tool = steel(), ghost = ghost_part();
  /// By ToolState::instrument and jaw_step(), where there is no scene.
  std::vector<std::vector<GpuMesh>> tray;
  struct ShownTool {
    std::uint32_t instrument = 0;
    std::size_t jaw = 0;
    Pose X_WT;
  };
  std::vector<ShownTool> tools;
  std::vector<GhostTool> ghosts;
  std::map<std::uint64_t, GpuMesh> own_loose;  ///< by shape, where there is no scene
  std::vector<LooseBone> loose;
  std::vector<TissuePart> loose_looks;  ///< of them
  std::vector<PlacingRod> rods;         ///< thread, graft and button now
  std::vector<TissuePart> placed;       ///< the same, in World
  bool rods_changed = false;
  LightTarget flat;
  GpuMesh corners;  ///< of the flat picture, that are not drawn
  int corners_px = 0;
  RenderTarget picture;
  bool software = false;
  std::optional<ScopePainted> painted;
  int calm = 0;  ///< pictures since the last that moved
  double gain = 0;
  double nearest_m = 0;                   ///< what the flat picture shows is no nearer
  std::vector<float> readings;            ///< room for those of the flat picture
  std::vector<ChangedCubes> own_changed;  ///< by TissuePart::model, where there is no scene
  std::uint64_t cubes = 0;                ///< how often they have been set

  /// The coarsest there is within `error_m` of the exact one.
  const GpuMesh& surface(const TissuePart& part, double error_m) const {
    return scene ? scene->surface_within(part.model, error_m) : part.surface;
  }
  const GpuMesh* tool_surface(std::uint32_t instrument, std::size_t jaw = 0) const {
    if (scene) return scene->tool_surface(instrument, jaw);
    if (instrument >= tray.size()) return nullptr;
    return &tray[instrument][jaw < tray[instrument].size() ? jaw : 0];
  }
  const GpuMesh* loose_surface(std::uint64_t shape) const {
    if (scene) return scene->loose_surface(shape);
    const auto found = own_loose.find(shape);
    return found == own_loose.end() ? nullptr : &found->second;
  }
  /// Where another surface stands than was prepared; null: nowhere.
  const ChangedCubes* changed(const TissuePart& part) const {
    if (part.model >= rest_X_WB.size() && part.pattern != TissuePattern::kCartilage) return nullptr;
    const ChangedCubes* all = scene                             ? &scene->changed(part.model)
                              : part.model < own_changed.size() ? &own_changed[part.model]
                                                                : nullptr;
    return all && !all->empty() ? all : nullptr;
  }

  /// Of a piece that lies loose.
  TissuePart looks_of(const LooseBone& shown) const {
    const std::size_t model = rest_X_WB.size() + shown.soft;
    const auto soft = std::find_if(parts.begin(), parts.end(),
                                   [&](const TissuePart& part) { return part.model == model; });
    if (shown.soft == kNoSoftPart || soft == parts.end() || shown.bone >= rest_X_WB.size())
      return {};
    return loose_part_of(*soft, rest_X_WB[shown.bone]);
  }

  /// What the tip lies in gives way to it: it is not seen from inside.
  static bool one_sided(const TissuePart& part) {
    return part.faces_out || part.pattern == TissuePattern::kFat;
  }

  /// A surface and the stretches of it that can be seen.
  struct Seen {
    const TissuePart* part = nullptr;
    const GpuMesh* mesh = nullptr;
    Pose X_CM;
    GpuMesh::Stretches stretches;
    double least_m = kFar_m;  ///< it is no nearer
    int triangles() const {
      return std::accumulate(stretches.counts.begin(), stretches.counts.end(), 0) / 3;
    }
  };
  Seen seen_of(const TissuePart& part, const GpuMesh& mesh, const Pose& X_CM,
               const ScopeField& field) const {
    Seen seen{&part, &mesh, X_CM, {}};
    seen.stretches = mesh.stretches([&](const GpuMesh::Chunk& chunk) {
      const Vec3 center_C = X_CM * chunk.center;
      if (!field.shows(center_C, chunk.radius, kNear_m)) return false;
      seen.least_m = std::min(seen.least_m, -center_C.z() - chunk.radius);
      return true;
    });
    return seen;
  }
  /// Of a part of the case, from the level that its nearest place in the field allows.
  Seen seen_of(const TissuePart& part, const Pose& X_CM, const ScopeField& field,
               double off) const {
    Seen exact = seen_of(part, surface(part, 0), X_CM, field);
    const GpuMesh& mesh = surface(part, off * std::max(exact.least_m, kNear_m));
    return &mesh == exact.mesh ? exact : seen_of(part, mesh, X_CM, field);
  }
  /// A coarser surface may lie off by `off` of its distance.
  std::vector<Seen> all_seen(const ScopeCamera& camera, const ScopeField& field, double off) const {
    const Pose X_CW = camera.X_WC().inverse();
    std::vector<Seen> out;
    for (const TissuePart& part : parts) out.push_back(seen_of(part, X_CW * part.X_WM, field, off));
    if (!wall.surface.empty()) out.push_back(seen_of(wall, wall.surface, X_CW, field));
    for (std::size_t k = 0; k < loose.size(); ++k)
      if (const GpuMesh* mesh = loose_surface(loose[k].shape))
        out.push_back(seen_of(loose_looks[k], *mesh, X_CW * loose[k].X_WB, field));
    for (const TissuePart& part : placed) out.push_back(seen_of(part, part.surface, X_CW, field));
    for (const ShownTool& shown : tools)
      if (const GpuMesh* mesh = tool_surface(shown.instrument, shown.jaw))
        out.push_back(seen_of(tool, *mesh, X_CW * shown.X_WT, field));
    std::erase_if(out,
                  [&](const Seen& seen) { return seen.stretches.empty() && !changed(*seen.part); });
    return out;
  }

  void paint_part(const Seen& seen, double half, bool depth_alone) const {
    const TissuePart& part = *seen.part;
    const ChangedCubes* const cubes_of = changed(part);
    if (cubes_of) {
      const Program& old = programs.changed(part);
      ScopePrograms::begin(old, part, flat_projection(half), seen.X_CM);
      cubes_of->hide(old);
      seen.mesh->draw(seen.stretches);
    }
    ScopePrograms::begin(programs.of(part, depth_alone), part, flat_projection(half), seen.X_CM);
    if (cubes_of) return cubes_of->draw();
    if (one_sided(part)) glEnable(GL_CULL_FACE);
    seen.mesh->draw(seen.stretches);
    glDisable(GL_CULL_FACE);
  }

  /// While nothing moves, programs of later pictures are compiled, one in place of each picture.
  /// Returns true: the one before stands.
  bool rest() {
    GLint bound = 0;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
    (void)(lens.ready_one(flat, picture) || bits.ready_one() || programs.ready_one());
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(bound));
    return true;
  }
  /// With the context current.
  void make_corners() {
    if (corners_px == flat.side()) return;
    corners_px = flat.side();
    corners = GpuMesh(plain_shaded(unseen_corners(corners_px)));
  }
  /// Nothing is drawn behind them.
  void hide_corners() const {
    if (corners.empty()) return;
    const Program& depth = programs.depth();
    depth.use();
    depth.set("u_clip_from_view", Eigen::Matrix4f(Eigen::Matrix4f::Identity()));
    depth.set("u_view_from_model", Eigen::Matrix4f(Eigen::Matrix4f::Identity()));
    corners.draw();
  }

  /// What hides others comes first: bones lie under soft parts, the wall behind all.
  std::pair<int, double> order(const Seen& seen) const {
    return {seen.part == &wall ? 2 : seen.part->model < rest_X_WB.size() ? 1 : 0, seen.least_m};
  }

  /// First the depth alone: the patterns are then worked out for what is seen only. Where surfaces
  /// may lie off, by `off_px`, their order alone does nearly as well.
  void paint_flat(const ScopeCamera& camera, double half, double off_px) const {
    glBindFramebuffer(GL_FRAMEBUFFER, flat.framebuffer());
    glViewport(0, 0, flat.side(), flat.side());
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClearDepth(1.0);
    glClear(GL_DEPTH_BUFFER_BIT);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    hide_corners();
    const ScopeField field(half, seen_radius(flat.side()));
    std::vector<Seen> all = all_seen(camera, field, off_px * 2 * half / flat.side());
    FlushNowAndThen flush;
    if (off_px > 0) {
      std::stable_sort(all.begin(), all.end(),
                       [&](const Seen& a, const Seen& b) { return order(a) < order(b); });
    } else {
      for (const Seen& seen : all) {
        paint_part(seen, half, true);
        flush.after(seen.triangles());
      }
      glDepthMask(GL_FALSE);
    }
    glDepthFunc(GL_LEQUAL);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    for (const Seen& seen : all) {
      paint_part(seen, half, false);
      flush.after(seen.triangles());
    }
    programs.paint_nothing();
    glDepthMask(GL_TRUE);
    bits.paint(camera.X_WC().inverse(), flat_projection(half));
    paint_ghosts(camera, half, field);
    glDisable(GL_DEPTH_TEST);
  }

  /// Over what is seen, the nearest side alone. The distance under them stays: they stand in no
  /// water and are as sharp as what is behind.
  void paint_ghosts(const ScopeCamera& camera, double half, const ScopeField& field) const {
    const Pose X_CW = camera.X_WC().inverse();
    for (const GhostTool& shown : ghosts) {
      const GpuMesh* const mesh = tool_surface(shown.instrument);
      if (!mesh) continue;
      const float opacity = std::min(shown.opacity, kScopeGhostMost);
      const Seen seen = seen_of(ghost, *mesh, X_CW * shown.X_WT, field);
      glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
      paint_part(seen, half, true);
      glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
      glEnable(GL_BLEND);
      glBlendColor(0, 0, 0, opacity);
      glBlendFuncSeparate(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA, GL_ZERO, GL_ONE);
      paint_part(seen, half, false);
      glDisable(GL_BLEND);
    }
  }

  void paint_lens(const ScopeCamera& camera, double half, double exposure,
                  const Viewport& viewport) {
    lens.paint(flat, picture, {camera, half, nearest_m, exposure, white, viewport}, water);
  }

  ScopePainted as_it_is(const ScopeCamera& camera, int side_px) const {
    ScopePainted now;
    now.side_px = side_px;
    now.X_WC = camera.X_WC();
    now.half_field_rad = camera.half_field_rad();
    now.barrel = camera.barrel();
    now.wall = walls;
    now.water = water;
    now.white = white;
    now.bits = bits.bits();
    now.version = scene ? scene->version() : cubes;
    for (const TissuePart& part : parts) now.parts.push_back(part.X_WM);
    for (const ShownTool& shown : tools) {
      now.instruments.push_back(shown.instrument);
      now.instruments.push_back(shown.jaw);
      now.tools.push_back(shown.X_WT);
    }
    for (const GhostTool& shown : ghosts) {
      now.instruments.push_back(shown.instrument);
      now.tools.push_back(shown.X_WT);
      now.ghosts.push_back(shown.opacity);
    }
    for (const LooseBone& shown : loose) now.tools.push_back(shown.X_WB);
    for (const PlacingRod& rod : rods)
      for (const Vec3& end : {rod.a_W, rod.b_W}) now.tools.push_back({end, Quat::Identity()});
    return now;
  }

  /// As many pixels as the round picture has in its middle, where the lens shows most, times
  /// `finer`.
  static int flat_side(const ScopeCamera& camera, const Viewport& viewport, double finer) {
    const double per_tangent = ScopeCamera::radius_px(viewport) * camera.barrel() /
                               std::tan(camera.barrel() * camera.half_field_rad());
    const double side = std::ceil(finer * 2 * flat_half(camera) * per_tangent);
    return std::clamp(static_cast<int>(side), 16, kMaxImageSide);
  }
  static double flat_half(const ScopeCamera& camera) {
    return 1.01 * std::tan(camera.half_field_rad());
  }
  static Result<std::unique_ptr<Impl>> load(const std::filesystem::path& data_dir);
  void add_parts(const Case& the_case);
  /// With the context current.
  void make_placed() {
    if (!rods_changed) return;
    rods_changed = false;
    placed.clear();
    for (const PlacingRod& rod : rods) placed.push_back(placed_part(rod));
  }
};

ScopeRenderer::ScopeRenderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ScopeRenderer::~ScopeRenderer() = default;
ScopeRenderer::ScopeRenderer(ScopeRenderer&&) noexcept = default;
ScopeRenderer& ScopeRenderer::operator=(ScopeRenderer&&) noexcept = default;

Result<std::unique_ptr<ScopeRenderer::Impl>> ScopeRenderer::Impl::load(
    const std::filesystem::path& data_dir) {
  auto impl = std::make_unique<Impl>();
  const std::filesystem::path shaders = data_dir / "shaders";
  auto programs = ScopePrograms::load(shaders);
  if (!programs) return tl::unexpected(programs.error());
  impl->programs = std::move(*programs);
  auto lens = ScopeLens::load(shaders);
  if (!lens) return tl::unexpected(lens.error());
  impl->lens = std::move(*lens);
  auto bits = ScopeBits::load(shaders);
  if (!bits) return tl::unexpected(bits.error());
  impl->bits = std::move(*bits);
  impl->wall.pattern = TissuePattern::kSynovium;
  return impl;
}

/// Bones, then soft parts without the skin.
void ScopeRenderer::Impl::add_parts(const Case& the_case) {
  for (std::size_t k = 0; k < the_case.bones.size(); ++k) {
    TissuePart part;
    part.model = k;
    part.X_WM = the_case.bones[k].X_WB;
    part.faces_out = faces_out(the_case.bones[k].mesh);
    rest_X_WB.push_back(part.X_WM);
    parts.push_back(std::move(part));
  }
  for (std::size_t k = 0; k < the_case.softs.size(); ++k) {
    const SoftPart& soft = the_case.softs[k];
    if (soft.kind == "skin") continue;
    TissuePart part;
    part.model = the_case.bones.size() + k;
    part.pattern = pattern_of(soft.kind);
    part.tint = soft.color_srgb;
    part.faces_out = faces_out(soft.mesh_W);
    for (const BoneId bone : soft.bones) part.rides_on.push_back(bone.index);
    find_fibres(soft, part);
    part.middle = part.center.cast<double>();
    parts.push_back(std::move(part));
  }
}

Result<ScopeRenderer> ScopeRenderer::create(const Case& the_case,
                                            const std::filesystem::path& data_dir,
                                            const PreparedCase& prepared) {
  auto impl = Impl::load(data_dir);
  if (!impl) return tl::unexpected(impl.error());
  (*impl)->add_parts(the_case);
  const std::size_t bones = the_case.bones.size();
  for (TissuePart& part : (*impl)->parts) {
    const bool soft = part.model >= bones;
    const auto& meshes = soft ? prepared.softs : prepared.bones;
    const std::size_t at = soft ? part.model - bones : part.model;
    if (at < meshes.size()) part.surface = GpuMesh(meshes[at]);
    if (soft && at < meshes.size()) part.light = {meshes[at].shades, meshes[at].roots};
  }
  static const ShadedMesh nothing;
  for (std::size_t k = 0; k < bones + the_case.softs.size(); ++k) {
    const auto& meshes = k < bones ? prepared.bones : prepared.softs;
    const std::size_t at = k < bones ? k : k - bones;
    (*impl)->own_changed.emplace_back().set_base(at < meshes.size() ? meshes[at] : nothing);
  }
  return ScopeRenderer(std::move(*impl));
}

Result<ScopeRenderer> ScopeRenderer::create(const Case& the_case,
                                            const std::filesystem::path& data_dir,
                                            const Renderer& scene) {
  auto impl = Impl::load(data_dir);
  if (!impl) return tl::unexpected(impl.error());
  (*impl)->add_parts(the_case);
  (*impl)->scene.emplace(scene.impl_->painter.another());
  (*impl)->software = scene.software_driver();
  return ScopeRenderer(std::move(*impl));
}

void ScopeRenderer::set_tray(std::span<const std::shared_ptr<const Tool>> tray) {
  impl_->tools.clear();
  impl_->tray.clear();
  if (impl_->scene) return;
  for (const auto& tool : tray) {
    std::vector<GpuMesh>& shapes = impl_->tray.emplace_back();
    shapes.emplace_back(plain_shaded(tool->mesh));
    for (const TriMesh& mesh : tool->opened) shapes.emplace_back(plain_shaded(mesh));
  }
}

void ScopeRenderer::set_ghosts(std::span<const GhostTool> ghosts) {
  impl_->ghosts.clear();
  for (const GhostTool& ghost : ghosts)
    if (ghost.opacity >= kScopeGhostSeen && is_finite(ghost.X_WT)) impl_->ghosts.push_back(ghost);
}

void ScopeRenderer::set_scene(const BoneSnapshot& bones, std::span<const ToolState> tools) {
  const std::size_t count = std::min<std::size_t>(impl_->rest_X_WB.size(), bones.count);
  for (std::size_t k = 0; k < count; ++k)
    if (is_finite(bones.bones[k].X_WB)) impl_->parts[k].X_WM = bones.bones[k].X_WB;
  for (TissuePart& part : impl_->parts)
    if (!part.rides_on.empty())
      part.X_WM = mean_motion(bones, impl_->rest_X_WB, part.rides_on, part.middle);
  impl_->tools.clear();
  for (const ToolState& tool : tools)
    if (impl_->tool_surface(tool.instrument) && is_finite(tool.X_WP))
      impl_->tools.push_back({tool.instrument, jaw_step(tool.jaw), tool.X_WP});
  impl_->loose.clear();
  for (std::size_t i = 0; i < std::min<std::size_t>(bones.loose.count, kMaxLoose); ++i)
    if (is_finite(bones.loose.bones[i].X_WB)) impl_->loose.push_back(bones.loose.bones[i]);
  impl_->loose_looks.clear();
  for (const LooseBone& shown : impl_->loose) impl_->loose_looks.push_back(impl_->looks_of(shown));
  auto rods = placing_rods(bones);
  std::erase_if(rods, [](const PlacingRod& rod) {
    return !is_finite(rod.a_W) || !((rod.b_W - rod.a_W).norm() > 1e-6);
  });
  impl_->rods_changed = impl_->rods_changed || !same_rods(rods, impl_->rods);
  impl_->rods = std::move(rods);
}

void ScopeRenderer::set_surface(BoneId part, const TriMesh& mesh) {
  if (impl_->scene) return;
  for (TissuePart& own : impl_->parts)
    if (own.model == part.index) own.surface = GpuMesh(plain_shaded(mesh));
  ++impl_->cubes;
}

// Of what a scope shows, nothing has grooves: skin is none of it.
void ScopeRenderer::move_surface(BoneId part, const TriMesh& rest_W, const TriMesh& moved_W,
                                 std::span<const float>) {
  if (impl_->scene) return;
  for (TissuePart& own : impl_->parts) {
    if (own.model != part.index) continue;
    const ShadedMesh lit = shown_light(rest_W, own.light, moved_W);
    own.surface = lit.positions.empty() ? GpuMesh(plain_shaded(moved_W)) : GpuMesh(lit);
  }
  ++impl_->cubes;
}

void ScopeRenderer::set_cubes(BoneId bone, const CubeGrid& grid,
                              std::span<const SurfaceCube> cubes) {
  if (bone.index >= impl_->own_changed.size()) return;  // the scene's own are seen
  impl_->own_changed[bone.index].set(
      grid, cubes, bone.index < impl_->rest_X_WB.size() ? bone.index : ChangedCubes::kSoft);
  ++impl_->cubes;
}

void ScopeRenderer::set_loose(std::uint64_t shape, BoneId bone, const SurfaceCube& surface) {
  if (impl_->scene) return;
  impl_->own_loose.insert_or_assign(shape, GpuMesh(loose_shaded(surface, bone.index)));
  ++impl_->cubes;
}

void ScopeRenderer::clear_cubes() {
  for (ChangedCubes& bone : impl_->own_changed) bone.clear();
  ++impl_->cubes;
}

void ScopeRenderer::set_water(const ScopeWater& water) {
  const auto bounded = [](double value, double most) {
    return std::isfinite(value) ? std::clamp(value, 0.0, most) : 0;
  };
  constexpr double kMostTaken_per_m = 1e5;
  ScopeWater& now = impl_->water;
  now = {};
  now.taken_per_m = bounded(water.taken_per_m, kMostTaken_per_m);
  now.blood = bounded(water.blood, 1);
  now.fog = bounded(water.fog, 1);
  const std::size_t count = std::min<std::size_t>(water.plume_count, ScopeWater::kMostPlumes);
  for (std::size_t k = 0; k < count; ++k) {
    const BloodPlume& plume = water.plumes[k];
    const double taken_per_m = bounded(plume.taken_per_m, kMostTaken_per_m);
    if (is_finite(plume.p_W) && bounded(plume.radius_m, 1) > 0 && taken_per_m > 0)
      now.plumes[now.plume_count++] = {plume.p_W, bounded(plume.radius_m, 1), taken_per_m};
  }
}

void ScopeRenderer::set_water_bits(std::span<const WaterBit> bits) { impl_->bits.set(bits); }

void ScopeRenderer::set_white_balance(const WhiteBalance& white) {
  impl_->white = shown_white(white);
}

void ScopeRenderer::set_wall(const TriMesh& wall_W) {
  impl_->wall.surface = GpuMesh(plain_shaded(wall_W));
  ++impl_->walls;
}

/// First as a pinhole sees it, then through the lens.
Image ScopeRenderer::draw_image(const ScopeCamera& camera, int width, int height,
                                RenderQuality quality) {
  const Viewport viewport{0, 0, std::clamp(width, 1, kMaxImageSide),
                          std::clamp(height, 1, kMaxImageSide)};
  const double half = Impl::flat_half(camera);
  const double finer = quality == RenderQuality::kFine ? 2 : 1;
  const int side = Impl::flat_side(camera, viewport, finer);
  GLint bound = 0;
  glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
  Image image;
  impl_->make_placed();
  impl_->painted.reset();
  if (impl_->flat.ensure(side) && impl_->picture.ensure(viewport.width, viewport.height, 0)) {
    impl_->make_corners();
    impl_->paint_flat(camera, half, 0);
    const FlatReading reading = read_flat(side, impl_->readings);
    impl_->nearest_m = reading.nearest_m;
    impl_->paint_lens(camera, half, reading.gain, viewport);
    image = read_back(viewport.width, viewport.height);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(bound));
  return image;
}

/// Gain and the least distance are read before the picture is drawn: by then the one before is
/// ready, and nothing waits for it.
bool ScopeRenderer::paint(const ScopeCamera& camera, int side_px) {
  constexpr double kOfProcessor = 0.7;  // flat pixels, where each costs a processor's time
  constexpr int kSettled = 12;          // pictures after which the gain has come to rest
  constexpr double kOfNearest = 0.9;    // it may have come nearer since the picture before
  const int size = std::clamp(side_px, 16, kMaxImageSide);
  const Viewport viewport{0, 0, size, size};
  impl_->make_placed();
  ScopePainted now = impl_->as_it_is(camera, size);
  const bool first = !impl_->painted;
  impl_->calm = !first && impl_->painted->still(now) ? impl_->calm + 1 : 0;
  if (impl_->calm > kSettled) return impl_->rest();
  const int side = Impl::flat_side(camera, viewport, impl_->software ? kOfProcessor : 1);
  const double half = Impl::flat_half(camera);
  GLint bound = 0;
  glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
  const bool known = !first && impl_->flat.side() == side && impl_->gain > 0;
  const bool room = impl_->flat.ensure(side) && impl_->picture.ensure(size, size, 0);
  if (room) {
    glBindFramebuffer(GL_FRAMEBUFFER, impl_->flat.framebuffer());
    const auto take = [&](const FlatReading& reading) {
      impl_->gain = known ? std::pow(impl_->gain, 0.7) * std::pow(reading.gain, 0.3) : reading.gain;
      impl_->nearest_m = kOfNearest * reading.nearest_m;
    };
    if (known) take(read_flat(side, impl_->readings));
    impl_->make_corners();
    if (impl_->calm == 0 || !known) impl_->paint_flat(camera, half, kScopeLevelError_px);
    if (!known) take(read_flat(side, impl_->readings));
    impl_->paint_lens(camera, half, impl_->gain, viewport);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(bound));
  if (impl_->calm == 0 || first) impl_->painted = std::move(now);
  return room;
}

void ScopeRenderer::show(const Viewport& viewport) const {
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  const RenderTarget& picture = impl_->picture;
  if (!impl_->painted || viewport.empty()) return;
  const bool same = picture.width() == viewport.width && picture.height() == viewport.height;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, picture.framebuffer());
  glBlitFramebuffer(0, 0, picture.width(), picture.height(), viewport.x, viewport.y,
                    viewport.x + viewport.width, viewport.y + viewport.height, GL_COLOR_BUFFER_BIT,
                    same ? GL_NEAREST : GL_LINEAR);
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(bound));
}

}  // namespace osteon
