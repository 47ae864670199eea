#include "window/controllers/cases/bone_edit.h"

#include <algorithm>
#include <utility>

#include "cases/noted_case.h"
#include "cases/open_case.h"
#include "osteon/mesh/repair.h"

namespace osteon {

BoneEdit::BoneEdit(BoneId bone, MeshEdit edit)
    : bone_(bone), edit_(std::move(edit)), walk_(edit_.mesh()) {}

Result<BoneEdit> BoneEdit::begin(const Case& the_case, BoneId bone) {
  if (bone.index >= the_case.bones.size())
    return fail("no bone is chosen", {}, "Click on a bone first");
  TriMesh mesh = the_case.bone(bone).mesh;
  // A vertex that is there twice would tear the surface open when one of the two is moved.
  weld_vertices(mesh, 0);
  auto edit = MeshEdit::begin(std::move(mesh));
  if (!edit) return tl::unexpected(edit.error());
  return BoneEdit(bone, std::move(*edit));
}

void BoneEdit::set_selection(const SoftSelection& selection) {
  selection_ = selection;
  if (edit_.is_grabbed() && edit_.select(selection)) ++version_;
}

void BoneEdit::grab(const Vec3& p_B) {
  by_probe_ = false;
  (void)edit_.grab(edit_.nearest_vertex(p_B), selection_);
}

void BoneEdit::drag(const Vec3& displacement_B) {
  if (!edit_.is_grabbed()) return;
  edit_.drag(displacement_B);
  ++version_;
}

void BoneEdit::release() {
  if (!edit_.is_grabbed()) return;
  findings_ = edit_.commit();
  by_probe_ = false;
  grabbed_at_W_.reset();
  ++version_;
}

std::optional<Command> BoneEdit::follow(const ToolState& tool, const Pose& X_WB) {
  const bool down = (tool.buttons & 1u) != 0;
  const bool pressed = down && !button_was_down_;
  button_was_down_ = down;
  if (pressed && !edit_.is_grabbed()) {
    const Vec3 tip_B = X_WB.inverse() * tool.X_WP.p;
    const std::uint32_t vertex = edit_.nearest_vertex(tip_B);
    if ((edit_.mesh().vertices[vertex] - tip_B).norm() > kGrabReach_m) return std::nullopt;
    if (!edit_.grab(vertex, selection_)) return std::nullopt;
    by_probe_ = true;
    grabbed_at_W_.reset();
    return Command{CommandKind::kGrab, kGrabStiffness_n_per_m};
  }
  if (!by_probe()) return std::nullopt;
  if (!down) {
    release();
    return Command{CommandKind::kGrab, 0};
  }
  // The haptic loop measures from where it took the command: so does the drag.
  if ((tool.status & kTickGrabbing) == 0) return std::nullopt;
  if (!grabbed_at_W_) grabbed_at_W_ = tool.X_WD.p;
  drag(X_WB.q.conjugate() * (tool.X_WD.p - *grabbed_at_W_));
  return std::nullopt;
}

void BoneEdit::undo() {
  if (!edit_.undo()) return;
  findings_ = edit_.check();
  ++version_;
}

void BoneEdit::redo() {
  if (!edit_.redo()) return;
  findings_ = edit_.check();
  ++version_;
}

std::vector<SoftWeight> BoneEdit::preview(const Vec3& p_B) const {
  return walk_.select(edit_.mesh(), edit_.nearest_vertex(p_B), selection_);
}

Result<void> save_edited_case(const std::string& spec, const std::string& bone_name,
                              const TriMesh& mesh_B, const std::filesystem::path& out) {
  auto def = open_case_def(spec);
  if (!def) return tl::unexpected(def.error());
  const auto bone = std::find_if(def->bones.begin(), def->bones.end(),
                                 [&](const BoneDef& b) { return b.name == bone_name; });
  if (bone == def->bones.end())
    return fail("has no bone '" + bone_name + "'", spec, "Open the case again");
  bone->mesh = mesh_B;
  const auto notes = notes_of(spec);
  if (!notes) return tl::unexpected(notes.error());
  return save_noted_case(*def, *notes, out);
}

}  // namespace osteon
