#include "window/controllers/cases/bend_control.h"

#include <algorithm>
#include <cmath>

#include "cases/felt_choice.h"
#include "ui/label.h"

namespace osteon {

// What is felt stays where it was until the case is opened again: no force meanwhile.
void BendControl::apply(const BendWish& wish) {
  LiveRun* const run = live_.run();
  if (!run || !scene_.the_case || wish.joint >= scene_.the_case->joints.size()) return;
  if (!bend_) {
    had_force_ = run->force_wanted();
    run->set_force(false);
  }
  bend_ = wish;
  if (!wish.done) return;
  const CaseJoint& joint = scene_.the_case->joints[wish.joint];
  if (std::abs(wish.degrees - joint.at_deg) < 1e-9) return end();
  const auto spec = bent_spec(scene_.wanted_source(), joint.name, wish.degrees);
  if (spec) return cases_.open({*spec, {}, nullptr});
  host_.note(ToastKind::kError, spec.error().message());
  end();
}

void BendControl::end() {
  if (!bend_) return;
  bend_.reset();
  LiveRun* const run = live_.run();
  if (!run) return;
  if (!had_force_) run->set_force(false);
  // Off for another reason, it stays off.
  else if (run->device_status().cause == ForceOff::kSoftware)
    run->set_force(true);
}

void BendControl::show() {
  if (!bend_ || !scene_.the_case || bend_->joint >= scene_.the_case->joints.size()) return;
  const CaseJoint& joint = scene_.the_case->joints[bend_->joint];
  const BoneSnapshot bent = bent_snapshot(*scene_.the_case, joint, bend_->degrees);
  for (const CaseJoint::Moved& moved : joint.bones)
    sight_.shown().bones.bones[moved.bone.index] = bent.bones[moved.bone.index];
}

void BendControl::hide_softs(ViewState& view) const {
  if (!bend_) return;
  const auto& softs = scene_.the_case->softs;
  for (std::size_t i = 0; i < std::min(view.softs.size(), softs.size()); ++i)
    if (softs[i].kind != "cartilage" && softs[i].kind != "meniscus") view.softs[i].visible = false;
}

std::vector<JointModel> BendControl::model() const {
  std::vector<JointModel> models;
  for (std::size_t i = 0; i < scene_.the_case->joints.size(); ++i) {
    const CaseJoint& joint = scene_.the_case->joints[i];
    const bool bending = bend_ && bend_->joint == i;
    models.push_back({label_of(joint.name), bending ? bend_->degrees : joint.at_deg,
                      joint.min_deg(), joint.max_deg()});
  }
  return models;
}

}  // namespace osteon
