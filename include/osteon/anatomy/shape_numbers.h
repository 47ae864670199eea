#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "osteon/base/result.h"

namespace osteon {

/// How many numbers shape a bone, or one named section of it: every number that a description
/// writes in the bone's `blend_mm`, `add`, `cut` and `clear`, zeros too. A long bone's parts may
/// name a `section`; what holds for the whole bone (`blend_mm`, `clear`) counts in each. What says
/// where the bone lies, how finely it is grown and what it weighs does not shape it.
struct ShapeNumbers {
  std::string bone;
  std::string section;  ///< empty: parts that name none
  std::size_t numbers = 0;
};

/// What no bone nor section of the built-in anatomies has more of.
inline constexpr std::size_t kMostShapeNumbers = 60;

/// Of every bone of a description (assets/anatomy/*.toml), sections in the order of their first
/// parts. Fails as the description's reader does.
Result<std::vector<ShapeNumbers>> shape_numbers(const std::filesystem::path& description);

}  // namespace osteon
