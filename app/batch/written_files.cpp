#include "app/batch/written_files.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "app/batch/stamps.h"
#include "app/output_names.h"
#include "app/recipe_word.h"
#include "io/export/export_segments.h"
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

bool hasWord(const Piece& piece, std::string_view begin) {
  return std::ranges::any_of(piece.words, [&](const std::string& word) { return word.starts_with(begin); });
}

// A range is one segment, and so are most recipes. What a file holds is not known.
bool hasOneSegment(const Piece& piece) {
  if (hasWord(piece, "--range=")) return true;
  return std::ranges::any_of(builtInRecipes(), [&](const Recipe& recipe) {
    return recipe.segments.size() == 1 &&
           std::ranges::find(piece.words, "--recipe=" + recipeWord(recipe)) != piece.words.end();
  });
}

bool writesSurfaces(const Piece& piece) {
  if (piece.command != "segment" && !hasWord(piece, "--as=stl")) return false;
  const auto format = segmentFormatOf(piece.outputs[0]);
  return format && (*format)->isSurface;
}

}  // namespace

std::optional<SurfaceNames> surfaceNames(const Piece& piece) {
  if (!writesSurfaces(piece) || hasWord(piece, "--one-file") || hasOneSegment(piece)) return {};
  const std::string& output = piece.outputs[0];
  const std::size_t ending = output.rfind('.');
  return SurfaceNames{output.substr(0, ending) + '-', output.substr(ending)};
}

std::vector<std::string> writtenNames(const Piece& piece) {
  std::vector<std::string> names;
  const int pictures = turntableOf(piece);
  for (std::size_t n = 0; n < piece.outputs.size(); ++n) {
    const std::string output = bareName(piece.outputs[n]);
    const bool isTurn = n == 0 && pictures > 0 && output.find('.') != output.npos;
    for (int picture = 0; isTurn && picture < pictures; ++picture)
      names.push_back(numberedName(output, picture));
    if (!isTurn) names.push_back(output);
    if (isLabelImage(piece, output)) names.push_back(labelTableOf(output));
  }
  names.push_back(stampFile(piece));
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

void SurfacePlaces::add(const Piece& piece, Places& placeOf) {
  if (const auto names = surfaceNames(piece))
    lines_.emplace(std::pair(placeOf(names->begin), names->end), piece.line);
}

int SurfacePlaces::lineOf(const std::string& place, int besides) const {
  const std::size_t name = place.rfind('/') + 1;
  for (std::size_t dash = place.find('-', name); dash != place.npos; dash = place.find('-', dash + 1)) {
    const std::string begin = place.substr(0, dash + 1), rest = place.substr(dash + 1);
    for (auto at = lines_.lower_bound({begin, ""}); at != lines_.end() && at->first.first == begin; ++at)
      if (rest.ends_with(at->first.second) && at->second != besides) return at->second;
  }
  return 0;
}

}  // namespace volumen
