#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/carve/carved_field.h"
#include "osteon/carve/cutter.h"
#include "osteon/carve/loose_pieces.h"
#include "osteon/carve/node_moments.h"
#include "osteon/carve/thrust.h"
#include "osteon/physics/bone_loss.h"
#include "osteon/physics/fallen_pieces.h"
#include "osteon/scene/case.h"
#include "osteon/scene/event.h"
#include "osteon/scene/removal.h"
#include "osteon/scene/state.h"

namespace osteon {

/// What an instrument of the tray takes away, and how.
struct CarvingTool {
  using Way = RemovalWay;
  Way way = Way::kDrill;
  Cutter cutter;
  double most_rev_per_s = 0;     ///< at full power
  double most_w = 0;             ///< of the blows on a blade, at full power
  double pilot_m = 0;            ///< of the cannula, which cuts nothing
  double grip = 0.3;             ///< cutting force by pressing force
  Vec3 middle_T = Vec3::Zero();  ///< of a burr's or a scraper's ball
  bool one_sided = false;        ///< it cuts on the side of +y alone
  bool soft_only = false;        ///< bone stops it: it removes what is softer
  bool reams = false;            ///< it widens a canal by its rim, and may chatter there
  bool stays = false;            ///< a pin: let go, it stays in the bone
  double length_m = 0;           ///< of a pin
};

/// What an instrument of the tray fixes a line with: the bore of an aimer's sleeve.
struct AimingTool {
  Pose X_TS;          ///< in Tool: origin at the place that is aimed at, +z outwards along the bore
  double bore_m = 0;  ///< its diameter
  double length_m = 0;  ///< from that place to the bore's outer end
};

/// A layer of cartilage on a bone that is carved, for who draws it.
struct CarvedLayer {
  std::uint32_t soft = 0;  ///< which soft part of the case
  Aabb box_B;              ///< in Bone
  Pose X_WB;               ///< of its bone at rest
};

/// All that is made before a session carves. Immutable.
struct CarvingSetup {
  std::vector<std::optional<CarvingTool>> tray;          ///< none: it removes nothing
  std::vector<std::optional<AimingTool>> aimers;         ///< as `tray`
  std::vector<std::shared_ptr<const UncutField>> bones;  ///< of the case; null: it is not carved
  std::vector<std::vector<CarvedLayer>> layers_on;       ///< as `bones`; may end before them
  BoneLayers layers;
  DrillTable table;
  DrillTable by_hand;  ///< of what the hand turns: its edges take more with each turn
  /// A desktop device gives a few newtons, a surgeon's arm a hundred: so many newtons on the drill
  /// stand for one in the hand.
  double thrust_scale = 20;
  /// So many newtons of the hand resist a drill that a pin or a sleeve leads, whatever bone it goes
  /// through: as a sum of piecewise linear functions along its line (rbf_force.h). 0: as bone does.
  double guided_n = 0;
  std::shared_ptr<const PiecesSetup> pieces;  ///< null: what is cut off is gone
  double irrigation_m3_s = 0;                 ///< of water over the bone that is cut; 0: it is dry
  std::size_t most_blocks = 4096;             ///< of each bone
  std::size_t channel_places = 0;  ///< for changes on their way to a hand; 0: as many as it takes
  double air_m = 0;                ///< cuts are known so far outside of a bone
  /// Walls are felt so far behind where they were cut.
  static constexpr double kSlack_m = 15e-6;
  /// Bone goes in bites of this: what is removed in a step is far less than a cell.
  static constexpr double kBite_m = 10e-6;
};

/// What one hand's instrument does to bone: a value.
struct CarvingHand {
  static constexpr std::uint32_t kNoBone = 0xffffffffu;
  std::uint32_t bone = kNoBone;  ///< that it cuts
  Pose X_BC;                     ///< of the cutter, where bone was last removed
  DrillState drill;
  double due_m = 0;           ///< removed by the model, not yet from the field
  double angle_rad = 0;       ///< between the drill and the surface where it began
  std::uint32_t idle = 0;     ///< steps since it cut
  std::uint64_t since = 0;    ///< step in which it began
  double most_torque_nm = 0;  ///< since then
  std::uint8_t tissue = 0;    ///< before the tip: 1 + BoneTissue; 0: none
  bool was_in = false;        ///< the tip has been in bone
  bool skives = false;
  std::uint32_t out = 0;      ///< steps since it came out; 0: it has not
  Vec3 p_out = Vec3::Zero();  ///< where, in Bone
  double plunge_m = 0;
  double twist_rad = 0;  ///< about its axis since it began, of what the hand turns
  bool jaw_open = false;
  bool in_hole = false;              ///< its hole holds it: it goes along the hole's line alone
  bool open = false;                 ///< nothing is before its tip
  double lag_m = 0;                  ///< the cutter still stands so far behind X_BC
  Vec3 mouth_B = Vec3::Zero();       ///< where the hole begins
  std::uint32_t rod = 0;             ///< that leads it: 1 + its place in Carving::rods; 0: none
  double grip = 0;                   ///< of the rod, 0 to 1
  double loose = 0;                  ///< of a hole that it came back to: what it does not hold yet
  Chatter chatter;                   ///< as it was told last; no amplitude: it runs smoothly
  std::uint64_t chatters_since = 0;  ///< step
  static constexpr std::uint32_t kAnyInstrument = 0xffffffffu;  ///< that which the hand holds
  std::uint32_t instrument = 0;                                 ///< in the tray
  friend bool operator==(const CarvingHand&, const CarvingHand&);
};

/// A hand that cuts nothing yet with what it holds.
CarvingHand anew(const CarvingHand& hand);

/// A hole that a drill has left and may come back to.
struct LeftHole {
  std::uint32_t bone = CarvingHand::kNoBone;  ///< kNoBone: none
  Pose X_BC;                                  ///< of the cutter at its end, +z outwards
  Vec3 mouth_B = Vec3::Zero();
  double diameter_m = 0, lag_m = 0;
  bool open = false;  ///< it goes through
};
/// The last ones; a new one takes the oldest one's place.
inline constexpr std::size_t kMaxLeftHoles = 8;
using LeftHoles = std::array<LeftHole, kMaxLeftHoles>;

/// Everything that carving changes: a value.
struct CarvingState {
  std::vector<CarveState> bones;  ///< as CarvingSetup::bones; of a bone that is not carved: empty
  std::array<CarvingHand, kMaxHands> hands{};
  std::uint64_t steps = 0;
  bool full = false;
  GuideRods rods{};
  LeftHoles holes{};  ///< from the newest
  FallenPiecesState pieces;
};

/// What a hand's instrument did in one step, for heat and sound.
struct CarvingReadout {
  std::uint32_t bone = CarvingHand::kNoBone;
  Vec3 tip_B = Vec3::Zero(), axis_B = Vec3::UnitZ();  ///< the axis points back, along the shaft
  double radius_m = 0;
  double advance_m = 0;
  double thrust_n = 0, torque_nm = 0;
  double cutting_w = 0, rubbing_w = 0;
  bool ball = false;  ///< it cuts all over a ball about the tip
};

/// Bone that the instruments of a session remove, one step after the other: a function of its
/// state and of the tools given to it, bit by bit the same from every compiler.
///
/// A drill cuts along its own axis: once its tip is in, the hole keeps its line, whatever the hand
/// pulls sideways, and the felt wall tells so. It goes forward by what step_drill lets it remove of
/// the bone before its tip, which is looked at in points over its front; what is felt of the bone
/// ends there, so a hand cannot push it on. When nothing is left before the tip it has come out.
/// Where the bone is slanted, a wide front first cuts off what rises beside its middle.
/// A pin whose chuck is opened (the jaw, above 0.5) stays in the bone, and a chuck that shuts
/// (below 0.1) at a pin takes it out. A pin leads what is hollow, the sleeve of an aimer that was
/// fixed (by its jaw, in the same way, while its tip touches bone) what fits into it: along its
/// line alone. So does a hole that a drill has left, when one as thick is put to its mouth again. A
/// burr removes where it is pressed: P = c F v at its rim, over the specific energy of what lies
/// there, is a volume in time, and that over half its cross-section is how fast it goes in. A piece
/// that hangs on nothing any more falls off with the next look for such pieces. Of a scraper v is
/// how fast the hand draws it along. A blade goes in by the power of the blows on it, over the
/// specific energy and its cross-section, and where the push alone is more than both.
class Carving {
 public:
  /// `coupling_n_per_m`: between what is felt and the hand, above 0.
  Carving(std::shared_ptr<const CarvingSetup> setup, std::size_t hands, double coupling_n_per_m);

