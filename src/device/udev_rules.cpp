#include "osteon/device/udev_rules.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <tuple>

#include "osteon/base/file.h"

namespace osteon {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kLargestProfile = 1 << 20;

// Its ids are the maker's and are in no profile.
const UsbId kFalcon{0x0403, 0xcb48, "Novint Falcon"};

std::optional<std::uint16_t> id_of(const toml::table& table, const char* key) {
  const auto value = table[key].value<std::int64_t>();
  if (!value || *value < 0 || *value > 0xffff) return std::nullopt;
  return static_cast<std::uint16_t>(*value);
}

// Drivers keep their tables where they like: any table with both ids tells of a device.
void collect(const toml::table& table, const std::string& name, std::vector<UsbId>& out) {
  const auto vendor = id_of(table, "vendor"), product = id_of(table, "product");
  if (vendor && product) out.push_back({*vendor, *product, name});
  for (const auto& [key, node] : table)
    if (const toml::table* inner = node.as_table()) collect(*inner, name, out);
}

void collect_file(const fs::path& file, std::vector<UsbId>& out) {
  const auto text = read_file(file, kLargestProfile);
  if (!text) return;
  try {
    const toml::table root = toml::parse(*text);
    collect(root, root["name"].value_or(file.stem().string()), out);
  } catch (const toml::parse_error&) {
  }
}

}  // namespace

std::vector<UsbId> known_usb_devices(const fs::path& folder) {
  std::vector<UsbId> out{kFalcon};
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(folder, ec))
    if (entry.path().extension() == ".toml") collect_file(entry.path(), out);
  const auto key = [](const UsbId& id) { return std::tie(id.vendor, id.product, id.name); };
  std::sort(out.begin(), out.end(),
            [&](const UsbId& a, const UsbId& b) { return key(a) < key(b); });
  const auto same = [](const UsbId& a, const UsbId& b) {
    return a.vendor == b.vendor && a.product == b.product;
  };
  out.erase(std::unique(out.begin(), out.end(), same), out.end());
  return out;
}

std::string udev_rules(const std::vector<UsbId>& devices) {
  std::string text =
      "# Lets the logged-in user open Osteon's haptic devices.\n"
      "# Install as /etc/udev/rules.d/70-osteon.rules, then: udevadm control --reload\n";
  for (const UsbId& id : devices) {
    char line[160];
    std::snprintf(line, sizeof line,
                  R"(SUBSYSTEM=="usb", ATTR{idVendor}=="%04x", ATTR{idProduct}=="%04x", )"
                  R"(TAG+="uaccess")",
                  id.vendor, id.product);
    text += "# " + id.name + "\n" + line + "\n";
  }
  return text;
}

}  // namespace osteon
