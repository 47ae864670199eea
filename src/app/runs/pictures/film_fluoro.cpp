#include "runs/pictures/film_fluoro.h"

#include <algorithm>
#include <cmath>

#include "osteon/image/tissue.h"
#include "osteon/render/anatomical_view.h"

namespace osteon {
namespace {

/// Between four neighbours; `x`, `y` in pixels whose middles are whole numbers.
double between(const std::vector<float>& grey, int side, double x, double y) {
  const double most = side - 1;
  x = std::clamp(x, 0.0, most);
  y = std::clamp(y, 0.0, most);
  const int x0 = std::min(static_cast<int>(x), std::max(side - 2, 0));
  const int y0 = std::min(static_cast<int>(y), std::max(side - 2, 0));
  const auto at = [&](int u, int v) {
    const int column = std::min(u, side - 1), row = std::min(v, side - 1);
    return static_cast<double>(grey[static_cast<std::size_t>(row * side + column)]);
  };
  const double fx = x - x0, fy = y - y0;
  return (1 - fy) * ((1 - fx) * at(x0, y0) + fx * at(x0 + 1, y0)) +
         fy * ((1 - fx) * at(x0, y0 + 1) + fx * at(x0 + 1, y0 + 1));
}

}  // namespace

Result<FilmFluoro> FilmFluoro::create(const Case& the_case, const Tray& tray) {
  const auto tissues = load_default_tissues();
  if (!tissues) return tl::unexpected(tissues.error());
  auto body = CaseBody::create(the_case, *tissues);
  if (!body) return tl::unexpected(body.error());
  auto cuts = XrayCuts::create();
  if (!cuts) return tl::unexpected(cuts.error());
  FilmFluoro fluoro(std::move(*body), std::move(*cuts));
  for (const auto& tool : tray) {
    auto mesh = xray_surface(tool->mesh, "the instrument '" + tool->name + "'");
    if (!mesh) return tl::unexpected(mesh.error());
    fluoro.steel_.push_back(std::move(*mesh));
    fluoro.hands_T_.push_back(hand_on(*tool));
  }
  const AnatomicalFrame frame = anatomical_frame(the_case);
  fluoro.scene_.patient = {frame.distal_W, frame.dorsal_W, frame.radial_W};
  const Camera all = preset_camera(ViewPreset::kAp, the_case, 1);
  fluoro.scene_.isocenter_W = close_up_camera(all, the_case, BoneId{}, 1).target_W;
  return fluoro;
}

// Without hands, whose dose takes time.
void FilmFluoro::place(const FilmMoment& moment, const AskCuts& cuts) {
  scene_.body = body_.posed(moment.bones);
  if (cuts) cuts_.add_to(scene_.body, cuts(), moment.bones);
  scene_.without_tools = scene_.body;
  scene_.hands_W.clear();
  XrayLayer steel{"instruments", kSteel, {}};
  for (std::size_t h = 0; h < moment.hands; ++h) {
    const ToolState& tool = moment.tools[h];
    if (tool.instrument < steel_.size() && is_finite(tool.X_WP))
      steel.surfaces.push_back({steel_[tool.instrument], tool.X_WP});
  }
  if (!steel.surfaces.empty())
    scene_.body.layers.insert(scene_.body.layers.begin(), std::move(steel));
}

Result<XrayShot> FilmFluoro::shoot(const FilmMoment& moment, const ShotOrder& order,
                                   const AskCuts& cuts) {
  place(moment, cuts);
  for (std::size_t h = 0; h < moment.hands; ++h) {
    const ToolState& tool = moment.tools[h];
    if (tool.instrument < hands_T_.size() && is_finite(tool.X_WP))
      scene_.hands_W.push_back(tool.X_WP * hands_T_[tool.instrument]);
  }
  XrayShotOrder shot;
  shot.arm.orbit_rad = order.orbit_rad;
  shot.arm.angulation_rad = order.angulation_rad;
  shot.arm.width_px = shot.arm.height_px = order.side;
  shot.arm.isocenter_W = scene_.isocenter_W;
  shot.seed = order.seed;
  return take_shot(scene_, shot);
}

Result<void> FilmFluoro::pulse(const FilmMoment& moment, int side, const AskCuts& cuts) {
  place(moment, cuts);
  XrayShotOrder order;
  order.arm.width_px = order.arm.height_px = side;
  order.arm.isocenter_W = scene_.isocenter_W;
  order.seed = static_cast<std::uint64_t>(pulse_) + 1;
  auto shot = take_shot(scene_, order);
  if (!shot) return tl::unexpected(shot.error());
  grey_ = std::move(shot->grey);
  side_ = side;
  return {};
}

Result<Image> FilmFluoro::draw(const FilmMoment& moment, int width, int height,
                               const AskCuts& cuts) {
  const int square = std::min(width, height), side = std::min(square, kMostSide_px);
  const auto now = static_cast<std::int64_t>(moment.time_s * kPulsesPerSecond + 1e-6);
  if (now != pulse_ || side != side_) {
    pulse_ = now;
    if (auto ok = pulse(moment, side, cuts); !ok) return tl::unexpected(ok.error());
  }
  Image image{width, height, {}};
  image.rgb.assign(3u * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  const int left = (width - square) / 2, top = (height - square) / 2;
  for (int y = 0; y < square; ++y)
    for (int x = 0; x < square; ++x) {
      const double scale = static_cast<double>(side_) / square;
      const double grey = between(grey_, side_, (x + 0.5) * scale - 0.5, (y + 0.5) * scale - 0.5);
      const auto byte = static_cast<std::uint8_t>(std::lround(255 * std::clamp(grey, 0.0, 1.0)));
      const auto pixel = static_cast<std::size_t>(top + y) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(left + x);
      std::fill_n(image.rgb.begin() + static_cast<std::ptrdiff_t>(3 * pixel), 3, byte);
    }
  return image;
}

}  // namespace osteon
