#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/physics/pieces_setup.h"
#include "osteon/physics/skin_setup.h"
#include "osteon/physics/soft_gripper.h"
#include "osteon/physics/soft_solid_setup.h"
#include "osteon/physics/solid_cutter.h"
#include "osteon/scene/case.h"
#include "osteon/scene/soft_band.h"
#include "osteon/scene/soft_friction.h"
#include "osteon/tissue/ligament_table.h"

namespace osteon {

/// What is soft in a session: made once from the case, the same for every run of it.
struct SoftSetup {
  std::vector<SoftBand> bands;
  std::vector<SoftSolid> solids;
  std::vector<std::uint32_t> blades;                 ///< places in the tray of what cuts bands
  double cutting_n = 8;                              ///< force of a blade on a band that cuts it
  std::vector<std::optional<SolidCutter>> cutters;   ///< by the tray; none: nothing cuts solids
  double solid_cutting_n = 6;                        ///< force of an edge on a solid that opens it
  std::vector<std::optional<SoftGripper>> grippers;  ///< by the tray; none: nothing is held
  std::vector<SkinPatch> skins;
  std::vector<SkinTool> skin_tools;  ///< by the tray; of skin alone
  /// What pieces of solids that were cut off meet; null: they are gone at once.
  std::shared_ptr<const PiecesSetup> pieces;
  bool pieces_meet_softs = false;  ///< they rest on what is soft, too
  /// Pieces of bone rest on what is soft, too, and what jaws carry slips from them where it stands
  /// in it.
  bool pieces_are_stopped = false;
  bool thin_ones_stop = false;      ///< by thin parts, too, in which nothing stands deep
  bool suction_heeds_thin = false;  ///< it leaves what a thin part would take off it at once
  /// What one hand presses on a solid brings it no nearer to another than the first is deep in it.
  bool presses_are_bounded = false;
  /// What lies inside another part of a tool, which presses a solid another way, does not begin to
  /// touch it: it is not felt before it has been out of it.
  bool covered_parts_wait = false;
  bool clears_by_strides = false;  ///< what clears does nothing before it has gone a little way
  bool by_strands = false;         ///< bands are cut and torn strand by strand
  bool bridges_tear = false;       ///< what jaws pull off a solid tears where it is narrow
  bool hooks_tear = false;         ///< off a solid, as jaws do
  bool punches_bite = false;       ///< strands off bands
  std::vector<std::optional<SolidCutter>> biters;  ///< by the tray: what bites bands
  bool clearers_part = false;  ///< what clears takes strands of bands that it presses, as it runs
  bool wounds_open = false;    ///< what retracts holds the lips of cut skin apart
  SoftFriction friction;       ///< of instruments on it; none unless told
  std::uint64_t hash = 0;      ///< over all of it
};
/// Lets instruments cut bands, by their places in the tray. Nothing changes where there are none.
void add_blades(SoftSetup& setup, std::vector<std::uint32_t> blades, double cutting_n);
/// Lets instruments rub on it, in the hands' ticks. Nothing changes where all ratios are zero.
void add_friction(SoftSetup& setup, const SoftFriction& friction);
/// Adds solids to what is soft.
void add_solids(SoftSetup& setup, std::vector<SoftSolid> solids);
/// Lets instruments cut its solids, by their places in the tray. Nothing changes where none cuts.
void add_cutters(SoftSetup& setup, std::vector<std::optional<SolidCutter>> cutters,
                 double cutting_n);
/// What is cut off of its solids lies loose then. Nothing changes where nothing cuts them.
void add_pieces(SoftSetup& setup, std::shared_ptr<const PiecesSetup> pieces);
/// Those pieces meet bands and solids then, as these are at rest. Nothing changes where none lies.
void let_pieces_meet_softs(SoftSetup& setup);
/// So do pieces of bone then, and what jaws and suction carry. Nothing changes where nothing is
/// soft but skin.
void let_pieces_be_stopped(SoftSetup& setup);
/// Parts too thin for anything to stand deep in them stop what is carried, too. Nothing changes
/// where none is stopped.
void let_thin_parts_stop_pieces(SoftSetup& setup);
/// Suction does not hold then what a thin part would take off it in the same step. Nothing changes
/// where these stop nothing.
void let_suction_heed_thin_parts(SoftSetup& setup);
/// Two hands that press a solid towards one another raise each other's forces no further than that
/// (SoftSetup::presses_are_bounded). Nothing changes where there are no solids.
void let_presses_be_bounded(SoftSetup& setup);
/// What one part of a tool covers does not begin to touch a solid then that this part presses
/// another way: a shaft is not stopped by what the thicker head before it has pressed aside. And
/// parts are looked at near the solid alone. Nothing changes where there are no solids.
void let_covered_parts_wait(SoftSetup& setup);
/// What clears soft solids does so whenever it has gone a hundredth of a millimetre, not in each
/// step. Nothing changes where nothing clears.
void let_clearing_go_by_strides(SoftSetup& setup);
/// A hook tears off what jaws would (let_bridges_tear), and a punch bites strands off bands.
/// Nothing changes where neither bands nor solids are cut.
void let_hooks_tear_and_punches_bite(SoftSetup& setup);
/// What clears takes strands of the bands that it presses then, while it runs. Nothing changes
/// where there are no bands, or nothing in the tray clears.
void let_clearers_part_bands(SoftSetup& setup);
/// Bands are cut and torn strand by strand then. Nothing changes where there are none.
void let_bands_part_by_strands(SoftSetup& setup);
/// What jaws pull tears off a cut solid then, where too little of it is left. Nothing changes where
/// nothing cuts solids, or no jaws hold them.
void let_bridges_tear(SoftSetup& setup);
/// What retracts holds the lips of cut skin apart then. Nothing changes where there is no patch of
/// skin, or nothing in the tray retracts.
void let_wounds_be_held_open(SoftSetup& setup);
/// What a set-up does more than those from before it.
void tell_hash(SoftSetup& setup, std::string_view does);
/// Lets jaws hold what is soft, by their places in the tray. Nothing changes where none does.
void add_grippers(SoftSetup& setup, std::vector<std::optional<SoftGripper>> grippers);
/// Adds patches of skin, and what instruments do to them, by their places in the tray.
void add_skins(SoftSetup& setup, std::vector<SkinPatch> patches, std::vector<SkinTool> tools);
/// Over everything that is felt of the bands.
std::uint64_t hash_of(std::span<const SoftBand> bands);

/// Makes bands of the case's ligaments. `names`: of the table's rows that have a soft part, or
/// "ligaments": kMaxBands that the case has, at most. Of each ligament the middle line between its
/// footprints is felt, as thick as its volume; all its bundles lie on it, slack as the table says
/// of the case's own bending; a finding leaves of it what the table says. `surface_n_per_m`: how a
/// ligament's surface yields. Fails, and says what there is, where a ligament is not in the table
/// or the case, or is no solid that runs between two bones.
Result<SoftSetup> make_soft_setup(const Case& the_case, const LigamentTable& table,
                                  std::span<const std::string> names, double surface_n_per_m);

}  // namespace osteon
