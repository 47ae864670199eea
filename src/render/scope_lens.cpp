#include "scope_lens.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "gl/frame.h"
#include "view/water_clouds.h"

namespace osteon {
namespace {

constexpr double kFocus_m = 0.012;
constexpr std::size_t kSeesWater = 1, kSeesFog = 2;

GlTexture cloud_texture() {
  constexpr int kSide = 64;  // three values in the smallest cell
  GlTexture texture = make_texture();
  const std::vector<std::uint8_t> values = water_clouds(kSide);
  glBindTexture(GL_TEXTURE_3D, texture.get());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage3D(GL_TEXTURE_3D, 0, GL_R8, kSide, kSide, kSide, 0, GL_RED, GL_UNSIGNED_BYTE,
               values.data());
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_3D, filter, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTexParameteri(GL_TEXTURE_3D, wrap, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAX_LEVEL, 0);
  glBindTexture(GL_TEXTURE_3D, 0);
  return texture;
}

}  // namespace

Result<ScopeLens> ScopeLens::load(const std::filesystem::path& shaders) {
  ScopeLens out;
  for (std::size_t k = 0; k < out.lenses_.size(); ++k) {
    std::string defines = (k & kSeesWater) != 0 ? "#define WATER\n" : "";
    if ((k & kSeesFog) != 0) defines += "#define FOG\n";
    auto lens = Program::load_with(shaders, "screen", "scope", defines);
    if (!lens) return tl::unexpected(lens.error());
    out.lenses_[k] = std::move(*lens);
  }
  out.no_vertices_ = make_vertex_array();
  out.clouds_ = cloud_texture();
  return out;
}

void ScopeLens::paint(const LightTarget& flat, const LensView& view,
                      const ScopeWater& water) const {
  glViewport(0, 0, view.viewport.width, view.viewport.height);
  const Program& lens = lenses_[(water.clear() ? 0 : kSeesWater) + (water.fog > 0 ? kSeesFog : 0)];
  lens.use();
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, flat.texture());
  lens.set("u_flat", 0);
  lens.set("u_screen_depth", 0.0f);
  lens.set("u_size_px", Eigen::Vector2f(static_cast<float>(view.viewport.width),
                                        static_cast<float>(view.viewport.height)));
  const double radius_px = ScopeCamera::radius_px(view.viewport);
  lens.set("u_radius_px", static_cast<float>(radius_px));
  lens.set("u_barrel", static_cast<float>(view.camera.barrel()));
  lens.set("u_half_field", static_cast<float>(view.camera.half_field_rad()));
  lens.set("u_flat_half", static_cast<float>(view.half));
  lens.set("u_tipped_to", static_cast<float>(view.camera.tipped_to_rad()));
  lens.set("u_exposure", static_cast<float>(view.exposure));
  lens.set("u_white", Eigen::Vector3f(view.white.cast<float>()));
  lens.set("u_focus", static_cast<float>(kFocus_m));
  lens.set("u_blur_px", static_cast<float>(0.02 * flat.side() / 720));
  lens.set("u_taken", static_cast<float>(water.taken_per_m));
  lens.set("u_blood", static_cast<float>(water.blood));
  if (!water.clear()) set_water(lens, water);
  lens.set("u_fog", static_cast<float>(water.fog));
  lens.set("u_world_from_view", to_matrix(view.camera.X_WC()));
  glBindVertexArray(no_vertices_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glBindTexture(GL_TEXTURE_2D, 0);
}

void ScopeLens::set_water(const Program& lens, const ScopeWater& water) const {
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_3D, clouds_.get());
  glActiveTexture(GL_TEXTURE0);
  lens.set("u_clouds", 1);
  lens.set("u_clouds_per_m", static_cast<float>(1 / kCloudTile_m));
  lens.set("u_plumes", static_cast<int>(water.plume_count));
  for (std::uint32_t k = 0; k < water.plume_count; ++k) {
    const std::string at = "[" + std::to_string(k) + "]";
    const BloodPlume& plume = water.plumes[k];
    lens.set(("u_plume_at" + at).c_str(), Eigen::Vector3f(plume.p_W.cast<float>()));
    lens.set(("u_plume_size" + at).c_str(), Eigen::Vector2f(static_cast<float>(plume.radius_m),
                                                            static_cast<float>(plume.taken_per_m)));
  }
}

}  // namespace osteon
