#include "ratios.h"

#include <benchmark/benchmark.h>

#include <cstdio>
#include <map>

namespace osteon::bench {
namespace {

/// Prints as usual, and keeps the times by name.
class KeepTimes : public benchmark::ConsoleReporter {
 public:
  KeepTimes() : ConsoleReporter(OO_Tabular) {}

  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      const bool counts = run.run_type == Run::RT_Iteration || run.aggregate_name == "median";
      if (!run.error_occurred && counts)
        seconds_[run.run_name.function_name] =
            run.GetAdjustedCPUTime() / benchmark::GetTimeUnitMultiplier(run.time_unit);
    }
  }
  /// 0: it did not run.
  double seconds(const std::string& name) const {
    const auto found = seconds_.find(name);
    return found == seconds_.end() ? 0 : found->second;
  }

 private:
  std::map<std::string, double> seconds_;
};

void print(const Comparison& comparison, const KeepTimes& times) {
  const double ours = times.seconds(comparison.ours);
  if (ours <= 0) return;
  std::printf("%-20s", comparison.ours.c_str());
  for (const std::string& peer : comparison.peers)
    if (const double theirs = times.seconds(peer); theirs > 0)
      std::printf("  %s %.1f", peer.c_str(), theirs / ours);
  std::printf("\n");
}

}  // namespace

int run(int argc, char** argv, const std::vector<Comparison>& comparisons) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  KeepTimes times;
  benchmark::RunSpecifiedBenchmarks(&times);
  benchmark::Shutdown();
  std::printf("\nHow many times as long the peers take:\n");
  for (const Comparison& comparison : comparisons) print(comparison, times);
  return 0;
}

}  // namespace osteon::bench
