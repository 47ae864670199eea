#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace osteon {

/// What the host tells the Falcon's firmware, sixteen bytes on the wire.
struct FalconCommand {
  std::array<int, 3> motors{};  ///< counts, within the motors' limit
  bool homing = false;
  std::uint8_t lights = 0;  ///< bits below
};
inline constexpr std::uint8_t kFalconGreen = 2;
inline constexpr std::uint8_t kFalconBlue = 4;
inline constexpr std::uint8_t kFalconRed = 8;

/// What the firmware answers to each command.
struct FalconReport {
  std::array<int, 3> encoders{};
  std::uint8_t homed = 0;  ///< bit i: motor i
  std::uint8_t grip = 0;   ///< buttons: plus 1, forward 2, centre 4, minus 8
  bool all_homed() const { return homed == 7; }
};

inline constexpr std::size_t kFalconPacketBytes = 16;
/// Of the USB converter, before the data of every packet.
inline constexpr std::size_t kFalconStatusBytes = 2;
using FalconPacket = std::array<std::uint8_t, kFalconPacketBytes>;

/// '<', three 16-bit numbers in nibbles (lowest first, each + 'A'), flags + 'A', 'A', '>'.
FalconPacket encode(const FalconCommand& command);
FalconPacket encode(const FalconReport& report);

/// Finds packets in the stream of bytes, wherever it is cut, and begins anew at the next '<' after
/// anything that is not as it must be. Any bytes may be fed.
class FalconPacketReader {
 public:
  /// True when this byte completes a packet; then `packet()` is whole.
  bool feed(std::uint8_t byte);
  const FalconPacket& packet() const { return packet_; }
  /// Packets begun and not ended as they must.
  std::uint64_t broken() const { return broken_; }
  void reset() { size_ = 0; }

 private:
  FalconPacket packet_{};
  std::size_t size_ = 0;
  std::uint64_t broken_ = 0;
};

/// Of a packet that FalconPacketReader completed.
FalconReport decode_report(const FalconPacket& packet);
FalconCommand decode_command(const FalconPacket& packet);

}  // namespace osteon
