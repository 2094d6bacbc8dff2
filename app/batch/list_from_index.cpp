#include "app/batch/list_from_index.h"

#include <nlohmann/json.hpp>

#include "app/batch/list_names.h"
#include "app/batch/piece.h"
#include "app/batch/shell_words.h"
#include "app/index_option.h"
#include "io/files/name_for_uid.h"

namespace volumen {

namespace {

using TypedJson = nlohmann::ordered_json;

// Returns the long name of an option without dashes; empty if the command has none of this name.
std::string longName(const CLI::App& command, const std::string& typed) {
  const CLI::Option* option = command.get_option_no_throw(typed);
  if (option && !option->get_lnames().empty()) return option->get_lnames()[0];
  return typed == "-o" || typed == "--output" ? "output" : "";
}

// Returns a command line as a piece of work without a path. The Error: it has an unknown word.
Result<TypedJson> jobOf(const std::vector<std::string>& words, const CommandLine& commands) {
  const std::string name = words.empty() ? "" : words[0];
  const CLI::App* command = commands.command(name);
  if (!command) return Error{"--do begins with a command of volumen, such as \"render\"."};
  TypedJson job = {{"command", name}};
  for (std::size_t n = 1; n < words.size(); ++n) {
    const std::string& word = words[n];
    const std::string typed = word.substr(0, word.find('='));
    const std::string option = longName(*command, typed);
    if (option.empty())
      return Error{"--do: volumen " + name + " has no option " + typed + "; the path is that of each study."};
    const CLI::Option* known = command->get_option_no_throw(typed);
    const bool isFlag = known && known->get_items_expected_max() == 0;
    if (isFlag)
      job[option] = true;
    else if (typed != word)
      job[option] = word.substr(typed.size() + 1);
    else if (++n < words.size())
      job[option] = words[n];
    else
      return Error{"--do: the value of " + typed + " is missing."};
  }
  return job;
}

std::string withName(std::string text, const std::string& name) {
  constexpr std::string_view place = "{out}";
  for (std::size_t at = text.find(place); at != text.npos; at = text.find(place, at + name.size()))
    text.replace(at, place.size(), name);
  return text;
}

}  // namespace

Result<std::string> listFromIndex(const std::string& words, const std::string& typed,
                                  const std::string& indexFolder, const CommandLine& commands,
                                  bool& isMistyped) {
  isMistyped = true;
  const auto split = shellWords(typed);
  if (!split) return Error{"--do: " + split.message() + "."};
  const auto job = jobOf(*split, commands);
  if (!job) return job.error();
  isMistyped = false;
  const Result<Index> index = openExistingIndex(indexFolder);
  if (!index) return index.error();
  const auto studies = index->studies({.words = words});
  if (!studies) return studies.error();
  if (studies->empty()) return Error{"No study of the index has all of these words: " + words + "."};
  std::string list;
  for (const IndexedStudy& study : *studies) {
    TypedJson piece = {{"command", (*job)["command"]}, {"path", "index:" + study.studyUid}};
    for (const auto& [name, value] : job->items())
      piece[name] = value.is_string()
                        ? TypedJson(withName(value.get<std::string>(), nameForUid(study.studyUid)))
                        : value;
    list += piece.dump() + '\n';
  }
  isMistyped = true;
  const auto right = readPieces(list, commands);
  if (!right) return Error{"--do: " + right.message()};
  const Status apart = checkNames(*right, {}, {}, {});
  return apart ? Result<std::string>(list) : Error{"--do: " + apart.message()};
}

}  // namespace volumen
