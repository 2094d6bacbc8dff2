#include "app/batch/piece.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "app/option_words.h"
#include "app/printable.h"
#include "io/paths/open_path.h"

namespace volumen {

namespace {

using JobJson = nlohmann::ordered_json;

constexpr std::string_view kinds[] = {"render", "slice", "segment", "measure", "info", "convert", "export"};
constexpr std::string_view writes[] = {"output", "csv", "stats", "error-map"};
// These options hold for a whole process, so pieces with them share none with others.
constexpr std::string_view alone[] = {"strict", "largest-frame"};
// These options make a command do something else.
constexpr std::string_view ofNoPiece[] = {"help", "list-recipes", "list-presets", "in-process"};

std::string listOfKinds() {
  std::string all;
  for (const std::string_view kind : kinds) all += (all.empty() ? "" : ", ") + std::string(kind);
  return all;
}

template <class Names>
bool isOneOf(const Names& names, const std::string& word) {
  return std::ranges::find(names, word) != std::end(names);
}

// Returns a text. The Error: on a command line it would end at a NUL.
Result<std::string> withoutNul(std::string text) {
  if (text.find('\0') != text.npos) return Error{"holds the character NUL"};
  return text;
}

// Returns the text of a value on a command line. The Error: it has none.
Result<std::string> textOf(const JobJson& value) {
  if (value.is_string()) return withoutNul(value.get<std::string>());
  if (value.is_number()) return value.dump();
  if (!value.is_array()) return Error{"is neither a text, a number nor a list of them"};
  std::string all;
  for (const JobJson& part : value) {
    const auto text = part.is_array() ? Result<std::string>(Error{"holds a list in a list"}) : textOf(part);
    if (!text) return text;
    all += (all.empty() ? "" : ",") + *text;
  }
  return all;
}

// Returns a text that can stand on a command line. The Error: it is none.
Result<std::string> wordOf(const JobJson& value) {
  if (!value.is_string() || value.get<std::string>().empty()) return Error{"is not a text"};
  return withoutNul(value.get<std::string>());
}

// Adds the path of a piece. A name that begins with a dash is no option.
Status addPath(const JobJson& value, Piece& piece) {
  const auto path = wordOf(value);
  if (!path) return Error{"\"path\" " + path.message()};
  piece.path = *path;
  const std::string word = pathOfArgument(*path);
  piece.words.push_back(word.starts_with('-') ? "./" + word : word);
  piece.reads.push_back(piece.words.back());
  return {};
}

Status addOutput(const std::string& name, const JobJson& value, Piece& piece) {
  const auto output = wordOf(value);
  if (!output) return Error{'"' + name + "\" " + output.message()};
  if (output->starts_with("archive:"))
    return Error{"a piece of work is written to a file, not to an archive"};
  if (bareName(*output).empty()) return Error{'"' + name + "\" is not the name of a file"};
  piece.outputs.insert(name == "output" ? piece.outputs.begin() : piece.outputs.end(), *output);
  return {};
}

bool namesFile(const CLI::Option& option, const std::string& value) {
  const std::string type = option.get_type_name();
  std::error_code ignored;
  return type.find("FILE") != type.npos || type == "OTHER" || type == "SESSION" ||
         std::filesystem::is_regular_file(value, ignored);
}

Status addFlag(const std::string& name, const JobJson& value, Piece& piece) {
  if (!value.is_boolean()) return Error{'"' + name + "\" is a flag: its value is true or false"};
  if (value.get<bool>()) piece.words.push_back("--" + name);
  return {};
}

Status addOption(const std::string& name, const JobJson& value, const CLI::App& command, Piece& piece) {
  const CLI::Option* option = command.get_option_no_throw("--" + name);
  const bool isStdout = name == "output" && !option;
  if (isOneOf(ofNoPiece, name)) return Error{"--" + name + " is no part of a piece of work"};
  if (!isStdout && !option) return Error{"volumen " + piece.command + " has no option --" + name};
  if (option && option->get_items_expected_max() == 0) return addFlag(name, value, piece);
  if (value.is_boolean()) return Error{'"' + name + "\" needs a value, not true or false"};
  const auto text = textOf(value);
  if (!text) return Error{'"' + name + "\" " + text.message()};
  const bool isWritten = isOneOf(writes, name);
  if (isWritten)
    if (Status s = addOutput(name, value, piece); !s) return s;
  if (!isWritten && namesFile(*option, *text)) piece.reads.push_back(*text);
  if (isStdout)
    piece.keepsStdout = true;
  else
    piece.words.push_back("--" + name + "=" + *text);
  return {};
}

bool writesFolder(const JobJson& json) {
  return json.value("as", JobJson()) == "series" || json.value("deidentify", JobJson()) == true;
}

Result<Piece> pieceOf(const JobJson& json, const CommandLine& commands) {
  Piece piece;
  if (!json.is_object()) return Error{"it is no JSON object"};
  if (const auto name = json.find("command"); name != json.end() && name->is_string()) piece.command = *name;
  if (!isOneOf(kinds, piece.command)) return Error{"\"command\" is none of " + listOfKinds()};
  piece.words.push_back(piece.command);
  const CLI::App& command = *commands.command(piece.command);
  if (!json.contains("path")) return Error{"\"path\" is missing"};
  if (Status s = addPath(json["path"], piece); !s) return s.error();
  std::string alike;
  for (const auto& [name, value] : json.items()) {
    if (name == "command" || name == "path") continue;
    if (Status s = addOption(name, value, command, piece); !s) return s.error();
    if (isOneOf(alone, name)) alike += '\n' + name + value.dump();
  }
  piece.group = piece.path + '\n' + (json.contains("series") ? json["series"].dump() : "") + alike;
  if (piece.outputs.empty()) return Error{"\"output\" is missing: the file to write"};
  if (writesFolder(json) && !piece.isFolder()) piece.outputs[0] += '/';
  return piece;
}

// The Error also: a key is there twice, of which a parser would take one.
Result<Piece> pieceOfLine(std::string_view text, const CommandLine& commands) {
  std::set<std::string> keys;
  std::string twice;
  const auto look = [&](int depth, JobJson::parse_event_t event, JobJson& parsed) {
    if (event != JobJson::parse_event_t::key || depth != 1) return true;
    if (!keys.insert(parsed.get<std::string>()).second) twice = parsed.get<std::string>();
    return true;
  };
  const JobJson json = JobJson::parse(text, look, false);
  if (json.is_object() && !twice.empty()) return Error{'"' + twice + "\" is there twice"};
  return pieceOf(json, commands);
}

}  // namespace

std::string bareName(const std::string& output) { return output.substr(0, output.find_last_not_of('/') + 1); }

Result<std::vector<Piece>> readPieces(std::string_view list, const CommandLine& commands,
                                      const CancelToken& cancel) {
  std::vector<Piece> pieces;
  const auto wrong = [](int line, const std::string& why) {
    return Error{"Line " + std::to_string(line) + " of the list: " + why + "."};
  };
  for (int line = 1; !list.empty(); ++line) {
    if (cancel.cancelled()) return Error{"Interrupted; nothing was done."};
    const std::string_view text = list.substr(0, list.find('\n'));
    list.remove_prefix(std::min(list.size(), text.size() + 1));
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == text.npos || text[first] == '#') continue;
    auto piece = pieceOfLine(text, commands);
    if (!piece) return wrong(line, piece.message());
    piece->line = line;
    pieces.push_back(*std::move(piece));
  }
  return pieces;
}

}  // namespace volumen
