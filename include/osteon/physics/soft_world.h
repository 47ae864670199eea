#pragma once

#include <memory>
#include <span>
#include <vector>

#include "osteon/physics/joint_water.h"
#include "osteon/physics/skin_bare.h"
#include "osteon/physics/soft_setup.h"
#include "osteon/physics/soft_state.h"
#include "osteon/scene/event.h"
#include "osteon/scene/soft_pushes.h"
#include "osteon/scene/soft_told.h"
#include "osteon/scene/state.h"
#include "osteon/scene/tool.h"

namespace osteon {

/// How a band was pulled in the last step.
struct BandReadout {
  double tension_n = 0;                     ///< by bones and hands together
  std::array<double, kMaxHands> force_n{};  ///< of each hand on it
};

class CarvedField;
class FallenPieces;
class PieceSoftGround;
class RestingSofts;
class PieceShape;
class SkinWorld;
struct FallenPiece;
class SoftGrips;
class SolidCutting;
class SolidPresses;
struct GripNews;
struct GripPull;
struct SolidHand;

/// How a solid was pressed in the last step.
struct SolidReadout {
  std::array<double, kMaxHands> force_n{};  ///< of each hand on it
  std::array<double, kMaxHands> deep_m{};
};

/// How a patch of skin was pressed in the last step, and what has been done to it so far.
struct SkinReadout {
  std::array<double, kMaxHands> force_n{};  ///< of each hand on it
  std::array<double, kMaxHands> deep_m{};
  double cut_m = 0;           ///< length that is open
  std::uint32_t holes = 0;    ///< that trocars have made
  std::uint32_t portals = 0;  ///< that have been made in it
  double open_m = 0;          ///< so far its lips stand apart where a tool holds them
};

/// The soft parts of a session at the physics' rate: it follows from which side each tool has come
/// to each band, how long the bands' paths are, and what tears. The hands' ticks are told which
/// bands are near (BandContacts) and find the force by themselves, so that it has no steps of 2 ms.
///
/// A step locks and logs nothing, and allocates only while solids are cut. What the bands do to the
/// bones is not known: bones that move on springs are not drawn back by them.
class SoftWorld {
 public:
  /// `tray`: the instruments by ToolState::instrument. `coupling_n_per_m`: the hands' stiffness.
  /// `limit_n`: a force on a band above it is an event. `first_made`: place of the first portal
  /// that can be made in skin, in the session's list.
  SoftWorld(std::shared_ptr<const SoftSetup> setup,
            std::span<const std::shared_ptr<const Tool>> tray, double coupling_n_per_m,
            double limit_n, double step_s, std::uint32_t first_made = 0);
  ~SoftWorld();

  /// `bones`: as this step has left them. `carved`: of each bone; null where it is as it was.
  void step(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
            std::span<const CarvedField* const> carved = {});

  const SoftSetup& setup() const { return *setup_; }
  const SoftState& state() const { return state_; }  ///< but what was cut
  SoftState save() const;                            ///< all of it
  double removed_m3(std::size_t solid) const;        ///< by cuts; looks at all of them
  std::uint32_t pieces(std::size_t solid) const;     ///< that came off
  /// Those that lie loose, hands hold, or suction: kMaxLooseSofts at most.
  std::span<const FallenPiece> lying() const;
  /// Of a stump, how much of what is to be cleared is gone; 0 of other solids.
  double cleared_percent(std::size_t solid) const;
  double all_cleared_percent() const;  ///< of all stumps together; -1: there are none
  SoftTold told() const;               ///< after the last step
  /// What the hand's ticks are to know of the last step.
  BandContacts contacts(std::size_t hand) const;
  const BandReadout& readout(std::size_t band) const { return readouts_[band]; }
  const SolidReadout& solid_readout(std::size_t solid) const { return solid_readouts_[solid]; }
  SkinReadout skin_readout(std::size_t patch) const;
  /// What loose pieces of bone meet of it, with the bones there; null: they meet nothing. Until it
  /// is asked for again.
  const PieceSoftGround* ground(const BoneSnapshot& bones) const;
  bool ground_parts() const;   ///< in the last step some of it was cut off or has torn
  bool ground_is_cut() const;  ///< or was cut by an instrument
  /// No patch of skin is felt from when on each has a portal; those are open to every shaft.
  void bare_skin(SkinBare bares);
  /// No tool is near it: nothing is done for it.
  bool is_asleep(std::size_t solid) const;
  /// What presses the solids now, and what has bent the bands in the last step: their shape follows
  /// from it.
  SoftPushes pushes() const;
  /// What was cut, torn or wounded in the last step, and bleeds. A blade or what removes tissue
  /// under power wounds what it presses with its working end, the faster the harder; of a meniscus
  /// its outer rim alone has vessels.
  std::span<const SoftOpening> openings() const { return openings_; }
  /// Of the last step.
  std::span<const Event> events() const { return events_; }
  std::uint64_t hash() const;
  bool fits(const SoftState& state) const;
  void restore(const SoftState& state, std::uint32_t epoch);
  /// To a restore point: what was torn since is whole, and no tool is near, wherever hands are.
  void go_back(const SoftState& state, std::uint32_t epoch);

