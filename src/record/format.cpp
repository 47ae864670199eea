#include "format.h"

#include "osteon/base/hash.h"

namespace osteon {

std::uint64_t header_checksum(const RecordingHeader& header) {
  Hasher hasher;
  hasher.add(header.case_name);
  hasher.add(header.case_source);
  hasher.add(header.case_hash);
  hasher.add(header.seed);
  hasher.add(header.settings_json);
  hasher.add(header.osteon_version);
  hasher.add(header.case_path);
  hasher.add(header.hands);
  hasher.add(header.tray_hash);
  hasher.add(header.portals_hash);
  hasher.add(header.names_json);
  return hasher.value();
}

}  // namespace osteon
