#include "acl_lines.h"

#include <cmath>

namespace osteon {
namespace {

constexpr double kPinRoom_m = 0.002;  // about its axis; a reamer with a cut-away side needs no more
// About the axis of a drill, beyond its radius: what it needs, and what it may lack at worst.
constexpr double kDrillRoom_m = 0.0001, kTight_m = -0.0004;
constexpr double kPinBites = 0.67;  // cosine to the face that it enters: 48 degrees
constexpr double kSocket_m = 0.025, kChannel_m = 0.040;
constexpr double kSoftRoom_m = 0.0007, kWorthSoft = 12;
constexpr double kWall_m = 0.0015;  // of bone behind a socket is enough
constexpr double kMostBehind_m = 0.01;
// A socket stands so far from the footprint's middle at most; farther where it would be open
// behind.
constexpr double kMostOff_m = 0.0036, kFarthestOff_m = 0.0048;
constexpr double kOpenWall_m = 0.0003;

bool is_steep(std::string_view fault) {
  return fault == "vertical_femur" || fault == "misplaced_socket" ||
         fault == "sound_socket_drilled";
}
bool is_in_front(std::string_view fault) {
  return fault == "anterior_tibia" || fault == "misplaced_tunnel" ||
         fault == "sound_tunnel_drilled";
}

Vec3 femoral_mouth(const AclKnee& knee, std::string_view fault) {
  const Vec3 mouth = knee.mark("acl_femur");
  const Vec3 back = knee.mark("blumensaat_posterior"), front = knee.mark("blumensaat_anterior");
  // Under the roof, beside the middle.
  if (is_steep(fault))
    return back + 0.25 * (front - back) + knee.femoral(Vec3(0.0012, -0.0045, -0.0016));
  return mouth;
}

struct Choice {
  double worth = -1e9;
  double given = 0;  // what is said for a line before it is looked at
  AclLine line;
};

// Least bone behind a socket: behind its mouth to the border of the condyle, which is not that of
// the notch's wall, and over its hind third from where the slanted mouth is closed all round.
double bone_behind(const AclKnee& knee, const AclLine& line, double radius) {
  constexpr double kIntoCondyle_m = 0.006, kDeepestMouth_m = 0.0125;
  const Vec3 along =
      (knee.mark("blumensaat_anterior") - knee.mark("blumensaat_posterior")).normalized();
  const Vec3& in = line.in_W;
  const Vec3 hind = (along.dot(in) * in - along).normalized(), side = in.cross(hind);
  const Vec3 inside = line.at_W - kIntoCondyle_m * knee.femoral(Vec3::UnitY());
  double least = std::min(kMostBehind_m, knee.way_out(true, inside, -along) - radius);
  const double straight = std::clamp(-knee.normal(true, line.at_W).dot(in), 0.2, 1.0);
  const double closed = radius * std::sqrt(1 - straight * straight) / straight + 0.001;
  const double first = std::min(closed, kDeepestMouth_m);
  for (int i = 0; i <= 5; ++i)
    for (int k = -3; k <= 3; ++k) {
      const double at = first + (kSocket_m - first) * i / 5, a = 20 * kAclTurn * k;
      const Vec3 out = std::cos(a) * hind + std::sin(a) * side;
      least = std::min(least, knee.way_out(true, line.at_W + at * in, out) - radius);
    }
  return least;
}

// What a line is worth beside the tunnel of an earlier reconstruction, 0 where there is none; below
// 0: it is not to be drilled. Enough bone is left between both; who errs opens the old one instead,
// but beyond his mouth.
double beside_old(const AclKnee& knee, bool of_femur, const AclLine& line, double length_m,
                  double radius_m, std::string_view fault) {
  constexpr double kBridge_m = 0.0016, kOpens_m = -0.001, kDeepest_m = -0.0035, kWorthPerM = 1000;
  const bool heedless = fault == "sound_socket_drilled" || fault == "sound_tunnel_drilled";
  if (!knee.has_old(of_femur) || heedless) return 0;
  const double gap = knee.to_old_m(of_femur, line.at_W, line.at_W + length_m * line.in_W, radius_m);
  if (fault != (of_femur ? "into_old_socket" : "into_old_tunnel"))
    return gap < kBridge_m ? -1 : kWorthPerM * std::min(gap, 0.002);
  return gap > kOpens_m || gap < kDeepest_m ? -1 : 0;
}

// The least room about the way of what comes along a line, up to what is enough.
double room_before(const AclKnee& knee, const AclLine& line, double enough_m) {
  constexpr double kFrom_m = 0.013, kTo_m = 0.09, kStride_m = 0.001;
  double room = enough_m;
  for (double before = kFrom_m; before < kTo_m && room > kPinRoom_m;) {
    const double gap = knee.gap_m(line.at_W - before * line.in_W);
    room = std::min(room, gap);
    before += std::max(kStride_m, gap - room);
  }
  return room;
}

// The same about what is soft and spared: drills cut it, and it holds an aimer up.
double soft_room_before(const AclKnee& knee, const AclLine& line, double enough_m) {
  constexpr double kFrom_m = 0.005, kTo_m = 0.06, kStride_m = 0.001;
  double room = enough_m;
  for (double before = kFrom_m; before < kTo_m && room > 0;) {
    const double gap = knee.soft_m(line.at_W - before * line.in_W);
    room = std::min(room, gap);
    before += std::max(kStride_m, gap - room);
  }
  return room;
}

double share_between(double value, double none, double all) {
  return std::clamp((value - none) / (all - none), 0.0, 1.0);
}

// What is wanted of a socket, in this order: soft parts that are spared, room for the drill on its
// way, bone behind it, a channel in which loop and button have their place, a mouth that is not too
// slanted. Who does not look behind finds the least bone there.
void weigh_socket(const AclKnee& knee, const AclLine& line, double radius, std::string_view fault,
                  double worth_soft, Choice& best) {
  constexpr double kFlattest = 0.3, kSteep = 0.55, kShort_m = 0.027, kLong_m = 0.031;
  const Vec3 &mouth = line.at_W, &in = line.in_W;
  const double straight = -knee.normal(true, mouth).dot(in);
  if (straight < kFlattest) return;
  const double channel = knee.way_out(true, mouth + 0.001 * in, in) + 0.001;
  if (!(channel > kSocket_m + 0.002)) return;
  const double to_old = beside_old(knee, true, line, channel, radius, fault);
  if (to_old < 0) return;
  double worth = best.given + to_old + 4 * share_between(channel, kShort_m, kLong_m) +
                 0.3 / (1 + std::abs(channel - kChannel_m) / 0.01) +
                 2 * share_between(straight, kFlattest, kSteep);
  if (worth + 8 + worth_soft <= best.worth) return;
  const double room = room_before(knee, line, radius + kDrillRoom_m);
  if (room <= kPinRoom_m) return;
  worth += 5 * share_between(room, radius + kTight_m, radius + kDrillRoom_m);
  if (worth + 3 + worth_soft <= best.worth) return;
  if (worth_soft > 0)
    worth += worth_soft * share_between(soft_room_before(knee, line, radius + kSoftRoom_m), 0,
                                        radius + kSoftRoom_m);
  if (worth + 3 <= best.worth) return;
  const double behind = std::clamp(bone_behind(knee, line, radius) / kWall_m, -1.0, 1.0);
  worth += (fault != "blow_out" ? 3 : -3) * behind;
  if (worth > best.worth) best = {worth, best.given, line};
}

// Mouths about the footprint and directions from each, coarse first and finer about the best.
class SocketSearch {
 public:
  SocketSearch(const AclKnee& knee, const Vec3& aimed_W, double most_off_m, double radius_m,
               std::string_view fault, bool spares_softs)
      : knee_(knee),
        aimed_W_(aimed_W),
        most_off_m_(most_off_m),
        radius_m_(radius_m),
        fault_(fault),
        worth_soft_(spares_softs ? kWorthSoft : 0) {
    forward_W_ =
        (knee.mark("blumensaat_anterior") - knee.mark("blumensaat_posterior")).normalized();
    down_W_ = forward_W_.cross(knee.normal(true, aimed_W)).normalized();
    if (down_W_.dot(knee.femoral(Vec3::UnitX())) < 0) down_W_ = -down_W_;
  }

