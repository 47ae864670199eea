#include "osteon/render/scope_renderer.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

#include "changed_cubes.h"
#include "frame.h"
#include "gl_objects.h"
#include "gpu_mesh.h"
#include "joint_wall.h"
#include "light_target.h"
#include "render_target.h"
#include "shapes.h"
#include "soft_motion.h"
#include "tissue_part.h"

namespace osteon {
namespace {

constexpr double kNear_m = 0.0003, kFar_m = 0.15;
constexpr double kFocus_m = 0.012;
/// Of the light that comes back, on the mean, in the picture.
constexpr double kMeanLight = 0.30;

TissuePattern pattern_of(std::string_view kind) {
  if (kind == "cartilage") return TissuePattern::kCartilage;
  if (kind == "meniscus" || kind == "disc") return TissuePattern::kMeniscus;
  if (kind == "ligament" || kind == "tendon") return TissuePattern::kFibres;
  return kind == "fat" ? TissuePattern::kFat : TissuePattern::kBone;
}

/// Fibres run along a band's longest axis; a meniscus lies across its shortest.
void find_fibres(const std::vector<Vec3>& vertices, TissuePart& tissue) {
  if (vertices.empty()) return;
  Vec3 center = Vec3::Zero();
  for (const Vec3& v : vertices) center += v / static_cast<double>(vertices.size());
  Mat3 spread = Mat3::Zero();
  for (const Vec3& v : vertices) spread += (v - center) * (v - center).transpose();
  if (!spread.allFinite()) return;
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);
  const int column = tissue.pattern == TissuePattern::kMeniscus ? 0 : 2;
  tissue.fibre = axes.eigenvectors().col(column).cast<float>();
  tissue.center = center.cast<float>();
}

/// A square picture as a pinhole sees it, `half` the tangent of half its width.
Eigen::Matrix4f flat_projection(double half) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  m(0, 0) = m(1, 1) = 1 / half;
  m(2, 2) = -(kFar_m + kNear_m) / (kFar_m - kNear_m);
  m(2, 3) = -2 * kFar_m * kNear_m / (kFar_m - kNear_m);
  m(3, 2) = -1;
  return m.cast<float>();
}

/// The camera's gain: brings the mean of what is seen to kMeanLight. Sparks count no more than
/// their surroundings.
double exposure_of(int side) {
  std::vector<float> rgba(4u * static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  glReadPixels(0, 0, side, side, GL_RGBA, GL_FLOAT, rgba.data());
  double sum = 0, count = 0;
  const int step = std::max(1, side / 64);
  for (int y = side / 6; y < side - side / 6; y += step)
    for (int x = side / 6; x < side - side / 6; x += step) {
      const float* at =
          rgba.data() + 4u * (static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                              static_cast<std::size_t>(x));
      const double light = 0.3 * static_cast<double>(at[0]) + 0.6 * static_cast<double>(at[1]) +
                           0.1 * static_cast<double>(at[2]);
      sum += std::log(std::clamp(light, 1e-4, 1e2));
      count += 1;
    }
  const double mean = count > 0 ? std::exp(sum / count) : 1;
  return std::clamp(kMeanLight / mean, 0.02, 50.0);
}

Image read_back(int width, int height) {
  Image image{width, height, {}};
  const std::size_t row_bytes = 3u * static_cast<std::size_t>(width);
  image.rgb.resize(row_bytes * static_cast<std::size_t>(height));
  std::vector<std::uint8_t> up(image.rgb.size());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, up.data());
  for (int row = 0; row < height; ++row)
    std::memcpy(image.rgb.data() + static_cast<std::size_t>(height - 1 - row) * row_bytes,
                up.data() + static_cast<std::size_t>(row) * row_bytes, row_bytes);
  return image;
}

}  // namespace

struct ScopeRenderer::Impl {
  Program tissue, changed_tissue, lens;
  std::vector<TissuePart> parts;
  TissuePart wall;
  std::vector<MeshDistance> bones;
  std::vector<std::string> names;
  std::vector<Pose> X_WB, rest_X_WB;
  std::vector<TissuePart> tray;  ///< by ToolState::instrument
  std::vector<std::pair<std::size_t, Pose>> tools;
  LightTarget flat;
  RenderTarget picture;
  GlVertexArray no_vertices;

  std::vector<ChangedCubes> changed;  ///< of the bones, which are the first parts

