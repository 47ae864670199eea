#include "state/fields.h"

namespace osteon::stored {

template <class A>
void field(A& a, Contact& c) {
  field(a, c.bone);
  field(a, c.piece);
  field(a, c.p_W);
  field(a, c.nhat_BT_W);
  field(a, c.depth_m);
  field(a, c.force_on_tool_W);
}

template <class A>
void field(A& a, ToolContact& c) {
  field(a, c.hand);
  field(a, c.p_W);
  field(a, c.nhat_W);
  field(a, c.force_on_tool_W);
}

template <class A>
void field(A& a, ToolState& t) {
  field(a, t.tick);
  field(a, t.time_s);
  field(a, t.X_WD);
  field(a, t.X_WP);
  field(a, t.v_W);
  field(a, t.force_W);
  field(a, t.buttons);
  field(a, t.status);
  first_of(a, t.contact_count, t.contacts);
  first_of(a, t.tool_contact_count, t.tool_contacts);
  field(a, t.epoch);
  field(a, t.instrument);
  field(a, t.power);
  field(a, t.jaw);
  field(a, t.portal);
  if (t.portal == kNoPortal || !since(a, 31)) return;  // portals lay fixed then
  field(a, t.p_portal_W);
  number(a, t.portal_way, 2);
}

template <class A>
void field(A& a, OtherTool& t) {
  field(a, t.tick);
  field(a, t.instrument);
  field(a, t.p_WD);
  field(a, t.X_WP);
  field(a, t.v_W);
}

template <class A>
void field(A& a, PortalHold& p) {
  field(a, p.portal);
  field(a, p.anchor_m);
  field(a, p.sliding);
  field(a, p.grip);
  field(a, p.tip_depth_m);
  field(a, p.nearest);
}

template void field(Out&, ToolState&);
template void field(In&, ToolState&);
template void field(Out&, OtherTool&);
template void field(In&, OtherTool&);
template void field(Out&, PortalHold&);
template void field(In&, PortalHold&);

}  // namespace osteon::stored
