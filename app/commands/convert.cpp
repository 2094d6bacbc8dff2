#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <vector>

#include "app/command.h"
#include "app/commands/convert_volumes.h"
#include "app/open_volume.h"
#include "app/progress.h"
#include "app/usage.h"
#include "io/export/dicom_folder.h"
#include "io/export/dicom_series.h"
#include "io/files/header_text.h"
#include "io/files/output_file.h"
#include "io/files/volume_writers.h"
#include "io/files/write_volume.h"

namespace volumen {

namespace {

struct ConvertOptions {
  std::string path, output, series;
};

// A folder (an existing one, or a name that ends in "/") means a DICOM series.
bool isFolder(const std::string& output) {
  std::error_code ignored;
  return output.ends_with('/') || std::filesystem::is_directory(output, ignored);
}

bool isNifti(const std::string& output) { return lowerCase(output).ends_with(".nii.gz"); }

Status checkOutput(const std::string& output) {
  if (isFolder(output)) return checkDicomFolder(output);
  const auto file = OutputFile::create(output);
  return file ? Status() : Status(file.error());
}

// Returns notes for the user about the written file.
Result<std::vector<std::string>> write(const Opened& opened, const std::string& output,
                                       const Progress& progress, const CancelToken& cancel) {
  const Volume& volume = *opened.loaded.drawn;
  if (isFolder(output)) {
    const auto tags = readDicomTags(opened.series, opened.loaded, progress, cancel);
    if (!tags) return tags.error();
    return writeDicomSeries(volume, *tags, output, progress, cancel);
  }
  if (const Status written = writeVolume(volume, output, progress, cancel); !written) return written.error();
  std::vector<std::string> notes;
  if (!volume.geometry().calibrated)
    notes.push_back("Not calibrated: " + output + " gives no size of its voxels, or 1 mm.");
  return notes;
}

// Returns a note on the written grid, for grids that differ from the acquired slices.
std::string gridNote(const Loaded& loaded) {
  const int made = loaded.interpolatedSlices();
  const std::string slices = std::to_string(loaded.drawn->size().z) + " evenly spaced slices were written";
  return slices + (made ? ", " + std::to_string(made) + " of them interpolated." : ".");
}

int runVolumes(const std::vector<Series>& volumes, const std::string& output, const CancelToken& cancel) {
  const auto written = writeVolumes(volumes, output, terminalProgress(), cancel);
  endTerminalProgress();
  if (!written) return fail(written.message(), cancel);
  printNotes(written->notes);
  std::cout << printable(output) << '\n';
  return statusWith(written->unread);
}

int run(const ConvertOptions& options, const CancelToken& cancel) {
  if (!isFolder(options.output) && !isVolumeFileName(options.output))
    return failUsage(options.output + ": volumes are written as " + volumeEndings() +
                     ", or as DICOM to FOLDER/.");
  if (Status s = checkOutput(options.output); !s) return fail(s.message());
  if (isNifti(options.output)) {
    const auto several = severalVolumes(options.path, options.series, terminalProgress(), cancel);
    if (several && !several->empty()) return runVolumes(*several, options.output, cancel);
  }
  Result<Opened> opened = openVolume(options.path, options.series, cancel);
  if (!opened) return fail(opened.message(), cancel);
  const auto written = write(*opened, options.output, terminalProgress(), cancel);
  endTerminalProgress();
  if (!written) return fail(written.message(), cancel);
  noteKeptTilt(*opened);
  if (opened->loaded.drawn != opened->loaded.acquired) opened->notes.push_back(gridNote(opened->loaded));
  opened->notes.insert(opened->notes.end(), written->begin(), written->end());
  printNotes(opened->notes);
  std::cout << printable(options.output) << '\n';
  return opened->status();
}

}  // namespace

std::function<int()> makeConvert(CLI::App& app, const CancelToken& cancel) {
  auto options = std::make_shared<ConvertOptions>();
  addPath(app, options->path)->required();
  app.add_option("-o,--output", options->output,
                 "The file to write, .nrrd, .nii.gz or .mha; or FOLDER/ for a DICOM series")
      ->type_name("FILE")
      ->required();
  addSeries(app, options->series);
  addExamples(app, {"volumen convert scans/ -o chest.nii.gz", "volumen convert scans/ --series 1 -o copy/"});
  return [options, &cancel] { return run(*options, cancel); };
}

}  // namespace volumen
