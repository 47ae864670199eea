#pragma once

#include <fstream>
#include <string>

#include "run_osteon.h"

namespace osteon::testing_cli {

/// Imports a block about the origin, its top at z = `h` mm, as dir/case.
inline Ran make_block_case(const fs::path& dir, int h = 20) {
  fs::create_directories(dir / "meshes");
  std::ofstream block(dir / "meshes/block.obj");
  for (int i = 0; i < 8; ++i)
    block << "v " << (i & 1 ? h : -h) << ' ' << (i & 2 ? h : -h) << ' ' << (i & 4 ? h : -h) << '\n';
  block << "f 1 3 2\nf 2 3 4\nf 5 6 7\nf 6 8 7\nf 1 2 5\nf 2 6 5\nf 3 7 4\nf 4 7 8\n"
           "f 1 5 3\nf 3 5 7\nf 2 4 6\nf 4 8 6\n";
  block.close();
  return run_osteon("import mesh " + (dir / "meshes").string() + " --unit mm --out " +
                    (dir / "case").string());
}

}  // namespace osteon::testing_cli
