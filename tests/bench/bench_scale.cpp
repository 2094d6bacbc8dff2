// How cost grows with the size of the data: for each row of a table the processor time and the peak of memory
// at three sizes or more, and the exponent of the time (the slope of a line through the logarithms of both).
// The data are made anew, the same each time.
//   bench_scale [--sizes A,B,C] [ROW...]
#include <QApplication>
#include <QTemporaryDir>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/worker/worker.h"
#include "tests/bench/scale_data.h"
#include "tests/bench/scale_run.h"
#include "tests/fixtures/program.h"
#include "ui/british.h"
#include "viewer/volume/clock.h"

namespace {

using namespace volumen;
using namespace volumen::bench;

struct Measured {
  double seconds = 0, mebibytes = 0;
  std::string note;  // may be empty
};

struct Row {
  const char* name;
  const char* what;  // N: the size
  std::vector<int> sizes;
  std::function<Measured(const std::string& folder, int size)> measure;
};

std::string self;

Measured run(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), VOLUMEN_PROGRAM);
  const Taken taken = runTimed(std::move(arguments));
  return {taken.seconds, taken.mebibytes, {}};
}

// What the window does in a process of its own, which prints its seconds.
Measured runWindow(const std::string& what, const std::string& with) {
  const Taken taken = runTimed({self, "--window", what, with});
  return {std::stod(taken.out), taken.mebibytes, {}};
}

Measured nifti(const std::string& folder, int timePoints) {
  const std::string path = folder + "/enhanced.dcm";
  apart([&] { writeEnhanced(path, timePoints); });
  return run({"convert", path, "--series", enhancedUid, "-o", folder + "/copy.nii.gz"});
}

Measured wheel(const std::string&, int measurements) {
  return runWindow("wheel", std::to_string(measurements));
}

Measured info(const std::string& folder, int files) {
  apart([&] { writeSlices(folder, files, 500); });
  return run({"info", folder, "--json"});
}

Measured oneSeries(const std::string& folder, int files) {
  apart([&] { writeSlices(folder, files, files); });
  return run({"info", folder, "--json"});
}

Measured segments(const std::string& folder, int count) {
  apart([&] { writeNoise(folder + "/noise.nrrd"); });
  writeNoiseRecipe(folder + "/noise.json", count);
  return run({"segment", folder + "/noise.nrrd", "--recipe", folder + "/noise.json", "-o",
              folder + "/noise.seg.nrrd"});
}

Measured render(const std::string& folder, const char* preset, int slices) {
  apart([&] { writeHead(folder + "/head.nrrd", slices); });
  const std::string stats = folder + "/stats.json";
  Measured m = run(
      {"render", folder + "/head.nrrd", "--preset", preset, "-o", folder + "/head.png", "--stats", stats});
  std::ifstream in(stats);
  const auto error = nlohmann::json::parse(in)["error"];
  std::ostringstream note;
  note.precision(3);
  note << m.mebibytes / (0.5 * slices) << " x the volume";
  if (!error.is_null()) note << ", PSNR at least " << error["psnrDb"].get<double>() << " dB";
  m.note = note.str();
  return m;
}

std::string ofPixels(double mebibytes, int edge) {
  std::ostringstream note;
  note.precision(3);
  note << mebibytes / (2.0 * edge * edge / (1 << 20)) << " x its pixels";
  return note.str();
}

Measured radiograph(const std::string& folder, int edge) {
  apart([&] { writeRadiograph(folder + "/radiograph.dcm", edge); });
  Measured m = run({"slice", folder + "/radiograph.dcm", "--plane", "frame", "--largest-frame", "1000", "-o",
                    folder + "/radiograph.png"});
  m.note = ofPixels(m.mebibytes, edge);
  return m;
}

Measured shown(const std::string& folder, int edge) {
  apart([&] { writeRadiograph(folder + "/radiograph.dcm", edge); });
  Measured m = runWindow("shown", folder + "/radiograph.dcm");
  m.note = ofPixels(m.mebibytes, edge);
  return m;
}

Measured mammograms(const std::string& folder, int megapixels, const char* transferSyntaxUid) {
  apart([&] { writeMammograms(folder, megapixels, transferSyntaxUid); });
  Measured m = runWindow("mammograms", folder);
  std::ostringstream note;
  note.precision(3);
  note << m.mebibytes * (1 << 20) / (4 * 2e6 * megapixels) << " x their pixels";
  m.note = note.str();
  return m;
}

