#include "record_source.h"

#include <algorithm>

namespace osteon {
namespace {

// At most so many at once: a copy of a whole recording would double its memory.
constexpr std::size_t kSome = 4096;

template <class Record>
std::vector<Record> some_from(const std::vector<Record>& all, std::uint64_t first) {
  if (first == 0 || first > all.size()) return {};
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first - 1);
  const std::size_t count = std::min(kSome, static_cast<std::size_t>(all.end() - begin));
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

RecordSource source_of(const Recording& recording) {
  RecordSource source;
  source.header = &recording.header;
  source.complete = recording.complete;
  source.ticks = [&](std::size_t hand, std::uint64_t first) -> Result<std::vector<TickRecord>> {
    return some_from(recording.ticks_of(hand), first);
  };
  source.steps = [&](std::uint64_t first) -> Result<std::vector<StepRecord>> {
    return some_from(recording.steps, first);
  };
  source.states = [&]() -> Result<std::vector<StoredState>> { return recording.states; };
  source.state = [&](std::uint64_t step) -> Result<std::string> {
    for (const StoredState& state : recording.states)
      if (state.step == step) return state.bytes;
    return fail("there is no stored state of step " + std::to_string(step), "recording");
  };
  return source;
}

RecordSource source_of(RecordingReader& reader) {
  RecordSource source;
  source.header = &reader.header();
  source.complete = reader.complete();
  source.ticks = [&](std::size_t hand, std::uint64_t first) {
    return reader.read_ticks(hand, first);
  };
  source.steps = [&](std::uint64_t first) { return reader.read_steps(first); };
  source.states = [&] { return reader.states(); };
  source.state = [&](std::uint64_t step) { return reader.read_state(step); };
  return source;
}

}  // namespace osteon
