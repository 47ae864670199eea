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

/// One tendon while it is harvested and folded.
struct TendonOnBench {
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
};

/// All that a step of the bench leaves to the next: of fixed size.
struct GraftBenchState {
  bool on = false;  ///< the case has a bench
  std::array<TendonOnBench, kGraftTendons> tendons{};
  std::array<BenchHand, kBenchHands> hands{};
  double passed_m = 0;   ///< smallest sizer that the graft went through; 0: none
  double refused_m = 0;  ///< largest sizer that did not go over it; 0: none
  double loop_m = 0;     ///< of the button that hangs on the graft; 0: none
  double tension_n = 0;  ///< that the board keeps on the graft
  double creep_s = 0;    ///< for how long, as if at kPretension_n
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
  std::array<Vec3, 3> posts_W{};              ///< at which a tendon is folded to 2, 3 and 4 strands
  Vec3 hook_W = Vec3::Zero();                 ///< where a loop is hung on the graft
  double channel_m = 0, socket_m = 0;         ///< of the femur that the graft is for, by the marks
  std::array<std::uint32_t, kLines> bones{};  ///< that each line runs in
  /// Of a line: its begin and its end.
  Vec3 begin_W(std::uint32_t line) const;
  Vec3 end_W(std::uint32_t line) const;
};

/// The bench of a case: bones `thigh`, `graft` and `board` with the landmarks of
/// docs/acl.md. None: it has none, or not all of that.
std::optional<GraftBenchPlan> find_graft_bench(const Case& the_case);

/// The tendon as it was harvested; nothing: it was not, or lies in the patient still.
std::optional<HarvestedTendon> harvested(const GraftBenchPlan& plan, const GraftBenchState& state,
                                         std::size_t tendon);
/// A place of the whipstitch of a tendon that lies on the table.
Vec3 stitch_W(const GraftBenchPlan& plan, std::size_t tendon, std::uint32_t place);
/// The fewest passes of thread through a tendon that is folded; 0 also where none is.
std::uint32_t fewest_passes(const GraftBenchState& state);
/// What has been made of the tendons; none: nothing is folded.
std::optional<Graft> graft_on(const GraftBenchPlan& plan, const GraftBenchState& state);

}  // namespace osteon
