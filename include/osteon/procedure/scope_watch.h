#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "osteon/scene/case.h"
#include "osteon/scene/event.h"
#include "osteon/scene/state.h"

namespace osteon {

// Codes of events that a scope's pose gives; the session makes none of them.
/// A landmark is in the picture and nothing hides it: {how far off the middle, as a share of half
/// the field; distance mm; turn of the picture, degrees}.
inline constexpr EventKind kMarkSeen{402};
/// {turn of the picture, degrees; how many marks are in it; 0}, of the hand itself.
inline constexpr EventKind kScopeHeld{403};
/// {how far the shaft passes its portal by, mm; 0; 0}, of the hand itself.
inline constexpr EventKind kShaftHeld{404};
/// {1: the other hand's tip is in the picture, 0: it is not; 0; 0}, of the hand that looks.
inline constexpr EventKind kTipSeen{405};
/// The shaft passes through a portal, which is the subject, as a landmark: {0; 0; 0}.
inline constexpr EventKind kThroughPortal{406};

/// How an instrument looks: the middle of its view leans from the shaft towards +y of Tool, where
/// its window looks; upwards in the picture is the same way. The camera turns with the shaft.
struct ScopeOptics {
  double angle_rad = 0;
  double half_field_rad = 0.9;
};

/// What is in the middle of a scope's picture, and which way is up in it; unit vectors.
struct ScopeView {
  Vec3 eye_W = Vec3::Zero();
  Vec3 along_W = -Vec3::UnitZ();
  Vec3 up_W = Vec3::UnitY();
};
ScopeView view_through(const ScopeOptics& optics, const Pose& X_WT);

/// How far the picture is turned off upright (World z upwards as far as it can be), degrees,
/// -180 to 180; 0 where the view is vertical and nothing is upright.
double turn_deg(const ScopeView& view);

/// Whether a bone stands between two points. The last `spare_m` before `to_W` do not count: what
/// lies on a bone is not hidden by that bone's skin.
inline constexpr double kMarkSpare_m = 0.0008;
bool is_hidden(const Case& the_case, const BoneSnapshot& bones, const Vec3& from_W,
               const Vec3& to_W, double spare_m = kMarkSpare_m);

/// Where a place is in a scope's picture.
struct PlaceInPicture {
  double share = 0;  ///< how far off the middle, of half the field
  double distance_m = 0;
  bool hidden = false;  ///< by bone
};
/// None: outside of the picture.
std::optional<PlaceInPicture> place_in_picture(const ScopeOptics& optics, const ScopeView& view,
                                               const Case& the_case, const BoneSnapshot& bones,
                                               const Vec3& p_W, double spare_m = kMarkSpare_m);

/// Makes events of what one hand's scope shows, 100 a second. A function of the states: a replay
/// makes the same ones. Keeps pointers to nothing but the case, which must outlive it.
class ScopeWatch {
 public:
  struct Settings {
    std::optional<ScopeOptics> optics;  ///< none: nobody looks through it
    std::vector<std::uint32_t> marks;   ///< in Case::landmarks
    std::optional<Vec3> portal_W;
    std::uint8_t hand = 0;
    double tick_s = 0.001;
    /// Of each portal of the session the landmark; ToolState::portal counts in it.
    std::vector<std::uint32_t> portal_marks = {};
  };
  ScopeWatch(const Case& the_case, Settings settings);
  /// Adds the tick's events to `out`. `other`: a tool that should stay in the picture; may be null.
  void add(const ToolState& tool, const ToolState* other, const BoneSnapshot& bones,
           std::vector<Event>& out);

 private:
  Event event(const ToolState& tool, EventKind kind, std::array<double, 3> values) const;
  void look(const ToolState& tool, const ToolState* other, const BoneSnapshot& bones,
            std::vector<Event>& out) const;
  /// Share of half the field, and distance in mm; none: it is not seen.
  std::optional<std::array<double, 2>> seen(const ScopeView& view, const BoneSnapshot& bones,
                                            const Vec3& p_W, double spare_m) const;

  const Case* case_;
  Settings settings_;
  std::uint64_t stride_;
};

}  // namespace osteon