  Choice best() const {
    constexpr double kStep_m = 0.001;
    Found found;
    for (int f = 0; f <= 5; ++f)
      for (int d = -2; d <= 4; ++d)
        if (const double forward = kStep_m * f, down = kStep_m * d; is_near(forward, down))
          for (int out = 10; out <= 65; out += 5)
            for (int up = 0; up <= 70; up += 5) weigh({forward, down, out * 1.0, up * 1.0}, found);
    const Place about = found.place;
    for (int f = -1; f <= 1; ++f)
      for (int d = -1; d <= 1; ++d)
        for (int out = -2; out <= 2; ++out)
          for (int up = -2; up <= 2; ++up)
            weigh({about.forward_m + 0.5 * kStep_m * f, about.down_m + 0.5 * kStep_m * d,
                   about.out_deg + 1.5 * out, about.up_deg + 1.5 * up},
                  found);
    return found.choice;
  }

 private:
  struct Place {
    double forward_m = 0, down_m = 0;  // of the mouth, from the footprint
    double out_deg = 0, up_deg = 0;    // of the way in
  };
  struct Found {
    Choice choice;
    Place place;
  };

  bool is_near(double forward_m, double down_m) const {
    return std::hypot(forward_m, down_m) <= most_off_m_;
  }

  void weigh(const Place& at, Found& found) const {
    constexpr double kWorthPerM = 250;
    if (!is_near(at.forward_m, at.down_m)) return;
    const double o = at.out_deg * kAclTurn, u = at.up_deg * kAclTurn;
    const Vec3 in =
        knee_.femoral(Vec3(-std::cos(o) * std::cos(u), -std::sin(o), std::cos(o) * std::sin(u)));
    const Vec3 mouth = knee_.on_femur(aimed_W_ + at.forward_m * forward_W_ + at.down_m * down_W_);
    const double before = found.choice.worth;
    found.choice.given = -kWorthPerM * std::hypot(at.forward_m, at.down_m);
    weigh_socket(knee_, {mouth, in}, radius_m_, fault_, worth_soft_, found.choice);
    if (found.choice.worth > before) found.place = at;
  }

