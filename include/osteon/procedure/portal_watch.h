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

/// Which way is which beside the patellar ligament; unit vectors, at right angles.
struct PortalFrame {
  Vec3 p_W = Vec3::Zero();
  Vec3 in_W = -Vec3::UnitZ();     ///< into the body
  Vec3 up_W = Vec3::UnitX();      ///< along the skin, away from the tibial tubercle
  Vec3 middle_W = Vec3::UnitY();  ///< along the skin, towards the other portal
};
/// None: the landmark is not portal_al or portal_am, or the case lacks one of them or the tubercle.
std::optional<PortalFrame> portal_frame(const Case& the_case, std::uint32_t landmark);

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

 private:
  /// What has been told of a portal.
  struct Told {
    bool any = false;
    std::uint32_t epoch = 0;
    Vec3 p_W = Vec3::Zero();
  };
  bool is_news(const ToolState& tool);
  bool is_seen(std::span<const ToolState* const> tools, std::size_t by_hand,
               const BoneSnapshot& bones) const;

  const Case* case_;
  Settings settings_;
  std::vector<std::optional<PortalFrame>> frames_;  ///< by ToolState::portal
  std::vector<Told> told_;                          ///< likewise
};

}  // namespace osteon
