#include "window/pictures/case_pictures.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <utility>

#include "window/pictures/picture_texture.h"

namespace osteon {

CasePictures::~CasePictures() {
  for (const auto& [spec, texture] : textures_)
    if (texture != 0) glDeleteTextures(1, &texture);
}

void CasePictures::want(const std::vector<std::string>& specs) {
  to_draw_.clear();
  if (specs.empty() && job_) job_->cancel();
  for (const std::string& spec : specs) {
    if (texture(spec) != 0) continue;
    const auto kept = store_.find(spec);
    if (kept)
      show(spec, *kept);
    else if (spec != drawing_ && !textures_.contains(spec))
      to_draw_.push_back(spec);
  }
  std::reverse(to_draw_.begin(), to_draw_.end());
}

void CasePictures::poll() {
  if (job_ && job_->done()) {
    const Result<Image> image = job_->take();
    const bool stopped = job_->cancelled();
    job_.reset();
    if (image) {
      store_.keep(drawing_, *image);
      show(drawing_, *image);
    } else if (!stopped) {
      textures_[drawing_] = 0;  // it would fail again
    }
    drawing_.clear();
  }
  if (!job_) begin_next();
}

void CasePictures::begin_next() {
  if (to_draw_.empty()) return;
  drawing_ = std::move(to_draw_.back());
  to_draw_.pop_back();
  job_ = std::make_unique<SideJob<Image>>([spec = drawing_](const Progress& progress) {
    return draw_case_picture(spec, kWidth_px, kHeight_px, progress);
  });
}

void CasePictures::show(const std::string& spec, const Image& image) {
  textures_[spec] = make_texture(image);
}

std::uintptr_t CasePictures::texture(const std::string& spec) const {
  const auto found = textures_.find(spec);
  return found == textures_.end() ? 0 : found->second;
}

}  // namespace osteon
