#pragma once

#include <optional>
#include <span>
#include <string>

#include "cases/make_patient.h"

namespace osteon {

/// What the panel for a new patient shows.
struct PatientModel {
  bool open = false;
  bool making = false;
  double fraction = 0;                             ///< 0..1, while making
  std::span<const VariationParameter> parameters;  ///< of the order's anatomy
  std::span<const AnatomyFinding> findings;
  PatientOrder order;
  std::string problem;  ///< why the last one could not be made; empty: it could, or none was tried
};

/// What it asks for.
struct PatientRequests {
  bool toggle = false;
  std::optional<PatientOrder> order = {};  ///< as the user has just changed it
  bool make = false;
  bool stop = false;
};

}  // namespace osteon
