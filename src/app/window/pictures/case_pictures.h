#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ui/side_job.h"
#include "window/pictures/case_picture.h"

namespace osteon {

/// Pictures of cases for the browser: from the user's cache, or drawn beside the window one at a
/// time while the browser is open. Needs the window's context in `want`, `poll` and the destructor.
class CasePictures {
 public:
  static constexpr int kWidth_px = 144, kHeight_px = 96;
  explicit CasePictures(std::filesystem::path folder) : store_(std::move(folder)) {}
  ~CasePictures();
  CasePictures(const CasePictures&) = delete;
  CasePictures& operator=(const CasePictures&) = delete;

  /// The cases whose pictures are shown now. None: what is being drawn is stopped.
  void want(const std::vector<std::string>& specs);
  void poll();
  /// OpenGL's texture of a case's picture; 0: there is none yet, or it cannot be drawn.
  std::uintptr_t texture(const std::string& spec) const;

 private:
  void begin_next();
  void show(const std::string& spec, const Image& image);

  CasePictureStore store_;
  std::map<std::string, unsigned> textures_;  ///< 0: not drawn yet, or it cannot be
  std::vector<std::string> to_draw_;          ///< the next one last
  std::string drawing_;
  std::unique_ptr<SideJob<Image>> job_;
};

}  // namespace osteon