  /// `bones`: where they are while the tools touch them.
  /// `softs`: soft parts that loose pieces meet; null: none.
  void step(std::span<const ToolState* const> tools, const BoneSnapshot& bones, double step_s,
            const PieceSoftGround* softs = nullptr);
  bool any_pieces() const { return pieces_ && !pieces_->empty(); }
  /// What rests on soft parts may rest no more: any of it, or what an instrument comes near.
  void stir_pieces() {
    if (pieces_) pieces_->stir();
  }
  void stir_pieces_by(std::span<const ToolState* const> tools, const BoneSnapshot& bones) {
    if (pieces_) pieces_->stir_by(tools, bones);
  }

  struct Changed {
    std::uint32_t bone = 0, block = 0;
  };
  /// Of the last step.
  std::span<const Changed> changed() const { return changed_; }
  /// A piece that hung on nothing and is gone.
  struct Fallen {
    std::uint32_t bone = 0;
    double volume_m3 = 0;
    bool dust = false;                       ///< too small for an event
    std::shared_ptr<const PieceShape> lies;  ///< as a loose piece; null: it is gone
  };
  /// Of the last step; looked for in every kLookEvery-th.
  std::span<const Fallen> fallen() const { return fallen_; }
  static constexpr std::uint64_t kLookEvery = 48;  ///< before a hand at rest forgets its bone
  static constexpr double kDust_m3 = 5e-9;         ///< own default
  std::span<const Event> events() const { return events_; }
  /// What leads the hands' instruments in the next ticks.
  const std::array<ToolGuide, kMaxHands>& guides() const { return guides_; }
  /// Pins in the bones and sleeves before them.
  const GuideRods& rods() const { return rods_; }
  /// Pieces that were cut off and lie loose.
  std::span<const FallenPiece> pieces() const;
  LooseBones loose() const;
  /// What is left of each bone; null: it is not carved.
  std::span<const CarvedField* const> fields() const { return carved_fields_; }
  /// Of a piece whose bone has that mass: all of one density.
  double mass_kg(const FallenPiece& piece, double bone_mass_kg) const;
  /// What became of them in the last step.
  std::span<const PieceNews> piece_news() const;
  /// The hands that held pieces are elsewhere now.
  void let_pieces_go();
  const CarvingReadout& readout(std::size_t hand) const { return readouts_[hand]; }

