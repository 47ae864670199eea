#include "falcon_bringup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "falcon_packet.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

// Requests of the FTDI converter, all host to device without data.
enum class Ftdi : std::uint8_t {
  kReset = 0,
  kModem = 1,
  kFlow = 2,
  kBaud = 3,
  kLine = 4,
  kLatency = 9
};
constexpr std::uint16_t kPurgeRx = 1, kPurgeTx = 2;
constexpr std::uint16_t kRtsLow = 0x0200, kDtrLow = 0x0100, kDtrHigh = 0x0101;
constexpr std::uint16_t kBaud9600 = 0x4138, kBaudLoad = 0x15, kBaudNormal = 0x02;
constexpr std::uint16_t kLine8n1 = 8, kNoFlow = 0;

constexpr std::size_t kChunk = 62;
constexpr double kAnswer_s = 0.05;
constexpr double kEcho_s = 1.0;
constexpr int kGreetings = 100;
constexpr int kTriesToSeeIt = 40;
constexpr std::uint64_t kLargestFirmware = 256 * 1024;
const char* const kWhere = "Novint Falcon";

struct Request {
  Ftdi what;
  std::uint16_t value;
};

Result<void> request(UsbLink& link, std::initializer_list<Request> requests) {
  for (const Request& r : requests) {
    const UsbSetup setup{0x40, static_cast<std::uint8_t>(r.what), r.value, 0, 0};
    const UsbControlResult result = control_and_wait(link, setup, {}, 1.0);
    if (result.error != UsbError::kNone)
      return fail(
          "could not set up the Falcon's serial converter: " + std::string(describe(result.error)),
          kWhere, "Unplug it, plug it in again and try again");
  }
  return {};
}

Result<void> send(UsbLink& link, std::span<const std::uint8_t> bytes) {
  const std::int64_t end_ns = link.now_ns() + std::llround(kEcho_s * 1e9);
  if (link.write(0, bytes)) {
    while (!link.out_idle() && !link.gone() && link.out_error() == UsbError::kNone &&
           link.now_ns() < end_ns) {
      link.wait(0.002);
      link.poll();
    }
    if (link.out_idle() && link.out_error() == UsbError::kNone) return {};
  }
  const UsbError error = link.gone() ? UsbError::kGone : link.out_error();
  return fail("the Falcon accepted no data: " +
                  std::string(describe(error == UsbError::kNone ? UsbError::kTimeout : error)),
              kWhere, "Check its power supply and its cable");
}

// What comes within the limit, up to `wanted` bytes, without the converter's own.
Bytes receive(UsbLink& link, std::size_t wanted, double limit_s) {
  const std::int64_t end_ns = link.now_ns() + std::llround(limit_s * 1e9);
  Bytes bytes;
  while (true) {
    link.poll();
    UsbPacket packet;
    while (link.next_in(packet))
      if (packet.bytes.size() > kFalconStatusBytes)
        bytes.insert(bytes.end(), packet.bytes.begin() + kFalconStatusBytes, packet.bytes.end());
    if (bytes.size() >= wanted || link.now_ns() >= end_ns || link.gone()) return bytes;
    link.wait(std::min(0.002, limit_s));
  }
}

Result<void> enter_normal_mode(UsbLink& link) {
  return request(link, {{Ftdi::kLatency, 1},
                        {Ftdi::kBaud, kBaudNormal},
                        {Ftdi::kReset, kPurgeRx},
                        {Ftdi::kReset, kPurgeTx}});
}

// Whether the firmware answers a command that asks for nothing.
bool firmware_runs(UsbLink& link) {
  FalconPacketReader reader;
  const FalconPacket quiet = encode(FalconCommand{});
  for (int i = 0; i < kTriesToSeeIt; ++i) {
    if (!send(link, quiet)) return false;
    for (const std::uint8_t byte : receive(link, kFalconPacketBytes, 0.005))
      if (reader.feed(byte)) return true;
  }
  return false;
}

