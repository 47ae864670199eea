#include "osteon/render/renderer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "osteon/render/software_gl.h"
#include "read_picture.h"
#include "renderer_impl.h"

namespace osteon {
namespace {

constexpr int kTile_px = 1024;  // of a still; keeps the memory of a supersampled picture small

std::string gl_text(GLenum name) {
  const auto* text = reinterpret_cast<const char*>(glGetString(name));
  return text != nullptr ? text : "unknown";
}

/// Whole pixels of the picture that one tile covers; y from the bottom.
struct Tile {
  int x = 0, y = 0, width = 0, height = 0;
};

PictureWindow window_of(const Tile& tile, int width, int height) {
  const double w = width, h = height;
  return {tile.x / w, tile.y / h, tile.width / w, tile.height / h};
}

/// Copies a tile, bottom row first, into a picture with its top row first.
void place(const std::vector<std::uint8_t>& pixels, const Tile& tile, Image& image) {
  const std::size_t bytes = 3u * static_cast<std::size_t>(tile.width);
  for (int row = 0; row < tile.height; ++row) {
    const auto target_row = static_cast<std::size_t>(image.height - 1 - (tile.y + row));
    std::uint8_t* target =
        image.rgb.data() + 3u * (target_row * static_cast<std::size_t>(image.width) +
                                 static_cast<std::size_t>(tile.x));
    std::memcpy(target, pixels.data() + static_cast<std::size_t>(row) * bytes, bytes);
  }
}

}  // namespace

bool Renderer::Impl::ensure_ground(PictureTargets& targets, const PictureWindow& window, int width,
                                   int height) {
  RenderTarget& ground = targets.ground;
  const bool same =
      ground.width() == width && ground.height() == height && targets.ground_window == window;
  if (same) return true;
  if (!ground.ensure(width, height, 0)) return false;
  targets.ground_window = window;
  glBindFramebuffer(GL_FRAMEBUFFER, ground.framebuffer());
  painter.paint_ground(window);
  return true;
}

bool Renderer::Impl::paint_scene(PictureTargets& targets, const RenderSnapshot& snapshot,
                                 const ViewState& view, const Frame& frame, int width, int height,
                                 int samples) {
  if (!targets.drawn.ensure(width, height, samples)) return false;
  glDisable(GL_SCISSOR_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glViewport(0, 0, width, height);
  if (samples == 0) {
    if (!ensure_ground(targets, frame.window, width, height)) return false;
    copy_color(targets.ground, targets.drawn);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, targets.drawn.framebuffer());
  glClearDepth(1.0);
  glClear(GL_DEPTH_BUFFER_BIT);
  if (samples > 0) painter.paint_ground(frame.window);
  painter.paint(snapshot, view, frame);
  return true;
}

void Renderer::Impl::smooth_and_show(PictureTargets& targets, const Frame& frame,
                                     const Aabb& content, GLuint framebuffer,
                                     const Viewport& viewport) {
  copy_color(targets.drawn, targets.resolved);
  const Viewport busy =
      busy_part(frame, content, targets.resolved.width(), targets.resolved.height());
  smoother->smooth(targets.drawn, targets.resolved, {&busy, 1});
  show(targets.resolved, framebuffer, viewport);
}

bool Renderer::Impl::draw_tile(const RenderSnapshot& snapshot, const ViewState& view, double aspect,
                               const PictureWindow& window, GLuint framebuffer,
                               const Viewport& viewport) {
  const Aabb content = painter.content(snapshot, view);
  const Frame frame = make_frame(view, aspect, content, window, viewport.width, viewport.height);
  // A processor pays for every sample, a graphics card hardly does.
  const bool fine = view.quality == RenderQuality::kFine;
  const int scale = fine ? 2 : 1;
  const int samples = fine || !software ? 4 : 0;
  const int width = scale * viewport.width, height = scale * viewport.height;
  if (!paint_scene(full, snapshot, view, frame, width, height, samples)) return false;
  if (!full.resolved.ensure(width, height, 0)) return false;
  if (samples == 0) {
    smooth_and_show(full, frame, content, framebuffer, viewport);
  } else {
    copy_color(full.drawn, full.resolved);
    show(full.resolved, framebuffer, viewport);
  }
  return true;
}

bool Renderer::Impl::draw_coarse(const RenderSnapshot& snapshot, const ViewState& view,
                                 GLuint framebuffer, const Viewport& viewport) {
  const auto fewer = [this](int side) {
    return std::max(1, static_cast<int>(std::lround(moving_detail * side)));
  };
  const int width = fewer(viewport.width), height = fewer(viewport.height);
  const Aabb content = painter.content(snapshot, view);
  Frame frame = make_frame(view, viewport.aspect(), content, {}, width, height);
  frame.passing = true;
  if (!paint_scene(coarse, snapshot, view, frame, width, height, 0)) return false;
  if (!coarse.resolved.ensure(width, height, 0)) return false;
  smooth_and_show(coarse, frame, content, framebuffer, viewport);
  return true;
}

Result<Renderer> Renderer::create(const Case& the_case, const Tool& tool,
                                  const std::filesystem::path& data_dir,
                                  const PreparedCase& prepared) {
  constexpr int kOpenGl33 = 33;
  if (epoxy_gl_version() < kOpenGl33)
    return fail("the graphics driver is older than OpenGL 3.3", gl_text(GL_RENDERER),
                "Update the driver, or set LIBGL_ALWAYS_SOFTWARE=1");
  const std::filesystem::path shader_dir = data_dir / "shaders";
  auto painter = ScenePainter::create(the_case, tool, shader_dir, prepared);
  if (!painter) return tl::unexpected(painter.error());
  auto smoother = EdgeSmoother::create(shader_dir);
  if (!smoother) return tl::unexpected(smoother.error());
  const std::string device = gl_text(GL_RENDERER);
  auto impl = std::unique_ptr<Impl>(
      new Impl{.painter = std::move(*painter),
               .smoother = std::make_shared<EdgeSmoother>(std::move(*smoother)),
               .picker = std::make_shared<Picker>(the_case),
               .device = device,
               .software = is_software_gl(device)});
  return Renderer(std::move(impl));
}

Result<Renderer> Renderer::create(const Case& the_case, const Tool& tool,
                                  const std::filesystem::path& data_dir) {
  return create(the_case, tool, data_dir, prepare_case(the_case));
}

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Renderer Renderer::another_view() const {
  return Renderer(std::unique_ptr<Impl>(new Impl{.painter = impl_->painter.another(),
                                                 .smoother = impl_->smoother,
                                                 .picker = impl_->picker,
                                                 .device = impl_->device,
                                                 .software = impl_->software}));
}

void Renderer::set_surfaces(const PreparedCase& prepared) {
  impl_->painter.set_surfaces(prepared);
  impl_->kept.reset();
}

void Renderer::set_pieces(const Case& the_case) {
  impl_->painter.set_pieces(the_case);
  impl_->kept.reset();
}

void Renderer::set_tray(std::span<const std::shared_ptr<const Tool>> tray) {
  impl_->painter.set_tray(tray);
  impl_->kept.reset();
}

void Renderer::set_others(std::span<const ToolState> others) { impl_->painter.set_others(others); }

void Renderer::set_ghosts(std::span<const GhostTool> ghosts) { impl_->painter.set_ghosts(ghosts); }

void Renderer::set_moving_detail(double share) {
  impl_->moving_detail = std::isfinite(share) ? std::clamp(share, 0.25, 1.0) : 1.0;
}

bool Renderer::drew_all() const { return impl_->drew_all; }

void Renderer::set_marks(std::span<const SolidMark> marks) {
  impl_->painter.set_marks(marks);
  impl_->kept.reset();
}

void Renderer::set_moving_marks(std::span<const SolidMark> marks) {
  impl_->painter.set_moving_marks(marks);
  impl_->composed.reset();
}

void Renderer::draw(const RenderSnapshot& snapshot, const ViewState& view,
                    const Viewport& viewport) {
  if (viewport.empty()) return;
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  const auto framebuffer = static_cast<GLuint>(bound);
  if (impl_->software && view.quality == RenderQuality::kFast)
    impl_->draw_changes(snapshot, view, framebuffer, viewport);
  else
    impl_->drew_all =
        impl_->draw_tile(snapshot, view, viewport.aspect(), {}, framebuffer, viewport);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

Image Renderer::draw_image(const RenderSnapshot& snapshot, const ViewState& view, int width,
                           int height) {
  Image image;
  image.width = std::clamp(width, 1, kMaxImageSide);
  image.height = std::clamp(height, 1, kMaxImageSide);
  const double aspect = static_cast<double>(image.width) / image.height;
  image.rgb.resize(3u * static_cast<std::size_t>(image.width) *
                   static_cast<std::size_t>(image.height));
  GLint bound = 0;
  glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
  bool whole = true;
  for (int y = 0; y < image.height && whole; y += kTile_px) {
    for (int x = 0; x < image.width && whole; x += kTile_px) {
      const Tile tile{x, y, std::min(kTile_px, image.width - x),
                      std::min(kTile_px, image.height - y)};
      whole = impl_->still.ensure(tile.width, tile.height, 0) &&
              impl_->draw_tile(snapshot, view, aspect, window_of(tile, image.width, image.height),
                               impl_->still.framebuffer(), {0, 0, tile.width, tile.height});
      if (!whole) break;
      std::vector<std::uint8_t> pixels(3u * static_cast<std::size_t>(tile.width) *
                                       static_cast<std::size_t>(tile.height));
      glBindFramebuffer(GL_READ_FRAMEBUFFER, impl_->still.framebuffer());
      glPixelStorei(GL_PACK_ALIGNMENT, 1);
      glReadPixels(0, 0, tile.width, tile.height, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
      place(pixels, tile, image);
    }
  }
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(bound));
  return whole ? image : Image{};
}

Image Renderer::draw_next_image(const RenderSnapshot& snapshot, const ViewState& view, int width,
                                int height) {
  width = std::clamp(width, 1, kMaxImageSide);
  height = std::clamp(height, 1, kMaxImageSide);
  GLint bound = 0;
  glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
  Image image;
  if (impl_->still.ensure(width, height, 0)) {
    glBindFramebuffer(GL_FRAMEBUFFER, impl_->still.framebuffer());
    draw(snapshot, view, {0, 0, width, height});
    image = read_back(width, height);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(bound));
  return image;
}

BoneId Renderer::pick(const RenderSnapshot& snapshot, const ViewState& view,
                      const Viewport& viewport, double x_px, double y_px) const {
  return pick_point(snapshot, view, viewport, x_px, y_px).bone;
}

SurfacePoint Renderer::pick_point(const RenderSnapshot& snapshot, const ViewState& view,
                                  const Viewport& viewport, double x_px, double y_px) const {
  const bool inside = x_px >= 0 && y_px >= 0 && x_px < viewport.width && y_px < viewport.height;
  if (viewport.empty() || !inside) return {};
  return impl_->picker->pick(snapshot, view, ray_through(view.camera, viewport, x_px, y_px));
}

void Renderer::set_surface(BoneId bone, const TriMesh& mesh_B) {
  impl_->painter.set_surface(bone.index, mesh_B);
  impl_->picker->set_surface(bone.index, mesh_B);
  impl_->kept.reset();
}

void Renderer::move_surface(BoneId part, const TriMesh& rest_W, const TriMesh& moved_W,
                            std::span<const float> depth_m) {
  impl_->painter.move_surface(part.index, rest_W, moved_W, depth_m);
}

void Renderer::set_cubes(BoneId bone, const CubeGrid& grid, std::span<const SurfaceCube> cubes) {
  impl_->painter.set_cubes(bone.index, grid, cubes);
  impl_->picker->set_cubes(bone.index, grid, cubes);
}

void Renderer::set_heat(BoneId bone, const HeatCells& heat) {
  impl_->painter.set_heat(bone.index, heat);
  impl_->kept.reset();
}

void Renderer::set_loose(std::uint64_t shape, BoneId bone, const SurfaceCube& surface) {
  impl_->painter.set_loose(shape, bone.index, surface);
}

void Renderer::clear_cubes() {
  impl_->painter.clear_cubes();
  impl_->picker->clear_cubes();
  impl_->kept.reset();
}

std::string Renderer::device_name() const { return impl_->device; }
bool Renderer::software_driver() const { return impl_->software; }

}  // namespace osteon
