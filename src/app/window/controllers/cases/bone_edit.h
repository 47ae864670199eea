#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "osteon/mesh/mesh_edit.h"
#include "osteon/scene/case.h"
#include "osteon/scene/command.h"
#include "osteon/scene/state.h"

namespace osteon {

/// Stiffness of a haptic device's resistance to a drag: 1.5 N at 10 mm.
inline constexpr double kGrabStiffness_n_per_m = 150;
/// The probe's tip grabs the vertex nearest to it within this.
inline constexpr double kGrabReach_m = 0.003;

/// One bone's surface while it is edited in the window, by the mouse or by the probe. Knows neither
/// window nor picture. Points are in Bone, which may move in World meanwhile.
class BoneEdit {
 public:
  static Result<BoneEdit> begin(const Case& the_case, BoneId bone);

  BoneId bone() const { return bone_; }
  const MeshEdit& edit() const { return edit_; }
  const SoftSelection& selection() const { return selection_; }
  /// Takes effect at once on a drag under way.
  void set_selection(const SoftSelection& selection);

  /// By the mouse: grabs the vertex nearest to a point of the surface.
  void grab(const Vec3& p_B);
  void drag(const Vec3& displacement_B);
  /// Ends a drag, whoever began it.
  void release();
  bool by_mouse() const { return edit_.is_grabbed() && !by_probe_; }
  bool by_probe() const { return edit_.is_grabbed() && by_probe_; }

  /// By the probe: its first button grabs the vertex nearest to the tip, moves it while held, and
  /// lets go. Once a frame; returns what the haptic loop shall be told: the resistance begins or
  /// ends.
  std::optional<Command> follow(const ToolState& tool, const Pose& X_WB);

  void undo();
  void redo();
  /// What is wrong with the surface since the last change; "sound" if nothing is.
  const EditFindings& findings() const { return findings_; }
  void mark_saved() { edit_.mark_saved(); }
  /// Rises with every change of the surface: whoever draws it compares.
  std::uint64_t version() const { return version_; }
  /// Vertices that a grab at the point would move, with their weights.
  std::vector<SoftWeight> preview(const Vec3& p_B) const;

 private:
  BoneEdit(BoneId bone, MeshEdit edit);

  BoneId bone_;
  MeshEdit edit_;
  SurfaceWalk walk_;
  SoftSelection selection_;
  EditFindings findings_;
  bool by_probe_ = false;
  bool button_was_down_ = true;       ///< a button that is held when editing begins grabs nothing
  std::optional<Vec3> grabbed_at_W_;  ///< the hand, where the resistance began
  std::uint64_t version_ = 0;
};

/// Writes the case that `spec` names as a new folder, with another surface for one bone (in Bone).
Result<void> save_edited_case(const std::string& spec, const std::string& bone_name,
                              const TriMesh& mesh_B, const std::filesystem::path& out);

}  // namespace osteon