Result<void> greet_boot_loader(UsbLink& link) {
  const auto set = request(link, {{Ftdi::kReset, kPurgeRx},
                                  {Ftdi::kReset, kPurgeTx},
                                  {Ftdi::kLatency, 16},
                                  {Ftdi::kBaud, kBaud9600},
                                  {Ftdi::kLine, kLine8n1},
                                  {Ftdi::kFlow, kNoFlow},
                                  {Ftdi::kModem, kRtsLow},
                                  {Ftdi::kModem, kDtrLow},
                                  {Ftdi::kModem, kDtrHigh}});
  if (!set) return set;
  constexpr std::array<std::uint8_t, 3> kHello{0x0a, 0x43, 0x0d};
  constexpr std::array<std::uint8_t, 4> kAnswer{0x0a, 0x44, 0x2c, 0x0d};
  for (int i = 0; i < kGreetings; ++i) {
    if (const auto sent = send(link, kHello); !sent) return sent;
    const Bytes got = receive(link, kAnswer.size(), kAnswer_s);
    if (std::search(got.begin(), got.end(), kAnswer.begin(), kAnswer.end()) != got.end()) return {};
  }
  return fail("the Falcon's boot loader does not answer", kWhere,
              "Switch its power supply off and on, then try again");
}

Result<void> start_loading(UsbLink& link) {
  if (const auto set = request(link, {{Ftdi::kModem, kDtrLow}, {Ftdi::kBaud, kBaudLoad}}); !set)
    return set;
  (void)receive(link, 0, 0);
  constexpr std::array<std::uint8_t, 1> kMark{0x41};
  if (const auto sent = send(link, kMark); !sent) return sent;
  const Bytes got = receive(link, 1, kEcho_s);
  if (!got.empty() && got.back() == kMark[0]) return {};
  return fail("the Falcon's boot loader did not accept the speed of the connection", kWhere,
              "Switch its power supply off and on, then try again");
}

Result<void> load(UsbLink& link, std::span<const std::uint8_t> firmware) {
  for (std::size_t at = 0; at < firmware.size(); at += kChunk) {
    const auto chunk = firmware.subspan(at, std::min(kChunk, firmware.size() - at));
    if (const auto sent = send(link, chunk); !sent) return sent;
    const Bytes echo = receive(link, chunk.size(), kEcho_s);
    if (!std::equal(chunk.begin(), chunk.end(), echo.begin(), echo.end()))
      return fail("the Falcon returned firmware bytes that differ from those sent, at byte " +
                      std::to_string(at),
                  kWhere,
                  "Switch it off and on and try again; if the error persists, " +
                      falcon_firmware_file().string() + " is not its firmware");
  }
  return {};
}

}  // namespace

UsbChannel falcon_channel() {
  UsbChannel channel;
  channel.in_endpoint = 0x81;
  channel.out_endpoint = 0x02;
  channel.in_bytes = 64;
  return channel;
}

fs::path falcon_firmware_file() {
  const auto set = [](const char* name) -> const char* {
    const char* value = std::getenv(name);
    return value && *value ? value : nullptr;
  };
  constexpr const char* kName = "falcon_firmware.bin";
  if (const char* file = set("OSTEON_FALCON_FIRMWARE")) return file;
  if (const char* config = set("XDG_CONFIG_HOME")) return fs::path(config) / "osteon" / kName;
  if (const char* roaming = set("APPDATA")) return fs::path(roaming) / "osteon" / kName;
  const char* home = set("HOME");
  return fs::path(home ? home : ".") / ".config" / "osteon" / kName;
}

Result<std::string> load_falcon_firmware() {
  const fs::path file = falcon_firmware_file();
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    return fail(
        "the Novint Falcon's firmware is missing", file.string(),
        "Put a copy there: its maker's driver contains it, and its licence forbids redistribution");
  auto content = read_file(file, kLargestFirmware);
  if (content && content->empty())
    return fail("the Novint Falcon's firmware is empty", file.string(),
                "Put a complete copy there");
  return content;
}

Result<void> bring_up_falcon(UsbLink& link, const std::string& firmware) {
  if (const auto normal = enter_normal_mode(link); !normal) return normal;
  if (firmware_runs(link)) return {};
  if (const auto greeted = greet_boot_loader(link); !greeted) return greeted;
  if (const auto started = start_loading(link); !started) return started;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(firmware.data());
  if (const auto loaded = load(link, {bytes, firmware.size()}); !loaded) return loaded;
  if (const auto normal = enter_normal_mode(link); !normal) return normal;
  if (firmware_runs(link)) return {};
  return fail("the Falcon accepted its firmware but does not run it",
              falcon_firmware_file().string(), "Check that the file is the Falcon's firmware");
}

}  // namespace osteon
