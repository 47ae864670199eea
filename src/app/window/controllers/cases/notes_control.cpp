#include "window/controllers/cases/notes_control.h"

#include <system_error>
#include <utility>

#include "cases/felt_choice.h"
#include "cases/noted_case.h"
#include "cases/xdg.h"
#include "ui/label.h"

namespace osteon {

void NotesControl::begin_case() {
  placing_ = false;
  // The same case bent or felt otherwise: what was not saved stays.
  const std::string source = source_without_choice(scene_.source);
  if (std::exchange(source_, source) == source && changed_) return;
  notes_.clear();
  changed_ = false;
  editing_.reset();
  auto read = notes_of(scene_.wanted_source());
  if (!read) return host_.note(ToastKind::kWarning, "Notes: " + read.error().message());
  notes_ = std::move(*read);
}

// A built-in case has no folder, and one that was bent or is felt otherwise keeps its own notes.
bool NotesControl::saves_itself() const {
  std::error_code ec;
  return std::filesystem::is_directory(source_without_choice(scene_.source), ec);
}

bool NotesControl::poll_pointer(const SceneInput& input) {
  const bool pressed = input.left && !left_was_down_;
  left_was_down_ = input.left;
  if (std::exchange(swallows_, swallows_ && input.left)) return true;
  if (!placing_ || input.over_panels || live_.probe_held()) return false;
  const SceneSight::PicturePoint at = sight_.in_picture(input.x, input.y);
  if (!pressed || !at.inside) return false;
  swallows_ = true;
  const SurfacePoint under =
      scene_.renderer->pick_point(sight_.shown(), sight_.view(), sight_.viewport(), at.x, at.y);
  if (!under.bone.valid()) {
    host_.note(ToastKind::kInfo, "Click on a bone to place the note.");
    return true;
  }
  place(under);
  return true;
}

// Made where the bone is now, it goes with the bone.
void NotesControl::place(const SurfacePoint& at) {
  const Pose& X_WB = sight_.shown().bones.bones[at.bone.index].X_WB;
  const std::string& bone = scene_.the_case->bone(at.bone).name;
  placing_ = false;
  if (!moved_) {
    notes_.push_back({"Note " + std::to_string(notes_.size() + 1), bone, {}});
    editing_ = notes_.size() - 1;
  }
  CaseNote& note = notes_[moved_ ? *moved_ : notes_.size() - 1];
  note.bone = bone;
  note.p_F = X_WB.inverse() * at.p_W;
  moved_.reset();
  keep();
}

void NotesControl::take_text(const std::string& text) {
  const std::size_t i = *std::exchange(editing_, std::nullopt);
  if (i >= notes_.size() || text == notes_[i].text) return;
  CaseNote changed = notes_[i];
  changed.text = text;
  if (auto sound = check_note(changed, "note"); !sound)
    return host_.note(ToastKind::kWarning, sound.error().message());
  notes_[i] = std::move(changed);
  keep();
}

void NotesControl::keep() {
  changed_ = true;
  if (!saves_itself()) return;
  const auto saved = save_notes(notes_, source_without_choice(scene_.source));
  changed_ = !saved;
  if (!saved) host_.note(ToastKind::kError, saved.error().message());
}

void NotesControl::save_as_case() {
  if (save_) return;
  const auto out = dated_file(data_home_dir() / "cases", scene_.the_case->name + "-notes", "");
  save_ = std::make_unique<SideJob<std::filesystem::path>>(
      save_notes_as_case(scene_.wanted_source(), notes_, out));
}

void NotesControl::poll_save() {
  if (!save_ || !save_->done()) return;
  const Result<std::filesystem::path> saved = save_->take();
  save_.reset();
  if (!saved) return host_.note(ToastKind::kError, saved.error().message());
  changed_ = false;
  host_.note(ToastKind::kInfo, "Saved as " + saved->string());
  if (!cases_.loading()) cases_.open({saved->string(), {}, nullptr});
}

void NotesControl::apply(const NotesRequests& requests, bool may_edit) {
  if (requests.toggle_shown) shown_ = !shown_;
  if (requests.stop_placing || !may_edit) placing_ = false;
  if (!may_edit) return;
  if (requests.text && editing_) take_text(*requests.text);
  if (requests.edit && *requests.edit < notes_.size()) editing_ = requests.edit;
  if (requests.remove && *requests.remove < notes_.size()) {
    notes_.erase(notes_.begin() + static_cast<long>(*requests.remove));
    editing_.reset();
    moved_.reset();
    placing_ = false;
    keep();
  }
  const bool moves = requests.move && *requests.move < notes_.size();
  if (moves || (requests.add && notes_.size() < kMostNotes)) {
    placing_ = true;
    moved_ = moves ? requests.move : std::nullopt;
  }
  if (requests.save) save_as_case();
}

// None: its bone is hidden, or the case has it not.
std::optional<Vec3> NotesControl::place_W(const CaseNote& note) const {
  if (note.bone.empty()) return note.p_F;
  const BoneId bone = scene_.the_case->find(note.bone);
  if (!bone.valid() || bone.index >= sight_.shown().bones.count) return std::nullopt;
  const auto& looks = sight_.view().bones;
  if (bone.index < looks.size() && !looks[bone.index].visible) return std::nullopt;
  return sight_.shown().bones.bones[bone.index].X_WB * note.p_F;
}

NotesModel NotesControl::model(bool may_edit) const {
  NotesModel model;
  model.shown = shown_;
  model.can_edit = may_edit;
  model.editing = editing_;
  model.placing = placing_;
  model.saves_itself = saves_itself();
  model.changed = changed_;
  model.saving = save_ != nullptr;
  const SceneSight::Projector onto = sight_.projector();
  for (const CaseNote& note : notes_) {
    NoteRow row{note.text, note.bone.empty() ? std::string() : label_of(note.bone)};
    const auto p_W = place_W(note);
    const auto at = shown_ && p_W ? onto(*p_W) : std::nullopt;
    row.drawn = at.has_value();
    if (at) row.x = static_cast<float>(at->x());
    if (at) row.y = static_cast<float>(at->y());
    model.rows.push_back(std::move(row));
  }
  return model;
}

}  // namespace osteon
