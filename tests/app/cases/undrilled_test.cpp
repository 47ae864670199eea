#include "cases/undrilled.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(Undrilled, AKneeWithoutTunnelsIsTheSame) {
  for (const char* source : {"", "builtin:knee", "builtin:knee:3:left:acl_tear=midsubstance",
                             "/cases/old_tunnel=front", "x#femur=field"})
    EXPECT_EQ(source_before_drilling(source), source);
}

TEST(Undrilled, FindingsThatAreTunnelsGo) {
  EXPECT_EQ(source_before_drilling("builtin:knee:3:left:acl_tear=midsubstance:old_socket=steep:"
                                   "old_tunnel=front#flexion=120"),
            "builtin:knee:3:left:acl_tear=midsubstance#flexion=120");
  EXPECT_EQ(source_before_drilling("builtin:knee:3:acl_tunnels=anatomic:left"),
            "builtin:knee:3:left");
}

}  // namespace
}  // namespace osteon
