#include "commands/cases/cmd_case_note.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "cases/case_bone.h"
#include "cases/noted_case.h"
#include "cases/open_case.h"

#include "commands/support/cli_support.h"
#include "commands/support/parser.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

struct CaseNoteCommand {
  std::string spec, text, bone, at, out;
  int remove = 0;
};

// On a bone without a place: on the bone's middle.
Result<CaseNote> note_of(const CaseNoteCommand& command, const CaseDef& def) {
  CaseNote note{command.text, command.bone, Vec3::Zero()};
  Vec3 p_W = Vec3::Zero();
  if (!command.at.empty()) {
    const auto at = point_from_mm(command.at, "--at");
    if (!at) return tl::unexpected(at.error());
    p_W = note.p_F = *at;
  }
  if (note.bone.empty()) return note;
  const auto bone = std::find_if(def.bones.begin(), def.bones.end(),
                                 [&](const BoneDef& b) { return b.name == note.bone; });
  if (bone == def.bones.end())
    return fail("there is no bone '" + note.bone + "'", "--on", "See: osteon case info");
  note.p_F = command.at.empty() ? bounds(bone->mesh).center() : Vec3(bone->X_WB.inverse() * p_W);
  return note;
}

Result<void> change_notes(const CaseNoteCommand& command, const CaseDef& def, CaseNotes& notes) {
  if (command.remove > 0) {
    const auto i = static_cast<std::size_t>(command.remove);
    if (i > notes.size())
      return fail("there is no note " + std::to_string(i), command.spec,
                  "It has " + std::to_string(notes.size()) + ". See: osteon case info");
    notes.erase(notes.begin() + command.remove - 1);
    return {};
  }
  auto note = note_of(command, def);
  if (!note) return tl::unexpected(note.error());
  if (auto sound = check_note(*note, "--text"); !sound) return sound;
  if (notes.size() >= kMostNotes)
    return fail("the case has " + std::to_string(notes.size()) + " notes, which is the limit",
                command.spec, "Remove one with --remove");
  notes.push_back(std::move(*note));
  return {};
}

int run_note(const CaseNoteCommand& command) {
  auto def = open_case_def(command.spec);
  if (!def) return report_error(def.error());
  auto notes = notes_of(command.spec);
  if (!notes) return report_error(notes.error());
  if (auto changed = change_notes(command, *def, *notes); !changed)
    return report_error(changed.error());
  // After the change, which may take away a note on a bone that is gone.
  if (auto known = check_notes(*notes, *def); !known) return report_error(known.error());
  const std::string to = command.out.empty() ? command.spec : command.out;
  const auto saved =
      command.out.empty() ? save_notes(*notes, to) : save_noted_case(*def, *notes, to);
  if (!saved) return report_error(saved.error());
  std::printf("%zu note%s -> %s\n", notes->size(), notes->size() == 1 ? "" : "s", to.c_str());
  return kExitDone;
}

void check_words(const CaseNoteCommand& command) {
  const bool removes = command.remove > 0;
  if (removes && !(command.text.empty() && command.bone.empty() && command.at.empty()))
    cli::refuse("--remove", "leave out --text, --on and --at");
  if (command.out.empty() && !std::filesystem::is_directory(command.spec))
    cli::refuse("--out", "only a case folder can be changed in place: name a new one");
  if (removes) return;
  if (command.text.empty()) cli::refuse("--text", "give the text of the note, or --remove");
  if (command.bone.empty() && command.at.empty())
    cli::refuse("--on", "name a bone, or give a position with --at, or both");
}

}  // namespace

void add_case_note(cli::App& group, int& exit_code) {
  cli::App* note =
      group.add_subcommand("note", "Add a note to a bone or a position of a case, or remove one");
  auto command = std::make_shared<CaseNoteCommand>();
  note->add_option("case", command->spec, "a case folder, builtin:wrist or builtin:knee")
      ->required();
  note->add_option("--text", command->text, "what the note says");
  note->add_option("--on", command->bone, "the bone that the note is attached to");
  note->add_option("--at", command->at,
                   "position of the note: x,y,z in mm, World; default: on the bone");
  note->add_option("--remove", command->remove, "remove the note with this number instead")
      ->check(cli::Range(1, static_cast<int>(kMostNotes)));
  note->add_option("--out", command->out,
                   "the case folder to make; default: change the case folder itself");
  note->callback([command, &exit_code] {
    check_words(*command);
    exit_code = run_note(*command);
  });
}

}  // namespace osteon
