#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>
#include "commands/support/parser.h"

#include "cases/all_cores.h"
#include "cases/case_bone.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "osteon/base/clock.h"
#include "osteon/base/percentiles.h"
#include "osteon/carve/carved_surface.h"
#include "osteon/carve/loose_pieces.h"
#include "osteon/carve/removed.h"
#include "osteon/mesh/mesh_io.h"
#include "osteon/scene/path.h"

namespace osteon {
namespace {

struct CarveCommand {
  std::string bone, tool, path, out;
  double size_mm = 0, cell_mm = 0.25, cortex_mm = 1.2, marrow_mm = 0;
  int memory_mb = 512;
  bool json = false;
};

/// What carving took and gave.
struct Carved {
  std::uint64_t steps = 0;
  Percentiles step_time, surface_time;
  ByTissue removed_m3{};
  std::size_t blocks = 0;
  double dust_m3 = 0;             ///< loose and removed, in removed_m3 too
  std::vector<double> pieces_m3;  ///< loose and larger: in the mesh beside the bone
  TriMesh mesh;                   ///< of the bone alone, without its cartilage
};

constexpr double kTick_s = 0.001;        // the hand's
constexpr double kPicture_s = 1.0 / 60;  // the window's
constexpr double kShortest_m = 0.00002;  // a shorter way needs no step of its own

/// Places at which the hand stands, a millisecond apart where it moves.
std::size_t steps_between(const PathSample& a, const PathSample& b) {
  const double turn = (a.X_WD.q.coeffs() - b.X_WD.q.coeffs()).norm();
  const double way = (a.X_WD.p - b.X_WD.p).norm() + 0.05 * turn;
  const double most = std::ceil((b.time_s - a.time_s) / kTick_s);
  return static_cast<std::size_t>(std::max(1.0, std::min(most, std::ceil(way / kShortest_m))));
}

class Carver {
 public:
  Carver(CarvedField field, Cutter cutter, const Pose& X_BW)
      : field_(std::move(field)), surface_(field_), cutter_(std::move(cutter)), X_BW_(X_BW) {}

  Result<Carved> follow(const ProbePath& path) {
    last_ = X_BW_ * path.samples.front().X_WD;
    if (auto done = step(last_, path.samples.front().time_s); !done)
      return tl::unexpected(done.error());
    for (std::size_t n = 1; n < path.samples.size(); ++n)
      if (auto done = follow(path, n); !done) return tl::unexpected(done.error());
    clear_dust();
    picture();
    out_.removed_m3 = removed_volume(field_);
    out_.blocks = field_.block_count();
    const auto& bare = field_.bone().bare();
    auto mesh = bare ? carved_mesh(field_, bare) : carved_mesh(field_);
    if (!mesh) return tl::unexpected(mesh.error());
    out_.mesh = std::move(*mesh);
    return std::move(out_);
  }

 private:
  /// From the sample before to this one.
  Result<void> follow(const ProbePath& path, std::size_t n) {
    const PathSample &a = path.samples[n - 1], &b = path.samples[n];
    // A punch bites where it is put, not on the way.
    const std::size_t steps = cutter_.bites ? 1 : steps_between(a, b);
    for (std::size_t s = 1; s <= steps; ++s) {
      const double share = static_cast<double>(s) / static_cast<double>(steps);
      const PathSample at = s == steps ? b : path.at(a.time_s + share * (b.time_s - a.time_s));
      if (auto done = step(X_BW_ * at.X_WD, at.time_s); !done) return done;
    }
    return {};
  }

  Result<void> step(const Pose& X_BT, double time_s) {
    const std::int64_t before = steady_now_ns();
    const CarveStep did = field_.cut(cutter_, cutter_.bites ? X_BT : last_, X_BT);
    out_.step_time.add_ns(steady_now_ns() - before);
    ++out_.steps;
    last_ = X_BT;
    if ((did.status & CarveStep::kBlocksFull) != 0)
      return fail("the cuts need more memory than is allowed", "carve",
                  "Allow more with --memory-mb, or choose larger cells with --cell");
    if (did.status & (CarveStep::kTooLong | CarveStep::kNotFinite))
      return fail("the path jumps too far at " + std::to_string(time_s) + " s", "carve",
                  "Give poses that are closer together");
    if (time_s - pictured_s_ >= kPicture_s) {
      pictured_s_ = time_s;
      picture();
    }
    return {};
  }

