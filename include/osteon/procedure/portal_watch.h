#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "osteon/procedure/scope_watch.h"
#include "osteon/scene/case.h"
#include "osteon/scene/event.h"
#include "osteon/scene/state.h"

namespace osteon {

// Made by who watches portals being made in skin; the session makes none of these. Their subject is
// the landmark that the portal is meant for, their hand the one whose shaft is in it.
/// A shaft is in a made portal for the first time: {so far towards the trunk from its landmark, mm;
/// so far towards the middle of the knee, mm; 0}.
inline constexpr EventKind kPortalPlaced{467};
/// Right after that: {1: the skin was pierced, 0: it was cut; 1: a scope in another portal saw the
/// tip, 0: none did; 0}.
inline constexpr EventKind kPortalWay{468};

/// A needle is in as deep as in a joint, near a landmark for a portal, and once more when a scope
/// comes to see its tip: {where its hole is, as kPortalPlaced, mm; the same; 1: seen, 0: not}.
inline constexpr EventKind kNeedleIn{470};

/// Which way is which beside the patellar ligament; unit vectors, at right angles.
struct PortalFrame {
  Vec3 p_W = Vec3::Zero();
  Vec3 in_W = -Vec3::UnitZ();     ///< into the body
  Vec3 up_W = Vec3::UnitX();      ///< along the skin, away from the tibial tubercle
  Vec3 middle_W = Vec3::UnitY();  ///< along the skin, towards the other portal
};
/// None: the landmark is not portal_al or portal_am, or the case lacks one of them or the tubercle.
std::optional<PortalFrame> portal_frame(const Case& the_case, std::uint32_t landmark);

/// Where a portal was made. Components: into the body, up and towards the middle, as in the frame
/// of the landmark that it is meant for.
struct MadePortalFound {
  std::uint32_t landmark = 0;
  Vec3 off_F = Vec3::Zero();           ///< from the landmark, m
  Vec3 shaft_F = Vec3::UnitX();        ///< unit, how the shaft went in
  bool pierced = false, seen = false;  ///< as kPortalWay
  /// From the hole of the needle that came there last; none: there was none.
  std::optional<double> from_needle_m = {};
};

/// Follows where portals are made. A function of the tools' states: a replay makes the same events.
class PortalWatch {
 public:
  struct Settings {
    std::vector<std::uint32_t> marks;                ///< landmarks, by ToolState::portal
    std::vector<std::optional<ScopeOptics>> optics;  ///< by hand
  };
  /// The case must outlive it.
  PortalWatch(const Case& the_case, Settings settings);
  /// Adds the tick's events to `out`.
  void add(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
           std::vector<Event>& out);
  /// Of each instrument of the session's tray whether it is a needle; before the first tick.
  void set_needles(std::vector<char> needles) { needles_ = std::move(needles); }
  /// Of each landmark the portal that was made last, in the order of the first ones.
  const std::vector<MadePortalFound>& found() const { return found_; }

 private:
  /// What has been told of a portal.
  struct Told {
    bool any = false;
    std::uint32_t epoch = 0;
    Vec3 p_W = Vec3::Zero();
  };
  /// A needle near a landmark.
  struct Needle {
    std::uint32_t mark = 0;
    Vec3 off_F = Vec3::Zero();  ///< of its hole, as MadePortalFound
  };
  std::optional<Needle> needle_at(const ToolState& tool, const BoneSnapshot& bones) const;
  void follow_needle(std::span<const ToolState* const> tools, std::size_t hand,
                     const BoneSnapshot& bones, std::vector<Event>& out);
  std::optional<double> from_needle(const MadePortalFound& portal) const;
  void keep(const MadePortalFound& portal);
  bool is_news(const ToolState& tool);
  bool is_seen(std::span<const ToolState* const> tools, std::size_t by_hand,
               const BoneSnapshot& bones) const;

  const Case* case_;
  Settings settings_;
  std::vector<std::optional<PortalFrame>> frames_;  ///< by ToolState::portal
  std::vector<Told> told_;                          ///< likewise
  std::vector<MadePortalFound> found_;
  std::vector<char> needles_;         ///< by instrument
  std::vector<int> needle_told_;      ///< by hand: 1: it is in, 2: and was seen
  std::vector<Needle> needle_holes_;  ///< the last of each landmark
};

}  // namespace osteon
