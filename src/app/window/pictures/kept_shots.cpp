#include "window/pictures/kept_shots.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <utility>

#include "window/pictures/picture_texture.h"

namespace osteon {
namespace {

constexpr int kThumbnail_px = 128;

void drop_texture(std::uintptr_t texture) {
  const auto name = static_cast<GLuint>(texture);
  if (name != 0) glDeleteTextures(1, &name);
}

}  // namespace

void KeptShots::add(XrayPicture picture) {
  total_.add(picture.dose, picture.hands);
  ShotModel model;
  const int factor = std::max(1, picture.image.width / kThumbnail_px);
  model.thumbnail = make_texture(smaller_image(picture.image, factor));
  model.number = ++taken_;
  model.turn = picture.turn;
  model.exposure = picture.exposure;
  model.dose = picture.dose;
  model.time_s = picture.time_s;
  if (shots_.size() == kMost) {
    drop_texture(shots_.front().model.thumbnail);
    shots_.erase(shots_.begin());
  }
  shots_.push_back({std::move(picture.image), model});
  choose(shots_.size() - 1);
}

void KeptShots::choose(std::size_t place) {
  if (place >= shots_.size()) return;
  shown_ = place;
  shown_image_.set(shots_[place].image);
}

void KeptShots::clear() {
  for (const Kept& shot : shots_) drop_texture(shot.model.thumbnail);
  shots_.clear();
  shown_image_.clear();
  shown_ = 0;
  taken_ = 0;
  total_ = {};
}

XrayModel KeptShots::model() const {
  XrayModel model;
  for (const Kept& shot : shots_) model.shots.push_back(shot.model);
  model.shown = shown_;
  model.total = total_;
  return model;
}

Image smaller_image(const Image& image, int factor) {
  const int side = std::max(factor, 1);
  Image small{image.width / side, image.height / side, {}};
  small.rgb.resize(3u * static_cast<std::size_t>(small.width) *
                   static_cast<std::size_t>(small.height));
  std::size_t to = 0;
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < 3 * small.width; ++x) {
      int sum = 0;
      for (int v = 0; v < side; ++v)
        for (int u = 0; u < side; ++u)
          sum += image.rgb[3u * (static_cast<std::size_t>(y * side + v) *
                                     static_cast<std::size_t>(image.width) +
                                 static_cast<std::size_t>(x / 3 * side + u)) +
                           static_cast<std::size_t>(x % 3)];
      small.rgb[to++] = static_cast<std::uint8_t>((sum + side * side / 2) / (side * side));
    }
  return small;
}

}  // namespace osteon
