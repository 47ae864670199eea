#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace osteon::testing_cli {

namespace fs = std::filesystem;

struct Ran {
  int exit_code = -1;
  std::string output;  ///< standard output and error
};

/// Runs the built executable through the shell and waits for it.
inline Ran run_osteon(const std::string& arguments) {
  Ran ran;
  const std::string command = std::string(OSTEON_EXECUTABLE) + " " + arguments + " 2>&1";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (!pipe) return ran;
  char block[4096];
  for (std::size_t got; (got = std::fread(block, 1, sizeof block, pipe)) > 0;)
    ran.output.append(block, got);
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) ran.exit_code = WEXITSTATUS(status);
  return ran;
}

/// Folder of the reference bones, empty when they are not here.
inline fs::path shared_dir() {
  const char* set = std::getenv("OSTEON_SHARED");
  const fs::path dir = set ? fs::path(set) : fs::path(OSTEON_SOURCE_DIR) / ".." / "shared";
  return fs::is_directory(dir / "anatomy") ? dir : fs::path();
}

/// A folder of its own for each test, removed afterwards.
class CliTest : public ::testing::Test {
 protected:
  void SetUp() override {
    dir_ = fs::temp_directory_path() / ("osteon_cli_" + std::to_string(::getpid()));
    fs::create_directories(dir_);
  }
  void TearDown() override { fs::remove_all(dir_); }
  std::string file(const std::string& name) const { return (dir_ / name).string(); }
  fs::path dir_;
};

}  // namespace osteon::testing_cli
