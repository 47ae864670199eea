#include "ui/desktop_chooser.h"

namespace osteon {
namespace {

constexpr unsigned kFoldersFrom = 3;  // the portal's version that asks for folders

}  // namespace

void DesktopChooser::look_for() {
  if (looked_) return;
  looked_ = true;
  looking_ = std::make_unique<SideJob<unsigned>>(
      [](const Progress&) -> Result<unsigned> { return desktop_chooser_version(); });
}

unsigned DesktopChooser::version() {
  if (!looking_ || !looking_->done()) return version_;
  if (const auto found = looking_->take()) version_ = *found;
  looking_.reset();
  return version_;
}

bool DesktopChooser::offers_files() { return version() > 0; }

bool DesktopChooser::offers_folders() { return version() >= kFoldersFrom; }

void DesktopChooser::ask(const DesktopQuestion& question) {
  if (asking_) return;
  asking_ = std::make_unique<SideJob<std::vector<std::string>>>(
      [question](const Progress& progress) { return choose_on_desktop(question, progress); });
}

Result<std::vector<std::string>> DesktopChooser::take() {
  if (!asking_ || !asking_->done()) return std::vector<std::string>{};
  auto chosen = asking_->take();
  asking_.reset();
  return chosen;
}

}  // namespace osteon
