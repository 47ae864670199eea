#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "osteon/render/renderer.h"
#include "osteon/scene/instrument.h"
#include "ui/side_job.h"

namespace osteon {

/// Pictures of instruments for the tray, drawn beside the window once they are first wanted. Needs
/// the window's context in `poll` and in the destructor.
class TrayPictures {
 public:
  static constexpr int kColumns = 6;
  TrayPictures() = default;
  ~TrayPictures();
  TrayPictures(const TrayPictures&) = delete;
  TrayPictures& operator=(const TrayPictures&) = delete;

  /// Draws these after the wrist probe, unless it has done so.
  void want(const std::vector<Instrument>& instruments);
  void poll();
  /// OpenGL's texture of all pictures; 0: not ready.
  std::uintptr_t texture() const { return texture_; }
  int rows() const { return rows_; }

 private:
  void forget();

  std::unique_ptr<SideJob<Image>> job_;
  std::vector<std::string> names_;  ///< of those drawn or being drawn
  int rows_ = 1;
  unsigned texture_ = 0;
};

}  // namespace osteon
