#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/parser.h"
#include "commands/support/progress_line.h"
#include "commands/support/render_options.h"
#include "osteon/media/film_writer.h"
#include "osteon/media/wav_writer.h"
#include "osteon/render/renderer.h"
#include "runs/hands/tray.h"
#include "runs/pictures/film_maker.h"
#include "runs/pictures/film_still.h"
#include "runs/pictures/film_view.h"
#include "runs/replays/recorded_case.h"
#include "runs/replays/recorded_sound.h"

namespace osteon {
namespace {

struct FilmCommand {
  std::string recording, view = "outside", side = "front", size = "1280x720", out, sound, case_spec;
  int fps = 30;
  double from_s = 0;
  std::optional<double> to_s;
  bool mute = false;
  bool heat = false;
  std::optional<double> pressure_mmhg, outlet_open;  ///< none: as recorded
};

/// A part of a recording.
struct FilmSpan {
  double from_s = 0, to_s = 0;
  double obscured_s = 0;  ///< for so long a scope's picture showed nothing but water

  std::uint64_t samples() const {
    return static_cast<std::uint64_t>(std::llround((to_s - from_s) * kSoundHz));
  }
  std::uint64_t pictures(int fps) const {
    return std::max<std::uint64_t>(1,
                                   static_cast<std::uint64_t>(std::llround((to_s - from_s) * fps)));
  }
};

Result<FilmSpan> span_of(const FilmCommand& command, const RecordingReader& recording,
                         double tick_s) {
  const double end_s = static_cast<double>(recording.ticks(0)) * tick_s;
  if (recording.ticks(0) == 0) return fail("holds no ticks", command.recording);
  const FilmSpan span{command.from_s, std::min(command.to_s.value_or(end_s), end_s), 0};
  if (!(span.from_s >= 0 && span.from_s < end_s))
    return fail("has no data at " + std::to_string(command.from_s) + " s", command.recording,
                "Choose a time between 0 and " + std::to_string(end_s) + " s");
  if (!(span.to_s > span.from_s))
    return fail("ends before it begins", "--from and --to", "Choose --to after --from");
  return span;
}

Result<void> save_sound(RecordingReader& recording, const FilmSpan& span, const std::string& file) {
  auto sound = RecordedSound::create(recording, span.from_s);
  if (!sound) return tl::unexpected(sound.error());
  auto wav = WavWriter::create(file, span.samples());
  if (!wav) return tl::unexpected(wav.error());
  ProgressLine line;
  const auto tell = line.stopping();
  std::vector<float> block(kSoundHz / 10);
  for (std::uint64_t at = 0; at < span.samples(); at += block.size()) {
    tell("sound", static_cast<double>(at) / static_cast<double>(span.samples()));
    if (auto ok = sound->render(block); !ok) return ok;
    if (auto ok = wav->add(block); !ok) return ok;
  }
  return wav->finish();
}

/// Ends a replay whose film cannot go on.
struct FilmStopped {};

// Who sets the one leaves the other as it stands where nobody has set it.
std::optional<WaterSettings> other_pump(const FilmCommand& command) {
  if (!command.pressure_mmhg && !command.outlet_open) return std::nullopt;
  WaterSettings water;
  if (command.pressure_mmhg) water.pump_pa = kPa_per_mmHg * *command.pressure_mmhg;
  if (command.outlet_open) water.outlet_open = *command.outlet_open;
  return water;
}

Result<FilmPainter> film_painter(const FilmCommand& command, const SessionSettings& settings,
                                 std::shared_ptr<const Case> the_case, const ReplayOptions& how,
                                 bool scope_is_held) {
  const auto size = parse_picture_size(command.size);
  const auto view = parse_film_view(command.view);
  auto painter = FilmPainter::create(
      std::move(the_case), settings, how.tray, scope_is_held,
      {*view, size->width, size->height, command.side, other_pump(command), command.heat});
  if (!painter) return painter;
  painter->set_carving(how.carving);
  painter->set_softs(how.softs);
  return painter;
}

bool shows_softs(const FilmCommand& command) {
  return *parse_film_view(command.view) != FilmView::kFluoro;
}

bool is_still(const FilmCommand& command) {
  return std::filesystem::path(command.out).extension() == ".png";
}

Result<std::unique_ptr<FilmMaker>> film_maker(const FilmCommand& command,
                                              RecordingReader& recording,
                                              const SessionSettings& settings, const FilmSpan& span,
                                              const std::shared_ptr<const Case>& the_case,
                                              const ReplayOptions& how) {
  const auto scope = holds_a_scope(recording, settings);
  if (!scope) return tl::unexpected(scope.error());
  auto sound = RecordedSound::create(recording, span.from_s);
  if (!sound) return tl::unexpected(sound.error());
  const auto size = parse_picture_size(command.size);
  auto writer =
      FilmWriter::create(command.out, {size->width, size->height, command.fps, !command.mute});
  if (!writer) return tl::unexpected(writer.error());
  return FilmMaker::create(
      [&, held = *scope] { return film_painter(command, settings, the_case, how, held); },
      std::move(*writer),
      [heard = std::make_shared<RecordedSound>(std::move(*sound))](std::span<float> block) {
        return heard->render(block);
      },
      FilmSofts(*the_case, shows_softs(command) ? how.softs : nullptr),
      {span.from_s, span.pictures(command.fps), command.fps, recording.header().hands});
}

/// `sees`: a FilmMaker or a FilmStill; its finish() says why it could not go on.
template <class Sees>
Result<void> replay_into(Sees& sees, RecordingReader& recording,
                         std::shared_ptr<const Case> the_case, ReplayOptions how,
                         const FilmSpan& span, bool heat) {
  ProgressLine line;
  const auto tell = line.stopping();
  how.from_s = heat ? 0 : span.from_s;  // how warm it is now tells of all that was cut before
  how.to_s = span.to_s;
  how.on_cuts = [&](const CutsPatch& cut, double) { sees.take(cut); };
  how.on_pushes = [&](const SoftPushes& pushes) { sees.take(pushes); };
  how.on_tick = [&](std::size_t hand, const ToolState& tool, const BoneSnapshot& bones,
                    std::span<const Event>) {
    sees.see(hand, tool, bones);
    if (!sees.good()) throw FilmStopped();
    if (hand == 0 && tool.tick % 16 == 0)
      tell("film", (tool.time_s - how.from_s) / (span.to_s - how.from_s));
  };
  try {
    if (const auto played = replay(recording, std::move(the_case), how); !played)
      return tl::unexpected(played.error());
  } catch (const FilmStopped&) {
    // The film knows why.
  }
  return {};
}

/// The picture of the span's end.
Result<void> save_still(const FilmCommand& command, RecordingReader& recording,
                        const SessionSettings& settings, const FilmSpan& span,
                        const std::shared_ptr<const Case>& the_case, ReplayOptions how) {
  const auto scope = holds_a_scope(recording, settings);
  if (!scope) return tl::unexpected(scope.error());
  auto painter = film_painter(command, settings, the_case, how, *scope);
  if (!painter) return tl::unexpected(painter.error());
  FilmStill still(std::move(*painter),
                  FilmSofts(*the_case, shows_softs(command) ? how.softs : nullptr),
                  recording.header().hands);
  if (auto ok = replay_into(still, recording, the_case, std::move(how), span, command.heat); !ok)
    return ok;
  const auto image = still.finish();
  if (!image) return tl::unexpected(image.error());
  return save_png(*image, command.out);
}

/// What can be seen to be wrong before anything long is begun.
Result<void> check_film(const FilmCommand& command, RecordingReader& recording,
                        const SessionSettings& settings) {
  const auto size = parse_picture_size(command.size);
  if (!size) return tl::unexpected(size.error());
  const auto view = parse_film_view(command.view);
  if (!view) return tl::unexpected(view.error());
  const std::filesystem::path out = command.out;
  if (out.has_extension() && out.extension() != ".webm" && !is_still(command))
    return fail("must end in .webm, or in .png for one picture", command.out,
                "Films are WebM files");
  if (is_still(command) && (command.to_s || !command.sound.empty()))
    return fail("is one picture, of the time --from", command.out,
                "Leave out --to and --sound, or name a .webm file");
  const auto scope = holds_a_scope(recording, settings);
  if (!scope) return tl::unexpected(scope.error());
  if (*view == FilmView::kScope && !*scope)
    return fail("no hand of the recording holds a scope", command.recording,
                "Choose --view outside, panorama, fluoro or layout");
  return {};
}

Result<FilmSpan> make_film(const FilmCommand& command) {
  auto recording = RecordingReader::open(command.recording);
  if (!recording) return tl::unexpected(recording.error());
  const auto settings = parse_settings(recording->header().settings_json);
  if (!settings) return tl::unexpected(settings.error());
  const auto span = span_of(command, *recording, settings->haptic.tick_s);
  if (!span) return span;
  if (auto ok = check_film(command, *recording, *settings); !ok) return tl::unexpected(ok.error());
  const auto spec = recorded_case_spec(command.recording, command.case_spec, recording->header());
  if (!spec) return tl::unexpected(spec.error());
  const auto the_case = open_and_show_progress(*spec, CaseParts::kAll);
  if (!the_case) return tl::unexpected(the_case.error());
  ReplayOptions how;
  if (auto ok = take_instruments(recording->header(), **the_case, how); !ok)
    return tl::unexpected(ok.error());
  if (is_still(command)) {
    constexpr double kBefore_s = 0.4;
    const FilmSpan before{std::max(0.0, span->from_s - kBefore_s),
                          span->from_s + settings->haptic.tick_s, 0};
    if (auto ok = save_still(command, *recording, *settings, before, *the_case, std::move(how));
        !ok)
      return tl::unexpected(ok.error());
    return FilmSpan{span->from_s, span->from_s, 0};
  }
  auto maker = film_maker(command, *recording, *settings, *span, *the_case, how);
  if (!maker) return tl::unexpected(maker.error());
  if (auto ok = replay_into(**maker, *recording, *the_case, std::move(how), *span, command.heat);
      !ok)
    return tl::unexpected(ok.error());
  if (auto ok = (*maker)->finish(); !ok) return tl::unexpected(ok.error());
  if (!command.sound.empty())
    if (auto ok = save_sound(*recording, *span, command.sound); !ok)
      return tl::unexpected(ok.error());
  return FilmSpan{span->from_s, span->to_s, (*maker)->obscured_s()};
}

int run_film(const FilmCommand& command) {
  const auto span = make_film(command);
  if (!span) return report_error(span.error());
  if (is_still(command)) {
    std::printf("%s view of %s at %.2f s -> %s\n", command.view.c_str(), command.recording.c_str(),
                span->from_s, command.out.c_str());
    return kExitDone;
  }
  std::printf("%s view of %s, %.2f to %.2f s, %d pictures a second -> %s\n", command.view.c_str(),
              command.recording.c_str(), span->from_s, span->to_s, command.fps,
              command.out.c_str());
  if (span->obscured_s > 0) std::printf("the water hid everything for %.1f s\n", span->obscured_s);
  return kExitDone;
}

Result<FilmSpan> make_sound(const FilmCommand& command) {
  auto recording = RecordingReader::open(command.recording);
  if (!recording) return tl::unexpected(recording.error());
  const auto settings = parse_settings(recording->header().settings_json);
  if (!settings) return tl::unexpected(settings.error());
  const auto span = span_of(command, *recording, settings->haptic.tick_s);
  if (!span) return span;
  if (auto ok = save_sound(*recording, *span, command.out); !ok) return tl::unexpected(ok.error());
  return span;
}

int run_sound(const FilmCommand& command) {
  const auto span = make_sound(command);
  if (!span) return report_error(span.error());
  std::printf("sound of %s, %.2f to %.2f s -> %s\n", command.recording.c_str(), span->from_s,
              span->to_s, command.out.c_str());
  return kExitDone;
}

void add_span_options(cli::App& sub, FilmCommand& command) {
  sub.add_option("recording", command.recording, "recording (.osr)")->required();
  sub.add_option("--from", command.from_s, "start of the part, s from the recording's start")
      ->check(cli::Range(0.0, 4 * 3600.0))
      ->capture_default_str();
  sub.add_option("--to", command.to_s, "end of the part, s; default: the recording's end")
      ->check(cli::Range(0.0, 4 * 3600.0));
}

void add_sound_command(cli::App& app, int& exit_code) {
  auto command = std::make_shared<FilmCommand>();
  cli::App* sub = app.add_subcommand("sound", "Write the sound of a recording as WAV");
  add_span_options(*sub, *command);
  sub->add_option("--out", command->out, "WAV file to write")->required();
  sub->callback([command, &exit_code] { exit_code = run_sound(*command); });
}

}  // namespace

void add_film_commands(cli::App& app, int& exit_code) {
  auto command = std::make_shared<FilmCommand>();
  cli::App* sub = app.add_subcommand(
      "film", "Make a film (WebM: VP9 and Opus) of a recording with its sound, without a window");
  add_span_options(*sub, *command);
  sub->add_option("--view", command->view, "scope, outside, panorama, fluoro or layout")
      ->capture_default_str();
  sub->add_option("--side", command->side, "side of the panorama: front, top or left")
      ->check(cli::IsMember({"front", "top", "left"}))
      ->capture_default_str();
  sub->add_option("--size", command->size, "width x height in pixels")->capture_default_str();
  sub->add_option("--fps", command->fps, "pictures a second")
      ->check(cli::Range(1, 120))
      ->capture_default_str();
  sub->add_option("--pressure", command->pressure_mmhg,
                  "pressure of the pump in mmHg, for the scope's picture; default: as recorded")
      ->check(cli::Range(0.0, 300.0));
  sub->add_option("--outlet", command->outlet_open,
                  "how far the outlet is open, 0 to 1; default: as recorded")
      ->check(cli::Range(0.0, 1.0));
  sub->add_option("--case", command->case_spec, "a case; default: the recording's own");
  sub->add_flag("--mute", command->mute, "leave out the sound");
  sub->add_flag("--heat", command->heat,
                "colour carved bones by the hottest temperature that they had (outside, panorama)");
  sub->add_option("--sound", command->sound, "write the sound as a WAV file too");
  sub->add_option("--out", command->out,
                  "WebM file to write; or a PNG file: one picture, of the time --from")
      ->required();
  sub->callback([command, &exit_code] { exit_code = run_film(*command); });
  add_sound_command(app, exit_code);
}

}  // namespace osteon
