#include "app/usage.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "viewer/scene/similar_name.h"

namespace volumen {

namespace {

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : between) + word;
  return all;
}

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

bool isNumber(const std::string& text, double low, double high, bool whole) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value >= low && value <= high &&
         (!whole || value == std::floor(value));
}

CLI::Option* numeric(CLI::Option* option, double low, double high, bool whole) {
  const std::string range = shortNumber(low) + " to " + shortNumber(high);
  const auto check = [=](const std::string& text) {
    if (isNumber(text, low, high, whole)) return std::string();
    return '"' + text + "\" is not a " + (whole ? "whole " : "") + "number from " + range + ".";
  };
  return option->check(CLI::Validator(check, ""))->type_name((whole ? "N (" : "X (") + range + ")");
}

// Returns "-o" for "-o,--output", as a user types it.
std::string typedName(const CLI::Option& option) {
  if (!option.get_snames().empty()) return "-" + option.get_snames().front();
  return option.get_name();
}

std::string missing(const CLI::App& app) {
  if (app.get_require_subcommand_min() > 0) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    return "Missing COMMAND: " + joined(names, ", ") + ".";
  }
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_required() || option->count() > 0) continue;
    std::string text = option->get_description();
    if (!text.empty()) text[0] = char(std::tolower(text[0]));
    if (option->get_positional()) return "Missing " + option->get_name(true) + ": " + text + ".";
    return "Missing " + typedName(*option) + " " + option->get_type_name() + ": " + text + ".";
  }
  return "Something is missing.";
}

std::string unexpected(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining(true);
  const auto option =
      std::find_if(words.begin(), words.end(), [](const std::string& word) { return word.starts_with('-'); });
  if (option == words.end())
    return words.empty() ? "Too many arguments." : "Unexpected argument \"" + words.front() + "\".";
  std::vector<std::string> names;
  for (const CLI::Option* known : app.get_options())
    for (const std::string& name : known->get_lnames()) names.push_back("--" + name);
  const std::string typed = option->substr(0, option->find('='));
  const auto similar = similarName(typed, names);
  return "Unknown option " + typed + "." + (similar ? " Did you mean " + *similar + "?" : "");
}

// An empty word usually is an unset variable of a script.
CLI::Validator notEmpty(const std::string& what) {
  return {[what](const std::string& text) {
            return text.empty() ? "\"\" is not a " + what + "." : std::string();
          },
          ""};
}

}  // namespace

HelpFormatter::HelpFormatter() {
  column_width(34);
  label("SUBCOMMAND", "COMMAND");
  label("Positionals", "Arguments");
}

// Two blanks at least tell an option from its text: one that leaves room for one blank has a line of its own.
std::string HelpFormatter::make_option(const CLI::Option* option, bool isPositional) const {
  std::string text = CLI::Formatter::make_option(option, isPositional);
  const std::string name = "  " + make_option_name(option, isPositional) + make_option_opts(option);
  if (name.size() + 1 == get_column_width())
    text.replace(name.size(), 1, "\n" + std::string(get_column_width(), ' '));
  return text;
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  const std::string type = option->get_type_name();
  return type.empty() ? "" : " " + type;
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const {
  if (app->get_parent() == nullptr)
    return "Usage: " + name + " [PATH ...]              open the window\n       " + name +
           " COMMAND [OPTIONS] PATH\n";
  return CLI::Formatter::make_usage(app, name);
}

CLI::Option* oneOf(CLI::Option* option, const std::vector<std::string>& words) {
  const auto check = [words](const std::string& text) {
    if (std::find(words.begin(), words.end(), text) != words.end()) return std::string();
    return '"' + text + "\" is not one of " + joined(words, ", ") + ".";
  };
  return option->check(CLI::Validator(check, ""))->type_name(joined(words, "|"));
}

CLI::Option* number(CLI::Option* option, double low, double high) {
  return numeric(option, low, high, false);
}

CLI::Option* wholeNumber(CLI::Option* option, long low, long high) {
  return numeric(option, double(low), double(high), true);
}

void addExamples(CLI::App& app, const std::vector<std::string>& lines) {
  app.footer("Examples:\n  " + joined(lines, "\n  "));
}

CLI::Option* addPath(CLI::App& app, std::string& path) {
  return app
      .add_option(
          "PATH", path,
          "A file, a folder, index:STUDY[/SERIES], archive:NAME/STUDY[/SERIES] or phantom:NAME[:SIZE]")
      ->check(notEmpty("file or folder"))
      ->type_name("");
}

CLI::Option* addPaths(CLI::App& app, std::vector<std::string>& paths) {
  return app.add_option("PATH", paths, "Files and folders")->check(notEmpty("file or folder"))->type_name("");
}

void addSeries(CLI::App& app, std::string& series) {
  app.add_option("--series", series, "The series to use: its number in `volumen info`, its UID or its id")
      ->check(notEmpty("series: `volumen info` numbers them"))
      ->type_name("SERIES");
}

std::string usageProblem(const CLI::ParseError& error, const CLI::App& app) {
  const std::string text = error.what();
  if (dynamic_cast<const CLI::RequiredError*>(&error)) return missing(app);
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) return unexpected(app);
  if (dynamic_cast<const CLI::ExcludesError*>(&error))
    if (const auto at = text.find(" excludes "); at != std::string::npos)
      return text.substr(0, at) + " does not go with " + text.substr(at + 10) + ".";
  if (dynamic_cast<const CLI::RequiresError*>(&error)) return text + ".";
  const std::string name = text.substr(0, text.find(':'));
  if (text.find("At Most 1") != std::string::npos) return name + " is given more than once.";
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) && text.ends_with("missing"))
    return name + " needs a value.";
  return text;
}

std::string unknownCommand(const std::string& word, const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands({})) names.push_back(sub->get_name());
  const auto similar = similarName(word, names);
  return "Unknown command \"" + word + "\"." + (similar ? " Did you mean " + *similar + "?" : "") +
         " Commands: " + joined(names, ", ") + " (plain `volumen` opens the window).";
}

}  // namespace volumen
