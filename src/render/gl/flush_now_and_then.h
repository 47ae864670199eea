#pragma once

#include "gl/gl_objects.h"

namespace osteon {

/// A processor that draws begins on what it has been given while it is given the rest.
class FlushNowAndThen {
 public:
  void after(int triangles) {
    constexpr int kAtOnce = 12'000;
    given_ += triangles;
    if (given_ < kAtOnce) return;
    glFlush();
    given_ = 0;
  }

 private:
  int given_ = 0;  ///< triangles since the last
};

}  // namespace osteon
