#pragma once

#include "osteon/scene/build_case.h"

namespace osteon {

/// The soft parts of a case, their bones found among `bones`. Fails with the soft part's name when
/// one has no name, no triangles or an unknown kind, when names repeat, when a number is not finite
/// or a bone is not there.
Result<std::vector<SoftPart>> build_softs(std::vector<SoftDef> defs,
                                          const std::vector<Bone>& bones);

/// The places where `def` should be mended, for check_case: open meshes, unknown bones, parts that
/// reach into a bone by more than kDeepestSoft_m, attachments off their bones.
std::vector<std::string> check_softs(const CaseDef& def);

/// Of a soft part in bone, metres: bands hold on in bone by less.
inline constexpr double kDeepestSoft_m = 0.0006;
/// Between an attachment and its bone's surface, metres.
inline constexpr double kFarthestAttachment_m = 0.001;

}  // namespace osteon
