#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/procedure/scope_watch.h"
#include "osteon/scene/case.h"
#include "osteon/scene/path.h"
#include "osteon/surgeon/acl_driller.h"
#include "osteon/surgeon/exam_surgeon.h"
#include "osteon/surgeon/skill.h"

namespace osteon {

/// What whoever reconstructs a cruciate ligament works with.
struct AclTools {
  ScopeOptics optics;
  std::string scope, probe, pin;  ///< names of the instruments; no probe: nothing is felt
  double reamed_m = 0.008;        ///< so wide the tunnels will be
  bool drills = false;            ///< both tunnels are drilled, not located alone
  double socket_m = 0.025;        ///< so deep the femur's is drilled
  bool after_graft = false;       ///< the hand that drills makes a graft before that
  bool drills_tibia = true, drills_femur = true;  ///< of those that drill
  std::vector<std::string> tour;                  ///< landmarks that are looked at
  std::vector<std::string> felt;                  ///< and those that the probe presses next to
  bool examines = false;      ///< the knee is tested by hand, between the scope and the probe
  std::string shaver;         ///< that clears the stumps after that; empty: they stay
  double begin_s = 0;         ///< nobody comes before; what drills then begins when it is told to
  bool spares_softs = false;  ///< drills keep off menisci and the other cruciate ligament
  std::optional<Vec3> al_W, am_W;  ///< where the portals were made; none: at the landmarks
};

/// Ways of three hands through a reconstruction.
struct AclWays {
  ProbePath scope, probe, pin;
  std::vector<AclMove> drilling;         ///< in place of `pin`, where tunnels are drilled
  double third_begin_s = 0;              ///< when that hand, or the pin's, begins
  bool after_graft = false;              ///< `drilling` begins when a graft has been made
  bool examines = false;                 ///< or when that time has come
  std::vector<TimedCommand> exam;        ///< of the knee and of the pump, meanwhile
  std::vector<std::string> unreachable;  ///< landmarks that no free way leads to
};

/// Plans the ways of somebody in a bent knee, left or right: the scope through the anterolateral
/// portal to each landmark of the tour, the probe through the anteromedial one, then the pin on the
/// front of the tibia's inner side, in line with the footprint, and on the femur's footprint: of
/// the ways that leave it room one with bone behind it and a channel of about 40 mm. A
/// beginner is slower, trembles, presses harder and misses both footprints by up to 5 mm. `skill`
/// "bad:NAME": one thing that is done wrong, acl_faults(). Fails when the case lacks a landmark or
/// portal, on another NAME, on an error of a bone that is not to be drilled, or when no way of the
/// pin is free. Beside a tunnel of an earlier reconstruction (landmarks `old_socket_mouth`, `_end`,
/// `old_tunnel_mouth`, `_end`) a new one leaves bone.
Result<AclWays> plan_acl(const Case& the_case, const AclTools& tools, const Skill& skill);

/// What a bad surgeon can do wrong, as an exercise's errors are named, besides making a portal or a
/// graft (puncture_faults, graft_faults_in_knee).
std::span<const std::string_view> acl_faults();

}  // namespace osteon
