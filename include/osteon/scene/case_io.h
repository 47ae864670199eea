#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/scene/build_case.h"

namespace osteon {

/// A `case.toml` before its meshes are read.
struct CaseText {
  CaseDef def;                          ///< complete but for the meshes
  std::vector<std::string> mesh_files;  ///< of each bone: relative to the folder, never outside it
  std::vector<std::string> soft_files;  ///< likewise, of each soft part
  double metres_per_unit = 1;           ///< of the mesh files
};

/// Reads the text of a `case.toml`; `where` names it in errors, which add the line. Strict: an
/// unknown key, a missing one, a wrong type, a number that is not finite or out of range, and a
/// mesh file outside the case's folder are errors. See docs/file-formats.md.
Result<CaseText> parse_case_toml(std::string_view text, const std::string& where);

/// Reads a case folder: `case.toml` and the meshes that it names, with vertices of equal
/// coordinates joined.
Result<CaseDef> load_case(const std::filesystem::path& folder);

/// Writes a case folder: meshes first (binary STL, metres, single precision), `case.toml` last, so
/// that a folder with a `case.toml` is whole. Makes the folder; refuses one that holds anything.
/// What was loaded reads back with the same bits.
Result<void> save_case(const CaseDef& def, const std::filesystem::path& folder);

/// What a careful reader would want to know before using a case: open meshes, inverted triangles,
/// duplicate names, sizes that hint at a wrong unit, materials out of range, soft parts that run
/// through bone or are attached beside it. Empty when sound.
std::vector<std::string> check_case(const CaseDef& def);

}  // namespace osteon
