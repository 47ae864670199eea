#include "runs/pictures/film_still.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace osteon {
namespace {

constexpr double kBetweenStills_s = 1.0 / 30;

}  // namespace

FilmStill::FilmStill(FilmPainter painter, FilmSofts softs, std::size_t hands)
    : painter_(std::move(painter)), softs_(std::move(softs)) {
  moment_.hands = std::clamp<std::size_t>(hands, 1, kMaxHands);
  // A hand that has not been heard of yet is nowhere.
  for (ToolState& tool : moment_.tools) tool.X_WP.p = Vec3::Constant(std::nan(""));
}

void FilmStill::see(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones) {
  if (hand < moment_.hands) moment_.tools[hand] = tool;
  if (hand != 0) return;
  moment_.bones = bones;
  moment_.time_s = tool.time_s;
  if (!good() || tool.time_s < next_s_) return;
  next_s_ = tool.time_s + kBetweenStills_s;
  draw();
}

void FilmStill::draw() {
  painter_.take(softs_.looks(pushes_));
  auto image = painter_.draw(moment_);
  if (image)
    last_ = std::move(*image);
  else
    failure_ = image.error();
}

Result<Image> FilmStill::finish() {
  if (good() && last_) draw();
  if (!good()) return tl::unexpected(*failure_);
  if (!last_) return fail("holds no ticks there", "the recording");
  return std::move(*last_);
}

}  // namespace osteon
