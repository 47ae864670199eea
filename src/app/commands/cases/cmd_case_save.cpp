#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/noted_case.h"
#include "cases/open_case.h"
#include "cases/whole_folder.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/number_check.h"
#include "commands/support/parser.h"
#include "osteon/carve/carved_surface.h"
#include "osteon/carve/removed.h"
#include "osteon/physics/carving.h"
#include "osteon/record/recording.h"
#include "osteon/session/session.h"
#include "runs/hands/tray.h"
#include "runs/replays/recorded_case.h"

namespace osteon {
namespace {

struct CaseSaveCommand {
  std::string recording, case_spec, out;
  double at_s = 0;
};

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

Result<CarvedMeshes> replay_to(RecordingReader& recording, const CaseSaveCommand& command,
                               const std::string& spec) {
  auto the_case = open_and_show_progress(spec, parts_of(recording.header()));
  if (!the_case) return tl::unexpected(the_case.error());
  ReplayOptions how;
  if (auto ready = take_instruments(recording.header(), **the_case, how); !ready)
    return tl::unexpected(ready.error());
  CarvedMeshes meshes;
  double reached_s = 0;
  how.from_s = how.to_s = command.at_s;
  how.at_end = [&](const Session& session) {
    meshes = meshes_of(session);
    reached_s = session.tool_state().time_s;
  };
  const auto outcome = replay(recording, *the_case, how);
  if (!outcome) return tl::unexpected(outcome.error());
  if (!outcome->identical)
    return fail("the replay differs from the recording", command.recording,
                "Use the version of Osteon that made it, with the same case");
  constexpr double kNear_s = 0.005;
  if (reached_s + kNear_s < command.at_s)
    return fail("the recording ends at " + std::to_string(reached_s) + " s", command.recording,
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

int run_save(const CaseSaveCommand& command) {
  const auto out = plain_folder(command.out);
  if (const auto free = refuse_existing(out); !free) return report_error(free.error());
  auto recording = RecordingReader::open(command.recording);
  if (!recording) return report_error(recording.error());
  const auto spec = recorded_case_spec(command.recording, command.case_spec, recording->header());
  if (!spec) return report_error(spec.error());
  auto meshes = replay_to(*recording, command, *spec);
  if (!meshes) return report_error(meshes.error());
  auto def = open_case_def(*spec);
  if (!def) return report_error(def.error());
  std::size_t carved = 0;
  for (std::size_t b = 0; b < meshes->bones.size() && b < def->bones.size(); ++b) {
    auto& mesh = meshes->bones[b];
    if (!mesh) continue;
    if (!*mesh) return report_error(mesh->error());
    def->bones[b].mesh = std::move(**mesh);
    ++carved;
  }
  take_layers(*meshes, *def);
  if (carved > 0) def->recipe.reset();  // it could not be grown again
  const auto notes = notes_of(*spec);
  if (!notes) return report_error(notes.error());
  const auto saved = save_noted_case(*def, *notes, out);
  if (!saved) return report_error(saved.error());
  std::printf("%zu carved bone%s at %g s -> %s\n", carved, carved == 1 ? "" : "s", command.at_s,
              out.string().c_str());
  return kExitDone;
}

}  // namespace

void add_case_save(cli::App& group, int& exit_code) {
  cli::App* save =
      group.add_subcommand("save", "Save the bones of a recording at a given moment as a new case");
  auto command = std::make_shared<CaseSaveCommand>();
  save->add_option("recording", command->recording, "a recording (.osr)")->required();
  save->add_option("--at", command->at_s, "seconds from the recording's start")
      ->required()
      ->check(refuse_negative);
  save->add_option("--case", command->case_spec, "the case; default: the recording's own");
  save->add_option("--out", command->out, "the case folder to make")->required();
  save->callback([command, &exit_code] { exit_code = run_save(*command); });
}

}  // namespace osteon
