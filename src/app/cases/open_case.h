#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "osteon/anatomy/generate.h"
#include "osteon/base/result.h"
#include "osteon/scene/build_case.h"
#include "osteon/scene/case.h"

namespace osteon {

/// Description, variation table and table of findings of a built-in anatomy; fails on an
/// unknown name.
struct AnatomyFiles {
  std::filesystem::path description, table, findings;
};
Result<AnatomyFiles> builtin_anatomy(const std::string& name);

/// The bones, soft parts, landmarks and findings of a grown anatomy, with default materials.
CaseDef case_from(GeneratedAnatomy anatomy);

/// How much of a built-in case is grown.
enum class CaseParts : std::uint8_t {
  kAll,
  kFelt,  ///< the bones alone: for runs that nobody looks at
  kSeen,  ///< all, but each bone felt as its hull, which costs nothing: for pictures
};

/// Case by what a user names it: `builtin:wrist` and `builtin:knee` are grown from their
/// descriptions in the assets, `builtin:wrist:7` is the patient that seed 7 draws, anything else is
/// a case folder. A choice of what is felt may follow (felt_choice.h). `progress` is told the share
/// of the bones grown; it may throw to stop.
Result<CaseDef> open_case_def(const std::string& spec,
                              const std::function<void(double)>& progress = {},
                              CaseParts parts = CaseParts::kAll);
/// The same, built. The pieces of its bones are kept beside the case (pieces.bin), or in the user's
/// cache for a built-in case and where the folder cannot be written. `progress` is told what goes
/// on and the share done; it may throw to stop.
using OpenProgress = std::function<void(const char* what, double share)>;
Result<std::shared_ptr<const Case>> open_case(const std::string& spec,
                                              const OpenProgress& progress = {},
                                              CaseParts parts = CaseParts::kAll);
/// A case that need not wait for its pieces.
struct OpenedAtOnce {
  std::shared_ptr<const Case> the_case;
  std::string spec;   ///< names what is felt of it
  std::string finer;  ///< what open_case takes for the case as it was asked for; empty: this is it
};
/// The same, but a bone whose pieces or field no cache holds yet is felt as its hull, which takes
/// no time: its pieces lie within it, so who does not touch a hull touches no piece either.
Result<OpenedAtOnce> open_case_at_once(const std::string& spec, const OpenProgress& progress = {});

inline Result<std::shared_ptr<const Case>> open_felt_case(const std::string& spec) {
  return open_case(spec, {}, CaseParts::kFelt);
}

}  // namespace osteon
