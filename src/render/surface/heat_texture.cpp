#include "surface/heat_texture.h"

#include <algorithm>
#include <string>

#include "osteon/render/heat_colors.h"

namespace osteon {
namespace {

constexpr GLuint kHeatUnit = 2;  // texture unit

bool is_whole(const HeatCells& heat) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &most);
  std::size_t all = 1;
  for (const int n : heat.count) {
    if (n <= 0 || n > most) return false;
    all *= static_cast<std::size_t>(n);
  }
  return all == heat.cells.size() && heat.cell_m > 0 && is_finite(heat.lo_B);
}

}  // namespace

void HeatTexture::set(const HeatCells& heat) {
  count_ = {};
  if (!is_whole(heat)) return;
  lo_B_ = heat.lo_B;
  cell_m_ = heat.cell_m;
  count_ = heat.count;
  if (cells_.get() == 0) cells_ = make_texture();
  glActiveTexture(GL_TEXTURE0 + kHeatUnit);
  glBindTexture(GL_TEXTURE_3D, cells_.get());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage3D(GL_TEXTURE_3D, 0, GL_RG8, count_[0], count_[1], count_[2], 0, GL_RG,
               GL_UNSIGNED_BYTE, heat.cells.data());
  for (const GLenum side : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTexParameteri(GL_TEXTURE_3D, side, GL_CLAMP_TO_BORDER);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAX_LEVEL, 0);
  glBindTexture(GL_TEXTURE_3D, 0);
  glActiveTexture(GL_TEXTURE0);
}

void HeatTexture::show(const Program& program) const {
  glActiveTexture(GL_TEXTURE0 + kHeatUnit);
  glBindTexture(GL_TEXTURE_3D, cells_.get());
  glActiveTexture(GL_TEXTURE0);
  program.set("u_heat", static_cast<int>(kHeatUnit));
  const Eigen::Vector3f lo = lo_B_.cast<float>();
  program.set("u_heat_from", Eigen::Vector4f(lo.x(), lo.y(), lo.z(), static_cast<float>(cell_m_)));
}

void HeatTexture::set_colors(const Program& program) {
  const auto color = [](const std::array<float, 3>& c) {
    return Eigen::Vector3f(c[0], c[1], c[2]);
  };
  program.set("u_heat_range", Eigen::Vector2f(static_cast<float>(HeatCells::kFrom_c),
                                              static_cast<float>(HeatCells::kTo_c)));
  program.set("u_heat_dead", color(kDeadColor));
  for (std::size_t k = 0; k < kHeatColors.size(); ++k) {
    const std::string at = "[" + std::to_string(k) + "]";
    program.set(("u_heat_colors" + at).c_str(), color(kHeatColors[k]));
    program.set(("u_heat_stops" + at).c_str(), static_cast<float>(kHeatStops_c[k]));
  }
}

}  // namespace osteon
