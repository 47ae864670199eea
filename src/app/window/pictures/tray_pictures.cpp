#include "window/pictures/tray_pictures.h"

#include <epoxy/gl.h>

#include "osteon/scene/tool.h"
#include "runs/hands/instrument_sheet.h"
#include "runs/hands/tray.h"
#include "window/pictures/picture_texture.h"

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
  std::vector<std::string> names{kWristProbe};
  for (const Instrument& instrument : instruments) names.push_back(instrument.name);
  if (names == names_) return;
  forget();
  names_ = std::move(names);
  const auto count = static_cast<int>(names_.size());
  rows_ = (count + kColumns - 1) / kColumns;
  job_ = std::make_unique<SideJob<Image>>([instruments, rows = rows_](const Progress&) {
    std::vector<SheetItem> items = sheet_items(instruments);
    items.insert(items.begin(), SheetItem{kWristProbe, make_wrist_probe().mesh});
    return instrument_sheet(items, kColumns, kColumns * kCell_px, rows * kCell_px);
  });
}

// Without pictures the tray has names all the same.
void TrayPictures::poll() {
  if (!job_ || !job_->done()) return;
  const Result<Image> sheet = job_->take();
  job_.reset();
  if (!sheet) return;
  texture_ = make_texture(*sheet);
}

}  // namespace osteon
