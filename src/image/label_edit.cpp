#include "osteon/image/label_edit.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "osteon/base/check.h"

namespace osteon {
std::size_t LabelEdit::Step::voxels() const {
  std::size_t count = 0;
  for (const VoxelRun& run : runs) count += run.count;
  return count;
}

std::size_t LabelEdit::Step::bytes() const {
  std::size_t sum = sizeof(Step) + what.size() + runs.size() * sizeof(VoxelRun);
  for (const NameChange& change : names)
    sum += sizeof(NameChange) + change.before.size() + change.after.size();
  return sum;
}

LabelEdit::LabelEdit(std::shared_ptr<const Volume> volume, std::size_t history_bytes)
    : volume_(std::move(volume)), history_bytes_(history_bytes) {
  labels_.frame = volume_->frame;
  labels_.values.assign(volume_->frame.count(), 0);
}

Result<LabelEdit> LabelEdit::begin(std::shared_ptr<const Volume> volume,
                                   std::size_t history_bytes) {
  const std::string todo = "Choose another series";
  if (!volume || volume->frame.count() == 0) return fail("has no voxels", "the scan", todo);
  if (volume->values.size() != volume->frame.count())
    return fail("has a number of voxels that does not match its size", "the scan", todo);
  if (volume->frame.count() > std::numeric_limits<std::uint32_t>::max())
    return fail("has more than 4 294 967 295 voxels", "the scan", "Crop it to the joint");
  return LabelEdit(std::move(volume), history_bytes);
}

void LabelEdit::begin_step(std::string what) {
  if (in_step_) commit_step();
  in_step_ = true;
  step_ = {};
  step_.what = std::move(what);
}

bool LabelEdit::commit_step() {
  if (!in_step_) return false;
  in_step_ = false;
  if (step_.runs.empty() && step_.names.empty()) return false;
  step_.number = ++steps_made_;
  remember(std::move(step_));
  return true;
}

void LabelEdit::cancel_step() {
  if (!in_step_) return;
  in_step_ = false;
  roll_back(step_);
}

void LabelEdit::remember(Step step) {
  redo_.clear();
  step.runs.shrink_to_fit();
  held_bytes_ += step.bytes();
  undo_.push_back(std::move(step));
  while (held_bytes_ > history_bytes_ && undo_.size() > 1) {
    held_bytes_ -= undo_.front().bytes();
    forgotten_at_ = undo_.front().number;
    undo_.pop_front();
  }
}

std::size_t LabelEdit::set(std::size_t first, std::size_t count, std::uint16_t label) {
  demand(in_step_, "labels change within a step only");
  demand(label == 0 || has(label), "a label needs a bone");
  demand(first <= labels_.values.size() && count <= labels_.values.size() - first,
         "a voxel outside the scan");
  std::size_t changed = 0;
  for (std::size_t n = first; n < first + count;) {
    const std::uint16_t before = labels_.values[n];
    std::size_t end = n + 1;
    while (end < first + count && labels_.values[end] == before) ++end;
    if (before != label) {
      record(n, end - n, before, label);
      write(n, end - n, before, label);
      changed += end - n;
    }
    n = end;
  }
  return changed;
}

void LabelEdit::record(std::size_t first, std::size_t count, std::uint16_t before,
                       std::uint16_t after) {
  if (!step_.runs.empty()) {
    VoxelRun& last = step_.runs.back();
    if (last.first + static_cast<std::size_t>(last.count) == first && last.before == before &&
        last.after == after) {
      last.count += static_cast<std::uint32_t>(count);
      return;
    }
  }
  step_.runs.push_back(
      {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count), before, after});
}

void LabelEdit::write(std::size_t first, std::size_t count, std::uint16_t before,
                      std::uint16_t after) {
  std::fill_n(labels_.values.begin() + static_cast<std::ptrdiff_t>(first), count, after);
  ++version_;
  if (const auto bone = bones_.find(before); bone != bones_.end()) {
    bone->second.voxels -= count;
    bone->second.version = version_;
    if (bone->second.voxels == 0) bone->second.box = {};
  }
  if (const auto bone = bones_.find(after); bone != bones_.end()) {
    include(bone->second, first, count);
    bone->second.voxels += count;
    bone->second.version = version_;
  }
}

void LabelEdit::include(EditedLabel& bone, std::size_t first, std::size_t count) const {
  const auto w = static_cast<std::size_t>(labels_.frame.size[0]);
  const auto h = static_cast<std::size_t>(labels_.frame.size[1]);
  const std::size_t last = first + count - 1;
  std::array<std::size_t, 3> lo = {first % w, first / w % h, first / (w * h)};
  std::array<std::size_t, 3> hi = {last % w, last / w % h, last / (w * h)};
  // A run that goes on into the next row or slice spans it as a whole.
  if (lo[2] != hi[2]) lo[1] = 0, hi[1] = h - 1;
  if (lo[2] != hi[2] || lo[1] != hi[1]) lo[0] = 0, hi[0] = w - 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const int from = static_cast<int>(lo[a]), to = static_cast<int>(hi[a]) + 1;
    bone.box.lo[a] = bone.voxels == 0 ? from : std::min(bone.box.lo[a], from);
    bone.box.hi[a] = bone.voxels == 0 ? to : std::max(bone.box.hi[a], to);
  }
}

void LabelEdit::set_name(std::uint16_t label, const std::string& name) {
  const auto bone = bones_.find(label);
  step_.names.push_back({label, bone == bones_.end() ? std::string() : bone->second.name, name});
  apply_name(label, name);
}

void LabelEdit::apply_name(std::uint16_t label, const std::string& name) {
  ++version_;
  if (name.empty())
    bones_.erase(label);
  else
    bones_[label].name = name;
}

// Voxels that a label takes must find its bone, those that it leaves too: names that appear come
// before the voxels, names that go after them.
void LabelEdit::roll_back(const Step& step) {
  for (auto change = step.names.rbegin(); change != step.names.rend(); ++change)
    if (!change->before.empty()) apply_name(change->label, change->before);
  for (auto run = step.runs.rbegin(); run != step.runs.rend(); ++run)
    write(run->first, run->count, run->after, run->before);
  for (auto change = step.names.rbegin(); change != step.names.rend(); ++change)
    if (change->before.empty()) apply_name(change->label, {});
}

void LabelEdit::roll_forward(const Step& step) {
  for (const NameChange& change : step.names)
    if (!change.after.empty()) apply_name(change.label, change.after);
  for (const VoxelRun& run : step.runs) write(run.first, run.count, run.before, run.after);
  for (const NameChange& change : step.names)
    if (change.after.empty()) apply_name(change.label, {});
}

bool LabelEdit::undo() {
  cancel_step();
  if (undo_.empty()) return false;
  roll_back(undo_.back());
  held_bytes_ -= undo_.back().bytes();
  redo_.push_back(std::move(undo_.back()));
  undo_.pop_back();
  return true;
}

bool LabelEdit::redo() {
  cancel_step();
  if (redo_.empty()) return false;
  roll_forward(redo_.back());
  held_bytes_ += redo_.back().bytes();
  undo_.push_back(std::move(redo_.back()));
  redo_.pop_back();
  return true;
}

bool LabelEdit::is_changed() const {
  return now_at() != saved_at_ || (in_step_ && !(step_.runs.empty() && step_.names.empty()));
}

void LabelEdit::mark_saved() {
  if (in_step_) commit_step();
  saved_at_ = now_at();
}

}  // namespace osteon
