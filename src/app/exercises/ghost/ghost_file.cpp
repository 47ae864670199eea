#include "exercises/ghost/ghost_file.h"

#include <cstring>
#include <system_error>
#include <utility>

#include "osteon/base/hash.h"

namespace osteon {
namespace {

constexpr std::string_view kMagic = "osteon ghost 1\n";
constexpr std::uint64_t kMost = 1u << 24;  // of anything in a track

class GhostWriter {
 public:
  template <class T>
  void put(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void put_text(const std::string& text) {
    put<std::uint64_t>(text.size());
    bytes_ += text;
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_{kMagic};
};

// Past the end everything is 0, and `sound` is false.
class GhostReader {
 public:
  explicit GhostReader(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  T take() {
    T value{};
    if (bytes_.size() < sizeof value) return sound_ = false, value;
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_.remove_prefix(sizeof value);
    return value;
  }
  std::size_t take_count(std::size_t least_bytes_each) {
    const auto count = take<std::uint64_t>();
    if (count > kMost || count * least_bytes_each > bytes_.size()) sound_ = false;
    return sound_ ? count : 0;
  }
  std::string take_text() {
    const std::size_t count = take_count(1);
    std::string text(bytes_.substr(0, count));
    bytes_.remove_prefix(count);
    return text;
  }
  bool sound() const { return sound_; }
  bool at_end() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
  bool sound_ = true;
};

std::uint64_t checksum_of(std::string_view bytes) {
  Hasher hash;
  hash.add(bytes);
  return hash.value();
}

void put_sample(const GhostTrack::Sample& sample, GhostWriter& out) {
  for (int i = 0; i < 3; ++i) out.put(sample.X_WT.p[i]);
  for (int i = 0; i < 4; ++i) out.put(sample.X_WT.q.coeffs()[i]);
  out.put(sample.instrument);
}

GhostTrack::Sample take_sample(GhostReader& in) {
  GhostTrack::Sample sample;
  for (int i = 0; i < 3; ++i) sample.X_WT.p[i] = in.take<double>();
  for (int i = 0; i < 4; ++i) sample.X_WT.q.coeffs()[i] = in.take<double>();
  sample.instrument = in.take<std::uint32_t>();
  return sample;
}

GhostStretch take_stretch(GhostReader& in) {
  GhostStretch stretch;
  stretch.stage = in.take<std::uint32_t>();
  stretch.from = in.take<std::uint64_t>();
  stretch.to = in.take<std::uint64_t>();
  const std::size_t parts = in.take_count(8);
  for (std::size_t i = 0; i < parts; ++i) {
    const auto goal = in.take<std::uint32_t>();
    stretch.done.push_back({goal, in.take<std::uint32_t>()});
  }
  return stretch;
}

// Of a track, hands are equally many and stretches lie in them.
bool is_whole(const GhostTrack& track) {
  const std::size_t samples = track.hands.empty() ? 0 : track.hands.front().size();
  for (const auto& hand : track.hands)
    if (hand.size() != samples) return false;
  for (const GhostStretch& stretch : track.stretches)
    if (stretch.from > stretch.to || stretch.to >= samples) return false;
  return true;
}

bool add_file(const std::filesystem::path& file, Hasher& hash) {
  std::error_code ec;
  const auto size = std::filesystem::file_size(file, ec);
  if (ec) return false;
  const auto written = std::filesystem::last_write_time(file, ec);
  if (ec) return false;
  hash.add(static_cast<std::uint64_t>(size));
  hash.add(static_cast<std::uint64_t>(written.time_since_epoch().count()));
  return true;
}

}  // namespace

std::string to_bytes(const GhostTrack& track, std::uint64_t key) {
  GhostWriter out;
  out.put(key);
  out.put<std::uint64_t>(track.tray.size());
  for (const std::string& name : track.tray) out.put_text(name);
  out.put<std::uint64_t>(track.hands.size());
  for (const auto& hand : track.hands) {
    out.put<std::uint64_t>(hand.size());
    for (const GhostTrack::Sample& sample : hand) put_sample(sample, out);
  }
  out.put<std::uint64_t>(track.stretches.size());
  for (const GhostStretch& stretch : track.stretches) {
    out.put(stretch.stage);
    out.put<std::uint64_t>(stretch.from);
    out.put<std::uint64_t>(stretch.to);
    out.put<std::uint64_t>(stretch.done.size());
    for (const GoalPart& part : stretch.done) {
      out.put(part.goal);
      out.put(part.part);
    }
  }
  std::string bytes = out.take();
  const std::uint64_t sum = checksum_of(bytes);
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  return bytes;
}

Result<GhostTrack> ghost_from_bytes(std::string_view bytes, std::uint64_t key) {
  const auto damaged = [] { return fail("the kept way of an expert is damaged"); };
  if (bytes.size() < kMagic.size() + sizeof(std::uint64_t) || !bytes.starts_with(kMagic))
    return damaged();
  std::uint64_t sum = 0;
  std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
  bytes.remove_suffix(sizeof sum);
  if (sum != checksum_of(bytes)) return damaged();
  GhostReader in(bytes.substr(kMagic.size()));
  if (in.take<std::uint64_t>() != key) return fail("the kept way of an expert is of another build");
  GhostTrack track;
  for (std::size_t n = in.take_count(8); n > 0; --n) track.tray.push_back(in.take_text());
  constexpr std::size_t kSampleBytes = 7 * sizeof(double) + sizeof(std::uint32_t);
  for (std::size_t hands = in.take_count(8); hands > 0; --hands) {
    auto& hand = track.hands.emplace_back();
    for (std::size_t n = in.take_count(kSampleBytes); n > 0; --n) hand.push_back(take_sample(in));
  }
  for (std::size_t n = in.take_count(8); n > 0; --n) track.stretches.push_back(take_stretch(in));
  if (!in.sound() || !in.at_end() || !is_whole(track)) return damaged();
  return track;
}

std::uint64_t ghost_key(const std::filesystem::path& recording) {
  Hasher hash;
  std::error_code ec;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", ec);
  if (ec || !add_file(recording, hash) || !add_file(program, hash)) return 0;
  return hash.value();
}

}  // namespace osteon
