#include "app/batch/piece.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

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

std::string listOfKinds() {
  std::string all;
  for (const std::string_view kind : kinds) all += (all.empty() ? "" : ", ") + std::string(kind);
  return all;
}

template <class Names>
bool isOneOf(const Names& names, const std::string& word) {
  return std::ranges::find(names, word) != std::end(names);
}

// Returns the text of a value on a command line. The Error: it has none.
Result<std::string> textOf(const JobJson& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return value.dump();
  if (!value.is_array()) return Error{"is neither a text, a number, true nor a list of them"};
  std::string all;
  for (const JobJson& part : value) {
    const auto text = part.is_array() ? Result<std::string>(Error{"holds a list in a list"}) : textOf(part);
    if (!text) return text;
    all += (all.empty() ? "" : ",") + *text;
  }
  return all;
}

// Adds the paths of a piece. The Error: there are none.
Status addPaths(const JobJson& value, Piece& piece) {
  const JobJson all = value.is_array() ? value : JobJson::array({value});
  for (const JobJson& path : all) {
    if (!path.is_string() || path.get<std::string>().empty()) return Error{"\"path\" is not a text"};
    piece.words.push_back(pathOfArgument(path.get<std::string>()));
    piece.path += (piece.path.empty() ? "" : " ") + path.get<std::string>();
  }
  return all.empty() ? Error{"\"path\" is empty"} : Status();
}

Status addOption(const std::string& name, const JobJson& value, const CLI::App& command, Piece& piece) {
  const bool isStdout = name == "output" && !command.get_option_no_throw("--output");
  if (!isStdout && !command.get_option_no_throw("--" + name))
    return Error{"volumen " + piece.command + " has no option --" + name};
  if (value.is_boolean()) {
    if (value.get<bool>()) piece.words.push_back("--" + name);
    return {};
  }
  const auto text = textOf(value);
  if (!text) return Error{'"' + name + "\" " + text.message()};
  if (isOneOf(writes, name)) {
    if (text->starts_with("archive:"))
      return Error{"a piece of work is written to a file, not to an archive"};
    piece.outputs.insert(name == "output" ? piece.outputs.begin() : piece.outputs.end(), *text);
  }
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
  if (Status s = addPaths(json["path"], piece); !s) return s.error();
  piece.group = piece.path + '\n' + (json.contains("series") ? json["series"].dump() : "");
  for (const auto& [name, value] : json.items()) {
    if (name == "command" || name == "path") continue;
    if (Status s = addOption(name, value, command, piece); !s) return s.error();
    if (isOneOf(alone, name)) piece.group += '\n' + name + value.dump();
  }
  if (piece.outputs.empty()) return Error{"\"output\" is missing: the file to write"};
  if (writesFolder(json) && !piece.isFolder()) piece.outputs[0] += '/';
  return piece;
}

// Returns a name under which a file is known however it is spelled.
std::string placeOf(const std::string& output) {
  std::error_code ignored;
  const auto place =
      std::filesystem::weakly_canonical(std::filesystem::absolute(bareName(output), ignored), ignored);
  return place.empty() ? output : place.string();
}

}  // namespace

std::string bareName(const std::string& output) { return output.substr(0, output.find_last_not_of('/') + 1); }

Result<std::vector<Piece>> readPieces(std::string_view list, const CommandLine& commands) {
  std::vector<Piece> pieces;
  std::map<std::string, int> lines;  // by output
  const auto wrong = [](int line, const std::string& why) {
    return Error{"Line " + std::to_string(line) + " of the list: " + why + "."};
  };
  for (int line = 1; !list.empty(); ++line) {
    const std::string_view text = list.substr(0, list.find('\n'));
    list.remove_prefix(std::min(list.size(), text.size() + 1));
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == text.npos || text[first] == '#') continue;
    auto piece = pieceOf(JobJson::parse(text, nullptr, false), commands);
    if (!piece) return wrong(line, piece.message());
    piece->line = line;
    for (const std::string& output : piece->outputs)
      if (const auto [other, isNew] = lines.emplace(placeOf(output), line); !isNew)
        return wrong(line, "it writes " + output + ", as line " + std::to_string(other->second) + " does");
    pieces.push_back(*std::move(piece));
  }
  return pieces;
}

}  // namespace volumen
