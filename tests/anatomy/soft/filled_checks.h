#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mesh/surface_checks.h"
#include "mesh/tet_checks.h"
#include "osteon/anatomy/generate.h"
#include "osteon/mesh/tetrahedra.h"

namespace osteon::checks {

/// Fills a soft part with tetrahedra, with no options, and expects what a simulation needs: no
/// inverted element, no angle below 15 degrees, the surface's volume within 1 %.
inline void expect_filled(const GeneratedSoft& soft) {
  SCOPED_TRACE(soft.name);
  const auto made = make_tetrahedra(soft.mesh_W);
  ASSERT_TRUE(made) << made.error().message();
  const auto [least, most] = dihedral_range_deg(made->mesh);
  double volume_m3 = 0;
  for (const Tetrahedron& t : made->mesh.tets) volume_m3 += determinant(made->mesh, t) / 6;
  const double off = volume_m3 / signed_volume(soft.mesh_W) - 1;
  std::printf("%-26s cell %5.2f mm, %7zu tetrahedra, %.1f to %.1f degrees, volume %+.2f %%\n",
              soft.name.c_str(), made->report.cell_m * 1e3, made->mesh.tets.size(), least, most,
              100 * off);
  EXPECT_TRUE(all_upright(made->mesh));
  EXPECT_GE(least, 15);
  EXPECT_LE(most, 165);
  EXPECT_LE(std::abs(off), 0.01);
  for (const std::string& warning : made->report.warnings) std::printf("  %s\n", warning.c_str());
}

}  // namespace osteon::checks
