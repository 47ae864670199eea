#include "falcon_packet.h"

namespace osteon {
namespace {

constexpr std::uint8_t kBegin = '<';
constexpr std::uint8_t kEnd = '>';
constexpr std::uint8_t kBase = 'A';
constexpr std::size_t kFlags = 13;

FalconPacket pack(const std::array<int, 3>& numbers, std::uint8_t flags) {
  FalconPacket p{};
  p.front() = kBegin;
  p.back() = kEnd;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto bits = static_cast<std::uint16_t>(numbers[i]);
    for (std::size_t k = 0; k < 4; ++k)
      p[1 + 4 * i + k] = static_cast<std::uint8_t>(kBase + ((bits >> (4 * k)) & 0xF));
  }
  p[kFlags] = static_cast<std::uint8_t>(kBase + flags);
  p[kFlags + 1] = kBase;
  return p;
}

std::array<int, 3> numbers_of(const FalconPacket& p) {
  std::array<int, 3> numbers{};
  for (std::size_t i = 0; i < 3; ++i) {
    std::uint16_t bits = 0;
    for (std::size_t k = 0; k < 4; ++k)
      bits = static_cast<std::uint16_t>(bits | ((p[1 + 4 * i + k] - kBase) & 0xF) << (4 * k));
    numbers[i] = static_cast<std::int16_t>(bits);
  }
  return numbers;
}

std::uint8_t flags_of(const FalconPacket& p) {
  return static_cast<std::uint8_t>(p[kFlags] - kBase);
}

// Whether a byte may stand at that place.
bool fits(std::size_t place, std::uint8_t byte) {
  if (place == 0) return byte == kBegin;
  if (place == kFalconPacketBytes - 1) return byte == kEnd;
  if (place < kFlags) return byte >= kBase && byte < kBase + 16;
  if (place == kFlags) return byte >= kBase && byte < kBase + 128;
  return byte != kBegin && byte != kEnd;  // of no meaning
}

}  // namespace

FalconPacket encode(const FalconCommand& command) {
  return pack(command.motors, static_cast<std::uint8_t>(command.lights | (command.homing ? 1 : 0)));
}

FalconPacket encode(const FalconReport& report) {
  return pack(report.encoders, static_cast<std::uint8_t>(report.homed << 4 | report.grip));
}

bool FalconPacketReader::feed(std::uint8_t byte) {
  if (!fits(size_, byte)) {
    if (size_ > 0) ++broken_;
    size_ = 0;
    if (byte != kBegin) return false;
  }
  packet_[size_++] = byte;
  if (size_ < kFalconPacketBytes) return false;
  size_ = 0;
  return true;
}

FalconReport decode_report(const FalconPacket& packet) {
  const std::uint8_t flags = flags_of(packet);
  return {numbers_of(packet), static_cast<std::uint8_t>(flags >> 4 & 7),
          static_cast<std::uint8_t>(flags & 0xF)};
}

FalconCommand decode_command(const FalconPacket& packet) {
  const std::uint8_t flags = flags_of(packet);
  return {numbers_of(packet), (flags & 1) != 0, static_cast<std::uint8_t>(flags & 0xE)};
}

}  // namespace osteon
