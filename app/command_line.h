#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "viewer/volume/cancel.h"

namespace volumen {

/// The command line of the program: its commands with their options.
class CommandLine {
 public:
  explicit CommandLine(const CancelToken& cancel);
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Parses a command line without the name of the program, and runs its command. Returns the exit status;
  /// what is wrong is told on stderr.
  int run(std::vector<std::string> words);
  /// Returns a command with its options; null if there is none of this name.
  const CLI::App* command(const std::string& name) const;

 private:
  CLI::App app_;
  std::function<int()> chosen_;
};

}  // namespace volumen
