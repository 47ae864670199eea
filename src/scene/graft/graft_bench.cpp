#include "osteon/scene/graft_bench.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <string>

#include "osteon/scene/case.h"

namespace osteon {
namespace {

constexpr std::array<const char*, kGraftTendons> kTendonNames{"st", "gr"};
constexpr std::array<const char*, 3> kPostNames{"fold_2", "fold_3", "fold_4"};

// Places of landmarks by name; remembers whether all were there.
struct BenchMarks {
  const Case* the_case;
  bool all = true;
  std::optional<Vec3> find(const std::string& name) const {
    for (const Landmark& mark : the_case->landmarks)
      if (mark.name == name) return mark.p_W;
    return std::nullopt;
  }
  Vec3 at(const std::string& name) {
    const auto found = find(name);
    all = all && found.has_value();
    return found.value_or(Vec3::Zero());
  }
};

GraftBenchPlan::Tendon tendon_between(BenchMarks& marks, const std::string& name) {
  GraftBenchPlan::Tendon tendon;
  tendon.insertion_W = marks.at(name + "_insertion");
  const Vec3 way = marks.at(name + "_end") - tendon.insertion_W;
  tendon.measures.length_m = way.norm();
  if (tendon.measures.length_m > 0) tendon.along_W = way / tendon.measures.length_m;
  const double radius = (marks.at(name + "_side") - tendon.insertion_W).norm();
  tendon.measures.area_m2 = std::numbers::pi * radius * radius;
  tendon.free_W = marks.at(name + "_free");
  for (std::size_t b = 0; b < kMostBands; ++b) {
    const auto band = marks.find(name + "_band_" + std::to_string(b + 1));
    if (!band) break;
    tendon.measures.bands_m[b] = tendon.along_W.dot(*band - tendon.insertion_W);
    tendon.measures.bands = static_cast<std::uint32_t>(b + 1);
    tendon.bands_W.push_back(*band);
  }
  return tendon;
}

}  // namespace

Vec3 GraftBenchPlan::begin_W(std::uint32_t line) const {
  if (line == kGraft) return graft_from_W;
  if (line == kBoard) return board_from_W;
  return tendons[line].insertion_W;
}

Vec3 GraftBenchPlan::end_W(std::uint32_t line) const {
  if (line == kGraft) return graft_to_W;
  if (line == kBoard) return board_to_W;
  const Tendon& tendon = tendons[line];
  return tendon.insertion_W + tendon.measures.length_m * tendon.along_W;
}

Vec3 GraftBenchPlan::fascia_along_W() const { return (fascia_to_W - fascia_from_W).normalized(); }

Vec3 GraftBenchPlan::fascia_across_W() const {
  const Vec3 way = tendons[kGracilis].insertion_W - tendons[kSemitendinosus].insertion_W;
  const Vec3 along = fascia_along_W();
  return (way - way.dot(along) * along).normalized();
}

Vec3 GraftBenchPlan::fascia_up_W() const {
  const Vec3 up = fascia_along_W().cross(fascia_across_W());
  return up.dot(fascia_from_W - tendons[kSemitendinosus].insertion_W) < 0 ? Vec3(-up) : up;
}

std::optional<GraftBenchPlan> find_graft_bench(const Case& the_case) {
  GraftBenchPlan plan;
  const std::array<BoneId, 3> bones{the_case.find("thigh"), the_case.find("graft"),
                                    the_case.find("board")};
  for (const BoneId bone : bones)
    if (!bone.valid()) return std::nullopt;
  plan.bones = {bones[0].index, bones[0].index, bones[1].index, bones[2].index};
  BenchMarks marks{&the_case};
  for (std::size_t t = 0; t < kGraftTendons; ++t)
    plan.tendons[t] = tendon_between(marks, kTendonNames[t]);
  plan.graft_from_W = marks.at("graft_from");
  plan.graft_to_W = marks.at("graft_to");
  plan.board_from_W = marks.at("board_from");
  plan.board_to_W = marks.at("board_to");
  for (std::size_t i = 0; i < kPostNames.size(); ++i) plan.posts_W[i] = marks.at(kPostNames[i]);
  plan.hook_W = marks.at("hook");
  const Vec3 channel = marks.at("channel_from");
  plan.channel_m = (marks.at("channel_to") - channel).norm();
  plan.socket_m = (marks.at("socket_to") - channel).norm();
  if (!marks.all) return std::nullopt;
  const auto from = marks.find("fascia_from"), to = marks.find("fascia_to");
  if (from && to) {
    plan.fascia_from_W = *from;
    plan.fascia_to_W = *to;
  }
  for (std::uint32_t line = 0; line < GraftBenchPlan::kLines; ++line)
    if (!((plan.end_W(line) - plan.begin_W(line)).norm() > 0.005)) return std::nullopt;
  return plan;
}

std::optional<HarvestedTendon> harvested(const GraftBenchPlan& plan, const GraftBenchState& state,
                                         std::size_t tendon) {
  if (!state.on || tendon >= kGraftTendons || !state.tendons[tendon].stripped) return std::nullopt;
  const TendonOnBench& is = state.tendons[tendon];
  return with_muscle(strip(plan.tendons[tendon].measures, is.amputated ? is.bands_cut : ~0u),
                     is.muscle_left());
}

GraftBenchState fresh_bench(const GraftBenchPlan& plan) {
  GraftBenchState state;
  state.on = true;
  if (!plan.is_covered()) return state;
  state.slit = 0;
  for (TendonOnBench& tendon : state.tendons) tendon.found = false;
  return state;
}

double fascia_open_m(const GraftBenchPlan& plan, const GraftBenchState& state) {
  std::uint32_t run = 0, longest = 0;
  for (std::uint32_t k = 0; plan.is_covered() && k < kFasciaCells; ++k) {
    run = (state.slit >> k & 1u) != 0 ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  return longest * plan.fascia_m() / kFasciaCells;
}

Vec3 found_at_W(const GraftBenchPlan& plan, std::size_t tendon) {
  const Vec3 across = plan.fascia_across_W(),
             middle = 0.5 * (plan.fascia_from_W + plan.fascia_to_W);
  return middle + across.dot(plan.tendons[tendon].insertion_W - middle) * across;
}

double TendonOnBench::muscle_left() const {
  return std::clamp(1 - scraped_m / kScrapedClean_m, 0.0, 1.0);
}

std::uint32_t TendonOnBench::passes() const {
  return static_cast<std::uint32_t>(std::popcount(stitches));
}

Vec3 stitch_W(const GraftBenchPlan& plan, std::size_t tendon, std::uint32_t place) {
  constexpr double kFirst_m = 0.006;
  const GraftBenchPlan::Tendon& is = plan.tendons[tendon];
  return is.free_W + (kFirst_m + kStitchApart_m * place) * is.lies_W;
}

std::uint32_t fewest_passes(const GraftBenchState& state) {
  std::uint32_t least = kMostStitches + 1;
  for (const TendonOnBench& tendon : state.tendons)
    if (tendon.folds > 0) least = std::min(least, tendon.passes());
  return least > kMostStitches ? 0 : least;
}

std::optional<Graft> graft_on(const GraftBenchPlan& plan, const GraftBenchState& state) {
  std::array<std::optional<HarvestedTendon>, kGraftTendons> tendons;
  std::array<std::uint32_t, kGraftTendons> folds{};
  bool any = false;
  for (std::size_t t = 0; t < kGraftTendons; ++t) {
    tendons[t] = harvested(plan, state, t);
    folds[t] = state.tendons[t].folds;
    any = any || (tendons[t] && folds[t] > 0);
  }
  if (!any) return std::nullopt;  // without the message that fold_graft would make
  const auto graft = fold_graft(tendons, folds);
  return graft ? std::optional<Graft>(*graft) : std::nullopt;
}

}  // namespace osteon