  const CarvingSetup& setup() const { return *setup_; }
  /// Null: that bone is not carved.
  const CarvedField* field(std::size_t bone) const;
  /// What a bone of that mass has lost: by nodes of its field, all of one density. A function of
  /// the cuts alone.
  BoneLoss loss(std::size_t bone, double mass_kg);
  /// Of all bones, by nodes: within a cell of each wall. A function of the cuts alone.
  GoneBone gone();
  std::uint64_t hash();
  CarvingState save() const;
  bool fits(const CarvingState& state) const;
  /// `state` must fit. Every block of every bone may have changed then.
  void restore(const CarvingState& state);

 private:
  struct Bone {
    std::optional<CarvedField> field;
    std::unique_ptr<LoosePieces> loose;
    std::unique_ptr<RemovedNodes> removed;
    std::unique_ptr<RemovedTissue> tissue_gone;
    std::int64_t whole = 0;                           ///< nodes of the uncut bone
    std::uint64_t looked_step = 0, looked_epoch = 0;  ///< of the field, when last looked for pieces
  };
  struct Push;

  void drop_pieces(std::span<const ToolState* const> tools, const BoneSnapshot& bones);
  void drop_pieces_of(std::uint32_t bone, std::span<const ToolState* const> tools,
                      const Pose& X_WB);
  bool drop_piece(std::uint32_t bone, const LoosePiece& piece, const Pose& X_WB);
  void step_pieces(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                   double step_s, const PieceSoftGround* softs);
  void let_go_of(const LoosePiece& piece, std::uint32_t bone,
                 std::span<const ToolState* const> tools);
  void end_hole(std::size_t hand, const ToolState& tool);

