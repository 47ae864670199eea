#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "osteon/physics/skin_state.h"
#include "osteon/physics/soft_setup.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/event.h"
#include "osteon/scene/soft_band.h"
#include "osteon/scene/soft_pushes.h"
#include "osteon/scene/soft_told.h"
#include "osteon/scene/tool.h"
#include "osteon/tissue/sheet_lips.h"
#include "skin/skin_slits.h"

namespace osteon {

/// A hand's tool in a step of the skin.
struct SkinToolNow {
  const ToolState* tool = nullptr;  ///< null: it touches nothing
  std::span<const RoundBox> parts;  ///< of the tool
};

std::uint64_t hash_of_cuts(const SheetCuts& cuts);

/// The patches of skin of a session at the physics' rate. Of each tool the part that is deepest in
/// a patch presses it: a ball or rod as a round tip of its radius presses the sheet where it is, a
/// box as a disc as large as what of it presses (skin_box.h). An edge that is pressed hard enough
/// goes in and cuts along its way; a trocar breaks through; what is round goes in where a slit is
/// wide enough. After a cut the sheet's stiffness is made anew in pieces, one a step. A function of
/// the state and of the tools, bit by bit. Allocates in steps in which something is cut, not in
/// others.
class SkinWorld {
 public:
  /// `setup` must outlive it.
  /// `first_made`: place of the first made portal in the session's list.
  SkinWorld(const SoftSetup& setup, double coupling_n_per_m, double limit_n, double step_s,
            std::uint32_t first_made = 0);
  ~SkinWorld();

  void step(std::span<const SkinToolNow> hands, const BoneSnapshot& bones);
  std::span<const Event> events() const { return events_; }
  void tell(std::size_t hand, BandContacts& contacts) const;
  /// Of the patches that are there for no portal.
  SkinOpening opening() const;
  /// Of a patch, by its place there.
  MadePortal made_portal(std::size_t patch, std::uint32_t portal) const;
  void show(SoftPushes& pushes) const;
  SkinReadout readout(std::size_t patch) const;

  std::uint64_t hash() const;
  std::shared_ptr<const SkinState> save() const;
  bool fits(const SkinState& state, std::span<const std::vector<Capsule>> tray) const;
  void restore(const SkinState& state);
  /// As restore, but no tool is near, and the stiffness follows in the next steps.
  void go_back(const SkinState& state);
  void clear();
  /// Portals of patches that are felt no more stay, see MadePortal::bare.
  void bare(SkinBare bares) { bares_ = bares; }

 private:
  static constexpr std::uint64_t kSkinStill = 0;  ///< next_hash: nothing is being solved
  struct Patch {
    SheetCuts cuts;
    std::uint64_t cuts_hash = 0, felt_hash = 0, next_hash = 0;
    SkinCuts felt, next;
    std::shared_ptr<const SheetYield> yields;
    std::unique_ptr<SheetWork> work;
    std::uint64_t worked = 0;
    std::unique_ptr<const SheetLips> lips;  ///< of `lips_of`; null: none can be held open
    std::unique_ptr<LipWork> lip_work;      ///< of `felt`
    SkinCuts lips_of;
    std::uint64_t lips_hash = 0, lips_worked = 0;
    LipPushes pushes;  ///< of the last step: no part of the state
    SkinSlits slits;
    double cut_m = 0;
    std::uint32_t holes = 0;
    std::uint32_t made_count = 0;
    std::array<SkinPortal, kMadePerPatch> made{};
    Pose X_WS;
    std::shared_ptr<const SkinCuts> shown;  ///< for pictures: no part of the state
  };
  struct Place;
  /// One hand on one patch in a step.
  struct At {
    std::size_t hand = 0, patch = 0;
    const SkinToolNow* now = nullptr;
    SkinHand* state = nullptr;
  };

  const SkinTool& use_of(std::uint32_t instrument) const;
  std::optional<Place> deepest(std::size_t patch, const SkinToolNow& now, double most_m) const;
  void follow(const At& at);
  void press(const At& at);
  std::optional<Place> deepest_box(std::size_t patch, const RoundBox& box_S) const;
  void slice(const At& at, const SheetPush& push);
  void pass(const At& at, const SheetPush& push);
  void begin_to_cut(const At& at, double force_n);
  void end_stroke_of(const At& at);
  void let_go(const At& at);
  void make_hole(const At& at, double radius_m);
  void follow_portal(const At& at);
  bool is_bare(std::size_t patch) const;
  double slit_at(const At& at) const;
  void make_portal(const At& at);
  std::optional<std::uint32_t> opening_at(const At& at) const;
  bool is_taken(std::size_t patch, std::uint32_t portal, std::size_t but) const;
  void changed(std::size_t patch);
  void follow_stiffness(std::size_t patch);
  void follow_lips(std::size_t patch);
  void put_lips(std::size_t patch, const SkinPatchState& from);
  bool follow_wound(const At& at, bool begins);
  bool may_enter(const At& at, bool begins) const;
  /// What stands in a wound, of all hands.
  struct DiscsInWound {
    std::uint32_t count = 0;
    std::array<LipDisc, 5 * (kMaxHands + 1)> all{};
    std::span<const LipDisc> list() const { return {all.data(), count}; }
  };
  DiscsInWound discs_in_wound(std::size_t patch) const;
  void hold_open(std::size_t patch, std::uint64_t step);
  double drawn_aside_m(const At& at) const;
  void feel_lips(const At& at, const DiscsInWound& in);
  void tell_touch(const At& at, std::uint64_t step);
  void tell_event(const At& at, EventKind kind, const std::array<double, 3>& values);
  void put(std::size_t patch, const SkinPatchState& from);

  const SoftSetup& setup_;
  double coupling_n_per_m_, limit_n_, step_s_;
  std::uint32_t first_made_;
  std::uint64_t step_ = 0;
  SkinBare bares_ = SkinBare::kNone;
  std::vector<Patch> patches_;
  std::array<std::array<SkinHand, kMaxSkins>, kMaxHands> hands_{};
  std::array<SkinReadout, kMaxSkins> readouts_{};
  mutable SheetScratch scratch_;
  LipPushes tried_;
  std::array<SkinToolNow, kMaxHands> now_{};
  std::span<const SkinToolNow> tools_;  ///< of the step
  std::vector<Event> events_;
};

}  // namespace osteon
