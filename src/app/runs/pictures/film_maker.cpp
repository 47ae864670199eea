#include "runs/pictures/film_maker.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace osteon {
namespace {

constexpr double kWait_s = 0.05;
constexpr std::size_t kMostUndrawn = 3;  // pictures that wait to be drawn

}  // namespace

FilmMaker::FilmMaker(MakePainter make_painter, FilmWriter writer, MakeSound sound, FilmSofts softs,
                     const FilmPace& pace)
    : sound_(std::move(sound)),
      softs_(std::move(softs)),
      pace_(pace),
      queue_(std::move(writer)),
      line_([this, make = std::move(make_painter)] { return begin_to_draw(make); }, kMostUndrawn) {
  FilmMoment& moment = next_.moment;
  moment.hands = std::clamp<std::size_t>(pace_.hands, 1, kMaxHands);
  // A hand that has not been heard of yet is nowhere.
  for (ToolState& tool : moment.tools) tool.X_WP.p = Vec3::Constant(std::nan(""));
}

Result<std::unique_ptr<FilmMaker>> FilmMaker::create(MakePainter make_painter, FilmWriter writer,
                                                     MakeSound sound, FilmSofts softs,
                                                     const FilmPace& pace) {
  std::unique_ptr<FilmMaker> maker(new FilmMaker(std::move(make_painter), std::move(writer),
                                                 std::move(sound), std::move(softs), pace));
  if (auto ok = maker->line_.begun(); !ok) return tl::unexpected(ok.error());
  return maker;
}

// The painter is made, used and let go on the thread that draws.
Result<FilmMaker::Line::Work> FilmMaker::begin_to_draw(const MakePainter& make_painter) {
  auto made = make_painter();
  if (!made) return tl::unexpected(made.error());
  return [this,
          painter = std::make_shared<FilmPainter>(std::move(*made))](Step& step) -> Result<void> {
    for (const CutsPatch& cut : step.cuts) painter->take(cut);
    painter->take(step.softs);
    auto image = painter->draw(step.moment);
    if (!image) return tl::unexpected(image.error());
    obscured_s_ = painter->obscured_s();
    return queue_.add(std::move(step.sound), std::move(*image));
  };
}

void FilmMaker::see(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones) {
  FilmMoment& moment = next_.moment;
  if (hand < moment.hands) moment.tools[hand] = tool;
  if (hand != 0) return;
  // A replay that begins later tells of one hand after the other: wait for all, but not long.
  const bool all = std::all_of(moment.tools.begin(), moment.tools.begin() + hands(),
                               [](const ToolState& t) { return t.tick > 0; });
  if (!all && tool.time_s < next_s() + kWait_s) return;
  moment.bones = bones;
  moment.time_s = tool.time_s;
  while (good() && made_ < pace_.pictures && tool.time_s + 1e-9 >= next_s()) add();
}

void FilmMaker::add() {
  const auto fps = static_cast<std::uint64_t>(pace_.fps);
  const std::uint64_t begin = made_ * kSoundHz / fps, end = (made_ + 1) * kSoundHz / fps;
  next_.sound.resize(static_cast<std::size_t>(end - begin));
  Result<void> done = sound_(next_.sound);
  if (done) {
    next_.softs = softs_.looks(pushes_);
    done = line_.add(next_);
  }
  if (!done) failure_ = done.error();
  next_.cuts.clear();
  ++made_;
}

Result<void> FilmMaker::finish() {
  while (good() && made_ > 0 && made_ < pace_.pictures) add();
  if (made_ == 0 && good()) return fail("holds no ticks there", "the recording");
  if (!good()) return tl::unexpected(*failure_);
  if (auto drawn = line_.finish(); !drawn) return drawn;
  return queue_.finish();
}

}  // namespace osteon
