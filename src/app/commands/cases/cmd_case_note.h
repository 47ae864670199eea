#pragma once

namespace osteon::cli {
class App;
}

namespace osteon {

void add_case_note(cli::App& group, int& exit_code);  // called by add_case_commands

}  // namespace osteon
