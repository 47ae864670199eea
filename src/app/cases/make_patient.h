#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "osteon/anatomy/variation.h"
#include "osteon/base/result.h"
#include "osteon/scene/case.h"

namespace osteon {

/// A patient of a built-in anatomy, as asked for.
struct PatientOrder {
  std::string anatomy = "wrist";           ///< "wrist", "knee" or "fast_box"
  std::optional<std::uint64_t> seed = {};  ///< draws what is not set; none: as built in
  std::vector<ParameterValue> set = {};
  std::vector<FindingChoice> findings = {};
  std::string side = {};  ///< "left", "right", or empty: the description's own
};

/// What was made of it.
struct MadePatient {
  std::vector<ParameterValue> values;  ///< every parameter as it was used
  int halvings = 0;                    ///< see VariedAnatomy
  std::vector<CaseFinding> findings;
  std::size_t bones = 0, soft_parts = 0;
  std::string side;
};

/// Parameters and findings that an anatomy can have.
struct PatientChoices {
  std::vector<VariationParameter> parameters;
  std::vector<AnatomyFinding> findings;
};
Result<PatientChoices> patient_choices(const std::string& anatomy);

/// The command that makes the patient again, numbers to their last digit.
std::string command_of(const PatientOrder& order);

/// Grows the patient. `soft_parts` false: the bones alone.
Result<VariedAnatomy> grow_patient(const PatientOrder& order,
                                   const std::function<void(double)>& progress = {},
                                   bool soft_parts = true);

/// Grows the patient and saves it as the case folder `out`, which must not hold anything yet;
/// case.toml begins with the command that makes it again and every value used. Nothing is left
/// under that name unless all was written. `progress` is told the share of the bones grown; it may
/// throw to stop.
Result<MadePatient> make_patient(const PatientOrder& order, const std::filesystem::path& out,
                                 const std::function<void(double)>& progress = {});

}  // namespace osteon
