#pragma once

#include <filesystem>
#include <string>

#include "osteon/scene/build_case.h"
#include "osteon/scene/case_notes.h"

namespace osteon {

/// Notes on the case that `spec` names; a built-in one has none.
Result<CaseNotes> notes_of(const std::string& spec);
/// Fails when a note is on a bone that the case has not.
Result<void> check_notes(const CaseNotes& notes, const CaseDef& def);
/// Saves a case with its notes as a new folder, whole or not at all.
Result<void> save_noted_case(const CaseDef& def, const CaseNotes& notes,
                             const std::filesystem::path& out);
}  // namespace osteon