  const AclKnee& knee_;
  Vec3 aimed_W_, forward_W_, down_W_;
  double most_off_m_, radius_m_;
  std::string_view fault_;
  double worth_soft_;
};

// How a tibial tunnel is to be.
struct TunnelWish {
  double length_m = 0.045, radius_m = 0.004;
  std::string_view fault;
  double least_square = -1;  ///< least cosine between the way out and the bone's face there
};

// `out`: from the plateau to the front of the inner side.
void weigh_tunnel(const AclKnee& knee, const Vec3& mouth, const Vec3& out, const TunnelWish& wish,
                  Choice& best) {
  // Where the axis enters the bone on the plateau.
  Vec3 in = mouth - 0.02 * out;
  for (int i = 0; i < 400 && knee.tibia_m(in) > 0; ++i) in += 0.00025 * out;
  const double length = knee.way_out(false, in + 0.001 * out, out) + 0.001;
  if (!(length > 0.01 && length < 0.08)) return;
  const AclLine inwards{in, out};
  const double to_old = beside_old(knee, false, inwards, length, wish.radius_m, wish.fault);
  if (to_old < 0 || knee.normal(false, in + length * out).dot(out) < wish.least_square) return;
  const double worth = best.given + to_old - std::abs(length - wish.length_m);
  if (worth > best.worth) best = {worth, best.given, {in + length * out, -out}};
}

// Where a tibial tunnel is looked for: angles of its way out, in degrees, and how far its mouth may
// stand behind or before its place, in mm.
struct TunnelRange {
  int flattest, steepest;
  int least_inner, most_inner;
  int beside;
};

Choice best_tunnel(const AclKnee& knee, const Vec3& mouth, const TunnelWish& wish,
                   const TunnelRange& range) {
  Choice best;
  for (int steep = range.flattest; steep <= range.steepest; steep += 5)
    for (int inner = range.least_inner; inner <= range.most_inner; inner += 10) {
      const double s = steep * kAclTurn, i = inner * kAclTurn;
      const Vec3 out =
          knee.tibial(Vec3(std::sin(s), std::cos(s) * std::sin(i), std::cos(s) * std::cos(i)));
      for (int mm = -range.beside; mm <= range.beside; ++mm) {
        best.given = -0.0005 * std::abs(mm);
        weigh_tunnel(knee, mouth + 0.001 * mm * knee.tibial(Vec3::UnitZ()), out, wish, best);
      }
    }
  return best;
}

}  // namespace

Result<AclLine> tibial_line(const AclKnee& knee, std::string_view fault, const Vec3& miss_W,
                            double reamed_m) {
  Vec3 mouth = knee.mark("acl_tibia") + miss_W;
  if (is_in_front(fault)) mouth += 0.0075 * knee.tibial(Vec3(0, 0, 1));
  // A flat way is short, but a flatter one would be no tunnel but a groove; one to a place in front
  // must be steep to be long enough.
  const bool is_short = fault == "short_tibia";
  const int flattest = is_short ? 50 : 40;
  const bool is_steep_too = is_in_front(fault) || fault == "into_old_tunnel";
  const int steepest = is_short ? 55 : is_steep_too ? 75 : 60;
  const TunnelWish wish{is_short ? 0.026 : 0.045, 0.5 * reamed_m, fault};
  // Beside an old tunnel the mouth may stand a little behind or before the footprint's middle.
  const bool is_beside = knee.has_old(false) && !is_in_front(fault);
  Choice best = best_tunnel(knee, mouth, wish, {flattest, steepest, 20, 50, is_beside ? 3 : 0});
  // Where the old one leaves no room there, farther aside or steeper, but not so steep that a pin
  // would slide off the tibia's front.
  TunnelWish aside = wish;
  aside.least_square = kPinBites;
  if (best.worth < -1e8 && is_beside)
    best = best_tunnel(knee, mouth, aside, {flattest, 75, 0, 70, 5});
  if (best.worth < -1e8 && !miss_W.isZero())
    return tibial_line(knee, fault, Vec3::Zero(), reamed_m);
  if (best.worth < -1e8) return fail("no line through the tibia was found", "the pin");
  return best.line;
}

Result<AclLine> femoral_line(const AclKnee& knee, std::string_view fault, const Vec3& miss_W,
                             double reamed_m) {
  const Vec3 aimed = femoral_mouth(knee, fault) + miss_W;
  const bool looks_behind = fault != "blow_out";
  // Who misses does not know how far, and stays there.
  const bool chooses = looks_behind && !is_steep(fault) && miss_W.isZero();
  const double radius = 0.5 * reamed_m;
  const auto best_line = [&](bool spares_softs) {
    const auto within = [&](double most_off_m) {
      return SocketSearch(knee, aimed, most_off_m, radius, fault, spares_softs).best();
    };
    Choice best = within(chooses ? kMostOff_m : 0);
    const bool found = best.worth > -1e8;
    if (chooses && (!found || bone_behind(knee, best.line, radius) < kOpenWall_m))
      if (const Choice farther = within(kFarthestOff_m); farther.worth > best.worth) best = farther;
    return best;
  };
  Choice best = best_line(false);
  // Another one where the drill would meet a meniscus or the other cruciate ligament on its way.
  const bool meets = best.worth > -1e8 && knee.spares_softs() &&
                     soft_room_before(knee, best.line, radius) < radius;
  if (meets) best = best_line(true);
  // Where his place is no place at all, he too sees it.
  if (best.worth < -1e8 && !miss_W.isZero())
    return femoral_line(knee, fault, Vec3::Zero(), reamed_m);
  if (best.worth < -1e8) return fail("no free way to the femoral footprint was found", "the pin");
  return best.line;
}

}  // namespace osteon
