#pragma once

namespace osteon {

/// The whole program: parses the command line and runs one command. Exit codes: 0 done, 1 the
/// answer is no (a check failed, a replay differs), 2 the input or the command line is bad.
int run_cli(int argc, char** argv);

}  // namespace osteon
