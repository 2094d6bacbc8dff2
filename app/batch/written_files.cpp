#include "app/batch/written_files.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "app/batch/stamps.h"
#include "app/output_names.h"
#include "io/export/label_table.h"
#include "io/files/header_text.h"

namespace volumen {

namespace {

namespace fs = std::filesystem;

int turntableOf(const Piece& piece) {
  constexpr std::string_view option = "--turntable=";
  constexpr int most = 9999;
  int pictures = 0;
  for (const std::string& word : piece.words)
    if (word.starts_with(option))
      std::from_chars(word.data() + option.size(), word.data() + word.size(), pictures);
  return piece.command == "render" ? std::clamp(pictures, 0, most) : 0;
}

bool isLabelImage(const Piece& piece, const std::string& output) {
  const std::string name = lowerCase(output);
  return piece.command == "segment" && (name.ends_with(".nii.gz") || name.ends_with(".mha"));
}

}  // namespace

std::vector<WrittenName> writtenNames(const Piece& piece) {
  std::vector<WrittenName> names;
  const int pictures = turntableOf(piece);
  for (std::size_t n = 0; n < piece.outputs.size(); ++n) {
    const std::string output = bareName(piece.outputs[n]);
    const bool isTurn = n == 0 && pictures > 0 && output.find('.') != output.npos;
    for (int picture = 0; isTurn && picture < pictures; ++picture)
      names.push_back({numberedName(output, picture), output});
    if (!isTurn) names.push_back({output, output});
    if (isLabelImage(piece, output)) names.push_back({labelTableOf(output), output});
  }
  return names;
}

std::string Places::operator()(const std::string& path) {
  const fs::path bare(bareName(path)), name = bare.filename();
  std::error_code ignored;
  if (name.empty() || name == "." || name == ".." || fs::is_symlink(bare, ignored)) return placeOfFile(path);
  const std::string parent = bare.has_parent_path() ? bare.parent_path().string() : ".";
  const auto [folder, isNew] = folders_.emplace(parent, "");
  if (isNew) folder->second = placeOfFile(parent);
  return (fs::path(folder->second) / name).string();
}

WrittenFiles::WrittenFiles(const std::vector<Piece>& pieces) {
  for (const Piece& piece : pieces) {
    for (const WrittenName& written : writtenNames(piece)) places_.insert(placeOf_(written.name));
    places_.insert(placeOf_(stampFile(piece)));
  }
}

bool WrittenFiles::has(const std::string& file) {
  fs::path place = placeOf_(file);
  while (!places_.contains(place.string()) && place.has_relative_path()) place = place.parent_path();
  return place.has_relative_path();
}

}  // namespace volumen
