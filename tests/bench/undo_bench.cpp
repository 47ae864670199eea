// What going back costs: to a restore point that was set five minutes before, by two hands with
// three instruments each, and to a state out of a recording.
#include <benchmark/benchmark.h>

#include "session/two_hands.h"

namespace osteon {
namespace {

constexpr std::uint64_t kFiveMinutes = 300'000;  // ticks
constexpr std::uint32_t kMark = 7;               // which the hands at random do not touch

std::array<HandInput, 2> inputs_at(testing::HandsAtRandom& hands, std::uint64_t n) {
  std::array<HandInput, 2> inputs = hands.at(n);
  if (n == 1) inputs[0].command = inputs[1].command = {CommandKind::kMark, kMark};
  return inputs;
}

// A session that has worked for five minutes since its restore point was set.
Session worked_session(testing::HandsAtRandom& hands) {
  Session session(testing::two_box_case(), testing::with_three_probes(), testing::three_probes());
  for (std::uint64_t n = 1; n <= kFiveMinutes; ++n) (void)session.tick(inputs_at(hands, n));
  return session;
}

void BM_undo_to_a_mark_of_five_minutes_ago(benchmark::State& state) {
  testing::HandsAtRandom hands(11);
  Session session = worked_session(hands);
  std::uint64_t n = kFiveMinutes;
  for (auto _ : state) {
    // Hands and physics have both gone back within two ticks.
    for (int i = 0; i < 2; ++i) {
      std::array<HandInput, 2> inputs = hands.at(++n);
      inputs[0].command = inputs[1].command =
          i == 0 ? Command{CommandKind::kRestore, kMark} : Command{};
      benchmark::DoNotOptimize(session.tick(inputs));
    }
  }
}
BENCHMARK(BM_undo_to_a_mark_of_five_minutes_ago)->Unit(benchmark::kMicrosecond)->Iterations(2000);

void BM_restore_a_stored_state(benchmark::State& state) {
  testing::HandsAtRandom hands(11);
  Session session(testing::two_box_case(), testing::with_three_probes(), testing::three_probes());
  for (std::uint64_t n = 1; n <= 5000; ++n) (void)session.tick(inputs_at(hands, n));
  const std::string bytes = to_bytes(session.save());
  for (auto _ : state) {
    const auto read = state_from_bytes(bytes);
    if (!read || !session.restore(*read)) state.SkipWithError("the state is not restored");
  }
  state.counters["bytes"] = static_cast<double>(bytes.size());
}
BENCHMARK(BM_restore_a_stored_state)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace osteon
