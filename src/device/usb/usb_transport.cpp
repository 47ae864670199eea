#include "usb_transport.h"

namespace osteon {

const char* describe(UsbError error) {
  switch (error) {
    case UsbError::kNone:
      return "no error";
    case UsbError::kStall:
      return "the device refused the transfer (STALL)";
    case UsbError::kTimeout:
      return "the device did not answer in time";
    case UsbError::kGone:
      return "the device was unplugged";
    case UsbError::kOverflow:
      return "the device sent more than was asked for";
    case UsbError::kShort:
      return "the device accepted less than was sent";
    case UsbError::kOther:
      return "the system refused the transfer";
  }
  return "unknown";
}

UsbSetup set_output_report(std::uint8_t interface_number, std::uint8_t id, std::size_t size) {
  constexpr std::uint8_t kSetReport = 0x09;
  return {0x21, kSetReport, static_cast<std::uint16_t>(0x0200 | id), interface_number,
          static_cast<std::uint16_t>(size)};
}

UsbControlResult control_and_wait(UsbLink& link, const UsbSetup& setup,
                                  std::span<const std::uint8_t> out, double timeout_s) {
  if (!link.start_control(setup, out, timeout_s))
    return {false, link.gone() ? UsbError::kGone : UsbError::kOther, {}};
  // The transfer ends by its own time-out; this one guards against one that does not.
  wait_until(link, timeout_s + 0.1, [&] { return !link.control().running; });
  UsbControlResult result = link.control();
  if (result.running) result = {false, UsbError::kTimeout, {}};
  return result;
}

}  // namespace osteon
