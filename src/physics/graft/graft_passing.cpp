#include "osteon/physics/graft_passing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "osteon/scene/graft.h"

namespace osteon {
namespace {

constexpr double kTendonFriction = 0.1, kThreadFriction = 0.2;
constexpr double kSnugDrag_n_per_m = 500, kPlay_m = 0.001, kMostSqueeze_m = 0.0005;

struct PassingRange {
  const char* name;
  double value, least, most, unit;
};

Result<void> check_passing(const PassingWay& w, const DrawnGraft& g) {
  const double turn_deg = 57.29577951308232, most_turn = 3.141592653589794;
  const PassingRange ranges[] = {
      {"tibial tunnel, mm", w.tibia_m, 0.001, 0.150, 1e3},
      {"between the mouths, mm", w.between_m, 0.001, 0.150, 1e3},
      {"channel, mm", w.channel_m, 0.001, 0.150, 1e3},
      {"socket, mm", w.socket_m, 0.001, 0.150, 1e3},
      {"tibial tunnel's diameter, mm", w.tibia_diameter_m, 0.001, 0.020, 1e3},
      {"socket's diameter, mm", w.socket_diameter_m, 0.001, 0.020, 1e3},
      {"turn at the tibial mouth, degrees", w.tibia_bend_rad, 0, most_turn, turn_deg},
      {"turn at the femoral mouth, degrees", w.femur_bend_rad, 0, most_turn, turn_deg},
      {"diameter, mm", g.diameter_m, 0.001, 0.020, 1e3},
      {"length, mm", g.length_m, 0.005, 0.300, 1e3},
      {"loop, mm", g.loop_m, 0.005, 0.060, 1e3},
      {"hold on the tail, N", g.tail_n, 0, 200, 1}};
  for (const PassingRange& range : ranges)
    if (!(range.value >= range.least && range.value <= range.most))
      return fail(std::to_string(range.unit * range.value) + " is outside of " +
                      std::to_string(range.unit * range.least) + " to " +
                      std::to_string(range.unit * range.most),
                  std::string("passing the graft: ") + range.name);
  const double room = std::min(w.tibia_diameter_m, w.socket_diameter_m) + kMostSqueeze_m;
  if (g.diameter_m > room + 1e-9)
    return fail("the graft is more than 0.5 mm thicker than a tunnel", "passing the graft",
                "Drill wider tunnels, or make a thinner graft");
  return {};
}

double drag_n_per_m(double graft_m, double tunnel_m) {
  return kSnugDrag_n_per_m * std::max(0.0, 1 + (graft_m - tunnel_m) / kPlay_m);
}

// Stations along the way, from the outer tibial mouth.
struct PassingStations {
  double knee, femur, socket, cortex;
};
PassingStations stations_of(const PassingWay& w) {
  const double femur = w.tibia_m + w.between_m;
  // A drill that went through leaves no shoulder: the socket ends where the channel does.
  return {w.tibia_m, femur, femur + std::min(w.socket_m, w.channel_m), femur + w.channel_m};
}

double tendon_front_m(const DrawnGraft& g, double drawn_m) {
  return drawn_m - kFlipRoom_m - g.loop_m;
}

double overlap_m(double a0, double a1, double b0, double b1) {
  return std::max(0.0, std::min(a1, b1) - std::max(a0, b0));
}

}  // namespace

double passing_pull_n(const PassingWay& way, const DrawnGraft& graft, double drawn_m) {
  const PassingStations at = stations_of(way);
  const double front = tendon_front_m(graft, drawn_m), tail = front - graft.length_m;
  const auto edge = [&](double station, double turn) {
    const bool tendon = tail <= station && station <= front;
    return std::exp((tendon ? kTendonFriction : kThreadFriction) * turn);
  };
  double t = graft.tail_n;
  t += drag_n_per_m(graft.diameter_m, way.tibia_diameter_m) * overlap_m(tail, front, 0, at.knee);
  t *= edge(at.knee, way.tibia_bend_rad);
  t *= edge(at.femur, way.femur_bend_rad);
  t += drag_n_per_m(graft.diameter_m, way.socket_diameter_m) *
       overlap_m(tail, front, at.femur, at.socket);
  return t;
}

Result<PassedGraft> pass_graft(const PassingWay& way, const DrawnGraft& graft) {
  if (auto ok = check_passing(way, graft); !ok) return tl::unexpected(ok.error());
  const PassingStations at = stations_of(way);
  const double out = at.cortex + 2 * kFlipRoom_m;
  const double stands = at.socket + graft.loop_m + kFlipRoom_m;
  PassedGraft passed;
  passed.turns = out <= stands + 1e-9;
  passed.end_m = std::min(out, stands);
  if (!passed.turns) {
    char missing[32];
    std::snprintf(missing, sizeof missing, "%.1f mm", 1e3 * (out - stands));
    passed.why = std::string("the graft stops at the socket's end before the button is out: ") +
                 missing + " are missing";
  }
  passed.last_pull_n = passing_pull_n(way, graft, passed.end_m);
  // The pull is linear in the way between places where an end of the tendon passes a station, and
  // may jump there: so its largest value lies beside one of them.
  constexpr double kBeside_m = 1e-9;
  const auto look = [&](double drawn) {
    if (!(drawn >= 0 && drawn <= passed.end_m)) return;
    const double pull = passing_pull_n(way, graft, drawn);
    if (!(pull > passed.most_pull_n)) return;
    passed.most_pull_n = pull;
    passed.most_pull_at_m = drawn;
  };
  look(0);
  look(passed.end_m);
  for (const double station : {0.0, at.knee, at.femur, at.socket})
    for (const double end : {0.0, graft.length_m})
      for (const double beside : {-kBeside_m, 0.0, kBeside_m})
        look(station + end + graft.loop_m + kFlipRoom_m + beside);
  return passed;
}

}  // namespace osteon
