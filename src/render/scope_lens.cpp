#include "scope_lens.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "gl/frame.h"
#include "view/water_clouds.h"

namespace osteon {
namespace {

constexpr double kFocus_m = 0.012;
/// Radius of blur, pixels of a flat picture of 720, a dioptre off focus; what is so many off is
/// sharp, and so is what is spread less than that many pixels. As scope.frag has it.
constexpr double kBlur_px = 0.02, kSharpDioptres = 60, kLeastBlur_px = 0.6;
constexpr std::size_t kSeesWater = 1, kSeesFog = 2, kSeesSoft = 4;
constexpr GLsizei kDiscCorners = 49;  // as disc.vert has them

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

/// tan(a) / r, a the angle off the middle that is seen at the share r of the picture's radius, as a
/// polynomial in r^2: within 1e-6 of it as far as a picture reaches.
std::array<double, 6> bow_of(const ScopeCamera& camera) {
  constexpr int kTerms = 6;
  constexpr double kFarthest = 1.06;  // of r^2
  Eigen::Matrix<double, kTerms, kTerms> powers;
  Eigen::Matrix<double, kTerms, 1> values;
  for (int k = 0; k < kTerms; ++k) {
    const double s = 0.5 * kFarthest * (1 - std::cos(std::numbers::pi * (k + 0.5) / kTerms));
    for (int n = 0; n < kTerms; ++n) powers(k, n) = std::pow(s, n);
    values(k) = std::tan(camera.off_middle_rad(std::sqrt(s))) / std::sqrt(s);
  }
  const Eigen::Matrix<double, kTerms, 1> terms = powers.partialPivLu().solve(values);
  std::array<double, kTerms> out{};
  for (int n = 0; n < kTerms; ++n) out[static_cast<std::size_t>(n)] = terms(n);
  return out;
}

Eigen::Vector3f three(const std::array<double, 6>& terms, std::size_t from) {
  return Eigen::Vector3d(terms[from], terms[from + 1], terms[from + 2]).cast<float>();
}

}  // namespace

bool ScopeLens::Soft::ensure(int wanted) {
  if (side == wanted && framebuffer.get() != 0) return true;
  side = wanted;
  framebuffer = make_framebuffer();
  texture = make_texture();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
  glBindTexture(GL_TEXTURE_2D, texture.get());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, side, side, 0, GL_RGBA, GL_FLOAT, nullptr);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.get(), 0);
  return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

Result<ScopeLens> ScopeLens::load(const std::filesystem::path& shaders) {
  ScopeLens out;
  for (std::size_t k = 0; k < out.softer_.size(); ++k) {
    constexpr std::array<const char*, 3> kTaps = {"4", "8", "64"};
    const std::string taps = std::string("#define TAPS ") + kTaps[k] + "\n";
    out.softer_[k] = {shaders, "screen", "softer", taps + (k == 2 ? "#define ROUND\n" : "")};
  }
  for (std::size_t k = 0; k < out.lenses_.size(); ++k) {
    std::string defines = (k & kSeesWater) != 0 ? "#define WATER\n" : "";
    if ((k & kSeesFog) != 0) defines += "#define FOG\n";
    if ((k & kSeesSoft) != 0) defines += "#define SOFT\n";
    out.lenses_[k] = {shaders, "disc", "scope", defines};
  }
  out.water_ = {shaders, "screen", "scope_water"};
  for (const LateProgram* late : {&out.softer_[0], &out.water_})
    if (const auto there = late->check(); !there) return tl::unexpected(there.error());
  auto clear = Program::load_with(shaders, "disc", "scope", {});
  if (!clear) return tl::unexpected(clear.error());
  out.clear_ = std::move(*clear);
  out.no_vertices_ = make_vertex_array();
  out.clouds_ = cloud_texture();
  return out;
}