  void describe(const Program& program, const TissuePart& part, const Pose& X_CW) const {
    program.set("u_view_from_model", to_matrix(X_CW * part.X_WM));
    program.set("u_kind", static_cast<int>(part.pattern));
    program.set("u_tint", Eigen::Vector3f(part.tint[0], part.tint[1], part.tint[2]));
    program.set("u_fibre", part.fibre);
    program.set("u_center", part.center);
  }
  void paint(const TissuePart& part, const Pose& X_CW) const {
    describe(tissue, part, X_CW);
    part.surface.draw();
  }
  void paint_bone(std::size_t k, const Pose& X_CW, double half) const {
    if (changed[k].empty()) return paint(parts[k], X_CW);
    begin(changed_tissue, half);
    describe(changed_tissue, parts[k], X_CW);
    changed[k].hide(changed_tissue);
    parts[k].surface.draw();
    begin(tissue, half);
    describe(tissue, parts[k], X_CW);
    changed[k].draw();
  }
  static void begin(const Program& program, double half) {
    program.use();
    program.set("u_clip_from_view", flat_projection(half));
    program.set("u_light", 1.0f);
  }

  void paint_flat(const ScopeCamera& camera, double half) const {
    glBindFramebuffer(GL_FRAMEBUFFER, flat.framebuffer());
    glViewport(0, 0, flat.side(), flat.side());
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glClearColor(0, 0, 0, 1);
    glClearDepth(1.0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    begin(tissue, half);
    const Pose X_CW = camera.X_WC().inverse();
    for (std::size_t k = 0; k < parts.size(); ++k)
      k < changed.size() ? paint_bone(k, X_CW, half) : paint(parts[k], X_CW);
    if (!wall.surface.empty()) paint(wall, X_CW);
    for (const auto& [instrument, X_WT] : tools) paint(tray[instrument], X_CW * X_WT);
    glDisable(GL_DEPTH_TEST);
  }

  void paint_lens(const ScopeCamera& camera, double half, double exposure,
                  const Viewport& viewport) const {
    glBindFramebuffer(GL_FRAMEBUFFER, picture.framebuffer());
    glViewport(0, 0, viewport.width, viewport.height);
    lens.use();
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, flat.texture());
    lens.set("u_flat", 0);
    lens.set("u_screen_depth", 0.0f);
    lens.set("u_size_px", Eigen::Vector2f(static_cast<float>(viewport.width),
                                          static_cast<float>(viewport.height)));
    const double radius_px = ScopeCamera::radius_px(viewport);
    lens.set("u_radius_px", static_cast<float>(radius_px));
    lens.set("u_barrel", static_cast<float>(camera.barrel()));
    lens.set("u_half_field", static_cast<float>(camera.half_field_rad()));
    lens.set("u_flat_half", static_cast<float>(half));
    lens.set("u_tipped_to", static_cast<float>(camera.tipped_to_rad()));
    lens.set("u_exposure", static_cast<float>(exposure));
    lens.set("u_focus", static_cast<float>(kFocus_m));
    lens.set("u_blur_px", static_cast<float>(0.02 * flat.side() / 720));
    glBindVertexArray(no_vertices.get());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    glBindTexture(GL_TEXTURE_2D, 0);
  }
};

ScopeRenderer::ScopeRenderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ScopeRenderer::~ScopeRenderer() = default;
ScopeRenderer::ScopeRenderer(ScopeRenderer&&) noexcept = default;
ScopeRenderer& ScopeRenderer::operator=(ScopeRenderer&&) noexcept = default;

Result<ScopeRenderer> ScopeRenderer::create(const Case& the_case,
                                            const std::filesystem::path& data_dir,
                                            const PreparedCase& prepared) {
  auto impl = std::make_unique<Impl>();
  auto tissue = Program::load(data_dir / "shaders", "tissue");
  if (!tissue) return tl::unexpected(tissue.error());
  auto lens = Program::load(data_dir / "shaders", "screen", "scope");
  if (!lens) return tl::unexpected(lens.error());
  impl->tissue = std::move(*tissue);
  auto changed = Program::load_changed(data_dir / "shaders", "tissue", "tissue");
  if (!changed) return tl::unexpected(changed.error());
  impl->changed_tissue = std::move(*changed);
  impl->lens = std::move(*lens);
  impl->no_vertices = make_vertex_array();
  for (std::size_t k = 0; k < the_case.bones.size() && k < prepared.bones.size(); ++k) {
    const Bone& bone = the_case.bones[k];
    TissuePart part;
    part.surface = GpuMesh(prepared.bones[k]);
    impl->changed.emplace_back().set_base(prepared.bones[k]);
    part.X_WM = bone.X_WB;
    impl->parts.push_back(std::move(part));
    impl->bones.emplace_back(bone.mesh);
    impl->names.push_back(bone.name);
    impl->X_WB.push_back(bone.X_WB);
    impl->rest_X_WB.push_back(bone.X_WB);
  }
  for (std::size_t k = 0; k < the_case.softs.size() && k < prepared.softs.size(); ++k) {
    const SoftPart& soft = the_case.softs[k];
    if (soft.kind == "skin") continue;
    TissuePart part;
    part.surface = GpuMesh(prepared.softs[k]);
    part.pattern = pattern_of(soft.kind);
    part.tint = soft.color_srgb;
    for (const BoneId bone : soft.bones) part.rides_on.push_back(bone.index);
    find_fibres(soft.mesh_W.vertices, part);
    part.middle = part.center.cast<double>();
    impl->parts.push_back(std::move(part));
  }
  return ScopeRenderer(std::move(impl));
}

