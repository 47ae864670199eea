#pragma once

#include <memory>

#include "osteon/scene/graft_bench.h"
#include "ring_box.h"

namespace osteon::testing {

/// A bench with blocks for its parts: tendons of 280 and 260 mm along +x from x = 0, two bands on
/// the first, one on the second; a channel of 40 mm, a socket of 26 mm. `fields`: the thigh, 110 mm
/// of it, is felt as a field.
inline CaseDef bench_def(bool fields = false) {
  CaseDef def;
  def.name = "bench";
  def.bones.push_back(block_at("thigh", {0, -0.03, -0.024}, {fields ? 0.11 : 0.35, 0.03, 0}));
  def.bones.push_back(block_at("graft", {-0.02, -0.164, -0.004}, {0.05, -0.156, 0.004}));
  def.bones.push_back(block_at("board", {-0.01, -0.235, -0.005}, {0.05, -0.225, 0.005}));
  if (fields) def.bones[0].felt = Felt::kField;
  const auto mark = [&](const char* name, double x, double y, double z) {
    def.landmarks.push_back({name, Vec3(0.001 * x, 0.001 * y, 0.001 * z)});
  };
  mark("st_insertion", 0, 12, -8);
  mark("st_side", 0, 12, -5.91);
  mark("st_end", 280, 12, -8);
  mark("st_band_1", 60, 12, 0);
  mark("st_band_2", 85, 12, 0);
  mark("st_free", -20, -70, -4);
  mark("gr_insertion", 0, -12, -8);
  mark("gr_side", 0, -12, -6.367);
  mark("gr_end", 260, -12, -8);
  mark("gr_band_1", 70, -12, 0);
  mark("gr_free", -20, -95, -4);
  mark("fold_2", 20, -80, 0);
  mark("fold_3", 45, -80, 0);
  mark("fold_4", 70, -80, 0);
  mark("graft_from", -20, -160, 0);
  mark("graft_to", 30, -160, 0);
  mark("hook", -30, -160, 0);
  mark("board_from", -10, -230, 0);
  mark("board_to", 40, -230, 0);
  mark("channel_from", 0, -250, 0);
  mark("socket_to", 26, -250, 0);
  mark("channel_to", 40, -250, 0);
  return def;
}

/// The same with fascia over the tendons, opened along 6 to 42 mm between them.
inline CaseDef covered_bench_def(bool fields = false) {
  CaseDef def = bench_def(fields);
  def.landmarks.push_back({"fascia_from", Vec3(0.006, 0, 0)});
  def.landmarks.push_back({"fascia_to", Vec3(0.042, 0, 0)});
  return def;
}

inline std::shared_ptr<const Case> bench_case(CaseDef def = bench_def()) {
  auto built = build_case(std::move(def));
  if (!built) return nullptr;
  return std::make_shared<const Case>(std::move(*built));
}

/// Both tendons stripped whole, clean, stitched and folded.
inline GraftBenchState folded_bench(std::uint32_t st, std::uint32_t gr) {
  GraftBenchState state;
  state.on = true;
  for (TendonOnBench& tendon : state.tendons) {
    tendon.stripped = true;
    tendon.scraped_m = kScrapedClean_m;
    tendon.stitches = 0b11111;
  }
  state.tendons[0].folds = st;
  state.tendons[1].folds = gr;
  return state;
}

}  // namespace osteon::testing
