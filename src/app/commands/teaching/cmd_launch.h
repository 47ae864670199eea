#pragma once

namespace osteon::cli {
class App;
}

namespace osteon {

void add_launch_command(cli::App& app, int& exit_code);  // launch: by a learning system (cmi5)

}  // namespace osteon