void ScopeRenderer::set_tray(std::span<const std::shared_ptr<const Tool>> tray) {
  impl_->tools.clear();
  impl_->tray.clear();
  for (const auto& tool : tray) {
    TissuePart part;
    part.surface = GpuMesh(plain_shaded(tool->mesh));
    part.pattern = TissuePattern::kSteel;
    part.tint = {0.86f, 0.88f, 0.91f};
    impl_->tray.push_back(std::move(part));
  }
}

void ScopeRenderer::set_scene(const BoneSnapshot& bones, std::span<const ToolState> tools) {
  const std::size_t count = std::min<std::size_t>(impl_->X_WB.size(), bones.count);
  for (std::size_t k = 0; k < count; ++k)
    if (is_finite(bones.bones[k].X_WB)) impl_->X_WB[k] = impl_->parts[k].X_WM = bones.bones[k].X_WB;
  for (TissuePart& part : impl_->parts)
    if (!part.rides_on.empty())
      part.X_WM = mean_motion(bones, impl_->rest_X_WB, part.rides_on, part.middle);
  impl_->tools.clear();
  for (const ToolState& tool : tools)
    if (tool.instrument < impl_->tray.size() && is_finite(tool.X_WP))
      impl_->tools.emplace_back(tool.instrument, tool.X_WP);
}

void ScopeRenderer::set_cubes(BoneId bone, const CubeGrid& grid,
                              std::span<const SurfaceCube> cubes) {
  if (bone.index < impl_->changed.size()) impl_->changed[bone.index].set(grid, cubes, bone.index);
}

void ScopeRenderer::clear_cubes() {
  for (ChangedCubes& bone : impl_->changed) bone.clear();
}

Result<void> ScopeRenderer::set_room(const Vec3& tip_W) {
  std::vector<WalledBone> bones;
  for (std::size_t k = 0; k < impl_->bones.size(); ++k)
    bones.push_back({&impl_->bones[k], impl_->X_WB[k], &impl_->names[k]});
  const auto wall = joint_wall(bones, tip_W);
  if (!wall) return tl::unexpected(wall.error());
  impl_->wall = {};
  impl_->wall.surface = GpuMesh(plain_shaded(*wall));
  impl_->wall.pattern = TissuePattern::kSynovium;
  return {};
}

/// First as a pinhole sees it, then through the lens. The flat picture has as many pixels as the
/// round one in its middle, where the lens shows most.
Image ScopeRenderer::draw_image(const ScopeCamera& camera, int width, int height,
                                RenderQuality quality) {
  const Viewport viewport{0, 0, std::clamp(width, 1, kMaxImageSide),
                          std::clamp(height, 1, kMaxImageSide)};
  const double half = 1.01 * std::tan(camera.half_field_rad());
  const double per_tangent = ScopeCamera::radius_px(viewport) * camera.barrel() /
                             std::tan(camera.barrel() * camera.half_field_rad());
  const double finer = quality == RenderQuality::kFine ? 2 : 1;
  const int side =
      std::clamp(static_cast<int>(std::ceil(finer * 2 * half * per_tangent)), 16, kMaxImageSide);
  GLint bound = 0;
  glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
  Image image;
  if (impl_->flat.ensure(side) && impl_->picture.ensure(viewport.width, viewport.height, 0)) {
    impl_->paint_flat(camera, half);
    impl_->paint_lens(camera, half, exposure_of(side), viewport);
    image = read_back(viewport.width, viewport.height);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(bound));
  return image;
}

}  // namespace osteon
