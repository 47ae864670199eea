// Two wild hands with the instruments of soft parts in the built-in cases, at up to 1 m/s, through
// and across everything, powered, with jaws that open and shut: what is soft stays sound, and the
// recording replays. OSTEON_LONG=1: 10^6 steps of physics in each case, by two seeds.
#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "osteon/base/random.h"
#include "osteon/base/types.h"
#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

struct WildCase {
  const char* name;
  const char* soft;
  Vec3 middle_mm, half_mm;
  std::vector<const char*> instruments;
};

// From place to place about the joint; every second time it turns, every seventh it takes another.
void write_wild_path(const WildCase& with, std::uint64_t seed, double seconds,
                     const std::string& file) {
  Random random(seed);
  const auto pick = [&](std::size_t of) {
    return std::min(of - 1, static_cast<std::size_t>(random.uniform(0, static_cast<double>(of))));
  };
  std::ofstream out(file);
  out << "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button,instrument,size,power,jaw\n";
  Vec3 at = with.middle_mm + Vec3(0, 0, 60);
  Quat q = Quat::Identity();
  const char* instrument = with.instruments[pick(with.instruments.size())];
  for (double t = 0; t < seconds;) {
    out << t << ',' << at.x() << ',' << at.y() << ',' << at.z() << ',' << q.w() << ',' << q.x()
        << ',' << q.y() << ',' << q.z() << ",0," << instrument << ",0,"
        << std::max(0.0, random.uniform(-1, 1)) << ',' << pick(2) << '\n';
    const Vec3 before = at;
    for (int k = 0; k < 3; ++k)
      at[k] = with.middle_mm[k] + random.uniform(-with.half_mm[k], with.half_mm[k]);
    // Its mean speed from place to place is from 10 mm/s to 1 m/s.
    t += std::max(0.02, 0.001 * (at - before).norm() / std::pow(10, random.uniform(-2, 0)));
    if (random.uniform(0, 1) < 0.5)
      q = Quat(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), 0.1)
              .normalized();
    if (random.uniform(0, 1) < 0.15) instrument = with.instruments[pick(with.instruments.size())];
  }
}

constexpr double kHand_n_per_mm = 2;  // of a simulated hand, where it is not told

class WildHands : public CliTest {
 protected:
  void expect_sound(const WildCase& with, std::uint64_t seed) {
    const bool is_long = std::getenv("OSTEON_LONG") != nullptr;
    const double seconds = is_long ? 1000 : 8;
    for (const std::uint64_t hand : {0, 1})
      write_wild_path(with, 2 * seed + hand, seconds, file("hand" + std::to_string(hand)));
    const std::string recording = file("wild" + std::to_string(seed) + ".osr");
    const Ran ran =
        run_osteon(std::string("simulate --case ") + with.name + " --hand right=" + file("hand0") +
                   " --hand left=" + file("hand1") + " --soft " + with.soft +
                   " --max-force 20 --record " + recording + " --report " + file("wild.json"));
    ASSERT_EQ(ran.exit_code, 0) << ran.output.substr(0, 2000);
    std::ifstream in(file("wild.json"));
    const auto report = nlohmann::json::parse(in, nullptr, false);
    ASSERT_FALSE(report.is_discarded());
    EXPECT_EQ(report.dump().find("null"), std::string::npos) << "a number that is none";
    int touched = 0;
    for (const nlohmann::json& part : report["soft"]["parts"]) {
      SCOPED_TRACE(part.dump());
      EXPECT_FALSE(part["lost"]);
      touched += part["contact_s"] > 0 ? 1 : 0;
      // An instrument pushes a ligament or a solid with 20 N at most; several parts of it, and
      // jaws, may do so at once. Skin that nothing has pierced meets a hand no harder than its
      // coupling is, however deep it has gone.
      const bool is_skin = part["name"].get<std::string>().starts_with("skin");
      const double deepest_mm = is_skin ? part["deepest_mm"].get<double>() : 0;
      EXPECT_LT(part["peak_force_n"], is_skin ? kHand_n_per_mm * deepest_mm + 1 : 60);
    }
    EXPECT_GT(touched, is_long ? 5 : 1);
    const Ran again = run_osteon("replay " + recording);
    EXPECT_EQ(again.exit_code, 0) << again.output.substr(0, 2000);
    EXPECT_NE(again.output.find("identical"), std::string::npos);
  }
};

TEST_F(WildHands, LeaveTheSoftPartsOfAKneeSound) {
  const WildCase knee{
      "builtin:knee#hull",
      "ligaments,menisci,skin",
      {0, 0, 10},
      {45, 45, 45},
      {"hook_probe", "scalpel_11", "scalpel_15", "grasper", "basket_punch", "shaver", "rf_ablator",
       "suction", "clamp", "malleable_retractor", "trocar_blunt", "freer_elevator"}};
  for (const std::uint64_t seed : {1, 2}) expect_sound(knee, seed);
}

TEST_F(WildHands, LeaveTheSoftPartsOfAWristSound) {
  const WildCase wrist{"builtin:wrist#hull",
                       "ligaments,tfcc,skin",
                       {0, 0, 0},
                       {30, 25, 20},
                       {"wrist_hook_probe", "scalpel_11", "grasper", "basket_punch", "shaver",
                        "suction", "trocar_blunt"}};
  for (const std::uint64_t seed : {3, 4}) expect_sound(wrist, seed);
}

}  // namespace
}  // namespace osteon::testing_cli
