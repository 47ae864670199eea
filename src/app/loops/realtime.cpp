#include "loops/realtime.h"

#include <string>

namespace osteon {

RealtimeGrant describe_grant(bool priority, bool memory_locked) {
  RealtimeGrant grant{priority, memory_locked, {}};
  if (priority && memory_locked) return grant;
  std::string missing;
  if (!priority) missing = "no real-time priority";
  if (!priority && !memory_locked) missing += " and ";
  if (!memory_locked) missing += "no locked memory";
  grant.warning = "The haptic loop has " + missing +
                  ". Ticks may come late when the computer is busy. "
                  "Allow rtprio and memlock for this user in /etc/security/limits.d.";
  return grant;
}

}  // namespace osteon
