#include "window/controllers/tray_pictures.h"

#include <epoxy/gl.h>

#include "runs/instrument_sheet.h"

namespace osteon {
namespace {

constexpr int kCell_px = 128;

}  // namespace

TrayPictures::~TrayPictures() { forget(); }

void TrayPictures::forget() {
  if (texture_ != 0) glDeleteTextures(1, &texture_);
  texture_ = 0;
}

void TrayPictures::want(const std::vector<Instrument>& instruments) {
  std::vector<std::string> names;
  for (const Instrument& instrument : instruments) names.push_back(instrument.name);
  if (names.empty() || names == names_) return;
  forget();
  names_ = std::move(names);
  const auto count = static_cast<int>(instruments.size());
  rows_ = (count + kColumns - 1) / kColumns;
  job_ = std::make_unique<SideJob<Image>>([instruments, rows = rows_](const Progress&) {
    return instrument_sheet(instruments, kColumns, kColumns * kCell_px, rows * kCell_px);
  });
}

// Without pictures the tray has names all the same.
void TrayPictures::poll() {
  if (!job_ || !job_->done()) return;
  const Result<Image> sheet = job_->take();
  job_.reset();
  if (!sheet) return;
  glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, sheet->width, sheet->height, 0, GL_RGB, GL_UNSIGNED_BYTE,
               sheet->rgb.data());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glBindTexture(GL_TEXTURE_2D, 0);
}

}  // namespace osteon
