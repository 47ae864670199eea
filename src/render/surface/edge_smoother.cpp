#include "surface/edge_smoother.h"

namespace osteon {
namespace {

void draw_in(std::span<const Viewport> areas) {
  for (const Viewport& area : areas) {
    glScissor(area.x, area.y, area.width, area.height);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
}

}  // namespace

Result<EdgeSmoother> EdgeSmoother::create(const std::filesystem::path& shader_dir) {
  EdgeSmoother out;
  auto find = Program::load(shader_dir, "screen", "edges_find");
  if (!find) return tl::unexpected(find.error());
  auto blur = Program::load(shader_dir, "screen", "edges");
  if (!blur) return tl::unexpected(blur.error());
  out.find_ = std::move(*find);
  out.blur_ = std::move(*blur);
  out.no_vertices_ = make_vertex_array();
  return out;
}

/// Two passes: the first marks the edges with the nearest depth, the second runs where its own
/// depth lies behind a mark.
void EdgeSmoother::smooth(const RenderTarget& source, const RenderTarget& target,
                          std::span<const Viewport> areas) const {
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  glViewport(0, 0, target.width(), target.height());
  glDisable(GL_SCISSOR_TEST);
  glClearDepth(1.0);
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_SCISSOR_TEST);
  glEnable(GL_DEPTH_TEST);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, source.texture());
  glBindVertexArray(no_vertices_.get());
  find_.use();
  find_.set("u_picture", 0);
  find_.set("u_screen_depth", -1.0f);
  glDepthFunc(GL_ALWAYS);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw_in(areas);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  blur_.use();
  blur_.set("u_picture", 0);
  blur_.set("u_screen_depth", 0.0f);
  blur_.set("u_pixel", Eigen::Vector2f(1.0f / static_cast<float>(source.width()),
                                       1.0f / static_cast<float>(source.height())));
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_FALSE);
  draw_in(areas);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LEQUAL);
  glBindVertexArray(0);
  glBindTexture(GL_TEXTURE_2D, 0);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_SCISSOR_TEST);
  glUseProgram(0);
}

}  // namespace osteon
