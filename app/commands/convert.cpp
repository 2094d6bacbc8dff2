#include <filesystem>
#include <iostream>
#include <memory>
#include <vector>

#include "app/command.h"
#include "app/progress.h"
#include "io/export/dicom_series.h"
#include "io/files/write_volume.h"
#include "io/study.h"

namespace volumen {

namespace {

struct ConvertOptions {
  std::string path, output, series;
};

using Notes = std::vector<std::string>;

// A folder stands for a DICOM series: one that is there, or a name that ends in "/".
bool isFolder(const std::string& output) {
  std::error_code ignored;
  return output.ends_with('/') || std::filesystem::is_directory(output, ignored);
}

Status write(const Volume& volume, const Series& series, const std::string& output, const Progress& progress,
             const CancelToken& cancel) {
  if (isFolder(output)) return writeDicomSeries(volume, dicomTags(series), output, progress, cancel);
  return writeVolume(volume, output, progress, cancel);
}

// What the user is to be told of what was written.
void addNotes(Notes& notes, const Study& study, const ConvertOptions& options, const Series& series,
              const Loaded& loaded) {
  if (options.series.empty() && study.volumes.size() > 1)
    notes.push_back(options.path + " holds " + std::to_string(study.volumes.size()) + " volumes; " +
                    series.id + ", the one with most voxels, was written (--series chooses).");
  notes.insert(notes.end(), loaded.warnings.begin(), loaded.warnings.end());
  if (loaded.drawn != loaded.acquired) {
    const int made = series.regular ? series.regular->interpolatedSlices : 0;
    notes.push_back("The slices of " + series.id + " are not evenly spaced: a regular grid of " +
                    std::to_string(loaded.drawn->size().z) + " slices was written, " + std::to_string(made) +
                    " of them interpolated.");
  }
  if (!loaded.drawn->geometry().calibrated)
    notes.push_back(series.id + " is not calibrated: " + options.output +
                    " gives no size of its voxels, or 1 mm.");
}

Result<Notes> convert(const ConvertOptions& options, const CancelToken& cancel) {
  const Progress progress = terminalProgress();
  const Result<Study> study = openStudy(options.path, progress, cancel);
  if (!study) return study.error();
  if (study->volumes.empty() && !study->refused.empty()) return Error{study->refused[0].reason};
  if (study->volumes.empty()) return Error{options.path + " holds no volume."};
  const Result<std::size_t> chosen = chooseSeries(*study, options.series);
  if (!chosen) return chosen.error();
  const Series& series = study->volumes[*chosen];
  const Result<Loaded> loaded = loadSeries(series, progress, cancel);
  if (!loaded) return loaded.error();
  if (const Status s = write(*loaded->drawn, series, options.output, progress, cancel); !s) return s.error();
  Notes notes;
  addNotes(notes, *study, options, series, *loaded);
  return notes;
}

int run(const ConvertOptions& options, const CancelToken& cancel) {
  if (!isFolder(options.output) && !isVolumeFileName(options.output))
    return failUsage(options.output +
                     ": volumes are written as .nrrd, .nii.gz or .mha, or as a DICOM series "
                     "into a folder, whose name ends in \"/\".");
  const Result<Notes> notes = convert(options, cancel);
  endTerminalProgress();
  if (!notes) return fail(notes.message());
  for (const std::string& note : *notes) std::cerr << "volumen: " << printable(note) << '\n';
  std::cout << printable(options.output) << '\n';
  return exitDone;
}

}  // namespace

std::function<int()> makeConvert(CLI::App& app, const CancelToken& cancel) {
  auto options = std::make_shared<ConvertOptions>();
  app.add_option("PATH", options->path, "A file, a folder or phantom:NAME[:SIZE]")->required();
  app.add_option("-o,--output", options->output,
                 "The file to write: .nrrd, .nii.gz or .mha; or FOLDER/ for a DICOM series")
      ->required();
  app.add_option("--series", options->series,
                 "Which series: its id, its UID or its number in `volumen info`");
  return [options, &cancel] { return run(*options, cancel); };
}

}  // namespace volumen
