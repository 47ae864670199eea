#include "commands/cases/carved_case.h"

#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include "cases/open_case.h"
#include "commands/support/cli_support.h"
#include "osteon/carve/carved_surface.h"
#include "osteon/carve/removed.h"
#include "osteon/physics/carving.h"
#include "osteon/record/recording.h"
#include "osteon/session/session.h"
#include "runs/hands/tray.h"
#include "runs/replays/recorded_case.h"

namespace osteon {
namespace {

/// Surfaces of what has cuts, by their place in the case. Of a layer of cartilage that is gone
/// altogether an empty one.
struct CarvedMeshes {
  std::vector<std::optional<Result<TriMesh>>> bones, softs;
};

/// What is left of the layers on a bone, in World at rest.
void add_layers(const CarvedField& field, const std::vector<CarvedLayer>& layers, const Case& of,
                CarvedMeshes& out) {
  for (const CarvedLayer& layer : layers) {
    const Pose X_BW = layer.X_WB.inverse();
    TriMesh mesh_B = of.softs[layer.soft].mesh_W;
    for (Vec3& v : mesh_B.vertices) v = X_BW * v;
    auto uncut = field.bone().make_beside(mesh_B);
    if (!uncut) continue;  // it was left out of what is felt as well
    const auto same = same_cuts(field, std::move(*uncut));
    if (!same || total(removed_volume(*same)) == 0) continue;
    auto left = carved_mesh(*same);
    TriMesh mesh_W = left ? std::move(*left) : TriMesh{};
    for (Vec3& v : mesh_W.vertices) v = layer.X_WB * v;
    out.softs[layer.soft] = std::move(mesh_W);
  }
}

CarvedMeshes meshes_of(const Session& session) {
  CarvedMeshes meshes;
  meshes.bones.resize(session.the_case().bones.size());
  meshes.softs.resize(session.the_case().softs.size());
  const Carving* carving = session.carving();
  for (std::size_t b = 0; carving && b < meshes.bones.size(); ++b) {
    const CarvedField* field = carving->field(b);
    if (!field || field->block_count() == 0) continue;
    const auto& bare = field->bone().bare();
    meshes.bones[b] = bare ? carved_mesh(*field, bare) : carved_mesh(*field);
    const auto& layers = carving->setup().layers_on;
    if (bare && b < layers.size()) add_layers(*field, layers[b], session.the_case(), meshes);
  }
  return meshes;
}

Result<CarvedMeshes> replay_to(RecordingReader& recording, const std::string& file,
                               std::optional<double> at_s, const std::string& spec) {
  auto the_case = open_and_show_progress(spec, parts_of(recording.header()));
  if (!the_case) return tl::unexpected(the_case.error());
  ReplayOptions how;
  if (auto ready = take_instruments(recording.header(), **the_case, how); !ready)
    return tl::unexpected(ready.error());
  CarvedMeshes meshes;
  double reached_s = 0;
  if (at_s) how.from_s = how.to_s = *at_s;
  how.at_end = [&](const Session& session) {
    meshes = meshes_of(session);
    reached_s = session.tool_state().time_s;
  };
  const auto outcome = replay(recording, *the_case, how);
  if (!outcome) return tl::unexpected(outcome.error());
  if (!outcome->identical)
    return fail("the replay differs from the recording", file,
                "Use the version of Osteon that made it, with the same case");
  constexpr double kNear_s = 0.005;
  if (at_s && reached_s + kNear_s < *at_s)
    return fail("the recording ends at " + std::to_string(reached_s) + " s", file,
                "Give an earlier time with --at");
  return meshes;
}

void take_layers(CarvedMeshes& meshes, CaseDef& def) {
  for (std::size_t s = std::min(meshes.softs.size(), def.softs.size()); s-- > 0;) {
    if (!meshes.softs[s]) continue;
    def.softs[s].mesh_W = std::move(**meshes.softs[s]);
    if (def.softs[s].mesh_W.triangles.empty())
      def.softs.erase(def.softs.begin() + static_cast<std::ptrdiff_t>(s));
  }
}

}  // namespace

Result<CarvedCase> carved_case(const std::string& recording_file, const std::string& case_spec,
                               std::optional<double> at_s, CaseParts parts) {
  auto recording = RecordingReader::open(recording_file);
  if (!recording) return tl::unexpected(recording.error());
  const auto spec = recorded_case_spec(recording_file, case_spec, recording->header());
  if (!spec) return tl::unexpected(spec.error());
  auto meshes = replay_to(*recording, recording_file, at_s, *spec);
  if (!meshes) return tl::unexpected(meshes.error());
  auto def = open_case_def(*spec, {}, parts);
  if (!def) return tl::unexpected(def.error());
  CarvedCase out{std::move(*def), *spec, 0};
  for (std::size_t b = 0; b < meshes->bones.size() && b < out.def.bones.size(); ++b) {
    auto& mesh = meshes->bones[b];
    if (!mesh) continue;
    if (!*mesh) return tl::unexpected(mesh->error());
    out.def.bones[b].mesh = std::move(**mesh);
    ++out.carved;
  }
  take_layers(*meshes, out.def);
  if (out.carved > 0) out.def.recipe.reset();  // it could not be grown again
  return out;
}

}  // namespace osteon