  void step_hand(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones, double step_s);
  void cut_with(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones, double step_s);
  void drill(std::size_t hand, const CarvingTool& with, const Push& push, double step_s);
  bool stand_before(std::size_t hand, const CarvingTool& with, const Push& push);
  void go_on(std::size_t hand, const CarvingTool& with, const Push& push, double advance_m);
  DrillStep go_guided(std::size_t hand, const CarvingTool& with, const DrillMaterial& material,
                      double push_n, double rev_per_s, double step_s);
  void strike(std::size_t hand, const CarvingTool& with, const Push& push, double step_s);
  double turning(std::size_t hand, const CarvingTool& with, const Push& push, double step_s);
  void burr(std::size_t hand, const CarvingTool& with, const Push& push, double step_s);
  void bite(std::size_t hand, const CarvingTool& with, const ToolState& tool, const Pose& X_BT,
            std::uint32_t bone);
  void rest(std::size_t hand, const Push& push);
  void shake(std::size_t hand, const CarvingTool& with, const Push& push, double rev_per_s);
  void run_smoothly(std::size_t hand, const Push& push);
  void begin(std::size_t hand, const CarvingTool& with, const Push& push);
  Pose cutter_pose(const CarvingHand& h) const;
  bool slid_off(const CarvingHand& h, const Push& push) const;
  void leave_hole(std::size_t hand, const CarvingTool& with, const ToolState& tool,
                  const BoneSnapshot& bones);
  void follow_rods(std::size_t hand, const CarvingTool& with, const ToolState& tool,
                   const BoneSnapshot& bones);
  void follow_chuck(std::size_t hand, const CarvingTool& with, const ToolState& tool,
                    const BoneSnapshot& bones);
  void follow_aimer(std::size_t hand, const AimingTool& with, const ToolState& tool,
                    const BoneSnapshot& bones);
  void slide_on_pin(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones);
  void keep_hole(const CarvingHand& h, const CarvingTool& with);
  void come_back(std::size_t hand, const CarvingTool& with, const ToolState& tool,
                 const BoneSnapshot& bones);
  double shaken_m(const CarvingHand& h) const;
  Vec3 end_of(const CarvingHand& h) const;
  void publish(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones);
  void run_free(CarvingHand& h, const CarvingTool& with, const Pose& X_BT);
  GuideRod* free_rod();
  void drop_rod(std::size_t place);
  void tell_of(std::size_t hand, const ToolState& tool, EventKind kind, std::uint32_t bone,
               std::array<double, 3> values);
  void follow_out(std::size_t hand, const Push& push);
  void note_tissue(std::size_t hand, const Push& push, std::optional<BoneTissue> tissue);
  bool remove(std::size_t hand, const Cutter& cutter, const Pose& from_B, const Pose& to_B);
  void tell_full(std::size_t hand, const Push& push, bool was_full);
  void tell(std::size_t hand, const Push& push, EventKind kind, std::array<double, 3> values);

  std::shared_ptr<const CarvingSetup> setup_;
  std::vector<Bone> bones_;
  std::size_t count_;         ///< of hands
  double most_shaken_m_ = 0;  ///< of the teeth's wave, for a hand
  std::array<CarvingHand, kMaxHands> hands_{};
  std::array<CarvingReadout, kMaxHands> readouts_{};
  std::array<ToolGuide, kMaxHands> guides_{};
  GuideRods rods_{};
  LeftHoles holes_{};
  std::vector<Changed> changed_;
  std::vector<Fallen> fallen_;
  std::optional<FallenPieces> pieces_;             ///< none: what is cut off is gone
  std::vector<const CarvedField*> carved_fields_;  ///< of each bone; null: it is not carved
  std::vector<Event> events_;
  std::uint64_t steps_ = 0;
  bool full_ = false;
};

}  // namespace osteon