bool ScopeLens::ready_one(const LightTarget& flat, const RenderTarget& picture) {
  constexpr int kSide = 16;
  Soft scratch;
  const auto ready = [&](const LateProgram& late, bool onto_picture) {
    if (late.ready()) return false;
    const Program* const program = late.get();
    if (program && flat.side() > 0 && (onto_picture || scratch.ensure(kSide)))
      draw_nothing(*program, flat.texture(),
                   onto_picture ? picture.framebuffer() : scratch.framebuffer.get());
    return true;
  };
  const auto light = [&](const LateProgram& late) { return ready(late, false); };
  if (std::any_of(softer_.begin(), softer_.end(), light) || light(water_)) return true;
  return std::any_of(lenses_.begin() + 1, lenses_.end(),
                     [&](const LateProgram& late) { return ready(late, true); });
}

void ScopeLens::draw_nothing(const Program& program, GLuint from, GLuint framebuffer) const {
  for (const GLenum test : {GL_DEPTH_TEST, GL_BLEND, GL_CULL_FACE}) glDisable(test);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glBindVertexArray(no_vertices_.get());
  program.use();
  program.set("u_flat", 0);
  for (int unit = 5; unit >= 0; --unit) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(unit == 1 ? GL_TEXTURE_3D : GL_TEXTURE_2D, unit == 1 ? clouds_.get() : from);
  }
  constexpr std::array<std::pair<const char*, int>, 5> kUnits = {
      {{"u_clouds", 1}, {"u_half", 2}, {"u_quarter", 3}, {"u_milky", 4}, {"u_water", 5}}};
  for (const auto& [name, unit] : kUnits) program.set(name, unit);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, 0, 0);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_SCISSOR_TEST);
  glBindVertexArray(0);
}

bool ScopeLens::is_soft(double nearest_m, int side_px) {
  const double before = 1 / std::max(nearest_m, 1e-3) - 1 / kFocus_m, beyond = 1 / kFocus_m;
  return kBlur_px * side_px / 720 * (std::max(before, beyond) - kSharpDioptres) >= kLeastBlur_px;
}

