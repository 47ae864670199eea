#include "causality.h"
#include "osteon/record/recording.h"

namespace osteon {
namespace {

template <class Record, class Read>
Result<void> read_all(std::vector<Record>& into, const Read& read) {
  for (;;) {
    auto some = read(into.size() + 1);
    if (!some) return tl::unexpected(some.error());
    if (some->empty()) return {};
    into.insert(into.end(), some->begin(), some->end());
  }
}

Result<void> read_states(RecordingReader& reader, std::vector<StoredState>& into) {
  auto states = reader.states();
  if (!states) return tl::unexpected(states.error());
  for (StoredState& state : *states) {
    auto bytes = reader.read_state(state.step);
    if (!bytes) return tl::unexpected(bytes.error());
    state.bytes = std::move(*bytes);
  }
  into = std::move(*states);
  return {};
}

Result<Recording> load(Result<RecordingReader> reader, const std::string& name) {
  if (!reader) return tl::unexpected(reader.error());
  Recording recording;
  recording.header = reader->header();
  recording.complete = reader->complete();
  recording.more_hands.resize(recording.header.hands - 1);
  Result<void> done;
  for (std::size_t h = 0; done && h < recording.hands(); ++h)
    done = read_all(recording.ticks_of(h),
                    [&](std::uint64_t first) { return reader->read_ticks(h, first); });
  if (done)
    done =
        read_all(recording.steps, [&](std::uint64_t first) { return reader->read_steps(first); });
  if (done)
    done =
        read_all(recording.events, [&](std::uint64_t first) { return reader->read_events(first); });
  if (done) done = read_states(*reader, recording.states);
  if (!done) return tl::unexpected(done.error());
  if (!recording.complete) trim_to_saved(recording);
  done = check_consumption(recording);
  if (!done) {
    done.error().where = name;
    return tl::unexpected(done.error());
  }
  return recording;
}

}  // namespace

Result<Recording> load_recording(const std::filesystem::path& file) {
  return load(RecordingReader::open(file), file.string());
}

Result<Recording> load_recording_from_memory(std::span<const std::byte> image) {
  return load(RecordingReader::open_memory(image), "memory");
}

}  // namespace osteon
