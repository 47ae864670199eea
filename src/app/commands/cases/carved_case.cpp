#include "commands/cases/carved_case.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "cases/open_case.h"
#include "commands/support/cli_support.h"
#include "osteon/carve/carved_surface.h"
#include "osteon/carve/piece_below.h"
#include "osteon/carve/removed.h"
#include "osteon/physics/carving.h"
#include "osteon/record/recording.h"
#include "osteon/session/session.h"
#include "runs/hands/tray.h"
#include "runs/replays/recorded_case.h"

namespace osteon {
namespace {

/// A piece of bone that lies loose, without its cartilage.
struct LoosePart {
  std::uint32_t bone = 0;  ///< that it was part of
  TriMesh mesh_B;          ///< before it fell
  Pose X_BP;               ///< from there to where it lies, as that bone sees it
};

/// Surfaces of what has cuts, by their place in the case, and of loose pieces. Of a layer of
/// cartilage that is gone altogether an empty one.
struct CarvedMeshes {
  std::vector<std::optional<Result<TriMesh>>> bones, softs;
  std::vector<LoosePart> pieces;
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

// What is thinner than a cell has no surface and is left out.
void add_pieces(const Session& session, CarvedMeshes& out) {
  for (const FallenPiece& piece : session.carving()->pieces()) {
    const std::uint32_t b = piece.shape->grid().bone;
    const CarvedField* field = session.carving()->field(b);
    if (!field || b >= session.bones().count) continue;
    const auto bare =
        field->bone().bare() ? piece_below(*piece.shape, field->bone(), 0) : piece.shape;
    if (!bare) continue;
    auto mesh = bare->surface();
    if (mesh)
      out.pieces.push_back(
          {b, std::move(*mesh), session.bones().bones[b].X_WB.inverse() * piece.X_WB});
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
  if (carving) add_pieces(session, meshes);
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

/// "ulna_piece", where that is taken "ulna_piece_2" and so on.
std::string free_piece_name(const CaseDef& def, const std::string& bone) {
  const auto taken = [&](const std::string& name) {
    return std::any_of(def.bones.begin(), def.bones.end(),
                       [&](const BoneDef& b) { return b.name == name; });
  };
  std::string name = bone + "_piece";
  for (int n = 2; taken(name); ++n) name = bone + "_piece_" + std::to_string(n);
  return name;
}

// A piece lies as it lay about its bone, which is put back to its rest.
Result<void> take_pieces(std::vector<LoosePart>& pieces, CarvedCase& out) {
  if (out.def.bones.size() + pieces.size() > kMaxBones)
    return fail("has " + std::to_string(out.def.bones.size()) + " bones and " +
                    std::to_string(pieces.size()) + " loose pieces; a case has no more than " +
                    std::to_string(kMaxBones) + " bones",
                "case '" + out.def.name + "'");
  for (LoosePart& piece : pieces) {
    BoneDef bone;
    const BoneDef& from = out.def.bones[piece.bone];
    bone.name = free_piece_name(out.def, from.name);
    bone.X_WB = from.X_WB * piece.X_BP;
    bone.mesh = std::move(piece.mesh_B);
    bone.density_kg_per_m3 = from.density_kg_per_m3;
    bone.material = from.material;
    out.def.bones.push_back(std::move(bone));
    ++out.pieces;
  }
  return {};
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
  CarvedCase out{std::move(*def), *spec};
  for (std::size_t b = 0; b < meshes->bones.size() && b < out.def.bones.size(); ++b) {
    auto& mesh = meshes->bones[b];
    if (!mesh) continue;
    if (!*mesh) return tl::unexpected(mesh->error());
    out.def.bones[b].mesh = std::move(**mesh);
    ++out.carved;
  }
  if (auto ok = take_pieces(meshes->pieces, out); !ok) return tl::unexpected(ok.error());
  take_layers(*meshes, out.def);
  if (out.carved > 0) out.def.recipe.reset();  // it could not be grown again
  return out;
}

}  // namespace osteon