 private:
  struct Hand {
    const ToolState* tool = nullptr;
    std::size_t index = 0;
    std::array<double, kMaxBands> force_n{}, deep_m{};
    std::array<Vec3, kMaxBands> p_W{};
    std::array<bool, kMaxBands> cuts{};    ///< a blade presses it hard enough
    std::array<Vec3, kMaxBands> edge_W{};  ///< towards that blade, unit
    bool works = false;                    ///< with an edge, or under power
    std::uint64_t lifted = 0;              ///< parts of the tool that are out of the way
    std::array<double, kMaxSolids> pull_n{}, pull_m{};  ///< of its jaws on the solids
    double leg_n = 0;  ///< tension of a band that its jaws hold, at most
  };
  bool is_felt(std::size_t band) const;
  bool is_blade(std::uint32_t instrument, std::size_t part) const;
  bool is_working_end(std::uint32_t instrument, std::size_t part) const;
  bool clears_now(const Hand& hand, const BandContact& contact) const;
  void wound(std::size_t band, const Vec3& p_W, double area_m2);
  void wound_ends(std::size_t band, double share);
  void wound_solids(const Hand& hand, const BoneSnapshot& bones);
  bool cut(std::size_t band, std::span<const Hand> hands);
  void tear_when_overloaded(std::size_t band, const Hand& by, double force_n);
  void lose_strand(std::size_t band, int strand, const Hand& by, bool by_edge);
  double share_of(std::size_t band, const Vec3& p_W) const;
  void step_solids(std::span<const Hand> hands, const BoneSnapshot& bones);
  void tell_solid_touches(const SolidHand& solid_hand, const Hand& hand, std::uint64_t step);
  void cut_solids(std::span<const SolidHand> hands, const BoneSnapshot& bones);
  void hook_solids(std::size_t hand, const SolidHand& with, const BoneSnapshot& bones);
  bool lies_on_something(const SolidNear& near, const BoneSnapshot& bones) const;
  void bite_bands(Hand& hand);
  void lay_down(std::uint32_t solid, std::shared_ptr<const PieceShape> shape,
                std::span<const SolidHand> hands);
  void step_pieces(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                   std::span<const CarvedField* const> carved);
  void tell_pieces();
  void stir_pieces(std::span<const ToolState* const> tools, const BoneSnapshot& bones);
  void restore_pieces(const SoftState& state, bool let_go);
  bool fits_pieces(const FallenPiecesState& state) const;
  void step_skins(std::span<const Hand> hands, const BoneSnapshot& bones);
  void put(const SoftState& state, std::uint32_t epoch);
  void restore_cuts(const SoftState& state);
  void place_bands(const BoneSnapshot& bones);
  void take(Hand& hand, const ToolState& tool, std::uint32_t epoch);
  bool is_bent_far(const SoftHandState& hand, const NearBand& but) const;
  bool presses(const Hand& hand, std::size_t band, std::size_t part) const;
  void grip(Hand& hand, const BoneSnapshot& bones);
  void tell_grip(const Hand& hand, const GripNews& news);
  void keep_hold(const GripPull& pull);
  void follow(const Hand& hand);
  void seek(const Hand& hand);
  void choose(SoftHandState& hand) const;
  void press(Hand& hand);
  void keep_bend(const BandContact& contact, const BandPress& press, double part_radius_m);
  void tear(std::span<const Hand> hands);
  void tell_touches(const Hand& hand, std::uint64_t step);
  void show_loads(SoftPushes& out) const;
  double taken_by_others(const NearBand& near) const;
  Vec3 shift_of(const Hand& hand, const RoundBox& part_W, const BandContact& contact,
                const Vec3& nhat_W) const;
  void tell(const Hand& hand, EventKind kind, std::size_t band, std::array<double, 3> values);
  void tell(Event event, const Vec3& p_W);

  std::shared_ptr<const SoftSetup> setup_;
  std::vector<std::vector<Capsule>> tray_;      ///< rods: where their ends are
  std::vector<std::vector<RoundBox>> shapes_;   ///< as tray_
  std::vector<std::vector<RoundBox>> on_skin_;  ///< the same as they meet skin
  std::vector<ToolUse> uses_;                   ///< as tray_
  double coupling_n_per_m_, limit_n_, step_s_;
  SoftState state_;
  std::uint32_t epoch_ = 0;
  std::uint64_t step_ = 0;  ///< the last one, as bones count them
  std::array<BandSpan, kMaxBands> spans_{};
  std::array<BandReadout, kMaxBands> readouts_{};
  std::array<StrandAxes, kMaxBands> sections_{};
  std::unique_ptr<SoftGrips> grips_;       ///< null: no jaws hold anything
  std::unique_ptr<SolidPresses> solids_;   ///< null: there are none
  std::unique_ptr<SolidCutting> cutting_;  ///< null: nothing cuts them
  std::unique_ptr<FallenPieces> pieces_;   ///< null: what is cut off is gone
  std::unique_ptr<RestingSofts> resting_;
  std::unique_ptr<SkinWorld> skins_;  ///< null: no patch of skin is felt
  std::array<SolidReadout, kMaxSolids> solid_readouts_{};
  std::uint32_t bend_count_ = 0;  ///< for pictures: no part of the state
  std::array<StringBend, SoftPushes::kMostBends> bends_{};
  std::vector<Event> events_;
  std::vector<SoftOpening> openings_;
};

}  // namespace osteon
