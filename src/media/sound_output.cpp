#include "osteon/media/sound_output.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "libal.h"
#include "osteon/media/film_writer.h"

namespace osteon {
namespace {

constexpr std::size_t kPiece = kSoundHz / 50;  // samples of one buffer: 20 ms
constexpr std::size_t kPieces = 12;            // 240 ms wait at most
constexpr std::size_t kBeforePlaying = 3;      // 60 ms, over which pictures may come late

std::int16_t sample_of(float value) {
  if (!std::isfinite(value)) return 0;
  return static_cast<std::int16_t>(std::lround(32767 * std::clamp(value, -1.0f, 1.0f)));
}

}  // namespace

/// Buffers go round: free, filled and waiting, played, free.
struct SoundOutput::Impl {
  Libal al;
  void* device = nullptr;
  void* context = nullptr;
  unsigned source = 0;
  std::array<unsigned, kPieces> buffers{};
  std::vector<unsigned> free;
  std::vector<std::int16_t> begun;  ///< of the next piece
  bool tells_loss = false;

  ~Impl() {
    if (context) {
      if (source) al.alDeleteSources(1, &source);
      if (buffers[0]) al.alDeleteBuffers(kPieces, buffers.data());
      al.alcMakeContextCurrent(nullptr);
      al.alcDestroyContext(context);
    }
    if (device) al.alcCloseDevice(device);
  }

  bool begin() {
    device = al.alcOpenDevice(nullptr);
    if (!device) return false;
    context = al.alcCreateContext(device, nullptr);
    if (!context || !al.alcMakeContextCurrent(context)) return false;
    al.alGenSources(1, &source);
    al.alGenBuffers(kPieces, buffers.data());
    if (al.alGetError() != 0) return false;
    free.assign(buffers.begin(), buffers.end());
    begun.reserve(kPiece);
    tells_loss = al.alcIsExtensionPresent(device, "ALC_EXT_disconnect") != 0;
    return true;
  }

  void take_back() {
    int played = 0;
    al.alGetSourcei(source, kAlBuffersProcessed, &played);
    for (; played > 0; --played) {
      unsigned buffer = 0;
      al.alSourceUnqueueBuffers(source, 1, &buffer);
      if (al.alGetError() != 0) return;
      free.push_back(buffer);
    }
  }

  int state() const {
    int now = 0;
    al.alGetSourcei(source, kAlSourceState, &now);
    return now;
  }

  // Of a source that has run dry what is queued anew counts as played, until it is rewound.
  void send() {
    take_back();
    if (state() == kAlStopped) al.alSourceRewind(source);
    if (!free.empty()) {
      const unsigned buffer = free.back();
      free.pop_back();
      al.alBufferData(buffer, kAlMono16, begun.data(),
                      static_cast<int>(begun.size() * sizeof(begun[0])), kSoundHz);
      al.alSourceQueueBuffers(source, 1, &buffer);
    }
    begun.clear();
    if (state() != kAlPlaying && kPieces - free.size() >= kBeforePlaying) al.alSourcePlay(source);
    (void)al.alGetError();
  }
};

SoundOutput::SoundOutput(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SoundOutput::~SoundOutput() = default;
SoundOutput::SoundOutput(SoundOutput&&) noexcept = default;
SoundOutput& SoundOutput::operator=(SoundOutput&&) noexcept = default;

Result<SoundOutput> SoundOutput::open(const std::string& library) {
  const auto al = load_libal(library.empty() ? libal_file() : library);
  if (!al) return tl::unexpected(al.error());
  auto impl = std::make_unique<Impl>();
  impl->al = *al;
  if (!impl->begin())
    return fail("there is no sound device", "OpenAL", "Connect one, or go on without sound");
  return SoundOutput(std::move(impl));
}

void SoundOutput::set_volume(double volume) {
  if (!std::isfinite(volume)) return;
  impl_->al.alSourcef(impl_->source, kAlGain, static_cast<float>(std::clamp(volume, 0.0, 1.0)));
}

void SoundOutput::play(std::span<const float> samples) {
  for (const float sample : samples) {
    impl_->begun.push_back(sample_of(sample));
    if (impl_->begun.size() == kPiece) impl_->send();
  }
}

std::size_t SoundOutput::waiting() const {
  impl_->take_back();
  return (kPieces - impl_->free.size()) * kPiece + impl_->begun.size();
}

std::size_t SoundOutput::most_waiting() { return (kPieces + 1) * kPiece; }

bool SoundOutput::lost() const {
  if (!impl_->tells_loss) return false;
  int connected = 1;
  impl_->al.alcGetIntegerv(impl_->device, kAlcConnected, 1, &connected);
  return connected == 0;
}

}  // namespace osteon
