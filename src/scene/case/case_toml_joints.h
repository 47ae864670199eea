#pragma once

#include <string>

#include "case/case_toml_reader.h"
#include "osteon/scene/case_io.h"

namespace osteon {

/// [[joints]] and [recipe] of case.toml, whose bones have been read.
void read_joints(CaseTomlReader& file, const std::string& where, CaseText& out);
void read_recipe(CaseTomlReader& file, const std::string& where, CaseText& out);

}  // namespace osteon
