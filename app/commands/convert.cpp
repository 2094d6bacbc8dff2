#include <filesystem>
#include <iostream>
#include <memory>
#include <vector>

#include "app/command.h"
#include "app/open_volume.h"
#include "app/progress.h"
#include "app/usage.h"
#include "io/export/dicom_series.h"
#include "io/files/output_file.h"
#include "io/files/write_volume.h"

namespace volumen {

namespace {

struct ConvertOptions {
  std::string path, output, series;
};

// A folder stands for a DICOM series: one that is there, or a name that ends in "/".
bool isFolder(const std::string& output) {
  std::error_code ignored;
  return output.ends_with('/') || std::filesystem::is_directory(output, ignored);
}

Status checkOutput(const std::string& output) {
  if (isFolder(output)) return checkDicomFolder(output);
  const auto file = OutputFile::create(output);
  return file ? Status() : Status(file.error());
}

Status write(const Volume& volume, const Series& series, const std::string& output, const Progress& progress,
             const CancelToken& cancel) {
  if (isFolder(output)) return writeDicomSeries(volume, dicomTags(series), output, progress, cancel);
  return writeVolume(volume, output, progress, cancel);
}

// What the user is to be told of the grid that was written.
void addNotes(std::vector<std::string>& notes, const Opened& opened, const std::string& output) {
  const Loaded& loaded = opened.loaded;
  if (loaded.drawn != loaded.acquired) {
    notes.push_back("Evenly spaced slices were written: " + std::to_string(loaded.drawn->size().z) + ", " +
                    std::to_string(loaded.interpolatedSlices) + " of them interpolated.");
  }
  if (!loaded.drawn->geometry().calibrated)
    notes.push_back("Not calibrated: " + output + " gives no size of its voxels, or 1 mm.");
}

int run(const ConvertOptions& options, const CancelToken& cancel) {
  if (!isFolder(options.output) && !isVolumeFileName(options.output))
    return failUsage(options.output +
                     ": volumes are written as .nrrd, .nii.gz or .mha, or as DICOM to FOLDER/.");
  if (Status s = checkOutput(options.output); !s) return fail(s.message());
  Result<Opened> opened = openVolume(options.path, options.series, cancel);
  if (!opened) return fail(opened.message(), cancel);
  const Status written =
      write(*opened->loaded.drawn, opened->series, options.output, terminalProgress(), cancel);
  endTerminalProgress();
  if (!written) return fail(written.message(), cancel);
  addNotes(opened->notes, *opened, options.output);
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
