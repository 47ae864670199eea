#pragma once

#include <string>

#include "osteon/base/result.h"

namespace osteon {

/// The way on which a graft is drawn in: from outside through the tibia, across the joint, into the
/// femur's socket, and its thread out through the narrow channel; m and rad.
struct PassingWay {
  double tibia_m = 0.040;                      ///< length of the tibial tunnel
  double between_m = 0.030;                    ///< from mouth to mouth in the joint
  double channel_m = 0.040, socket_m = 0.026;  ///< of the femur, from its mouth
  double tibia_diameter_m = 0.008, socket_diameter_m = 0.008;
  double tibia_bend_rad = 0, femur_bend_rad = 0;  ///< how far the way turns at each mouth
};

/// What is drawn in. The loop hangs on the middle of a button of 12 mm.
struct DrawnGraft {
  double diameter_m = 0.008, length_m = 0.120, loop_m = 0.020;
  double tail_n = 10;  ///< with which a second hand holds the graft's tail
};

/// How it goes. `drawn` lengths: of the button's leading end, from the outer tibial mouth.
struct PassedGraft {
  double most_pull_n =
      0;  ///< of the hand at the thread until the button is out or the graft stands
  double most_pull_at_m = 0;  ///< drawn
  double last_pull_n = 0;     ///< at the end of the way
  double end_m = 0;           ///< drawn, where the button may turn or the graft can go no further
  bool turns = true;          ///< the button comes out as far as it needs to turn
  std::string why;            ///< it does not
};

/// Pull of the hand at the thread that moves the graft on, N, when the button's leading end is
/// `drawn_m` along the way: rod on a way of straight pieces with two edges, quasi-static.
///
/// Symbols: T tension from the tail on, in the order of the way; q drag of a wall for each metre of
/// tendon in it; mu friction at an edge; theta the turn there. In a tunnel T grows by q times the
/// tendon in it, at a mouth it is multiplied by exp(mu theta) (capstan, Euler and Eytelwein). mu is
/// 0.1 under tendon, 0.2 under thread and loop (E). q is 0.5 N/mm for a graft as thick as its
/// tunnel, 0 for one 1 mm thinner, and goes on in proportion to one 0.5 mm thicker (E). Bending
/// stiffness is left out.
double passing_pull_n(const PassingWay& way, const DrawnGraft& graft, double drawn_m);

/// The whole way. The button turns when it is out of the far cortex with its whole length: then the
/// graft's front stands 6 mm further than at last (scene/graft.h), or at the end of the socket.
/// Fails on values out of range.
Result<PassedGraft> pass_graft(const PassingWay& way, const DrawnGraft& graft);

}  // namespace osteon
