#pragma once

#include <map>
#include <string>
#include <vector>

#include "osteon/surgeon/way_surgeon.h"

namespace osteon {

// A way that is being planned.
struct WayDraft {
  const Skill& skill;
  WayTool tool;
  std::map<std::string, double> fault;  // numbers of the rule that is broken on purpose
  std::vector<WayLeg> legs;

  static constexpr double kInsideShare = 0.3;  // of the speed outside
  static constexpr double kTooHard_n = 6.5, kBeyond_m = 0.02;
  double inside() const { return kInsideShare * skill.travel_m_per_s; }
  bool breaks(const char* rule) const { return skill.fault == rule; }
  void go(const Vec3& to_W, double m_per_s, bool place = false) {
    WayLeg leg;
    leg.to_W = to_W;
    leg.m_per_s = m_per_s;
    leg.place = place;
    legs.push_back(leg);
  }
  // Leans on what is there, and comes back.
  void press_hard(const Vec3& from_W, const Vec3& to_W) {
    go(from_W, inside());
    go(from_W + (to_W - from_W).normalized() * kBeyond_m, skill.approach_m_per_s);
    legs.back().press_n = kTooHard_n;
    legs.back().wait_s = 0.3;
    legs.back().leans = true;
    go(from_W, inside());
    legs.back().leans = true;
  }
};

inline Vec3 raised(const Vec3& p_W, double z_m) { return {p_W.x(), p_W.y(), p_W.z() + z_m}; }

}  // namespace osteon
