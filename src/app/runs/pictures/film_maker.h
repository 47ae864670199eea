#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "osteon/media/film_writer.h"
#include "runs/pictures/film_line.h"
#include "runs/pictures/film_queue.h"
#include "runs/pictures/film_softs.h"
#include "runs/pictures/film_view.h"

namespace osteon {

/// What a film shows and sounds like at each of its pictures.
struct FilmPace {
  double from_s = 0;
  std::uint64_t pictures = 1;
  int fps = 30;
  std::size_t hands = 1;
};

/// Takes a replay's ticks and makes pictures and sound of them: on threads of their own, so that
/// the replay goes on while a picture is drawn and another one is written.
class FilmMaker {
 public:
  using MakePainter = std::function<Result<FilmPainter>()>;
  using MakeSound = std::function<Result<void>(std::span<float> block)>;  ///< the next of it
  /// `softs` may be null. Fails where the pictures cannot be drawn.
  static Result<std::unique_ptr<FilmMaker>> create(MakePainter make_painter, FilmWriter writer,
                                                   MakeSound sound, FilmSofts softs,
                                                   const FilmPace& pace);

  void see(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones);
  void take(const CutsPatch& cut) { next_.cuts.push_back(cut); }
  void take(const SoftPushes& pushes) { pushes_ = pushes; }
  /// After the last tick: what was recorded may end a tick before the last picture.
  Result<void> finish();

  /// False: the film cannot go on, and finish() says why.
  bool good() const { return !failure_; }
  /// The water hid everything for so long; once it is finished.
  double obscured_s() const { return obscured_s_; }

 private:
  /// What is drawn next.
  struct Step {
    FilmMoment moment;
    std::vector<CutsPatch> cuts;
    SoftLooks softs;
    std::vector<float> sound;
  };
  using Line = FilmLine<Step>;

  FilmMaker(MakePainter make_painter, FilmWriter writer, MakeSound sound, FilmSofts softs,
            const FilmPace& pace);
  Result<Line::Work> begin_to_draw(const MakePainter& make_painter);
  std::ptrdiff_t hands() const { return static_cast<std::ptrdiff_t>(next_.moment.hands); }
  double next_s() const { return pace_.from_s + static_cast<double>(made_) / pace_.fps; }
  void add();

  MakeSound sound_;
  FilmSofts softs_;
  FilmPace pace_;
  Step next_;
  SoftPushes pushes_;
  std::uint64_t made_ = 0;
  std::optional<Error> failure_;
  double obscured_s_ = 0;  ///< the drawing thread's until it has ended
  FilmQueue queue_;
  Line line_;  ///< after what it draws for
};

}  // namespace osteon
