#include "cases/piece_work.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cases/all_cores.h"
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
  run_on_all_cores(
      tasks.size(), [&](std::size_t i) { work_on(tasks[i], def.bones[tasks[i].bone].mesh); },
      progress);
  for (Task& task : tasks) {
    if (task.pieces) pieces.put(task.key, std::move(*task.pieces));
    if (task.made_field) fields.put(task.key, std::move(task.made_field));
  }
}

}  // namespace osteon
