#include "acl_lines.h"

#include <cmath>

namespace osteon {
namespace {

constexpr double kPinRoom_m = 0.002;  // about its axis; a reamer with a cut-away side needs no more
constexpr double kSocket_m = 0.025, kChannel_m = 0.040;

Vec3 femoral_mouth(const AclKnee& knee, std::string_view fault) {
  const Vec3 mouth = knee.mark("acl_femur");
  const Vec3 back = knee.mark("blumensaat_posterior"), front = knee.mark("blumensaat_anterior");
  // Under the roof, beside the middle.
  if (fault == "vertical_femur")
    return back + 0.25 * (front - back) + knee.femoral(Vec3(0.0012, -0.0045, -0.0016));
  return mouth;
}

struct Choice {
  double worth = -1e9;
  AclLine line;
};

// Least bone behind a socket: at its mouth, and about its hind third where the mouth is closed.
double bone_behind(const AclKnee& knee, const AclLine& line, double radius) {
  const Vec3 along =
      (knee.mark("blumensaat_anterior") - knee.mark("blumensaat_posterior")).normalized();
  const Vec3& in = line.in_W;
  const Vec3 hind = (along.dot(in) * in - along).normalized(), side = in.cross(hind);
  const Vec3 up = knee.normal(true, line.at_W);
  double least = knee.way_out(true, line.at_W - 0.002 * up, -along) - radius;
  // So deep the slanted mouth is closed all round.
  const double straight = std::clamp(-up.dot(in), 0.2, 1.0);
  const double closed = radius * std::sqrt(1 - straight * straight) / straight + 0.001;
  const double first = std::min(closed, 0.5 * kSocket_m);
  for (int i = 0; i <= 5; ++i)
    for (int k = -2; k <= 2; ++k) {
      const double at = first + (kSocket_m - first) * i / 5, a = 30 * kAclTurn * k;
      const Vec3 out = std::cos(a) * hind + std::sin(a) * side;
      least = std::min(least, knee.way_out(true, line.at_W + at * in, out) - radius);
    }
  return least;
}

// How near a channel is to what is wanted, where a pin has room on its way to the mouth; bone
// behind it counts more, up to 3 mm of it; who does not look behind finds the least.
void weigh_socket(const AclKnee& knee, const AclLine& line, double radius, bool looks_behind,
                  Choice& best) {
  const Vec3 &mouth = line.at_W, &in = line.in_W;
  const double channel = knee.way_out(true, mouth + 0.001 * in, in) + 0.001;
  if (!(channel > kSocket_m + 0.002)) return;
  if (!knee.is_free(mouth - 0.008 * in, mouth - 0.09 * in, kPinRoom_m)) return;
  const double most = 1 / (1 + std::abs(channel - kChannel_m) / 0.01);
  if (most + 2 <= best.worth) return;
  const double behind = std::clamp(bone_behind(knee, line, radius) / 0.003, -1.0, 1.0);
  const double worth = most + (looks_behind ? 2 : -2) * behind;
  if (worth > best.worth) best = {worth, line};
}

// `out`: from the plateau to the front of the inner side.
void weigh_tunnel(const AclKnee& knee, const Vec3& mouth, const Vec3& out, double wanted_m,
                  Choice& best) {
  // Where the axis enters the bone on the plateau.
  Vec3 in = mouth - 0.02 * out;
  for (int i = 0; i < 400 && knee.tibia_m(in) > 0; ++i) in += 0.00025 * out;
  const double length = knee.way_out(false, in + 0.001 * out, out) + 0.001;
  if (!(length > 0.01 && length < 0.08)) return;
  const double worth = -std::abs(length - wanted_m);
  if (worth > best.worth) best = {worth, {in + length * out, -out}};
}

}  // namespace

Result<AclLine> tibial_line(const AclKnee& knee, std::string_view fault, const Vec3& miss_W) {
  Vec3 mouth = knee.mark("acl_tibia") + miss_W;
  if (fault == "anterior_tibia") mouth += 0.0075 * knee.tibial(Vec3(0, 0, 1));
  // A flat way is short, but a flatter one would be no tunnel but a groove; one to a place in front
  // must be steep to be long enough.
  const bool is_short = fault == "short_tibia";
  const int steepest = is_short ? 50 : fault == "anterior_tibia" ? 75 : 60;
  Choice best;
  for (int steep = 40; steep <= steepest; steep += 5)
    for (int inner = 20; inner <= 50; inner += 10) {
      const double s = steep * kAclTurn, i = inner * kAclTurn;
      const Vec3 out =
          knee.tibial(Vec3(std::sin(s), std::cos(s) * std::sin(i), std::cos(s) * std::cos(i)));
      weigh_tunnel(knee, mouth, out, is_short ? 0.026 : 0.045, best);
    }
  if (best.worth < -1e8) return fail("no line through the tibia was found", "the pin");
  return best.line;
}

Result<AclLine> femoral_line(const AclKnee& knee, std::string_view fault, const Vec3& miss_W,
                             double reamed_m) {
  const Vec3 aimed = femoral_mouth(knee, fault) + miss_W;
  const bool looks_behind = fault != "blow_out";
  Choice best;
  for (int out_deg = 20; out_deg <= 65; out_deg += 5)
    for (int up_deg = 0; up_deg <= 70; up_deg += 5) {
      const double o = out_deg * kAclTurn, u = up_deg * kAclTurn;
      const Vec3 in =
          knee.femoral(Vec3(-std::cos(o) * std::cos(u), -std::sin(o), std::cos(o) * std::sin(u)));
      // Onto the wall along the pin's own way.
      Vec3 at = aimed - 0.008 * in;
      for (int i = 0; i < 80 && knee.femur_m(at) > 0; ++i) at += 0.0002 * in;
      if (knee.femur_m(at) <= 0 && (at - aimed).norm() < 0.004)
        weigh_socket(knee, {at, in}, 0.5 * reamed_m, looks_behind, best);
    }
  if (best.worth < -1e8) return fail("no free way to the femoral footprint was found", "the pin");
  return best.line;
}

}  // namespace osteon
