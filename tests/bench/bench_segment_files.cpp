// Times writing and reading segments of the chest CT (512 x 512 x 138). Prints medians of real time. Goals: a
// DICOM segmentation of two segments written in 600 ms and read in 500 ms; the surface of all above 226 HU,
// smoothed and written as STL, in 3 s and 600 MiB.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <QTemporaryDir>

#include "io/export/export_segments.h"
#include "io/export/read_segments.h"
#include "tests/bench/often.h"
#include "tests/fixtures/real_volume.h"
#include "viewer/segment/range.h"

namespace {

using namespace volumen;

struct Chest {
  Series series;
  VolumePtr volume;
  std::vector<Segmented> boneAndRest, bone;
};

// Segments: bone, and all else except air.
const Chest& chest() {
  static const Chest made = [] {
    const Result<Study> study = openStudy(tests::dataPath("ct-chest-lidc0314-138"));
    if (!study || study->volumes.empty()) throw std::runtime_error("the chest CT of the data is not there");
    Chest c{study->volumes.front(), {}, {}, {}};
    const Result<Loaded> loaded = loadSeries(c.series);
    if (!loaded) throw std::runtime_error(loaded.message());
    c.volume = loaded->drawn;
    const LabelMap none(c.volume->geometry());
    const LabelMap bone = withLabel(none, 1, voxelsInRange(*c.volume, {226, 1e30}));
    const LabelMap both = withLabel(bone, 2, voxelsInRange(*c.volume, {-300, 225}));
    c.bone.push_back({{{.number = 1, .label = "Bone"}}, bone});
    c.boneAndRest.push_back({{{.number = 1, .label = "Bone"}, {.number = 2, .label = "Rest"}}, both});
    return c;
  }();
  return made;
}

const QTemporaryDir& folder() {
  static const QTemporaryDir made;
  return made;
}
std::string pathOf(const char* name) { return folder().filePath(QString::fromUtf8(name)).toStdString(); }

void written(benchmark::State& state, const char* name, std::vector<Segmented> Chest::*maps) {
  const std::string path = pathOf(name);
  for (auto _ : state)
    if (const auto done = exportSegments(path, chest().*maps, chest().series); !done)
      state.SkipWithError(done.message().c_str());
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["process MiB"] = double(usage.ru_maxrss) / 1024;
}

void read(benchmark::State& state, const char* name) {
  const std::string path = pathOf(name);
  if (const auto done = exportSegments(path, chest().boneAndRest, chest().series); !done)
    state.SkipWithError(done.message().c_str());
  for (auto _ : state)
    if (const auto file = readSegments(path, chest().series, chest().volume->geometry()); !file)
      state.SkipWithError(file.message().c_str());
}

BENCHMARK_CAPTURE(written, DICOM SEG, "both.dcm", &Chest::boneAndRest)->Apply(often);
BENCHMARK_CAPTURE(read, DICOM SEG, "both.dcm")->Apply(often);
BENCHMARK_CAPTURE(written, seg.nrrd, "both.seg.nrrd", &Chest::boneAndRest)->Apply(often);
BENCHMARK_CAPTURE(read, seg.nrrd, "both.seg.nrrd")->Apply(often);
BENCHMARK_CAPTURE(written, STL, "bone.stl", &Chest::bone)->Apply(often);

}  // namespace

BENCHMARK_MAIN();
