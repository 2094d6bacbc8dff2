#include "app/batch/stamps.h"

#include <QCryptographicHash>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "app/output_names.h"
#include "app/printable.h"
#include "app/version.h"
#include "io/files/output_file.h"
#include "io/deidentify/pseudonyms.h"
#include "io/files/preset_files.h"
#include "io/paths/open_path.h"
#include "io/regular_file.h"

namespace volumen {

namespace {

namespace fs = std::filesystem;
using StampJson = nlohmann::ordered_json;

constexpr std::uint64_t mostStampBytes = 64 << 20;

// Returns name, size and time of a file as a line of text.
std::string lineOf(const fs::path& file) {
  std::error_code problem;
  const auto bytes = fs::file_size(file, problem);
  const auto time = fs::last_write_time(file, problem).time_since_epoch().count();
  return problem ? std::string()
                 : file.string() + '\n' + std::to_string(bytes) + ' ' + std::to_string(time) + '\n';
}

// Returns the bytes of a file, or of each file in a folder by its name there; null if there is none.
StampJson bytesOf(const std::string& name) {
  std::error_code problem;
  if (!fs::is_directory(name, problem)) {
    const auto bytes = fs::file_size(name, problem);
    return problem ? StampJson() : StampJson(bytes);
  }
  StampJson files = StampJson::object();
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(name, problem))
    if (!entry.is_directory(problem))
      files[fs::path(entry.path()).lexically_relative(name).string()] = entry.file_size(problem);
  return files;
}

// Returns whether `bytes` names all files that `output` has now.
bool namesAllOf(const std::string& output, const StampJson& bytes) {
  const StampJson now = bytesOf(output);
  return !now.is_object() || std::ranges::all_of(now.items(), [&](const auto& file) {
    return bytes.is_object() && bytes.contains(file.key());
  });
}

// Returns the files that an output became: itself, or a file for each segment (NAME-*.stl).
std::vector<std::string> filesOf(const std::string& output) {
  std::error_code ignored;
  if (fs::exists(bareName(output), ignored)) return {bareName(output)};
  const fs::path place(output);
  const std::string begin = place.stem().string() + '-', end = place.extension().string();
  const fs::path folder = place.has_parent_path() ? place.parent_path() : fs::path(".");
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(begin) && name.ends_with(end)) files.push_back((folder / name).string());
  }
  std::ranges::sort(files);
  return files;
}

// Returns name, size and time of all files that the outputs of a piece became.
std::string linesOfOutputs(const Piece& piece) {
  std::string lines;
  for (const std::string& output : piece.outputs)
    for (const std::string& file : filesOf(output)) lines += lineOf(file);
  return lines;
}

// Returns what is in the stamp file of a piece; null: there is none, or it is broken.
StampJson stampOf(const Piece& piece) {
  const auto text = wholeText(stampFile(piece), mostStampBytes, "a stamp");
  const auto json = text ? StampJson::parse(*text, nullptr, false) : StampJson();
  return json.is_object() ? json : StampJson();
}

}  // namespace

std::string stampFile(const Piece& piece) { return bareName(piece.outputs[0]) + ".volumen-stamp"; }

bool isStamped(const Piece& piece, const std::string& output) {
  const StampJson json = stampOf(piece),
                  outputs = json.is_object() ? json.value("outputs", StampJson()) : json;
  const std::string place = placeOfFile(output);
  return outputs.is_object() && std::ranges::any_of(outputs.items(), [&](const auto& one) {
           return placeOfFile(one.key()) == place && namesAllOf(output, one.value());
         });
}

const std::string& Stamps::filesAt(const std::string& path) {
  const auto [known, isNew] = known_.emplace(path, "");
  if (!isNew || path.starts_with("archive:") || path.starts_with("phantom:")) return known->second;
  QCryptographicHash hash(QCryptographicHash::Sha256);
  if (auto files = filesOfPath(path, {}, cancel_); files) {
    std::ranges::sort(*files);
    for (const std::string& file : *files) hash.addData(QByteArray::fromStdString(lineOf(file)));
  }
  return known->second = hash.result().toHex().toStdString();
}

std::string Stamps::of(const Piece& piece) {
  std::vector<std::string> read = {presetFolder()};
  read.insert(read.end(), piece.reads.begin(), piece.reads.end());
  if (std::ranges::find(piece.words, "--deidentify") != piece.words.end() && userPseudonymKey())
    read.push_back(userPseudonymKeyFile());
  StampJson words = StampJson::array(), files = StampJson::array();
  for (const std::string& word : piece.words) words.push_back(pathForJson(word));
  for (const std::string& path : read) files.push_back(filesAt(path));
  return StampJson{{"version", std::string(VOLUMEN_VERSION) + " " + revision},
                   {"command", words},
                   {"files", files},
                   {"memory", mostBytes_}}
      .dump();
}

bool isDone(const Piece& piece, const std::string& stamp) {
  const StampJson json = stampOf(piece);
  if (!json.is_object() || json.value("made", StampJson()).dump() != stamp) return false;
  const auto outputs = json.find("outputs");
  return outputs != json.end() && outputs->is_object() && !outputs->empty() &&
         std::ranges::all_of(outputs->items(), [](const auto& one) {
           const StampJson bytes = bytesOf(one.key());
           return !bytes.is_null() && one.value() == bytes;
         });
}

StampedEnd stampedEnd(const Piece& piece) {
  const StampJson json = stampOf(piece);
  StampedEnd end;
  if (!json.is_object()) return end;
  if (const auto status = json.find("exit"); status != json.end() && status->is_number_integer())
    end.exitStatus = status->get<int>();
  if (const auto said = json.find("warnings"); said != json.end() && said->is_array())
    for (const StampJson& one : *said)
      if (one.is_string()) end.warnings.push_back(one.get<std::string>());
  return end;
}

Status writeStamp(const Piece& piece, const std::string& stamp, const StampedEnd& end,
                  const FilesAside& aside) {
  StampJson outputs = StampJson::object();
  for (const auto& [name, file] : aside) outputs[name] = bytesOf(file);
  for (const std::string& output : piece.outputs) {
    if (!aside.empty() && output == piece.outputs[0]) continue;
    const std::vector<std::string> files = filesOf(output);
    if (files.empty()) return Error{"It ended well, but " + output + " is not there."};
    for (const std::string& file : files) outputs[file] = bytesOf(file);
  }
  const StampJson all = {{"made", StampJson::parse(stamp)},
                         {"exit", end.exitStatus},
                         {"warnings", end.warnings},
                         {"outputs", outputs}};
  return writeWholeFile(stampFile(piece),
                        all.dump(-1, ' ', false, StampJson::error_handler_t::replace) + "\n");
}

StampTaken::StampTaken(const Piece& piece) : piece_(piece), outputs_(linesOfOutputs(piece)) {
  if (const auto text = wholeText(stampFile(piece), mostStampBytes, "a stamp")) text_ = *text;
  std::error_code ignored;
  fs::remove(stampFile(piece), ignored);
}

void StampTaken::giveBack() const {
  if (!text_.empty() && linesOfOutputs(piece_) == outputs_)
    static_cast<void>(writeWholeFile(stampFile(piece_), text_));
}

}  // namespace volumen
