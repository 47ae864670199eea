#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "osteon/base/id.h"
#include "osteon/scene/case.h"

namespace osteon {

/// One hand of the run, for the hand card.
struct HandRow {
  std::string name;        ///< "Right"; empty: the only one
  std::string instrument;  ///< its title
  std::string portal;      ///< that its shaft passes through; empty: none
  bool runs = false;       ///< its motor does
  bool active = false;
  bool rests = false;         ///< as if held by an assistant
  std::string key_does = {};  ///< the key V, while it is held: "run"; empty: nothing
};

/// One line of the tray.
struct TrayItem {
  std::string title;        ///< "Hook probe"
  std::string size;         ///< "1.5 mm"; empty: it has one size alone
  std::string does;         ///< "probe, cut (no effect yet)"
  std::uint32_t place = 0;  ///< in the session's tray
  int picture = -1;         ///< cell of the sheet; -1: none
  bool used = false;        ///< by the active hand, in the exercise that runs; these come first
};

struct TrayModel {
  bool open = false;
  std::string search;
  std::vector<TrayItem> items;  ///< the ones taken last come first
  std::uint32_t held = 0;       ///< by the active hand
  std::uintptr_t sheet = 0;     ///< texture of the pictures; 0: not drawn yet
  int sheet_columns = 1, sheet_rows = 1;
};

/// How far the active tip is from bone.
struct TipModel {
  bool known = false;
  double distance_mm = 0;
  BoneId bone;
  std::optional<std::uint32_t> soft;  ///< in Case::softs; none: the bone itself
  bool drawn = false;                 ///< as a line in the picture, between these points
  float x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  std::optional<double> depth_mm = {};  ///< of a drill's tip in its hole
};

struct NameTag {
  BoneId bone;
  float x = 0, y = 0;
};

struct HandsModel {
  std::vector<HandRow> rows;
  std::vector<std::string> portals;  ///< titles
  std::size_t next_portal = 0;       ///< that the key brings the hand to
  bool can_bring = false;            ///< the mouse moves the active hand
  bool can_add = false;              ///< a second hand
  std::size_t restore_points = 0;
  TrayModel tray;
  TipModel tip;
  std::vector<NameTag> names;  ///< on the bones; empty unless asked for
  bool names_on = false;
};

/// What the user asked of them.
struct HandsRequests {
  bool change = false;  ///< the other hand; the first time, a second one comes in
  bool toggle_tray = false;
  std::optional<std::string> search;  ///< as typed
  std::optional<std::uint32_t> take;  ///< place in the tray
  int step = 0;                       ///< that many instruments on
  bool next_size = false;
  std::optional<std::size_t> portal;  ///< the active hand goes before it
  bool mark = false, undo = false;
  bool upright = false;  ///< the active hand's instrument, on what its tip is nearest to
  bool toggle_names = false;
};

}  // namespace osteon
