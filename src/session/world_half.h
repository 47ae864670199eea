#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "felt_bands.h"
#include "felt_cuts.h"
#include "knee_half.h"
#include "osteon/physics/bone_world.h"
#include "osteon/physics/carving.h"
#include "osteon/physics/graft_bench_work.h"
#include "osteon/physics/graft_placing.h"
#include "osteon/physics/joint_water.h"
#include "osteon/physics/loose_rings.h"
#include "osteon/physics/structure_watch.h"
#include "osteon/record/recording.h"
#include "osteon/session/session.h"

namespace osteon {

/// The physics of a session, on cache lines of its own: it has a thread.
class alignas(64) WorldHalf {
 public:
  WorldHalf(std::shared_ptr<const Case> the_case, const SessionSettings& settings);

  /// `hands`: who feels what is carved, one after the other. Before the first step.
  void set_carving(std::shared_ptr<const CarvingSetup> setup, std::vector<FeltCuts*> hands);
  const Carving* carving() const { return carving_.get(); }
  double mass_kg(std::size_t bone) const { return world_.mass_kg(bone); }
  /// How the bones are carved, for who draws; null: none is.
  CutsFeed* cuts_feed() { return feed_.get(); }
  bool told(std::size_t hand) const { return hand >= felt_.size() || !felt_[hand]->behind(); }
  /// For one thread that runs both halves: no cut waits for room on its way to a hand.
  void catch_up();
  /// Before the first step. What an instrument of the tray can do at the bench, if the case has
  /// one.
  void set_bench(std::vector<BenchTool> tray);
  /// The same of a graft that is placed: if the case has both tunnels for it, or once one is
  /// handed over.
  void set_placing(std::vector<PlacingTool> tray);
  /// Before the first step. The joint is filled where the case has one; see
  /// SessionSettings::water.
  void set_water(std::span<const std::shared_ptr<const Tool>> tray, bool hashed);
  /// Before the first step, after softs and carving: what the tips of instruments can be in.
  void set_structures(bool softs);
  /// Before the first step.
  void set_softs(std::unique_ptr<SoftHalf> softs) { softs_ = std::move(softs); }
  const SoftWorld* softs() const { return softs_ ? &softs_->world() : nullptr; }

  const BoneSnapshot& step(std::span<const ToolState* const> tools, const Command& command);
  const BoneSnapshot& bones() const { return world_.snapshot(); }
  const StepRecord& record() const { return record_; }
  std::uint64_t hash() const;
  void save(WorldState& into) const;
  bool fits(const WorldState& state) const;
  void restore(const WorldState& from);

 private:
  void obey(const Command& command);
  void keep(std::uint32_t mark);
  void go_back(const WorldMark& mark);
  std::shared_ptr<const CarvingState> carved() const;
  void place_rings();
  void step_softs(std::span<const ToolState* const> tools, const BoneSnapshot& bones);
  void show_loose();
  void lighten();
  void lead();
  bool takes_graft(const Command& command);
  void make_placing(const GraftPlacingState& state);
  bool fits_placing(const GraftPlacingState& state) const;
  void begin_bent();
  void order_bend(double degrees);
  bool examines(const Command& command);
  void bend();
  void pull_tail(double tension_n);
  void turn_pump(const Command& command);
  void let_flow(std::span<const ToolState* const> tools);
  void look_inside(std::span<const ToolState* const> tools);
  WaterState fresh_water() const;

  std::shared_ptr<const Case> the_case_;
  BoneWorld world_;
  std::unique_ptr<Carving> carving_;  ///< null: no bone is carved
  std::unique_ptr<CutsFeed> feed_;
  std::unique_ptr<StructureWatch> structures_;  ///< null: nothing is entered
  std::unique_ptr<SoftHalf> softs_;             ///< null: nothing is soft
  std::unique_ptr<LooseRings> rings_;           ///< null: none lie loose
  std::unique_ptr<GraftBenchWork> bench_;       ///< null: no graft is made
  std::unique_ptr<GraftPlacing> placing_;       ///< null: none is placed
  std::vector<PlacingTool> placing_tray_;
  std::optional<PlacingPlan> own_plan_;  ///< of a case with both tunnels
  KneeHalf knee_;
  std::optional<JointWater> water_;  ///< none: the case has no joint that is filled
  bool water_hashed_ = true;
  std::vector<FeltCuts*> felt_;  ///< of the hands
  bool all_changed_ = false;     ///< bones came back from a restore point in this step
  double step_s_;
  double coupling_n_per_m_;
  std::uint64_t keep_every_;  ///< steps
  std::array<WorldMark, kMaxMarks> marks_{};
  std::array<std::uint64_t, kMaxMarks> mark_hashes_{};
  StepRecord record_;
};

}  // namespace osteon
