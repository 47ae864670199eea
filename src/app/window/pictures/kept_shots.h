#pragma once

#include <cstddef>
#include <vector>

#include "window/controllers/cases/shown_image.h"
#include "window/xray_model.h"

namespace osteon {

/// An X-ray picture with what is known of it.
struct XrayPicture {
  Image image;
  CArmTurn turn;
  XrayExposure exposure;
  XrayDose dose;
  std::vector<HandDose> hands;
  double time_s = 0;
};

/// The pictures of an examination, one of them on show, and what they gave together. Needs the
/// window's context in every call and in the destructor.
class KeptShots {
 public:
  /// Before the oldest is dropped; its dose stays.
  static constexpr std::size_t kMost = 24;
  KeptShots() = default;
  ~KeptShots() { clear(); }
  KeptShots(const KeptShots&) = delete;
  KeptShots& operator=(const KeptShots&) = delete;

  /// It is shown from now on.
  void add(XrayPicture picture);
  /// Nothing where there is no such place.
  void choose(std::size_t place);
  void clear();
  bool empty() const { return shots_.empty(); }
  void show(const Viewport& viewport) const { shown_image_.show(viewport); }
  /// Without the C-arm's turn.
  XrayModel model() const;

 private:
  struct Kept {
    Image image;
    ShotModel model;
  };
  std::vector<Kept> shots_;
  std::size_t shown_ = 0;
  ShownImage shown_image_;
  XrayTally total_;
  int taken_ = 0;
};

/// The mean of squares of `factor` pixels a side; what is left over at the right and the bottom is
/// dropped.
Image smaller_image(const Image& image, int factor);

}  // namespace osteon
