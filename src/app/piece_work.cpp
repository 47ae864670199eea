#include "piece_work.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "osteon/scene/bone_pieces.h"

namespace osteon {
namespace {

struct Task {
  std::size_t bone;
  std::uint64_t key;
  bool field = false;
  std::optional<PieceCorners> pieces;
  FieldCache::Field made_field;
};

void work_on(Task& task, const TriMesh& mesh) {
  if (!task.field) {
    task.pieces = cut_into_pieces(mesh);
    return;
  }
  auto made = DistanceField::make(mesh);
  if (made) task.made_field = std::make_shared<const DistanceField>(std::move(*made));
}

// Workers that take the next task until none is left, or until they are told to stop.
class Workers {
 public:
  Workers(const CaseDef& def, std::vector<Task>& tasks) : def_(def), tasks_(tasks) {}
  ~Workers() {
    next_ = tasks_.size();
    for (std::thread& thread : threads_) thread.join();
  }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  void start(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      threads_.emplace_back([this] {
        while (work_once()) {
        }
      });
  }
  bool work_once() {
    const std::size_t i = next_.fetch_add(1);
    if (i >= tasks_.size()) return false;
    Task& task = tasks_[i];
    work_on(task, def_.bones[task.bone].mesh);
    ++done_;
    return true;
  }
  void wait() {
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
  }
  std::size_t done() const { return done_; }

 private:
  const CaseDef& def_;
  std::vector<Task>& tasks_;
  std::atomic<std::size_t> next_{0};
  std::atomic<std::size_t> done_{0};
  std::vector<std::thread> threads_;
};

std::vector<Task> unknown(const CaseDef& def, PieceCache& pieces, FieldCache& fields) {
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < def.bones.size(); ++i) {
    const BoneDef& bone = def.bones[i];
    const std::uint64_t cut_key = piece_key(bone.mesh);
    if (bone.felt != Felt::kHull && !pieces.find(cut_key))
      tasks.push_back({i, cut_key, false, std::nullopt, nullptr});
    if (bone.felt != Felt::kField) continue;
    const std::uint64_t key = field_key(bone.mesh);
    if (!fields.find(key)) tasks.push_back({i, key, true, std::nullopt, nullptr});
  }
  // The largest first, so that no worker is left alone with it at the end.
  std::stable_sort(tasks.begin(), tasks.end(), [&](const Task& a, const Task& b) {
    return def.bones[a.bone].mesh.triangles.size() > def.bones[b.bone].mesh.triangles.size();
  });
  return tasks;
}

}  // namespace

void find_what_is_felt(const CaseDef& def, PieceCache& pieces, FieldCache& fields,
                       const std::function<void(double)>& progress) {
  std::vector<Task> tasks = unknown(def, pieces, fields);
  if (tasks.empty()) return;
  {
    Workers workers(def, tasks);
    const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
    workers.start(std::min(cores, tasks.size()) - 1);
    do {
      progress(static_cast<double>(workers.done()) / static_cast<double>(tasks.size()));
    } while (workers.work_once());
    workers.wait();
  }
  for (Task& task : tasks) {
    if (task.pieces) pieces.put(task.key, std::move(*task.pieces));
    if (task.made_field) fields.put(task.key, std::move(task.made_field));
  }
}

}  // namespace osteon
