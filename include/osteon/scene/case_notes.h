#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"

namespace osteon {

/// What an instructor wrote beside a case: nothing of it is felt.
struct CaseNote {
  std::string text;         ///< UTF-8, one line
  std::string bone;         ///< that it is on and moves with; empty: none
  Vec3 p_F = Vec3::Zero();  ///< in the frame of that bone, else in World; m

  bool operator==(const CaseNote&) const = default;
};
using CaseNotes = std::vector<CaseNote>;

/// The most notes of a case, and the most bytes of one.
inline constexpr std::size_t kMostNotes = 200;
inline constexpr std::size_t kLongestNote = 500;

/// Fails when a note says nothing, is too long, holds control characters or is no UTF-8, or when
/// its place is not finite or farther than 2 m from the frame's origin. `where` names it in the
/// error.
Result<void> check_note(const CaseNote& note, const std::string& where);

/// Reads the text of a `notes.toml`; `where` names it in errors, which add the line. As strict as
/// parse_case_toml.
Result<CaseNotes> parse_notes(std::string_view text, const std::string& where);
std::string notes_text(const CaseNotes& notes);

/// `notes.toml` of a case folder; no notes where there is none.
Result<CaseNotes> load_notes(const std::filesystem::path& folder);
/// Replaces it in one step; without notes no file is left.
Result<void> save_notes(const CaseNotes& notes, const std::filesystem::path& folder);

}  // namespace osteon
