#include "osteon/media/wav_writer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "osteon/media/film_writer.h"
#include "out_file.h"

namespace osteon {
namespace {

constexpr std::uint64_t kHeadBytes = 44, kSampleBytes = 2;

void put(std::string& bytes, std::uint64_t value, int count) {
  for (int shift = 0; shift < 8 * count; shift += 8)
    bytes += static_cast<char>(value >> shift & 0xff);
}

/// RIFF header of 16-bit PCM in one channel.
std::string wav_head(std::uint64_t samples) {
  const std::uint64_t data = kSampleBytes * samples;
  std::string head = "RIFF";
  put(head, kHeadBytes - 8 + data, 4);
  head += "WAVEfmt ";
  put(head, 16, 4);
  put(head, 1, 2);
  put(head, 1, 2);
  put(head, kSoundHz, 4);
  put(head, kSampleBytes * kSoundHz, 4);
  put(head, kSampleBytes, 2);
  put(head, 8 * kSampleBytes, 2);
  head += "data";
  put(head, data, 4);
  return head;
}

}  // namespace

struct WavWriter::Impl {
  OutFile file;
  std::uint64_t left = 0;

  Result<void> write(const std::string& bytes) {
    const int bad = file.write(bytes.data(), bytes.size());
    return bad == 0 ? Result<void>() : tl::unexpected(write_error(bad, file.file()));
  }
};

WavWriter::WavWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
WavWriter::~WavWriter() = default;
WavWriter::WavWriter(WavWriter&&) noexcept = default;
WavWriter& WavWriter::operator=(WavWriter&&) noexcept = default;

Result<WavWriter> WavWriter::create(const std::filesystem::path& file, std::uint64_t samples) {
  if (samples > (0xffffffffu - kHeadBytes) / kSampleBytes)
    return fail("is too long for a WAV file", file.string(), "Choose a part of it");
  auto out = OutFile::create(file);
  if (!out) return tl::unexpected(out.error());
  auto impl = std::make_unique<Impl>(Impl{std::move(*out), samples});
  if (auto ok = impl->write(wav_head(samples)); !ok) return tl::unexpected(ok.error());
  return WavWriter(std::move(impl));
}

Result<void> WavWriter::add(std::span<const float> samples) {
  std::string bytes;
  const auto count = std::min<std::uint64_t>(samples.size(), impl_->left);
  for (const float value : samples.first(static_cast<std::size_t>(count))) {
    const long level = std::lround(32767 * std::clamp(static_cast<double>(value), -1.0, 1.0));
    put(bytes, static_cast<std::uint64_t>(level), 2);
  }
  impl_->left -= count;
  return impl_->write(bytes);
}

Result<void> WavWriter::finish() {
  while (impl_->left > 0) {
    const auto count = std::min<std::uint64_t>(impl_->left, 1 << 16);
    impl_->left -= count;
    const std::string zeros(static_cast<std::size_t>(kSampleBytes * count), '\0');
    if (auto ok = impl_->write(zeros); !ok) return ok;
  }
  return impl_->file.keep();
}

}  // namespace osteon
