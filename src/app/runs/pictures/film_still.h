#pragma once

#include <cstddef>
#include <optional>

#include "runs/pictures/film_softs.h"
#include "runs/pictures/film_view.h"

namespace osteon {

/// One picture of a replay, of its last moment. The pictures before it are drawn too, 30 a second:
/// what a picture owes to those before it (drifting flakes, fog, light) is as in a film.
class FilmStill {
 public:
  FilmStill(FilmPainter painter, FilmSofts softs, std::size_t hands);
  void see(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones);
  void take(const CutsPatch& cut) { painter_.take(cut); }
  void take(const SoftPushes& pushes) { pushes_ = pushes; }
  /// False: it cannot go on, and finish() says why.
  bool good() const { return !failure_; }
  /// Fails where there was no tick, or a picture could not be drawn.
  Result<Image> finish();

 private:
  void draw();

  FilmPainter painter_;
  FilmSofts softs_;
  FilmMoment moment_;
  SoftPushes pushes_;
  double next_s_ = 0;
  std::optional<Image> last_;
  std::optional<Error> failure_;
};

}  // namespace osteon
