#pragma once

#include "commands/support/parser.h"

namespace osteon {

/// `results send` and `results copy`: attempts given to others who keep them.
void add_result_sending(cli::App& results, int& exit_code);

/// `results rescore`: many recordings judged again.
void add_result_rescore(cli::App& results, int& exit_code);

/// `results standard`: a standard set by two groups of learners.
void add_result_standard(cli::App& results, int& exit_code);

}  // namespace osteon