  /// What hangs on nothing stays where it is when it is large enough to be a body.
  void clear_dust() {
    constexpr double kDust_m3 = 5e-9, kAround_m = 0.001;
    if (field_.block_count() == 0) return;
    LoosePieces loose(field_);
    for (const LoosePiece& piece : loose.find(field_)) {
      const bool dust = piece.volume_m3 < kDust_m3;
      if (dust && loose.take_away(field_, piece, kAround_m))
        out_.dust_m3 += piece.volume_m3;
      else
        out_.pieces_m3.push_back(piece.volume_m3);
    }
  }

  void picture() {
    const std::int64_t before = steady_now_ns();
    const bool any = !surface_.update(field_).empty();
    if (any) out_.surface_time.add_ns(steady_now_ns() - before);
  }

  CarvedField field_;
  CarvedSurface surface_;
  Cutter cutter_;
  Pose X_BW_, last_;
  double pictured_s_ = -1e300;
  Carved out_;
};

/// The bone's field and what of the memory is left for cuts.
Result<CarvedField> make_field(const CaseBone& source, const CarveCommand& command) {
  const auto layers = bone_layers(command.cortex_mm / 1000, command.marrow_mm / 1000);
  if (!layers) return tl::unexpected(layers.error());
  UncutFieldOptions options;
  options.cell_m = command.cell_mm / 1000;
  options.most_bytes = static_cast<std::size_t>(command.memory_mb) << 20;
  options.run = [](std::size_t count, const std::function<void(std::size_t)>& task) {
    run_on_all_cores(count, task, [](double) {});
  };
  auto field = source.covered ? UncutField::make(*source.covered, options)
                              : UncutField::make(source.bone.mesh, options);
  if (!field) return tl::unexpected(field.error());
  const std::size_t bytes_of_block = source.covered ? 3328 : 2304;
  const std::size_t left = options.most_bytes - std::min((*field)->bytes(), options.most_bytes);
  const std::size_t blocks = std::min(CarvedField::kMostBlocks * 4, left / bytes_of_block);
  if (blocks == 0)
    return fail("there is not enough memory for cuts", command.bone, "Allow more with --memory-mb");
  return CarvedField::make(std::move(*field), *layers, blocks);
}

Result<void> check_size(const BoneDef& bone, const Cutter& cutter) {
  Aabb box;
  for (const Vec3& v : bone.mesh.vertices) box.include(v);
  if (cutter.size_m <= box.extent().maxCoeff()) return {};
  return fail("the tool is larger than the bone", cutter.name,
              "Give its diameter in mm: " + bone.name + " measures " +
                  std::to_string(std::lround(1e3 * box.extent().maxCoeff())) + " mm");
}

Result<Carved> carve(const CaseBone& source, const CarveCommand& command) {
  auto cutter = make_cutter(command.tool, command.size_mm / 1000);
  if (!cutter) return tl::unexpected(cutter.error());
  if (auto fits = check_size(source.bone, *cutter); !fits) return tl::unexpected(fits.error());
  const auto path = load_path(command.path);
  if (!path) return tl::unexpected(path.error());
  if (path->samples.empty()) return fail("the path has no poses", command.path);
  auto field = make_field(source, command);
  if (!field) {
    Error error = field.error();
    error.where = command.bone;
    return tl::unexpected(error);
  }
  return Carver(std::move(*field), std::move(*cutter), source.bone.X_WB.inverse()).follow(*path);
}

nlohmann::json to_json(const Carved& carved) {
  nlohmann::json tissues = nlohmann::json::object();
  for (std::size_t t = 0; t < kBoneTissues; ++t)
    tissues[std::string(to_text(static_cast<BoneTissue>(t)))] = 1e9 * carved.removed_m3[t];
  nlohmann::json pieces = nlohmann::json::array();
  for (const double piece : carved.pieces_m3) pieces.push_back(1e9 * piece);
  const auto us = [&](double q) { return 1e-3 * carved.step_time.quantile_ns(q); };
  return {{"removed_mm3", 1e9 * total(carved.removed_m3)},
          {"removed_by_tissue_mm3", tissues},
          {"dust_mm3", 1e9 * carved.dust_m3},
          {"pieces_mm3", pieces},
          {"steps", carved.steps},
          {"step_us", {{"p50", us(0.5)}, {"p99", us(0.99)}, {"p999", us(0.999)}}},
          {"surface_us", 1e-3 * carved.surface_time.quantile_ns(0.5)},
          {"blocks", carved.blocks}};
}

void print(const Carved& carved, const CaseBone& source, const CarveCommand& command) {
  std::printf("%s: %.2f mm^3 removed in %llu steps\n", source.bone.name.c_str(),
              1e9 * total(carved.removed_m3), static_cast<unsigned long long>(carved.steps));
  for (std::size_t t = 0; t < kBoneTissues; ++t)
    if (carved.removed_m3[t] > 0)
      std::printf("  %-16s %.2f mm^3\n", std::string(to_text(static_cast<BoneTissue>(t))).c_str(),
                  1e9 * carved.removed_m3[t]);
  if (carved.dust_m3 > 0)
    std::printf("  %.2f mm^3 of it was no longer connected and fell off as dust\n",
                1e9 * carved.dust_m3);
  for (const double piece : carved.pieces_m3)
    std::printf("  a piece of %.2f mm^3 is cut off; it stays in the file\n", 1e9 * piece);
  std::printf("  a step           %.1f us (median), %.1f us (p99.9)\n",
              1e-3 * carved.step_time.quantile_ns(0.5), 1e-3 * carved.step_time.quantile_ns(0.999));
  std::printf("%s written, in %s\n", command.out.c_str(), source.unit.c_str());
}

int run_carve(const CarveCommand& command) {
  const auto source = load_case_bone(command.bone, true);
  if (!source) return report_error(source.error());
  const auto carved = carve(*source, command);
  if (!carved) return report_error(carved.error());
  if (auto saved = save_stl(carved->mesh, command.out, source->metres_per_unit); !saved)
    return report_error(saved.error());
  if (command.json)
    std::puts(to_json(*carved).dump(2).c_str());
  else
    print(*carved, *source, command);
  if (total(carved->removed_m3) == 0)
    std::fprintf(stderr, "osteon: the path does not touch the bone: nothing was removed\n");
  return kExitDone;
}

std::string tool_help() {
  std::string text = "cutting tool:";
  for (const CutterKind& kind : cutter_kinds())
    text += (text.back() == ':' ? " " : ", ") + std::string(kind.name);
  return text;
}

}  // namespace

void add_carve_command(cli::App& app, int& exit_code) {
  auto command = std::make_shared<CarveCommand>();
  cli::App* carve = app.add_subcommand(
      "carve", "Move a cutting tool along a path through a bone and save the remaining bone");
  carve->add_option("CASE#BONE", command->bone, "case and bone, such as builtin:knee#femur")
      ->required();
  carve->add_option("--tool", command->tool, tool_help())->required();
  carve->add_option("--size", command->size_mm, "diameter of the tool, or width of a blade, mm")
      ->required();
  carve
      ->add_option("--path", command->path,
                   "the tool's poses in World (CSV, see docs/file-formats.md)")
      ->required();
  carve
      ->add_option("--out", command->out,
                   "STL file to write, in the bone's own frame and the case's unit")
      ->required();
  carve
      ->add_option("--cell", command->cell_mm,
                   "edge of a cell, mm; smaller cells show finer cuts and take more memory")
      ->capture_default_str();
  carve->add_option("--cortex", command->cortex_mm, "thickness of the cortical bone, mm")
      ->capture_default_str();
  carve
      ->add_option("--marrow", command->marrow_mm,
                   "depth below the surface at which marrow begins, mm; 0: no marrow")
      ->capture_default_str();
  carve->add_option("--memory-mb", command->memory_mb, "memory limit for the cuts, MiB")
      ->check(cli::Range(1, 65536))
      ->capture_default_str();
  carve->add_flag("--json", command->json, "print the result as JSON");
  carve->callback([command, &exit_code] { exit_code = run_carve(*command); });
}

}  // namespace osteon
