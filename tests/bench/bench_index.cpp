// Times the index: opening, listing and searching 100,000 instances, and importing 20,000 small DICOM files.
// usage: bench_index [FOLDER]. Makes the files there or in a temporary folder.
#include <QCoreApplication>
#include <QTemporaryDir>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "io/index/index.h"
#include "io/open.h"
#include "tests/fixtures/filled_index.h"
#include "tests/unit/io/dicom_folder.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

double milliseconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Prints the median of several runs.
void print(const char* what, const std::function<void()>& work, int runs = 9) {
  std::vector<double> times;
  for (int n = 0; n < runs; ++n) times.push_back(milliseconds(work));
  std::ranges::sort(times);
  std::printf("%-44s %9.1f ms (most %.1f)\n", what, times[times.size() / 2], times.back());
}

void timeQueries(const std::string& folder) {
  print(
      "fill 100,000 instances, 1000 studies",
      [&] {
        const Status filled = fillIndex(folder, {.patients = 500, .studies = 2, .series = 4, .files = 25});
        if (!filled) std::printf("%s\n", filled.message().c_str());
      },
      1);
  print("open", [&] { (void)Index::open(folder).ok(); });
  const Result<Index> index = Index::open(folder);
  if (!index) return;
  print("open and list all studies", [&] { (void)Index::open(folder)->studies().ok(); });
  print("list all studies", [&] { (void)index->studies().ok(); });
  for (const char* words : {"m", "mu", "muller17", "王", "2003", "ct chest", "nothing at all"})
    print(words, [&] { (void)index->studies({.words = words}).ok(); });
  print("series of a study", [&] { (void)index->series(77).ok(); });
}

void timeImport(const std::string& data, const std::string& folder) {
  constexpr int count = 20000, perSeries = 100;
  if (!std::filesystem::exists(data)) {
    for (int n = 0; n < count; ++n) {
      const std::string series = numbered("s", n / perSeries);
      std::filesystem::create_directories(data + "/" + series);
      DicomPicture picture = sliceAt(n % perSeries, n % perSeries);
      picture.seriesUid = "1.2.3." + std::to_string(n / perSeries);
      writeDicom(data + "/" + series + numbered("/i", n), picture);
    }
  }
  Result<Index> index = Index::open(folder);
  const auto import = [&] {
    const Result<ImportReport> report = index->import({data});
    if (report) std::printf("%d new, %d unchanged: ", report->added, report->unchanged);
  };
  print("import 20,000 files", import, 1);
  print("again", import, 3);
  print(
      "openStudy of the same folder", [&] { (void)openStudy(data).ok(); }, 1);
}

}  // namespace

int main(int argc, char** argv) {
  const QCoreApplication app(argc, argv);
  const QTemporaryDir temporary;
  const std::string at = temporary.path().toStdString();
  timeQueries(at + "/filled");
  timeImport(argc > 1 ? argv[1] : at + "/data", at + "/imported");
}
