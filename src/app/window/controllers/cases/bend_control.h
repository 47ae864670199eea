#pragma once

#include <optional>
#include <vector>

#include "window/controllers/cases/case_control.h"
#include "window/ui_model.h"

namespace osteon {

/// A joint of the case is bent: shown at once, then the case is opened in that pose.
class BendControl {
 public:
  BendControl(WindowHost& host, ShownCase& scene, SceneSight& sight, LiveControl& live,
              CaseControl& cases)
      : host_(host), scene_(scene), sight_(sight), live_(live), cases_(cases) {}

  bool on() const { return bend_.has_value(); }
  void apply(const BendWish& wish);
  /// The pose was given up, or the case has been opened in it. A user's own "off" stays.
  void end();
  /// Moves the bones on show.
  void show();
  /// What reaches over the joint is not drawn until it has been grown in the new pose.
  void hide_softs(ViewState& view) const;
  std::vector<JointModel> model() const;

 private:
  WindowHost& host_;
  ShownCase& scene_;
  SceneSight& sight_;
  LiveControl& live_;
  CaseControl& cases_;
  std::optional<BendWish> bend_;  ///< shown, until the case is open in that pose
  bool had_force_ = true;         ///< before it began
};

}  // namespace osteon
