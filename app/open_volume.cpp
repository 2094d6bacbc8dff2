#include "app/open_volume.h"

#include <algorithm>
#include <iostream>

#include "app/command.h"
#include "app/progress.h"
#include "io/paths/open_path.h"
#include "io/load.h"
#include "io/study/choose.h"
#include "io/zip_archive.h"
#include "results/series/time_points.h"
#include "results/text/text.h"
#include "viewer/scene/automatic.h"

namespace volumen {

Error nothingToShow(const std::string& path, const Study& study) {
  std::vector<Refused> unread = study.refused;
  for (const Image& image : study.images) unread.push_back({image.path, image.notVolume});
  if (unread.empty()) return Error{"No images found in " + path + "."};
  const std::string why = unread[0].path + ": " + unread[0].reason;
  const std::string frames = study.images.empty() ? "" : "\n`volumen slice --plane frame` draws its frames.";
  if (unread.size() == 1) return Error{why + frames};
  return Error{"No images found in " + path + ": " + noVolumesText(study).toStdString() +
               " The first: " + why + "\n`volumen info` lists them." + frames};
}

namespace {

bool strict = false;

// What was opened last, where keepOpened() was called.
struct LastOpened {
  bool isKept = false;
  std::string path;
  std::optional<Study> study;
  Series series;
  std::optional<Loaded> loaded;
};
LastOpened last;

// Loads a series, unless it is the last one loaded and is kept.
Result<Loaded> loadOnce(const Series& series, const Progress& progress, const CancelToken& cancel) {
  if (last.loaded && last.series == series) return *last.loaded;
  last.loaded.reset();  // two volumes may not fit into memory
  Result<Loaded> loaded = loadSeries(series, progress, cancel);
  if (loaded && last.isKept) last.series = series, last.loaded = *loaded;
  return loaded;
}

// Returns one line a series, with the numbers and names of `info`.
std::string listOf(const Study& study) {
  std::string list;
  for (std::size_t n = 0; n < study.volumes.size(); ++n) {
    const int slices = study.volumes[n].acquired.size.z;
    list += "\n  " + std::to_string(n + 1) + "  " + seriesText(study.volumes[n]).toStdString() + ", " +
            std::to_string(slices) + (slices == 1 ? " slice" : " slices");
  }
  return list;
}

Result<Opened> load(const Series& series, const MemoryUse& use, const Progress& progress,
                    const CancelToken& cancel) {
  const VoxelGeometry& grid = series.regular ? series.regular->geometry : series.acquired;
  const auto voxels = double(grid.voxelCount());
  if (Status s = checkMemoryFor(series, use.doing, std::uint64_t(use.bytesAVoxel * voxels)); !s)
    return s.error();
  Result<Loaded> loaded = loadOnce(series, progress, cancel);
  if (!loaded) return loaded.error();
  if (Status whole = checkLosses(series.path, loaded->unread); !whole) return whole.error();
  Opened opened{series, std::move(*loaded), {}};
  opened.notes = sentences(opened.loaded.warnings);
  return opened;
}

// Returns the difference of a volume from others of its series, else the name of the series.
std::string distinction(const Series& series) {
  std::string words;
  for (const SplitBy& by : series.splitBy) words += (words.empty() ? "" : ", ") + by.words;
  if (words.empty()) words = series.label;
  return words.empty() ? seriesText(series).toStdString() : words;
}

// Returns a note on the chosen series, if the user did not choose it in full; else empty.
std::string choiceNote(const std::string& path, const Study& study, const std::string& wanted,
                       std::size_t chosen) {
  const std::size_t volumes = volumesOfUid(study, wanted).size();
  std::string held;
  if (wanted.empty() && study.volumes.size() > 1)
    held = path + " holds " + std::to_string(study.volumes.size()) + " series";
  if (volumes > 1) held = "Series " + wanted + " holds " + std::to_string(volumes) + " volumes";
  if (held.empty()) return {};
  const Series& series = study.volumes[chosen];
  return held + "; using number " + std::to_string(chosen + 1) + ", \"" +
         (wanted.empty() ? seriesText(series).toStdString() + "\" (the largest)"
                         : distinction(series) + '"') +
         ". Choose another with --series.";
}

// Returns Opened::timePoints.
std::vector<Series> timePointsIn(const Study& study, std::size_t chosen) {
  std::vector<const Series*> steps;
  for (const Series& series : study.volumes)
    if (areTimePoints(study.volumes[chosen], series)) steps.push_back(&series);
  if (steps.size() < 2) return {};
  sortTimePoints(steps);
  std::vector<Series> all;
  for (const Series* step : steps) all.push_back(*step);
  return all;
}

Result<Opened> open(const Study& study, const std::string& path, const std::string& wanted,
                    const MemoryUse& use, const CancelToken& cancel) {
  if (study.volumes.empty()) return nothingToShow(path, study);
  const Result<std::size_t> chosen = chooseSeries(study, wanted);
  if (!chosen) return Error{chosen.message() + " " + printable(path) + " holds:" + listOf(study)};
  Result<Opened> opened = load(study.volumes[*chosen], use, terminalProgress(), cancel);
  if (!opened) return opened;
  opened->timePoints = timePointsIn(study, *chosen);
  if (const std::string note = choiceNote(path, study, wanted, *chosen); !note.empty())
    opened->notes.insert(opened->notes.begin(), note);
  return opened;
}

}  // namespace

std::vector<std::size_t> volumesOfUid(const Study& study, const std::string& series) {
  std::vector<std::size_t> volumes;
  for (std::size_t n = 0; n < study.volumes.size(); ++n) {
    if (!series.empty() && study.volumes[n].id == series) return {};
    if (!series.empty() && study.volumes[n].seriesUid == series) volumes.push_back(n);
  }
  return volumes.size() > 1 ? volumes : std::vector<std::size_t>();
}

int Opened::status() const { return statusWith(loaded.unread); }

int statusWith(const std::vector<Unread>& unread) { return unread.empty() ? exitDone : exitLosses; }

void addUnread(std::vector<Unread>& all, const std::vector<Unread>& more) {
  for (const Unread& file : more)
    if (std::ranges::find(all, file) == all.end()) all.push_back(file);
}

void refuseLosses() { strict = true; }

void keepOpened() { last.isKept = true; }

Status checkStrict(const std::string& what, const std::vector<Unread>& unread) {
  if (!strict || unread.empty()) return {};
  std::string list;
  for (const Unread& file : unread) list += "\n  " + printable(lastingPath(file.path)) + ": " + file.reason;
  return Error{"Nothing was written (--strict): of " + what + " could not be read:" + list};
}

Status checkLosses(const std::string& what, const std::vector<Unread>& unread) {
  const auto ofMachine = std::ranges::find(unread, true, &Unread::again);
  if (ofMachine != unread.end())
    return Error{"Nothing was written, as not all of " + what +
                 " could be read now: " + printable(lastingPath(ofMachine->path)) + ": " + ofMachine->reason};
  return checkStrict(what, unread);
}

std::vector<std::string> sentences(const std::vector<Warning>& warnings) {
  std::vector<std::string> all;
  for (const Warning& w : warnings) all.push_back(w.sentence);
  return all;
}

std::vector<std::string> unreadSentences(const std::vector<const Series*>& all) {
  std::vector<std::string> said;
  for (const Series* series : all)
    for (const Warning& w : series->warnings)
      if (w.kind == WarningKind::unread && std::ranges::find(said, w.sentence) == said.end())
        said.push_back(w.sentence);
  return said;
}

nlohmann::ordered_json unreadJson(const std::vector<Unread>& unread) {
  auto list = nlohmann::ordered_json::array();
  for (const Unread& file : unread)
    list.push_back(
        {{"path", pathForJson(lastingPath(file.path))}, {"reason", file.reason}, {"beside", file.beside}});
  return list;
}

Result<Study> openStudyAt(const std::string& path, const CancelToken& cancel) {
  if (last.study && last.path == path) return *last.study;
  Result<Study> study = openPath(path, terminalProgress(), cancel);
  endTerminalProgress();
  if (study && last.isKept) last.path = path, last.study = *study;
  return study;
}

Result<Opened> openVolume(const std::string& path, const std::string& series, const CancelToken& cancel,
                          const MemoryUse& use) {
  const Result<Study> study = openStudyAt(path, cancel);
  return study ? openVolume(*study, path, series, cancel, use) : study.error();
}

Result<Opened> openVolume(const Study& study, const std::string& path, const std::string& series,
                          const CancelToken& cancel, const MemoryUse& use) {
  auto opened = open(study, path, series, use, cancel);
  endTerminalProgress();
  return opened;
}

Result<Opened> openSeries(const Series& series, const CancelToken& cancel) {
  auto opened = load(series, {}, terminalProgress(), cancel);
  endTerminalProgress();
  return opened;
}

Status checkHounsfield(const Opened& opened) {
  const Volume& volume = *opened.loaded.drawn;
  if (inHounsfield(volume, histogram(volume, 1 << 16))) return {};
  return Error{"--remove-table is for CT alone: the values of " + opened.series.id +
               " are not Hounsfield units."};
}

Status takeAway(const Mask& mask, Opened& opened, const CancelToken& cancel) {
  const Volume& volume = *opened.loaded.drawn;
  if (mask.tableRemoved)
    if (Status s = checkHounsfield(opened); !s) return s;
  Result<VolumePtr> without = masked(volume, mask, cancel);
  if (!without) return without.error();
  if (opened.loaded.acquired == opened.loaded.drawn) opened.loaded.acquired = *without;
  opened.loaded.drawn = *without;
  return {};
}

void noteKeptTilt(Opened& opened) {
  for (const Warning& warning : opened.loaded.warnings) {
    if (warning.kind != WarningKind::sheared) continue;
    const std::string tilt = warning.sentence.substr(0, warning.sentence.find(','));
    std::ranges::replace(opened.notes, warning.sentence, tilt + ", kept in the file.");
  }
}

void printNotes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) std::cerr << "volumen: " << printable(note) << '\n';
}

}  // namespace volumen
