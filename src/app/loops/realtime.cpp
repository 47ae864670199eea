#include "loops/realtime.h"

namespace osteon {

RealtimeGrant describe_grant(bool priority, bool memory_locked) {
  RealtimeGrant grant{priority, memory_locked, {}};
  if (priority && memory_locked) return grant;
  grant.warning = "The system gave the haptic loop no ";
  if (!priority) grant.warning += "real-time priority";
  if (!priority && !memory_locked) grant.warning += " and no ";
  if (!memory_locked) grant.warning += "locked memory";
  grant.warning += "; ticks may come late when the computer is busy. ";
  grant.warning += "Allow rtprio and memlock for this user in /etc/security/limits.d.";
  return grant;
}

}  // namespace osteon
