#include "app/commands/bench_paper.h"

#include <zlib.h>

#include <filesystem>
#include <iostream>

#include "app/command.h"
#include "app/open_volume.h"
#include "app/progress.h"
#include "app/report_files.h"
#include "results/plots/paper_charts.h"
#include "viewer/scene/presets.h"

namespace volumen {

namespace {

struct StandIn {
  int column;
  const char *path, *name;
  /// size of a gzipped file of bytes without a header, in voxels; 0: the file has a header
  glm::ivec3 rawBytes{0};
};

constexpr StandIn standIns[] = {
    {3, "volumes-classic/engine_256x256x128_uint8.raw.gz", "engine (CT of an engine block)", {256, 256, 128}},
    {4, "volumes-classic/silicium.mha", "silicium"},
    {5, "mr-head-siemens-gap-175", "MR head (Siemens)"},
    {6, "volumes-classic/headsq-quarter/quarter.nhdr", "headsq quarter (CT head)"}};

Result<VolumePtr> readRawBytes(const std::string& path, glm::ivec3 size) {
  VolumeParts parts;
  parts.geometry.size = size;
  std::vector<std::uint8_t> bytes(parts.geometry.voxelCount());
  const gzFile file = gzopen(path.c_str(), "rb");
  const int read = file ? gzread(file, bytes.data(), unsigned(bytes.size())) : -1;
  if (file) gzclose(file);
  if (read != int(bytes.size()))
    return Error{path + " does not hold " + std::to_string(bytes.size()) + " bytes."};
  parts.values = std::move(bytes);
  std::vector<std::string> warnings;
  return Volume::make(std::move(parts), warnings);
}

Result<VolumePtr> readStandIn(const StandIn& s, const std::string& data, const CancelToken& cancel) {
  const std::string path = (std::filesystem::path(data) / s.path).string();
  if (s.rawBytes.x > 0) return readRawBytes(path, s.rawBytes);
  auto opened = openVolume(path, {}, cancel);
  if (!opened) return opened.error();
  return opened->loaded.drawn;
}

// Adds the stand-ins that exist, and notes the missing ones.
Result<std::vector<PaperVolume>> withStandIns(const std::string& data, const CancelToken& cancel) {
  std::vector<PaperVolume> volumes = paperPhantoms();
  if (data.empty()) return volumes;
  for (const StandIn& s : standIns) {
    const auto volume = readStandIn(s, data, cancel);
    if (cancel.cancelled()) return Error{"cancelled"};
    if (!volume) {
      printNotes(
          {volume.message() + " Nothing stands in for the paper's " + paperVolumeNames[s.column] + "."});
      continue;
    }
    const auto scene = presetScene("auto", **volume);
    if (!scene) return scene.error();
    volumes.push_back({s.column, s.name, *volume, *scene});
  }
  return volumes;
}

Status writeAll(const PaperBench& bench, const std::string& folder) {
  if (Status s = makeFolder(folder); !s) return s;
  prepareFonts();
  const StudyTitle title = titleOf({}, {});
  if (Status s = writeReport(folder, "paper.md", paperText(bench, title.machine, title.date)); !s) return s;
  if (Status s = writeReport(folder, "tables.csv", paperTablesCsv(bench)); !s) return s;
  if (Status s = writeReport(folder, "threads.csv", paperThreadsCsv(bench)); !s) return s;
  if (Status s = writeReport(folder, "section4.csv", paperRivalsCsv(bench)); !s) return s;
  const QImage figure9 = chartImage(speedUpByThreads(bench, title), {1100, 800});
  if (Status s = writeReport(folder, "figure9.png", figure9); !s) return s;
  const auto figure3 = drawFigure3(480);
  if (!figure3) return figure3.error();
  return writeReport(folder, "figure3.png", figure3Image(*figure3));
}

}  // namespace

int benchPaper(const std::string& folder, const std::string& data, const PaperOptions& options,
               const CancelToken& cancel) {
  if (Status s = checkFolder(folder); !s) return fail(s.message());
  auto volumes = withStandIns(data, cancel);
  const auto bench = volumes ? measurePaper(std::move(*volumes), options, terminalProgress(), cancel)
                             : Result<PaperBench>(volumes.error());
  endTerminalProgress();
  if (!bench) return fail(bench.message(), cancel);
  const Status written = writeAll(*bench, folder);
  return written.ok() ? exitDone : fail(written.message());
}

}  // namespace volumen
