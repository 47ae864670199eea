#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/record/recording.h"
#include "osteon/render/renderer.h"
#include "osteon/scene/case.h"
#include "osteon/scene/state.h"
#include "osteon/session/session.h"
#include "runs/pictures/film_softs.h"
#include "water/scope_water.h"

namespace osteon {

enum class FilmView { kScope, kOutside, kPanorama, kFluoro, kLayout };
/// "scope", "outside", "panorama", "fluoro", "layout".
Result<FilmView> parse_film_view(const std::string& text);

/// Everything that a film's picture shows at one moment.
struct FilmMoment {
  double time_s = 0;
  BoneSnapshot bones;
  std::array<ToolState, kMaxHands> tools;
  std::size_t hands = 1;
};

/// Draws a recorded session's pictures without a window, in one of the views. One thread, where it
/// was made.
class FilmPainter {
 public:
  struct Order {
    FilmView view = FilmView::kOutside;
    int width = 1280, height = 720;
    std::string side = "front";  ///< of the panorama: front, top or left
    /// The pump stands so; none: as it does in the recording.
    std::optional<WaterSettings> water = {};
    bool heat = false;  ///< carved bones are coloured by how warm they became
  };
  /// Fails where the view cannot be drawn: no OpenGL, no hand that ever holds a scope, a case that
  /// X-rays cannot go through. `scope_is_held`: some hand holds one at some time.
  static Result<FilmPainter> create(std::shared_ptr<const Case> the_case,
                                    const SessionSettings& settings, const Tray& tray,
                                    bool scope_is_held, const Order& order);
  ~FilmPainter();
  FilmPainter(FilmPainter&&) noexcept;
  FilmPainter& operator=(FilmPainter&&) noexcept;

  /// What the recorded session removed bone with; before the first cut. Null: nothing.
  void set_carving(std::shared_ptr<const CarvingSetup> setup);
  /// What of the recorded session is soft: drawn as it gives way. Null: nothing.
  void set_softs(const std::shared_ptr<const SoftSetup>& setup);
  /// Bone is gone from the next picture on.
  void take(const CutsPatch& cut);
  /// What is soft looks so from the next picture on.
  void take(const SoftLooks& looks);
  /// For so long of what was drawn through a scope the water let nothing be seen.
  double obscured_s() const;
  /// Fails where the graphics driver has no memory for it.
  Result<Image> draw(const FilmMoment& moment);

 private:
  struct Impl;
  explicit FilmPainter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Whether any hand of a recording holds a scope at some time.
Result<bool> holds_a_scope(RecordingReader& recording, const SessionSettings& settings);

}  // namespace osteon
