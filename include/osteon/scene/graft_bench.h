#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/scene/graft.h"

namespace osteon {

struct Case;

/// Hands that a bench knows; as many as a session has.
inline constexpr std::size_t kBenchHands = 4;

/// Fascia over a bench's tendons is opened a millimetre at a time: so many of them, and all open.
inline constexpr std::uint32_t kFasciaCells = 36;
inline constexpr std::uint64_t kFasciaOpen = (std::uint64_t{1} << kFasciaCells) - 1;
/// What lies beside and under it, and a blade can hurt: bits of GraftBenchState::hurt.
inline constexpr std::uint32_t kMclHurt = 1, kNerveHurt = 2;

/// One tendon while it is harvested and folded.
struct TendonOnBench {
  bool found = true;            ///< lifted out from under the fascia, or no fascia covers it
  std::uint32_t bands_cut = 0;  ///< bit b: band b
  double front_m = 0;           ///< stripped so far, from the insertion
  bool stripped = false;        ///< to its end
  bool amputated = false;       ///< at the band that the stripper was pushed through
  std::uint32_t folds = 0;      ///< strands that it was folded to; 0: it lies open
  double scraped_m = 0;         ///< over its muscle, all strokes together
  std::uint32_t stitches = 0;   ///< bit k: thread goes through it at the place k from its free end
  /// What of its muscle is left, 0 to 1.
  double muscle_left() const;
  std::uint32_t passes() const;  ///< of thread
};

/// What a hand is doing at the bench.
struct BenchHand {
  std::uint32_t instrument = 0xffffffffu;  ///< that it held at the last step
  std::uint32_t line = 0;                  ///< that leads it: 1 + GraftBenchPlan::Line; 0: none
  double grip = 0;                         ///< how much of the hold there is yet
  double front_m = 0;                      ///< on the line of the graft: how far the sizer came
  std::uint32_t carries = 0;               ///< 1 + tendon whose end is in its jaws; 0: none
  bool shut = true;                        ///< its jaws were
  std::uint32_t over = 0;                  ///< 1 + band over which its blade is drawn; 0: none
  Vec3 from_W = Vec3::Zero();              ///< where the blade came on; was last, scraping
  std::uint32_t scrapes = 0;               ///< 1 + tendon whose muscle its blade is on; 0: none
  std::uint32_t hangs = 0;                 ///< steps for which a loop has been held on the graft
  std::uint32_t slits = 0;                 ///< 1: its blade is on the fascia; 2: on the nerve
  std::uint32_t lifts = 0;                 ///< 1 + tendon in its jaws in the thigh; 0: none
};

/// All that a step of the bench leaves to the next: of fixed size.
struct GraftBenchState {
  bool on = false;  ///< the case has a bench
  std::array<TendonOnBench, kGraftTendons> tendons{};
  std::array<BenchHand, kBenchHands> hands{};
  /// Bit k: the fascia is open at k to k + 1 parts of its line; also where none covers the tendons.
  std::uint64_t slit = kFasciaOpen;
  std::uint32_t hurt = 0;  ///< kMclHurt, kNerveHurt
  double passed_m = 0;     ///< smallest sizer that the graft went through; 0: none
  double refused_m = 0;    ///< largest sizer that did not go over it; 0: none
  double loop_m = 0;       ///< of the button that hangs on the graft; 0: none
  double tension_n = 0;    ///< that the board keeps on the graft
  double creep_s = 0;      ///< for how long, as if at kPretension_n
};

/// Where things lie on a bench, World, bones at rest.
struct GraftBenchPlan {
  /// What leads an instrument that is pushed along it.
  enum Line : std::uint32_t { kSemitendinosus, kGracilis, kGraft, kBoard, kLines };
  struct Tendon {
    Vec3 insertion_W = Vec3::Zero(), along_W = Vec3::UnitX();  ///< to its muscle
    TendonMeasures measures;
    Vec3 free_W = Vec3::Zero();   ///< its free end over the table, once stripped
    Vec3 lies_W = Vec3::UnitX();  ///< unit, from there along it
    std::vector<Vec3> bands_W{};  ///< where a blade meets them
  };
  std::array<Tendon, kGraftTendons> tendons;
  Vec3 graft_from_W = Vec3::Zero(), graft_to_W = Vec3::UnitX();  ///< along which a sizer goes
  Vec3 board_from_W = Vec3::Zero(), board_to_W = Vec3::UnitX();  ///< of the tensioner's slide
  std::array<Vec3, 3> posts_W{};       ///< at which a tendon is folded to 2, 3 and 4 strands
  Vec3 hook_W = Vec3::Zero();          ///< where a loop is hung on the graft
  double channel_m = 0, socket_m = 0;  ///< of the femur that the graft is for, by the marks
  /// On the thigh's surface, along which the fascia is opened; the same place: there is none.
  Vec3 fascia_from_W = Vec3::Zero(), fascia_to_W = Vec3::Zero();
  std::array<std::uint32_t, kLines> bones{};  ///< that each line runs in
  /// Of a line: its begin and its end.
  Vec3 begin_W(std::uint32_t line) const;
  Vec3 end_W(std::uint32_t line) const;
  bool is_covered() const { return fascia_from_W != fascia_to_W; }  ///< by fascia
  double fascia_m() const { return (fascia_to_W - fascia_from_W).norm(); }
  /// Unit, of a covered bench: along the fascia's line, to the gracilis across it, out of the
  /// thigh.
  Vec3 fascia_along_W() const;
  Vec3 fascia_across_W() const;
  Vec3 fascia_up_W() const;
};

/// The bench of a case: bones `thigh`, `graft` and `board` with the landmarks of
/// docs/acl.md. None: it has none, or not all of that. Fascia is there where both its marks are.
std::optional<GraftBenchPlan> find_graft_bench(const Case& the_case);

/// The tendon as it was harvested; nothing: it was not, or lies in the patient still.
std::optional<HarvestedTendon> harvested(const GraftBenchPlan& plan, const GraftBenchState& state,
                                         std::size_t tendon);
/// A bench on which nothing has been done: fascia covers the tendons of a plan that has one.
GraftBenchState fresh_bench(const GraftBenchPlan& plan);
/// The longest stretch over which a bench's fascia is open; none to open: 0.
double fascia_open_m(const GraftBenchPlan& plan, const GraftBenchState& state);
/// Where a clamp takes a tendon in the fascia's slit, on the thigh's surface over the tendon.
Vec3 found_at_W(const GraftBenchPlan& plan, std::size_t tendon);
/// A place of the whipstitch of a tendon that lies on the table.
Vec3 stitch_W(const GraftBenchPlan& plan, std::size_t tendon, std::uint32_t place);
/// The fewest passes of thread through a tendon that is folded; 0 also where none is.
std::uint32_t fewest_passes(const GraftBenchState& state);
/// What has been made of the tendons; none: nothing is folded.
std::optional<Graft> graft_on(const GraftBenchPlan& plan, const GraftBenchState& state);

}  // namespace osteon
