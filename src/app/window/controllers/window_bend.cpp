#include <algorithm>
#include <cmath>
#include <utility>

#include "cases/felt_choice.h"
#include "ui/label.h"
#include "window/window_app.h"

namespace osteon {

bool WindowApp::can_bend() const {
  return live_ && !live_->recording() && !replay_ && !edit_ && !checkup_;
}

// What is felt stays where it was until the case is opened again: no force meanwhile.
void WindowApp::apply_bend(const BendWish& wish) {
  if (!case_ || wish.joint >= case_->joints.size() || !can_bend()) return;
  if (!bend_) {
    bend_had_force_ = live_->force_wanted();
    live_->set_force(false);
  }
  bend_ = wish;
  if (!wish.done) return;
  const CaseJoint& joint = case_->joints[wish.joint];
  if (std::abs(wish.degrees - joint.at_deg) < 1e-9) return end_bend();
  const auto spec = bent_spec(wanted_source(), joint.name, wish.degrees);
  if (spec) return open({*spec, {}, nullptr});
  note(ToastKind::kError, spec.error().message());
  end_bend();
}

// The pose was given up, or the case has been opened in it. A user's own "off" stays.
void WindowApp::end_bend() {
  if (!bend_) return;
  bend_.reset();
  if (!live_) return;
  if (!bend_had_force_) live_->set_force(false);
  // Off for another reason, it stays off.
  else if (live_->device_status().cause == ForceOff::kSoftware)
    live_->set_force(true);
}

void WindowApp::show_bend() {
  if (!bend_ || !case_ || bend_->joint >= case_->joints.size()) return;
  const BoneSnapshot bent = bent_snapshot(*case_, case_->joints[bend_->joint], bend_->degrees);
  for (const CaseJoint::Moved& moved : case_->joints[bend_->joint].bones)
    shown_.bones.bones[moved.bone.index] = bent.bones[moved.bone.index];
}

// What reaches over the joint is not drawn until it has been grown in the new pose.
void WindowApp::hide_while_bending(ViewState& view) const {
  if (!bend_) return;
  for (std::size_t i = 0; i < std::min(view.softs.size(), case_->softs.size()); ++i) {
    const std::string& kind = case_->softs[i].kind;
    if (kind != "cartilage" && kind != "meniscus") view.softs[i].visible = false;
  }
}

std::vector<JointModel> WindowApp::joint_models() const {
  std::vector<JointModel> models;
  for (std::size_t i = 0; i < case_->joints.size(); ++i) {
    const CaseJoint& joint = case_->joints[i];
    const bool bending = bend_ && bend_->joint == i;
    models.push_back({label_of(joint.name), bending ? bend_->degrees : joint.at_deg,
                      joint.min_deg(), joint.max_deg()});
  }
  return models;
}

}  // namespace osteon
