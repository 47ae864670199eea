#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/render/white_balance.h"
#include "ui/ui_layout.h"
#include "water/scope_water.h"
#include "window/xray_model.h"

namespace osteon {

/// What the picture of a window shows.
enum class PictureLayout : std::uint8_t {
  kOutside,   ///< bones and instruments from outside
  kScope,     ///< what a hand's arthroscope shows
  kPanorama,  ///< bones seen through, with a cone where the scope looks
  kAll,       ///< the scope large; panorama and outside beside it, and the last X-ray picture
  kFluoro     ///< the last X-ray picture
};
inline constexpr std::size_t kPictureLayouts = 5;

/// "outside", "scope", "panorama", "layout", "fluoro".
Result<PictureLayout> parse_picture_layout(const std::string& text);
/// "Outside", "Scope", "Panorama", "All", "X-ray".
const char* title_of(PictureLayout layout);
PictureLayout next_layout(PictureLayout layout);

enum class PaneKind : std::uint8_t { kOutside, kScope, kPanorama, kFluoro };
const char* title_of(PaneKind kind);

/// One view's place in the picture.
struct Pane {
  PaneKind kind = PaneKind::kOutside;
  UiRect area;
  bool large = true;
};

/// The large one first. They fill `free` without covering each other; `scale` as of make_layout.
/// `has_shot`: there is an X-ray picture, which the layout of all then has too.
std::vector<Pane> panes_of(PictureLayout layout, const UiRect& free, float scale, bool has_shot);

/// A pane and what it says in place of a picture; empty: it has one.
struct PaneModel {
  Pane pane;
  std::string message;
  bool offers_scope = false;  ///< one can be taken with a click
};

struct SoundModel {
  double volume = 0;    ///< 0 to 1
  std::string problem;  ///< why nothing is heard; empty: nothing is wrong
};

/// A film of the window.
struct ScreenFilmModel {
  bool on = false;
  bool ending = false;  ///< what is left is being written
  double seconds = 0;
  double megabytes = 0;
  std::string file;
};

struct ObserverModel {
  bool open = false;
  PictureLayout layout = PictureLayout::kScope;
};

/// The water that a scope looks through.
struct WaterModel {
  WaterSettings settings;
  double pressure_pa = 0;  ///< in the joint
  double turbidity = 0;    ///< 0 clear to 1 nothing is seen
  bool collapsed = false;  ///< the pressure does not hold the joint open
  bool can_set = true;     ///< not in a replay: it shows the pump as it was
};

/// A scope's camera head.
struct ScopeCameraModel {
  WhiteBalance white;
  bool looks = true;  ///< a hand looks through a scope: there is a picture to keep
};

struct ViewsModel {
  PictureLayout layout = PictureLayout::kOutside;
  std::vector<PaneModel> panes;
  bool can_shoot = false;  ///< an X-ray picture can be asked for
  bool shooting = false;
  XrayModel xray;
  ObserverModel observer;
  std::optional<WaterModel> water;               ///< none: no scope's picture is on show
  std::optional<ScopeCameraModel> scope_camera;  ///< likewise
  ScreenFilmModel film;
  SoundModel sound;
};

/// What the user asked of them.
struct ViewsRequests {
  std::optional<PictureLayout> layout;
  std::optional<PictureLayout> observer_layout;
  bool take_scope = false;
  bool shoot = false;
  XrayRequests xray;
  bool keep_still = false;  ///< of the scope's picture
  std::optional<WhiteBalance> white_balance;
  std::optional<WaterSettings> water;
  bool toggle_observer = false;
  bool toggle_film = false;
  std::optional<double> sound_volume;
};

}  // namespace osteon