void ScopeLens::soften(const Program& softer, GLuint from, const Soft& to, double spread) {
  softer.use();
  softer.set("u_flat", 0);
  softer.set("u_screen_depth", 0.0f);
  softer.set("u_spread", static_cast<float>(spread));
  glBindFramebuffer(GL_FRAMEBUFFER, to.framebuffer.get());
  glViewport(0, 0, to.side, to.side);
  glBindTexture(GL_TEXTURE_2D, from);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

// What is out of focus is mixed of three pictures: taking all its light at every place would cost
// a processor more than all else. A disc of 3 pixels is spread as the half picture is, one of 9 as
// the quarter one.
void ScopeLens::paint(const LightTarget& flat, const RenderTarget& picture, const LensView& view,
                      const ScopeWater& water) {
  constexpr double kHalfSpread_px = 2.2, kQuarterSpread_px = 7.3;  // of the flat picture
  const int side = flat.side();
  glBindVertexArray(no_vertices_.get());
  for (const GLenum test : {GL_DEPTH_TEST, GL_BLEND, GL_SCISSOR_TEST, GL_CULL_FACE})
    glDisable(test);
  glActiveTexture(GL_TEXTURE0);
  const bool soft = is_soft(view.nearest_m, side) && softer_[0].get() && softer_[1].get() &&
                    half_.ensure((side + 1) / 2) && quarter_.ensure((side + 3) / 4);
  if (soft) {
    soften(*softer_[0].get(), flat.texture(), half_, kHalfSpread_px / side);
    soften(*softer_[1].get(), half_.texture.get(), quarter_, kQuarterSpread_px / side);
  }
  // An eighth of the picture cannot tell where the taps lie: its pixels are as wide as their steps.
  constexpr double kFogSpread = 0.17;  // of the flat picture
  const bool milky = water.fog > 0 && softer_[2].get() && milky_.ensure((side + 7) / 8);
  if (milky) soften(*softer_[2].get(), flat.texture(), milky_, kFogSpread);
  const bool cloudy = !water.clear() && water_.get() && on_the_way_.ensure((side + 1) / 2);
  if (cloudy) measure_water(flat, view, water);
  glBindFramebuffer(GL_FRAMEBUFFER, picture.framebuffer());
  glViewport(0, 0, view.viewport.width, view.viewport.height);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  const std::size_t sees =
      (cloudy ? kSeesWater : 0) + (milky ? kSeesFog : 0) + (soft ? kSeesSoft : 0);
  const Program* const seeing = sees == 0 ? nullptr : lenses_[sees].get();
  const Program& lens = seeing ? *seeing : clear_;
  lens.use();
  const std::array<GLuint, 5> levels = {flat.texture(), soft ? half_.texture.get() : flat.texture(),
                                        soft ? quarter_.texture.get() : flat.texture(),
                                        milky ? milky_.texture.get() : flat.texture(),
                                        cloudy ? on_the_way_.texture.get() : flat.texture()};
  for (const std::size_t k : {4u, 3u, 2u, 1u, 0u}) {
    glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + (k > 0 ? k + 1 : 0)));
    glBindTexture(GL_TEXTURE_2D, levels[k]);
  }
  const double radius_px = ScopeCamera::radius_px(view.viewport);
  lens.set("u_flat", 0);
  lens.set("u_half", 2);
  lens.set("u_quarter", 3);
  lens.set("u_milky", 4);
  lens.set("u_water", 5);
  constexpr double kStopWide_px = 1.5;  // more than the stop's soft edge
  lens.set("u_disc", Eigen::Vector2f(2 * (radius_px + kStopWide_px) / view.viewport.width,
                                     2 * (radius_px + kStopWide_px) / view.viewport.height));
  lens.set("u_size_px", Eigen::Vector2f(static_cast<float>(view.viewport.width),
                                        static_cast<float>(view.viewport.height)));
  lens.set("u_radius_px", static_cast<float>(radius_px));
  const std::array<double, 6> bow = bow_of(view.camera);
  lens.set("u_bow_near", three(bow, 0));
  lens.set("u_bow_far", three(bow, 3));
  lens.set("u_flat_half", static_cast<float>(view.half));
  const double to_mark = view.camera.tipped_to_rad();
  lens.set("u_to_mark", Eigen::Vector2d(std::cos(to_mark), std::sin(to_mark)).cast<float>().eval());
  lens.set("u_exposure", static_cast<float>(view.exposure));
  lens.set("u_white", Eigen::Vector3f(view.white.cast<float>()));
  lens.set("u_focus", static_cast<float>(kFocus_m));
  lens.set("u_blur_px", static_cast<float>(kBlur_px * flat.side() / 720));
  lens.set("u_taken", static_cast<float>(water.taken_per_m));
  lens.set("u_blood", static_cast<float>(water.blood));
  lens.set("u_fog", static_cast<float>(water.fog));
  glDrawArrays(GL_TRIANGLE_FAN, 0, kDiscCorners);
  glBindVertexArray(0);
  glBindTexture(GL_TEXTURE_2D, 0);
}

void ScopeLens::measure_water(const LightTarget& flat, const LensView& view,
                              const ScopeWater& water) const {
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_3D, clouds_.get());
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, flat.texture());
  const Program& thickness = *water_.get();
  thickness.use();
  thickness.set("u_screen_depth", 0.0f);
  thickness.set("u_flat", 0);
  thickness.set("u_flat_half", static_cast<float>(view.half));
  thickness.set("u_world_from_view", to_matrix(view.camera.X_WC()));
  thickness.set("u_clouds", 1);
  thickness.set("u_clouds_per_m", static_cast<float>(1 / kCloudTile_m));
  thickness.set("u_plumes", static_cast<int>(water.plume_count));
  for (std::uint32_t k = 0; k < water.plume_count; ++k) {
    const std::string at = "[" + std::to_string(k) + "]";
    const BloodPlume& plume = water.plumes[k];
    thickness.set(("u_plume_at" + at).c_str(), Eigen::Vector3f(plume.p_W.cast<float>()));
    thickness.set(
        ("u_plume_size" + at).c_str(),
        Eigen::Vector2f(static_cast<float>(plume.radius_m), static_cast<float>(plume.taken_per_m)));
  }
  glBindFramebuffer(GL_FRAMEBUFFER, on_the_way_.framebuffer.get());
  glViewport(0, 0, on_the_way_.side, on_the_way_.side);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace osteon
