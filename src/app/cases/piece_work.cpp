#include "cases/piece_work.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "cases/all_cores.h"
#include "osteon/base/log.h"
#include "osteon/scene/bone_cover.h"
#include "osteon/scene/bone_pieces.h"
#include "osteon/scene/wide_field.h"

namespace osteon {
namespace {

struct Task {
  std::size_t bone;
  std::uint64_t key;
  bool field = false;
  std::optional<PieceCorners> pieces;
  FieldCache::Field made_field;
};

/// Passes a stop from the caller's progress, which throws, on to the tasks of all threads.
class Stopping {
 public:
  explicit Stopping(const std::function<void(double)>& progress) : progress_(progress) {}

  /// On the calling thread.
  void tell(double share) {
    share_ = share;
    try {
      progress_(share);
    } catch (...) {
      stopped_ = true;
      throw;
    }
  }
  /// On any thread, from within a task. A task on the calling thread may last minutes, so it asks.
  bool stopped() {
    if (stopped_ || std::this_thread::get_id() != caller_) return stopped_;
    try {
      progress_(share_);
    } catch (...) {
      stopped_ = true;
      why_ = std::current_exception();
    }
    return stopped_;
  }
  void rethrow() const {
    if (why_) std::rethrow_exception(why_);
  }

 private:
  const std::function<void(double)>& progress_;
  std::thread::id caller_ = std::this_thread::get_id();
  double share_ = 0;
  std::atomic<bool> stopped_{false};
  std::exception_ptr why_;
};

void work_on(Task& task, const BoneDef& bone, Stopping& stopping) {
  if (!task.field) {
    DecomposeOptions options;
    options.stop = [&] { return stopping.stopped(); };
    task.pieces = cut_into_pieces(bone.mesh, options);
    return;
  }
  auto made = make_felt_field(bone);
  if (made) task.made_field = std::make_shared<const DistanceField>(std::move(*made));
}

void say_coarser(const BoneDef& bone, const PieceCorners& pieces) {
  char height[32];
  std::snprintf(height, sizeof height, "%.1f mm", 1000 * pieces.concavity_m);
  log(LogLevel::kWarning,
      "bone '" + bone.name + "' is too large or too complex for fine pieces: they " +
          "extend up to " + height + " beyond it. Set felt = \"field\" to feel its true surface.");
}

std::vector<Task> unknown(const CaseDef& def, PieceCache& pieces, FieldCache& fields) {
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < def.bones.size(); ++i) {
    const BoneDef& bone = def.bones[i];
    const std::uint64_t cut_key = piece_key(bone.mesh);
    if (bone.felt != Felt::kHull && !pieces.find(cut_key))
      tasks.push_back({i, cut_key, false, std::nullopt, nullptr});
    if (!is_field(bone.felt)) continue;
    const std::uint64_t key = field_key(bone);
    if (!fields.find(key)) tasks.push_back({i, key, true, std::nullopt, nullptr});
  }
  // The largest first, so that no worker is left alone with it at the end.
  std::stable_sort(tasks.begin(), tasks.end(), [&](const Task& a, const Task& b) {
    return def.bones[a.bone].mesh.triangles.size() > def.bones[b.bone].mesh.triangles.size();
  });
  return tasks;
}

}  // namespace

bool is_known(const BoneDef& bone, PieceCache& pieces, FieldCache& fields) {
  if (bone.felt == Felt::kHull) return true;
  if (!pieces.find(piece_key(bone.mesh))) return false;
  return !is_field(bone.felt) ||
         (fields.find(field_key(bone)) && fields.find(field_key(bone, wide_field_options())));
}

void find_what_is_felt(const CaseDef& def, PieceCache& pieces, FieldCache& fields,
                       const std::function<void(double)>& progress) {
  std::vector<Task> tasks = unknown(def, pieces, fields);
  if (tasks.empty()) return;
  Stopping stopping(progress);
  run_on_all_cores(
      tasks.size(), [&](std::size_t i) { work_on(tasks[i], def.bones[tasks[i].bone], stopping); },
      [&](double share) {
        stopping.rethrow();
        stopping.tell(share);
      });
  stopping.rethrow();
  for (Task& task : tasks) {
    if (task.pieces && task.pieces->coarser) say_coarser(def.bones[task.bone], *task.pieces);
    if (task.pieces) pieces.put(task.key, std::move(*task.pieces));
    if (task.made_field) fields.put(task.key, std::move(task.made_field));
  }
}

}  // namespace osteon
