// Parts of finished pictures, and moving them between framebuffers.
#include <algorithm>

#include "renderer_impl.h"

namespace osteon {

Viewport busy_part(const Frame& frame, const Aabb& content, int width, int height) {
  const Viewport all{1, 1, std::max(width - 2, 0), std::max(height - 2, 0)};
  const Eigen::Matrix4d clip_from_view = frame.clip_from_view.cast<double>();
  Aabb box;
  for (const Vec3& p_W : corners(content)) {
    const Eigen::Vector4d clip = clip_from_view * (frame.X_CW * p_W).homogeneous();
    if (clip.w() <= 0) return all;
    box.include(clip.head<3>() / clip.w());
  }
  constexpr int kMargin_px = 4;
  const auto low = [](double clip, int side) {
    return static_cast<int>(std::clamp(0.5 * (clip + 1) * side - kMargin_px, 1.0, side + 1.0));
  };
  const auto high = [](double clip, int side) {
    return static_cast<int>(
        std::clamp(0.5 * (clip + 1) * side + kMargin_px, 0.0, std::max(side - 1.0, 0.0)));
  };
  const int x = low(box.lo.x(), width), y = low(box.lo.y(), height);
  return {x, y, std::max(high(box.hi.x(), width) - x, 0),
          std::max(high(box.hi.y(), height) - y, 0)};
}

void copy_color(const RenderTarget& from, const RenderTarget& to) {
  copy_color(from, to, {0, 0, from.width(), from.height()});
}

void copy_color(const RenderTarget& from, const RenderTarget& to, const Viewport& part) {
  const int right = part.x + part.width, top = part.y + part.height;
  glDisable(GL_SCISSOR_TEST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to.framebuffer());
  const bool same = from.width() == to.width() && from.height() == to.height();
  if (same)
    glBlitFramebuffer(part.x, part.y, right, top, part.x, part.y, right, top, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
  else
    glBlitFramebuffer(0, 0, from.width(), from.height(), 0, 0, to.width(), to.height(),
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void show(const RenderTarget& picture, GLuint framebuffer, const Viewport& viewport) {
  const bool same = picture.width() == viewport.width && picture.height() == viewport.height;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, picture.framebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  glBlitFramebuffer(0, 0, picture.width(), picture.height(), viewport.x, viewport.y,
                    viewport.x + viewport.width, viewport.y + viewport.height, GL_COLOR_BUFFER_BIT,
                    same ? GL_NEAREST : GL_LINEAR);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

}  // namespace osteon
