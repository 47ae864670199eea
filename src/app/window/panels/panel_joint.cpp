#include <cmath>

#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

// A finer step would open the case again for what nobody sees.
constexpr double kBendStep_deg = 1;

void draw_joint(const PanelContext& c, std::size_t i) {
  const JointModel& joint = c.model.joints[i];
  double degrees = joint.degrees;
  const bool moved =
      ui::slider(joint.label.c_str(), &degrees, joint.min_deg, joint.max_deg, "%.0f\xc2\xb0",
                 "Bends the joint: bones at once, soft parts when you release it. The force is off "
                 "while you bend it.");
  const bool let_go = ImGui::IsItemDeactivatedAfterEdit();
  if (!moved && !let_go) return;
  degrees = std::round(degrees / kBendStep_deg) * kBendStep_deg;
  c.requests.bend = BendWish{i, degrees, let_go};
}

}  // namespace

void draw_joint_section(const PanelContext& c) {
  if (c.model.joints.empty() || !ui::section(c.fonts, "Joint")) return;
  ImGui::BeginDisabled(!c.model.can_bend);
  for (std::size_t i = 0; i < c.model.joints.size(); ++i) draw_joint(c, i);
  ImGui::EndDisabled();
}

}  // namespace osteon
