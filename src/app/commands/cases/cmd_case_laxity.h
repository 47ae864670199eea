#pragma once

namespace osteon {

namespace cli {
class App;
}

/// case laxity, case isometry; after add_case_commands.
void add_case_laxity_commands(cli::App& app, int& exit_code);
/// case acl, which the former adds.
void add_case_acl_command(cli::App& app, int& exit_code);
/// case acl-faults, which that adds.
void add_case_acl_faults_command(cli::App& app, int& exit_code);

}  // namespace osteon
