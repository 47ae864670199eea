#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "bones_age.h"
#include "event_list.h"
#include "event_watch.h"
#include "felt_bands.h"
#include "felt_cuts.h"
#include "osteon/record/recording.h"
#include "osteon/session/session.h"
#include "scope_gaze.h"

namespace osteon {

/// Everything of one hand lies on cache lines of its own: each hand has a thread.
class alignas(64) HandHalf {
 public:
  /// `tray` must not be empty.
  HandHalf(std::shared_ptr<const Case> the_case, const Tray& tray,
           const std::vector<Portal>& portals, const SessionSettings& settings, std::size_t hand);

  /// Bones can be carved: what this hand feels of that, for the physics to tell. Once, before the
  /// first tick.
  FeltCuts& set_carving(const CarvingSetup& setup);

  /// Of the tray's instruments, mm: what the events of an exchange tell. Before the first tick.
  void set_sizes(std::vector<double> sizes_mm) { sizes_mm_ = std::move(sizes_mm); }
  /// Bands are felt: what this hand feels of them, for the physics to tell. Once, before the first
  /// tick; they must outlive this.
  FeltBands& set_bands(const std::vector<SoftBand>& bands, const SoftFriction& friction);

  const ToolState& tick(const ToolInput& input, const BoneSnapshot& bones, const OtherTools& others,
                        const Command& command);
  const ToolState& tool_state() const { return loop().state().tool; }
  const Tool& tool() const { return loop().tool(); }
  const TickRecord& record() const { return record_; }
  std::span<const Event> events() const { return events_.all(); }
  /// All that the next tick depends on, but for what it will consume.
  std::uint64_t hash() const;
  void save(HandState& into) const;
  /// Whether it is a state of this case and tray.
  bool fits(const HandState& state) const;
  void restore(const HandState& from);
  const OtherTools& seen() const { return seen_; }

 private:
  const HapticLoop& loop() const { return loops_[held_]; }
  HapticLoop& loop() { return loops_[held_]; }
  void obey(const Command& command);
  void take(std::uint32_t instrument, double power, double jaw, bool even_the_same);
  void go_back(std::uint32_t mark);
  void tell_portals(std::uint32_t before, std::uint32_t now);
  void tell_sights(const BoneSnapshot& bones);
  void tell_structures(const BoneSnapshot& bones);
  void tell(EventKind kind, SubjectKind subject_kind, std::uint32_t subject, double value = 0);
  void keep_record(const ToolInput& input, const BoneSnapshot& bones, const OtherTools& others,
                   const Command& command);

  std::size_t hand_;
  std::unique_ptr<FeltCuts> cuts_;    ///< null: no bone is carved
  std::unique_ptr<FeltBands> bands_;  ///< null: nothing is soft
  std::vector<HapticLoop> loops_;     ///< one for each instrument in the tray
  std::vector<double> sizes_mm_;
  std::uint32_t held_ = 0;
  std::uint32_t portal_count_;
  HapticParams params_;
  BonesAge age_;
  EventWatch events_of_;
  ScopeGaze gaze_;
  bool sights_;
  double step_s_;  ///< of physics
  WatchState watch_;
  std::array<HandMark, kMaxMarks> marks_{};
  ToolState before_;
  OtherTools seen_{};
  TickRecord record_;
  EventList events_;
};

}  // namespace osteon
