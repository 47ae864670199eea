#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/render/renderer.h"
#include "osteon/scene/case.h"
#include "osteon/session/session.h"
#include "osteon/xray/case_body.h"
#include "runs/pictures/film_view.h"
#include "runs/pictures/xray_cuts.h"
#include "runs/pictures/xray_shot.h"

namespace osteon {

/// A fluoroscope that pulses through a film, AP: between two pulses its last picture stands.
class FilmFluoro {
 public:
  static constexpr double kPulsesPerSecond = 8;
  static constexpr int kMostSide_px = 512;

  /// Fails as CaseBody::create does, and on an instrument that is not closed.
  static Result<FilmFluoro> create(const Case& the_case, const Tray& tray);
  /// Asked where a picture is taken.
  using AskCuts = std::function<CutScene()>;
  /// A square picture in the middle of one of this size, black around it.
  Result<Image> draw(const FilmMoment& moment, int width, int height, const AskCuts& cuts = {});
  /// One shot of `side` by `side` pixels with its dose, also to each hand that holds an instrument.
  /// `orbit_rad`, `angulation_rad`: as CArm's.
  struct ShotOrder {
    double orbit_rad = 0, angulation_rad = 0;
    int side = kMostSide_px;
    std::uint64_t seed = 1;  ///< of the noise
  };
  Result<XrayShot> shoot(const FilmMoment& moment, const ShotOrder& order,
                         const AskCuts& cuts = {});

 private:
  FilmFluoro(CaseBody body, XrayCuts cuts) : body_(std::move(body)), cuts_(std::move(cuts)) {}
  Result<void> pulse(const FilmMoment& moment, int side, const AskCuts& cuts);
  void place(const FilmMoment& moment, const AskCuts& cuts);

  CaseBody body_;
  XrayCuts cuts_;
  std::vector<std::shared_ptr<const TriMesh>> steel_;  ///< by place in the tray
  std::vector<Vec3> hands_T_;                          ///< that hold them, likewise
  XrayScene scene_;
  std::int64_t pulse_ = -1;
  int side_ = 0;
  std::vector<float> grey_;  ///< of the last pulse, side_ by side_
};

}  // namespace osteon
