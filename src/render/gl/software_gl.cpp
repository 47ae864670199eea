#include "osteon/render/software_gl.h"

#include <algorithm>
#include <array>

namespace osteon {

bool is_software_gl(std::string_view renderer) {
  constexpr std::array<std::string_view, 4> kNames = {"llvmpipe", "softpipe", "swrast", "SWR"};
  return std::any_of(kNames.begin(), kNames.end(), [&](std::string_view name) {
    return renderer.find(name) != std::string_view::npos;
  });
}

}  // namespace osteon
