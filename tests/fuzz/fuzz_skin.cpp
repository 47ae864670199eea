// Strokes over a sheet of skin: whatever the blade does, its surface stays a manifold of the same
// area, and the scene of a file is an error or sound.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

#include "osteon/base/check.h"
#include "osteon/tissue/skin_scene.h"

namespace {

// Two bytes: a place on the sheet and a little beyond it.
osteon::SheetPoint place(const std::uint8_t* data) {
  return {0.034 * (data[0] / 255.0 - 0.5), 0.034 * (data[1] / 255.0 - 0.5)};
}

void check(const osteon::SkinSheet& sheet, const osteon::SheetCuts& cuts) {
  const osteon::SplitSheet open = osteon::split(sheet, cuts);
  const osteon::TriMesh mesh = osteon::sheet_surface(open, {}, {});
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> ways;
  for (const osteon::Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      osteon::demand(++ways[{t[k], t[(k + 1) % 3]}] == 1, "two triangles along one edge");
  osteon::demand(std::abs(osteon::sheet_area(open) - 0.03 * 0.03) < 1e-12, "another area");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  (void)osteon::parse_skin_scene({reinterpret_cast<const char*>(data), size}, "fuzz");
  static const auto sheet = osteon::SkinSheet::make(0.03, 0.03, 0.002, {});
  osteon::SheetCuts cuts = osteon::whole_sheet(*sheet);
  for (std::size_t i = 0; i + 3 <= size; i += 3) {
    const osteon::SheetPoint p = place(data + i + 1);
    const double depth = 1e-4 * (data[i] >> 2);
    if (data[i] % 4 == 0) osteon::begin_stroke(*sheet, cuts, p);
    if (data[i] % 4 == 3)
      osteon::end_stroke(*sheet, cuts, p, depth);
    else
      osteon::go_on(*sheet, cuts, p, depth);
  }
  check(*sheet, cuts);
  return 0;
}
