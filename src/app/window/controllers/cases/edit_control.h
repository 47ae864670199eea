#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "window/controllers/cases/bone_edit.h"
#include "window/controllers/cases/case_control.h"
#include "window/edit_model.h"

namespace osteon {

/// The editing of a bone's surface in the picture: BoneEdit does it, this one has pointer, probe,
/// picture and the saving.
class EditControl {
 public:
  EditControl(WindowHost& host, ShownCase& scene, SceneSight& sight, LiveControl& live,
              CaseControl& cases)
      : host_(host), scene_(scene), sight_(sight), live_(live), cases_(cases) {}

  bool on() const { return edit_ != nullptr; }
  /// Of the picked bone.
  void begin();
  /// What was not saved is put back.
  void end();
  /// True while the pointer drags the bone, not the camera.
  bool poll_pointer(const SceneInput& input);
  void apply(const EditRequests& requests);
  void poll_save();
  /// Gives the renderer the surface as it is now.
  void show();
  /// The renderer has lost it.
  void draw_again() { drawn_ = kNotDrawn; }
  EditModel model() const;

 private:
  static constexpr std::uint64_t kNotDrawn = ~std::uint64_t{0};
  Pose pose() const;
  void drag(const SceneInput& input, const Pose& X_WB);
  std::vector<EditDot> dots() const;

  WindowHost& host_;
  ShownCase& scene_;
  SceneSight& sight_;
  LiveControl& live_;
  CaseControl& cases_;
  std::unique_ptr<BoneEdit> edit_;
  std::unique_ptr<SideJob<std::filesystem::path>> save_;  ///< while one runs
  std::uint64_t drawn_ = 0;                               ///< version that the renderer has
  std::optional<Vec3> hover_B_;                           ///< under the pointer
  Vec3 moved_C_ = Vec3::Zero();                           ///< by the mouse since the grab
  bool left_was_down_ = false;
};

}  // namespace osteon
