#include "app/open_volume.h"

#include <iostream>

#include "app/command.h"
#include "app/progress.h"
#include "viewer/scene/automatic.h"
#include "viewer/segment/table.h"

namespace volumen {

namespace {

Result<Opened> open(const std::string& path, const std::string& seriesText, const Progress& progress,
                    const CancelToken& cancel) {
  const Result<Study> study = openStudy(path, progress, cancel);
  if (!study) return study.error();
  if (study->volumes.empty() && !study->refused.empty()) {
    const Refused& first = study->refused.front();
    const std::size_t more = study->refused.size() - 1;
    return Error{
        first.path + ": " + first.reason +
        (more ? " (" + std::to_string(more) + " more files were refused: volumen info " + path + ")" : "")};
  }
  if (study->volumes.empty()) return Error{path + " holds no image that could be drawn."};
  const Result<std::size_t> chosen = chooseSeries(*study, seriesText);
  if (!chosen) return chosen.error();
  Opened opened{study->volumes[*chosen], {}, {}};
  Result<Loaded> loaded = loadSeries(opened.series, progress, cancel);
  if (!loaded) return loaded.error();
  opened.loaded = std::move(*loaded);
  if (seriesText.empty() && study->volumes.size() > 1)
    opened.notes.push_back(path + " holds " + std::to_string(study->volumes.size()) + " volumes; this is " +
                           opened.series.id + ", the one with most voxels (--series chooses).");
  opened.notes.insert(opened.notes.end(), opened.loaded.warnings.begin(), opened.loaded.warnings.end());
  return opened;
}

}  // namespace

Result<Opened> openVolume(const std::string& path, const std::string& series, const CancelToken& cancel) {
  auto opened = open(path, series, terminalProgress(), cancel);
  endTerminalProgress();
  return opened;
}

Status removeTable(Opened& opened, const CancelToken& cancel) {
  const Volume& volume = *opened.loaded.drawn;
  if (!inHounsfield(volume, histogram(volume, 1 << 16)))
    return Error{"--remove-table is for CT alone: the values of " + opened.series.id +
                 " are not Hounsfield units."};
  Result<VolumePtr> without = withoutTable(volume, cancel);
  if (!without) return without.error();
  if (opened.loaded.acquired == opened.loaded.drawn) opened.loaded.acquired = *without;
  opened.loaded.drawn = *without;
  return {};
}

void printNotes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) std::cerr << "volumen: " << printable(note) << '\n';
}

}  // namespace volumen
