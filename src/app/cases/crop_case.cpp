#include "cases/crop_case.h"

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "cases/all_cores.h"
#include "osteon/scene/bone_cover.h"
#include "osteon/scene/bone_pieces.h"
#include "osteon/scene/field_cache.h"
#include "osteon/scene/piece_cache.h"

namespace osteon {
namespace {

constexpr double kCroppedCell_m = 0.0005;

// Keeps of each triangle what lies before the plane. Places on its edges are made once, from the
// lower to the higher vertex, so that neighbours share them.
class PlaneCut {
 public:
  PlaneCut(const TriMesh& mesh, const Vec3& n, double c) : mesh_(mesh) {
    for (const Vec3& v : mesh.vertices) beyond_.push_back(n.dot(v) - c);
    out_.vertices = mesh.vertices;
  }

  TriMesh run() {
    for (const Triangle& t : mesh_.triangles) keep(t);
    close_ends();
    drop_unused();
    return std::move(out_);
  }

 private:
  bool is_kept(std::uint32_t v) const { return beyond_[v] <= 0; }

  std::uint32_t between(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto [at, made] =
        on_edge_.try_emplace({a, b}, static_cast<std::uint32_t>(out_.vertices.size()));
    if (made) {
      const double share = beyond_[a] / (beyond_[a] - beyond_[b]);
      out_.vertices.push_back(mesh_.vertices[a] + share * (mesh_.vertices[b] - mesh_.vertices[a]));
    }
    return at->second;
  }

  void keep(const Triangle& t) {
    std::vector<std::uint32_t> corners;
    std::array<std::uint32_t, 2> rim{};
    bool crossed = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (is_kept(a)) corners.push_back(a);
      if (is_kept(a) == is_kept(b)) continue;
      const std::uint32_t at = between(a, b);
      corners.push_back(at);
      rim[is_kept(a) ? 0 : 1] = at;  // out of what is kept, then back into it
      crossed = true;
    }
    for (std::size_t k = 2; k < corners.size(); ++k)
      out_.triangles.push_back({corners[0], corners[k - 1], corners[k]});
    if (crossed) next_[rim[1]] = rim[0];
  }

  // Rims run round against the triangles beside them.
  void close_ends() {
    while (!next_.empty()) {
      std::vector<std::uint32_t> loop;
      for (auto at = next_.begin(); at != next_.end(); at = next_.find(loop.back())) {
        if (loop.empty()) loop.push_back(at->first);
        loop.push_back(at->second);
        next_.erase(at);
      }
      Vec3 middle = Vec3::Zero();
      for (std::size_t k = 1; k < loop.size(); ++k) middle += out_.vertices[loop[k]];
      const auto center = static_cast<std::uint32_t>(out_.vertices.size());
      out_.vertices.push_back(middle / static_cast<double>(loop.size() - 1));
      for (std::size_t k = 1; k < loop.size(); ++k)
        out_.triangles.push_back({loop[k - 1], loop[k], center});
    }
  }

  void drop_unused() {
    constexpr std::uint32_t kUnused = 0xffffffffu;
    std::vector<std::uint32_t> to(out_.vertices.size(), kUnused);
    std::vector<Vec3> kept;
    for (Triangle& t : out_.triangles)
      for (std::uint32_t& v : t) {
        if (to[v] == kUnused) {
          to[v] = static_cast<std::uint32_t>(kept.size());
          kept.push_back(out_.vertices[v]);
        }
        v = to[v];
      }
    out_.vertices = std::move(kept);
  }

  const TriMesh& mesh_;
  std::vector<double> beyond_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> on_edge_;
  std::map<std::uint32_t, std::uint32_t> next_;
  TriMesh out_;
};

}  // namespace

TriMesh cut_off(const TriMesh& mesh, const Vec3& n, double c) { return PlaneCut(mesh, n, c).run(); }

Result<void> crop_knee(CaseDef& def, double near_m) {
  if (!def.recipe || def.recipe->anatomy != "knee")
    return fail("only a generated knee can be cropped", "case '" + def.name + "'",
                "Leave out 'near'");
  for (BoneDef& bone : def.bones) {
    if (bone.name != "femur" && bone.name != "tibia") continue;
    const Vec3 away(bone.name == "femur" ? -1 : 1, 0, 0);
    TriMesh left = cut_off(bone.mesh, away, near_m);
    if (left.triangles.empty())
      return fail("no part of the " + bone.name + " is that close to the joint",
                  "case '" + def.name + "'");
    bone.mesh = std::move(left);
  }
  return {};
}

void prepare_cropped(const CaseDef& def, PieceCache& pieces, FieldCache& fields) {
  FieldOptions coarse;
  coarse.cell_m = kCroppedCell_m;
  // A cache is asked on one thread: it reads its file when it is first asked.
  std::vector<const BoneDef*> bones, unknown;
  for (const BoneDef& bone : def.bones)
    if (is_field(bone.felt) && !bone.beside) bones.push_back(&bone);
  for (const BoneDef* bone : bones)
    if (!fields.find(field_key(*bone))) unknown.push_back(bone);
  std::vector<FieldCache::Field> made(unknown.size());
  run_on_all_cores(
      unknown.size(),
      [&](std::size_t i) {
        auto field = make_felt_field(*unknown[i], coarse);
        if (field) made[i] = std::make_shared<const DistanceField>(std::move(*field));
      },
      [](double) {});
  for (std::size_t i = 0; i < unknown.size(); ++i)
    if (made[i]) fields.put(field_key(*unknown[i]), made[i]);
  for (const BoneDef* bone : bones)
    pieces.put(piece_key(bone->mesh), PieceCorners{{bone->mesh.vertices}, 0, false});
}

}  // namespace osteon
