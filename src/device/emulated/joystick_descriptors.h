#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "usb/usb_transport.h"

namespace osteon {

/// What a device tells of itself, to the byte (joysticks: docs/joystick-firmware.md).
struct JoystickDescriptors {
  std::span<const std::uint8_t> device;
  std::span<const std::uint8_t> configuration;
  std::span<const std::uint8_t> report;  ///< HID report descriptor; empty: none
  const char* product = "";
  const char* serial = "";
};

JoystickDescriptors vector_joystick_descriptors();
/// `out_endpoint`: without one the output reports come by SET_REPORT.
JoystickDescriptors pid_joystick_descriptors(bool out_endpoint = true);

/// Answers GET_DESCRIPTOR (device, configuration, strings, HID report). False: STALL.
bool answer_descriptor(const JoystickDescriptors& descriptors, const UsbSetup& setup,
                       std::span<std::uint8_t> in, std::size_t& in_size);

}  // namespace osteon
