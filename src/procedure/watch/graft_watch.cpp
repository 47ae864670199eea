#include "osteon/procedure/graft_watch.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "osteon/scene/graft.h"
#include "watch/watch_event.h"

namespace osteon {
namespace {

constexpr double kTellEvery_s = 10;  // of the board's clock

std::uint32_t bands_left(const GraftBenchPlan& plan, const GraftBenchState& state) {
  std::uint32_t left = 0;
  for (std::size_t t = 0; t < kGraftTendons; ++t)
    left += plan.tendons[t].measures.bands -
            static_cast<std::uint32_t>(std::popcount(state.tendons[t].bands_cut));
  return left;
}

// Of the tendon that has more of it; `folded`: of those alone that are in the graft.
double most_muscle(const GraftBenchState& state, bool folded) {
  double most = 0;
  for (const TendonOnBench& tendon : state.tendons)
    if (!folded || tendon.folds > 0) most = std::max(most, tendon.muscle_left());
  return most;
}

double tenths(double share) { return std::floor(10 * share + 1e-9); }

}  // namespace

GraftWatch::GraftWatch(const Case& the_case) : plan_(find_graft_bench(the_case)) {
  if (plan_) seen_ = fresh_bench(*plan_);
}

void GraftWatch::tell_finding(std::uint64_t tick, const GraftBenchState& now,
                              std::vector<Event>& out) const {
  double found = 0;
  bool more = false;
  for (std::size_t t = 0; t < kGraftTendons; ++t) {
    found += now.tendons[t].found ? 1 : 0;
    more = more || (now.tendons[t].found && !seen_.tendons[t].found);
  }
  const double open_m = fascia_open_m(*plan_, now);
  if (open_m > fascia_open_m(*plan_, seen_))
    out.push_back(event_of(tick, kFasciaOpened, {1e3 * open_m, 0, 0}));
  if (more) out.push_back(event_of(tick, kTendonFound, {found, 0, 0}));
  for (std::uint32_t k = 0; k < 2; ++k)
    if (((now.hurt & ~seen_.hurt) >> k & 1u) != 0)
      out.push_back(event_of(tick, kByFasciaHurt, {static_cast<double>(k), 0, 0}));
}

void GraftWatch::tell_tendons(std::uint64_t tick, const GraftBenchState& now,
                              std::vector<Event>& out) const {
  double whole = 0;
  for (const TendonOnBench& tendon : now.tendons)
    whole += tendon.stripped && !tendon.amputated ? 1 : 0;
  for (std::size_t t = 0; t < kGraftTendons; ++t) {
    const TendonOnBench &is = now.tendons[t], &was = seen_.tendons[t];
    if (is.bands_cut != was.bands_cut)
      out.push_back(event_of(tick, kBandCut, {static_cast<double>(bands_left(*plan_, now)), 0, 0}));
    if (is.stripped && !was.stripped)
      out.push_back(
          event_of(tick, kTendonStripped,
                   {1e3 * harvested(*plan_, now, t)->length_m, is.amputated ? 1.0 : 0.0, whole}));
    const auto graft = is.folds != was.folds ? graft_on(*plan_, now) : std::nullopt;
    if (graft)
      out.push_back(event_of(tick, kTendonFolded, {static_cast<double>(graft->strands), 0, 0}));
  }
}

void GraftWatch::tell_table_work(std::uint64_t tick, const GraftBenchState& now,
                                 std::vector<Event>& out) const {
  bool scraped = false, stitched = false;
  std::uint32_t fewest = kMostStitches;
  for (std::size_t t = 0; t < kGraftTendons; ++t) {
    const TendonOnBench &is = now.tendons[t], &was = seen_.tendons[t];
    scraped = scraped || tenths(is.muscle_left()) != tenths(was.muscle_left());
    stitched = stitched || is.stitches != was.stitches;
    fewest = std::min(fewest, is.passes());
  }
  if (scraped) out.push_back(event_of(tick, kMuscleScraped, {100 * most_muscle(now, false), 0, 0}));
  if (stitched) out.push_back(event_of(tick, kTendonStitched, {static_cast<double>(fewest), 0, 0}));
}

void GraftWatch::tell_graft(std::uint64_t tick, const GraftBenchState& now,
                            std::vector<Event>& out) {
  const auto graft = graft_on(*plan_, now);
  if (!graft) return;
  if (now.passed_m != seen_.passed_m || now.refused_m != seen_.refused_m)
    out.push_back(event_of(tick, kGraftSized,
                           {1e3 * now.passed_m, 1e3 * now.refused_m, 1e3 * graft->length_m}));
  if (now.creep_s < told_creep_s_) told_creep_s_ = 0;  // a restore point
  if (now.creep_s - told_creep_s_ >= kTellEvery_s) {
    told_creep_s_ = now.creep_s;
    out.push_back(event_of(tick, kGraftTensioned, {now.creep_s, now.tension_n, 0}));
  }
  tell_loop(tick, *graft, now, out);
}

// Once for each loop that is hung, when its channel is known.
void GraftWatch::tell_loop(std::uint64_t tick, const Graft& graft, const GraftBenchState& now,
                           std::vector<Event>& out) {
  if (!(now.loop_m > 0)) told_loop_m_ = 0;  // also a restore point
  if (now.loop_m == told_loop_m_ || (drilled_ && !room_)) return;
  told_loop_m_ = now.loop_m;
  const LoopFit fit = fit_loop(plan_->channel_m, plan_->socket_m, now.loop_m);
  const std::array<double, kGraftValueNames.size()> values{
      1e3 * graft.sized_m,
      1e3 * graft.length_m,
      static_cast<double>(graft.strands),
      1e3 * fit.in_socket_m,
      100 * creep_left(now.creep_s),
      100 * most_muscle(now, true),
      static_cast<double>(fewest_passes(now)),
      room_ ? 1e3 * (room_->wide_m - graft.sized_m) : 0};
  const std::size_t count = values.size() - (room_ ? 0 : 1);
  for (std::size_t i = 0; i < count; ++i)
    out.push_back(event_of(tick, kGraftMeasured, {static_cast<double>(i), values[i], 0}));
  out.push_back(
      event_of(tick, kLoopHung, {1e3 * now.loop_m, 1e3 * fit.in_socket_m, fit.flips ? 1.0 : 0.0}));
}

void GraftWatch::set_room(const std::optional<GraftRoom>& room) {
  drilled_ = true;
  room_ = room;
  if (!plan_) return;
  plan_->channel_m = room ? room->channel_m : 0;
  plan_->socket_m = room ? room->socket_m : 0;
}

void GraftWatch::add(std::uint64_t tick, const BoneSnapshot& bones, std::vector<Event>& out) {
  if (!plan_ || !bones.bench.on) return;
  tell_finding(tick, bones.bench, out);
  tell_tendons(tick, bones.bench, out);
  tell_table_work(tick, bones.bench, out);
  tell_graft(tick, bones.bench, out);
  seen_ = bones.bench;
}

}  // namespace osteon
