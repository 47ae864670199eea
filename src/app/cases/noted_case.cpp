#include "cases/noted_case.h"

#include <algorithm>
#include <system_error>

#include "cases/felt_choice.h"
#include "cases/whole_folder.h"
#include "osteon/scene/case_io.h"

namespace osteon {
namespace {

bool is_on_a_bone_of(const CaseNote& note, const CaseDef& def) {
  return note.bone.empty() || std::any_of(def.bones.begin(), def.bones.end(),
                                          [&](const BoneDef& b) { return b.name == note.bone; });
}

}  // namespace

Result<CaseNotes> notes_of(const std::string& spec) {
  const std::filesystem::path folder = source_without_choice(spec);
  std::error_code ec;
  if (!std::filesystem::is_directory(folder, ec)) return CaseNotes();
  return load_notes(folder);
}

Result<void> check_notes(const CaseNotes& notes, const CaseDef& def) {
  for (std::size_t i = 0; i < notes.size(); ++i)
    if (!is_on_a_bone_of(notes[i], def))
      return fail("there is no bone '" + notes[i].bone + "'", "note " + std::to_string(i + 1),
                  "See: osteon case info");
  return {};
}

Result<void> save_noted_case(const CaseDef& def, const CaseNotes& notes,
                             const std::filesystem::path& out) {
  const std::filesystem::path folder = plain_folder(out);
  if (auto free = refuse_existing(folder); !free) return free;
  return write_whole_folder(folder, [&](const std::filesystem::path& part) -> Result<void> {
    if (auto saved = save_case(def, part); !saved) return saved;
    return save_notes(notes, part);
  });
}

}  // namespace osteon
