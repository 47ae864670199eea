#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/image/volume.h"

namespace osteon {

/// A bone of a segmentation that is being made by hand.
struct EditedLabel {
  std::string name;           ///< unique, not empty
  std::size_t voxels = 0;     ///< may be 0: a bone that is still to be drawn
  VoxelBox box;               ///< holds every voxel of it; may be larger
  std::uint64_t version = 0;  ///< that of the whole when its voxels last changed
};

/// Labels over a scan while they are edited by hand: which voxels belong to which bone, and how the
/// bones are called. Every change belongs to a step, and each step that is committed can be undone
/// and redone. The tools that find voxels are in label_tools.h.
///
/// A step holds the runs of voxels that it changed, 12 bytes each. History is bounded by memory:
/// when the steps that can be undone hold more than `history_bytes`, the oldest is forgotten.
class LabelEdit {
 public:
  static constexpr std::size_t kHistoryBytes = 256u << 20;

  /// Begins with nothing labelled. Fails on a volume without voxels, on one whose values do not fit
  /// its size, and on one of 2^32 voxels or more.
  static Result<LabelEdit> begin(std::shared_ptr<const Volume> volume,
                                 std::size_t history_bytes = kHistoryBytes);

  const Volume& volume() const { return *volume_; }
  std::shared_ptr<const Volume> shared_volume() const { return volume_; }
  const LabelVolume& labels() const { return labels_; }
  const std::map<std::uint16_t, EditedLabel>& bones() const { return bones_; }
  bool has(std::uint16_t label) const { return bones_.count(label) > 0; }
  /// "bone_3": not in use.
  std::string unused_name() const;

  /// Starts a step; one under way is committed first. `what` is shown to the user: "Grow lunate".
  void begin_step(std::string what);
  bool in_step() const { return in_step_; }
  /// Gives `count` voxels from place `first` of memory on a label, 0 for none. Only within a step,
  /// and only a label that there is. Returns how many changed.
  std::size_t set(std::size_t first, std::size_t count, std::uint16_t label);
  /// Ends the step: one of history, unless nothing changed. True when something did.
  bool commit_step();
  /// Ends the step and puts everything back.
  void cancel_step();

  /// A new bone without voxels, within the step under way or as a step of its own; an empty name
  /// stands for an unused one. Fails on a name that is taken and when labels have run out.
  Result<std::uint16_t> add(const std::string& name = {});
  /// Steps of their own. Fail on a label that does not exist, `rename` also on a name that is
  /// empty or taken, `merge` also when both are one.
  Result<void> rename(std::uint16_t label, const std::string& name);
  Result<void> remove(std::uint16_t label);
  Result<void> merge(std::uint16_t from, std::uint16_t into);
  /// Takes other labels with their names in place of what there is, as one step. Fails, and leaves
  /// all as it was, on another size, on a label without a name and on names that repeat.
  Result<void> replace(const LabelVolume& labels, const std::map<std::uint16_t, std::string>& names,
                       const std::string& what);

  /// False when there is nothing to undo or redo. A step under way is cancelled first.
  bool undo();
  bool redo();
  std::size_t undo_steps() const { return undo_.size(); }
  std::size_t redo_steps() const { return redo_.size(); }
  /// How many voxels undo or redo would change.
  std::size_t undo_voxels() const { return undo_.empty() ? 0 : undo_.back().voxels(); }
  std::size_t redo_voxels() const { return redo_.empty() ? 0 : redo_.back().voxels(); }
  /// What undo and redo would take back and repeat; empty: nothing.
  std::string undo_what() const { return undo_.empty() ? std::string() : undo_.back().what; }
  std::string redo_what() const { return redo_.empty() ? std::string() : redo_.back().what; }
  std::size_t history_bytes() const { return held_bytes_; }
  /// True when the labels are not what they were at the begin or at the last `mark_saved`.
  bool is_changed() const;
  void mark_saved();
  /// Rises with every change of any voxel, name or list: whoever shows them compares.
  std::uint64_t version() const { return version_; }

 private:
  struct VoxelRun {
    std::uint32_t first, count;
    std::uint16_t before, after;
  };
  struct NameChange {
    std::uint16_t label;
    std::string before, after;  ///< empty: there was, or is, no such bone
  };
  struct Step {
    std::string what;
    std::vector<VoxelRun> runs;
    std::vector<NameChange> names;
    std::uint64_t number = 0;
    std::size_t bytes() const;
    std::size_t voxels() const;
  };

  LabelEdit(std::shared_ptr<const Volume> volume, std::size_t history_bytes);
  void set_name(std::uint16_t label, const std::string& name);
  void apply_name(std::uint16_t label, const std::string& name);
  void write(std::size_t first, std::size_t count, std::uint16_t before, std::uint16_t after);
  void include(EditedLabel& bone, std::size_t first, std::size_t count) const;
  void record(std::size_t first, std::size_t count, std::uint16_t before, std::uint16_t after);
  void roll_back(const Step& step);
  void roll_forward(const Step& step);
  void remember(Step step);
  Result<void> check_name(const std::string& name, std::uint16_t label) const;
  Result<void> check_label(std::uint16_t label) const;
  Result<void> check_labels(const LabelVolume& labels,
                            const std::map<std::uint16_t, std::string>& names) const;
  void relabel(std::uint16_t from, std::uint16_t into);
  std::uint64_t now_at() const { return undo_.empty() ? forgotten_at_ : undo_.back().number; }

  std::shared_ptr<const Volume> volume_;
  LabelVolume labels_;
  std::map<std::uint16_t, EditedLabel> bones_;
  std::size_t history_bytes_;

  bool in_step_ = false;
  Step step_;
  std::deque<Step> undo_;
  std::vector<Step> redo_;
  std::size_t held_bytes_ = 0;
  std::uint64_t steps_made_ = 0;
  std::uint64_t forgotten_at_ = 0;  ///< number of the last step forgotten; 0: none
  std::uint64_t saved_at_ = 0;      ///< number of the step after which it was saved; 0: none
  std::uint64_t version_ = 0;
};

}  // namespace osteon
