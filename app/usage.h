#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace volumen {

/// Formats help texts: one line a command, and option, value, text for each option, without the parser's
/// remarks.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter();
  std::string make_option(const CLI::Option* option, bool isPositional) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_usage(const CLI::App* app, std::string name) const override;
};

/// Restricts `option` to these words, which the help shows.
CLI::Option* oneOf(CLI::Option* option, const std::vector<std::string>& words);

/// Restricts `option` to numbers (or whole numbers) from `low` to `high`, which the help shows.
CLI::Option* number(CLI::Option* option, double low, double high);
CLI::Option* wholeNumber(CLI::Option* option, long low, long high);

/// Adds "Examples:" and one line each below a command's help.
void addExamples(CLI::App& app, const std::vector<std::string>& lines);

/// Add PATH (or several) and --series, which most commands take.
CLI::Option* addPath(CLI::App& app, std::string& path);
CLI::Option* addPaths(CLI::App& app, std::vector<std::string>& paths);
void addSeries(CLI::App& app, std::string& series);

/// Returns the problem of an invalid command line in one sentence.
std::string usageProblem(const CLI::ParseError& error, const CLI::App& app);

/// Returns "Unknown command "X". Did you mean render? Commands: ..."
std::string unknownCommand(const std::string& word, const CLI::App& app);

}  // namespace volumen
