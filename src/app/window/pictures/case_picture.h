#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "osteon/image/progress.h"
#include "osteon/render/renderer.h"

namespace osteon {

/// A small picture of a case's joint, seen as at first. Opens a graphics context of its own for
/// the calling thread. `progress` is asked whether to go on; a picture that was stopped is an
/// error.
Result<Image> draw_case_picture(const std::string& spec, int width, int height,
                                const Progress& progress);

/// Pictures of cases in a folder of the user's cache. One is looked up by the case's name and by
/// the time when the case was last written, so that a picture of an older state is not found.
class CasePictureStore {
 public:
  explicit CasePictureStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// None: there is no such picture yet, or its file is damaged.
  std::optional<Image> find(const std::string& spec) const;
  /// Where the cache cannot be written, the picture is drawn again the next time.
  void keep(const std::string& spec, const Image& image) const;

 private:
  std::filesystem::path file_of(const std::string& spec) const;
  std::filesystem::path folder_;
};

}  // namespace osteon
