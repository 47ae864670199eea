// A scene of `osteon tissue solve`: an error, or one whose numbers are sound.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "osteon/base/check.h"
#include "osteon/tissue/solve_scene.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto scene = osteon::parse_solve_scene({reinterpret_cast<const char*>(data), size}, "fuzz");
  if (!scene) return 0;
  osteon::demand(static_cast<bool>(osteon::check_material(scene->material)), "a bad material");
  osteon::demand(osteon::is_finite(scene->gravity_m_per_s2), "gravity is not finite");
  osteon::demand(scene->time_s > 0, "no time");
  for (const auto& box : scene->fixed) osteon::demand(!box.box_m.empty(), "an empty box");
  for (const auto& box : scene->loads)
    osteon::demand(osteon::is_finite(box.force_n) && box.over_s >= 0, "a bad load");
  return 0;
}
