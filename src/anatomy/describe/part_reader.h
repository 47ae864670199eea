#pragma once

#include <string>
#include <vector>

#include "describe/shape.h"
#include "describe/toml_reader.h"

namespace osteon {

// Ranges that a description's lengths and angles keep to.
inline constexpr Range kPlace_mm{-2000, 2000};
inline constexpr Range kRadius_mm{0.1, 1000};
inline constexpr Range kBlend_mm{0, 100};
inline constexpr Range kCell_mm{0.1, 10};
inline constexpr Range kAngle_deg{-360, 360};

/// Reads one PART (docs/anatomy-description.md) from its table, but for the keys that only some
/// parts have; `blend` (metres) holds where the part says none. The caller finishes the reader.
Part read_part(TomlReader& in, Operation operation, double blend);

/// Reads the list of parts under `key` into a bone's solid; it must be there where parts are added.
/// Entries may be `like` others further up, and name a `section`.
Result<void> read_parts(TomlReader& in, const std::string& key, Operation operation, double blend,
                        Solid& solid);

}  // namespace osteon
