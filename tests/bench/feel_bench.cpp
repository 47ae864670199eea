// What the hand feels of a bone as its hull, as pieces and as a distance field, on the same
// strokes, and what a tick costs. With OSTEON_SHARED set: strokes of 20 mm over the carpal bones of
// the real wrist, each alone; else over the built-in ones. Without friction. The hand is drawn 1 mm
// under the true surface at 20 mm/s.
//   jump_pct   largest change of force in one tick, as a share of the mean force
//   click_pct  the same beyond what the true surface gives there (its distance field)
//   off_um, off_max_um  how far the tip's middle is from where it would rest on the true mesh
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "cases/open_case.h"
#include "haptic/stroke.h"
#include "osteon/base/percentiles.h"
#include "osteon/scene/tool.h"
#include "wrist_case.h"

namespace {

using namespace osteon;

const CaseDef& bones() {
  static const CaseDef def = [] {
    CaseDef all = bench::wrist_def();
    if (all.bones.empty()) {
      auto grown = open_case_def("builtin:wrist");
      if (!grown) throw std::runtime_error(grown.error().message());
      all = std::move(*grown);
    }
    CaseDef carpals;
    carpals.name = all.name;
    for (BoneDef& bone : all.bones)
      for (const char* name :
           {"scaphoid", "lunate", "triquetrum", "capitate", "hamate", "trapezium", "trapezoid"})
        if (bone.name == name) {
          bone.X_WB = {};
          carpals.bones.push_back(std::move(bone));
        }
    return carpals;
  }();
  return def;
}

std::shared_ptr<const Case> alone(std::size_t i, Felt felt) {
  static std::map<std::pair<std::size_t, Felt>, std::shared_ptr<const Case>> made;
  auto& the_case = made[{i, felt}];
  if (the_case) return the_case;
  CaseDef def;
  def.name = bones().name + "-" + std::string(to_text(felt));
  def.bones.push_back(bones().bones[i]);
  def.bones[0].felt = felt;
  return the_case = bench::built(std::move(def));
}

struct Bout {
  std::size_t bone;
  test::Stroke stroke;
};

// Three ways over each bone from its uppermost, foremost and leftmost places.
const std::vector<Bout>& bouts() {
  static const std::vector<Bout> list = [] {
    std::vector<Bout> out;
    for (std::size_t i = 0; i < bones().bones.size(); ++i) {
      const DistanceField& field = *alone(i, Felt::kField)->bones[0].field;
      for (Eigen::Index k = 0; k < 3; ++k) {
        Vec3 start = field.box().center();
        start[k] = field.box().hi[k] + 0.0005;
        if (auto stroke = test::stroke_over(field, start, Vec3::Unit((k + 1) % 3)))
          out.push_back({i, std::move(*stroke)});
      }
    }
    return out;
  }();
  return list;
}

void feel_as(benchmark::State& state, Felt felt) {
  const auto tool = std::make_shared<const Tool>(make_wrist_probe());
  Percentiles times;
  double jump = 0, click = 0, off = 0, off_max = 0, samples = 0, lost = 0;
  std::size_t count = 0;
  for (auto _ : state) {
    for (const Bout& bout : bouts()) {
      const MeshDistance mesh(bones().bones[bout.bone].mesh);
      const auto truth = test::feel(alone(bout.bone, Felt::kField), tool, bout.stroke);
      const auto felt_now = test::feel(alone(bout.bone, felt), tool, bout.stroke);
      jump = std::max(jump, test::worst_jump(felt_now));
      click = std::max(click, test::worst_click(felt_now, truth));
      for (const double us : felt_now.tick_us) times.add_ns(static_cast<std::int64_t>(1e3 * us));
      for (std::size_t i = 0; i < felt_now.proxy.size(); i += 10) {
        const double d =
            std::abs(mesh.closest(felt_now.proxy[i]).signed_distance - tool->tip_radius_m);
        off += d;
        off_max = std::max(off_max, d);
        samples += 1;
      }
      lost += static_cast<double>(felt_now.lost);
      ++count;
    }
  }
  state.counters["jump_pct"] = 100 * jump;
  state.counters["click_pct"] = 100 * click;
  state.counters["off_um"] = 1e6 * off / samples;
  state.counters["off_max_um"] = 1e6 * off_max;
  state.counters["p50_us"] = 1e-3 * times.quantile_ns(0.5);
  state.counters["p999_us"] = 1e-3 * times.quantile_ns(0.999);
  state.counters["lost"] = lost;
  state.counters["strokes"] = static_cast<double>(count);
  state.SetLabel(bones().name);
}

void feel_hull(benchmark::State& state) { feel_as(state, Felt::kHull); }
void feel_pieces(benchmark::State& state) { feel_as(state, Felt::kPieces); }
void feel_field(benchmark::State& state) { feel_as(state, Felt::kField); }

BENCHMARK(feel_hull)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(feel_pieces)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(feel_field)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
