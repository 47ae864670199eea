#pragma once

#include <string>
#include <vector>

namespace osteon::bench {

/// A benchmark of ours and those of the same work by others.
struct Comparison {
  std::string ours;
  std::vector<std::string> peers;
};

/// Runs the benchmarks that the arguments choose, and then prints how many times as long each peer
/// took as ours (CPU time; the median where there were several runs). Returns the exit status.
int run(int argc, char** argv, const std::vector<Comparison>& comparisons);

}  // namespace osteon::bench
