#pragma once

#include <initializer_list>
#include <string>
#include <utility>

#include "osteon/procedure/report.h"

namespace osteon::testing {

/// A case of bones with names and nothing else: all that a report reads.
inline Case named_case(std::initializer_list<const char*> names) {
  Case the_case;
  the_case.name = "wrist";
  the_case.hash = 0xabcdef;
  for (const char* name : names) {
    the_case.bones.emplace_back();
    the_case.bones.back().name = name;
  }
  return the_case;
}

/// Tick `n` with the proxy at `p_WP`.
inline ToolState tool_at(std::uint64_t n, const Vec3& p_WP) {
  ToolState tool;
  tool.tick = n;
  tool.time_s = static_cast<double>(n) * 0.001;
  tool.X_WP.p = p_WP;
  return tool;
}

inline void touch(ToolState& tool, std::uint32_t bone, const Vec3& force_W, double depth_m) {
  Contact& contact = tool.contacts[tool.contact_count++];
  contact.bone = BoneId{bone};
  contact.force_on_tool_W = force_W;
  contact.depth_m = depth_m;
}

/// A report whose numbers are all different.
inline Report sample_report() {
  Report report;
  report.case_name = "wrist";
  report.case_hash = 0x123;
  report.duration_s = 60.5;
  report.bones = {{"radius", 1.5, 3.25, 2.5, 1.25, 0.75},
                  {"lunate", 4.0, 1.0, 5.0, 2.0, 0.5},
                  {"hamate", -1, 0, 0, 0, 0}};
  report.path_length_mm = 812.5;
  report.smoothness_sparc = -7.5;
  report.tick_p50_us = 9.5;
  report.tick_p99_us = 20.5;
  report.tick_p999_us = 31.5;
  report.tick_max_us = 55.5;
  report.ticks = 60500;
  report.missed_ticks = 3;
  report.state_hash = 0xfedcba9876543210ull;
  report.realtime_factor = 41.5;
  return report;
}

}  // namespace osteon::testing
