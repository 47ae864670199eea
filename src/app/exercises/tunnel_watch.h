#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/procedure/judge.h"
#include "osteon/scene/state.h"
#include "runs/acl_report.h"

namespace osteon {

/// Whether a scenario asks about landmarks felt or tunnels.
bool asks_about_tunnels(const ScenarioPlan& plan);

/// What locates tunnels.
inline constexpr std::string_view kGuidePin = "guide_pin";

/// Makes the events of tunnel_events.h from what hands did in a knee. The line of a tunnel is that
/// of a pin which is pressed on a bone and held still: from its tip along its axis, as deep as the
/// scenario says or through the bone. Of each bone the last line counts; all is measured once each
/// bone has one, anew whenever one changes, and as the attempt ends. A function of the tools'
/// states: a replay makes the same events. The plan and the case must outlive it.
class TunnelWatch {
 public:
  /// `case_spec` names the case: its knee, stretched out and whole, is grown before measuring.
  /// `pins`: of each hand whether it holds a pin.
  TunnelWatch(const ScenarioPlan& plan, const Case& the_case, std::string case_spec,
              std::vector<char> pins, double tick_s);
  void add(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
           std::vector<Event>& out);
  /// The attempt is over: what was not measured yet is.
  void finish(std::vector<Event>& out);
  /// What was measured.
  const AclReport& report() const { return report_; }
  /// Why tunnels could not be measured: their line misses what it must meet, for example.
  const std::optional<Error>& problem() const { return problem_; }

 private:
  static constexpr std::size_t kBones = 2;  ///< femur, tibia
  /// How a pin must be held, and what its line becomes.
  struct Wanted {
    bool asked = false;
    double force_n = 0.3, for_s = 1, depth_m = 0, reamed_m = 0.008;
  };
  struct Line {
    bool known = false;
    Vec3 from_B = Vec3::Zero(), to_B = Vec3::Zero();
  };
  /// A pin on a bone.
  struct Hold {
    std::size_t bone = kBones;
    std::uint64_t since = 0;
    Vec3 tip_B = Vec3::Zero();
    bool told = false;
  };
  void see_marks(const ToolState& tool, std::size_t hand, std::vector<Event>& out) const;
  void follow_pin(const ToolState& tool, std::size_t hand, const BoneSnapshot& bones,
                  std::vector<Event>& out);
  std::size_t pressed(const ToolState& tool, const BoneSnapshot& bones) const;
  void locate(const ToolState& tool, std::size_t hand, const Pose& X_BT, std::vector<Event>& out);
  bool all_located() const;
  void measure(const Event& at, std::vector<Event>& out);
  Result<AclReport> measured();
  DrilledLine stretched_out(std::size_t k) const;

  const Case* case_;
  std::string spec_;
  std::vector<char> pins_;
  double tick_s_;
  std::uint64_t stride_;
  std::vector<std::uint32_t> felt_;  ///< landmarks
  std::array<std::uint32_t, kBones> bones_{kNoSubject, kNoSubject};
  std::array<Wanted, kBones> wanted_;
  std::array<Line, kBones> lines_;
  std::vector<Hold> holds_;  ///< by hand
  std::uint64_t last_tick_ = 0;
  bool fresh_ = false;  ///< a line has changed since they were measured
  std::optional<CaseDef> whole_;
  AclReport report_;
  std::optional<Error> problem_;
};

}  // namespace osteon