Row mammogramRow(const char* name, const char* what, const char* transferSyntaxUid) {
  return {name, what, {6, 12, 23}, [transferSyntaxUid](const std::string& folder, int megapixels) {
            return mammograms(folder, megapixels, transferSyntaxUid);
          }};
}

Measured inTurn(const std::string&, int series) { return runWindow("turn", std::to_string(series)); }

const std::vector<Row>& rows() {
  static const std::vector<Row> all{
      {"nifti", "4-D NIfTI from one enhanced file, 64 x 64 x 40 x N", {125, 250, 500}, nifti},
      {"wheel", "a wheel step with N measurements in the series", {0, 500, 1000, 2000}, wheel},
      {"info", "`info --json` of N files", {5000, 15000, 50000}, info},
      {"series", "`info --json` of one series of N files", {5000, 15000, 50000}, oneSeries},
      {"segments", "N segments of noise, 512 x 512 x 138, as .seg.nrrd", {5, 10, 20}, segments},
      {"bone",
       "`render` of 512 x 512 x N, bone",
       {250, 500, 1000},
       [](const std::string& folder, int n) { return render(folder, "CT-Bone", n); }},
      {"skin",
       "`render` of 512 x 512 x N, skin and bone",
       {250, 500, 1000},
       [](const std::string& folder, int n) { return render(folder, "CT-Skin-and-Bone", n); }},
      {"radiograph", "`slice` of a radiograph of N x N pixels", {2500, 5000, 10000}, radiograph},
      {"shown", "a radiograph of N x N pixels in the window, until it is seen", {2500, 5000, 10000}, shown},
      mammogramRow("mammograms", "four mammograms of N megapixels until all are seen, on the clock",
                   "1.2.840.10008.1.2.1"),
      mammogramRow("mammograms-jpeg", "the same, JPEG lossless", "1.2.840.10008.1.2.4.70"),
      mammogramRow("mammograms-jpegls", "the same, JPEG-LS", "1.2.840.10008.1.2.4.80"),
      mammogramRow("mammograms-jpeg2000", "the same, JPEG 2000 lossless", "1.2.840.10008.1.2.4.90"),
      {"turn", "N series of 256 x 256 x 104 in the window, one after the other", {5, 10, 20}, inTurn},
  };
  return all;
}

// The slope of log(seconds) over log(size), of sizes above 0.
double exponent(const std::vector<int>& sizes, const std::vector<Measured>& measured) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t m = 0; m < sizes.size(); ++m) {
    if (sizes[m] <= 0 || measured[m].seconds <= 0) continue;
    const double a = std::log(sizes[m]), b = std::log(measured[m].seconds);
    n += 1, x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

void print(const Row& row, const std::vector<int>& sizes) {
  std::vector<Measured> measured;
  for (const int size : sizes) {
    const QTemporaryDir folder;
    measured.push_back(row.measure(folder.path().toStdString(), size));
    const Measured& m = measured.back();
    std::printf("| %s | %d | %.3g s | %.0f MiB | %s |\n", row.what, size, m.seconds, m.mebibytes,
                m.note.c_str());
    std::fflush(stdout);
  }
  std::printf("| %s | exponent | %.2f | | |\n", row.what, exponent(sizes, measured));
}

int runWindowRow(const std::string& what, const std::string& with, double startMs) {
  if (what == "mammograms") return showMammograms(with, startMs);
  if (what == "wheel") return turnTheWheel(std::stoi(with));
  if (what == "turn") return showInTurn(std::stoi(with));
  return showRadiograph(with);
}

}  // namespace

int main(int argc, char** argv) {
  const double startMs = wallMs();
  self = argv[0];
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() == 3 && words[0] == "--window") {
    if (words[1] == "mammograms" && !worker::start()) return 1;
    const QTemporaryDir own;
    for (const char* name : {"XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_DATA_HOME"})
      qputenv(name, own.path().toLocal8Bit());
    QApplication app(argc, argv);
    speakBritish(app);
    return runWindowRow(words[1], words[2], startMs);
  }
  std::vector<int> sizes;
  std::vector<std::string> wanted;
  for (std::size_t n = 0; n < words.size(); ++n) {
    if (words[n] != "--sizes") {
      wanted.push_back(words[n]);
      continue;
    }
    std::stringstream list(n + 1 < words.size() ? words[++n] : "");
    for (std::string size; std::getline(list, size, ',');) sizes.push_back(std::stoi(size));
  }
  for (const Row& row : rows())
    if (wanted.empty() || std::ranges::find(wanted, row.name) != wanted.end())
      print(row, sizes.empty() ? row.sizes : sizes);
  return 0;
}
