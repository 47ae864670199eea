#pragma once

#include "osteon/anatomy/virtual_scan.h"
#include "scan/scan_parts.h"

namespace osteon {

/// What is to be scanned, in Patient.
struct ScanBody {
  ScanParts parts;
  Aabb box_P;
  double air_hu = 0;
};

/// Lays the bones and soft parts of a case into Patient, gives them their CT numbers and puts them
/// in the order in which they are seen (virtual_scan.h says which, and when this fails).
Result<ScanBody> make_scan_body(const ScannedBody& body, const TissueTable& tissues,
                                const ScanOptions& options);

}  // namespace osteon
