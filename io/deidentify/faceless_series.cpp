#include "io/deidentify/faceless_series.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "io/load.h"
#include "io/study/faces.h"
#include "viewer/segment/face.h"
#include "viewer/segment/mask.h"

namespace volumen {

namespace {

bool isNear(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(1.0, std::abs(b)); }

// Returns the voxels that stay of the slices as acquired: those of the nearest drawn slices.
BitMask keptOf(const Loaded& loaded, const BitMask& face) {
  BitMask kept(loaded.acquired->geometry());
  const int last = face.size().z - 1;
  for (int k = 0; k < kept.size().z; ++k) {
    const double place = loaded.places.empty() ? k : loaded.places[std::size_t(k)];
    const int drawn = std::clamp(int(std::lround(place)), 0, last);
    for (int j = 0; j < kept.size().y; ++j) std::ranges::copy(face.row(j, drawn), kept.row(j, k).begin());
  }
  return inverted(std::move(kept));
}

}  // namespace

bool FacelessSeries::mayBeOf(const Series& series) {
  const bool hasKind = series.modality == "CT" || series.modality == "MR";
  const std::set<std::string> files(series.files.begin(), series.files.end());
  return hasKind && series.format == "DICOM" && showsFaceIn3d(series) != false &&
         files.size() == series.files.size() && std::size_t(series.acquired.size.z) == files.size();
}

Result<FacelessSeries> FacelessSeries::of(const Series& series, const Progress& progress,
                                          const CancelToken& cancel) {
  const auto loaded = loadSeries(series, progress, cancel);
  if (!loaded) return loaded.error();
  const auto face = faceOf(*loaded->drawn, cancel);
  if (!face) return face.error();
  auto source = readDicomSource(series, progress, cancel);
  if (!source) return source.error();
  const Volume& acquired = *loaded->acquired;
  const bool isWhole = std::size_t(acquired.size().z) == series.files.size() &&
                       acquired.size().x == face->size().x && acquired.size().y == face->size().y;
  if (!isWhole) return Error{acquired.attributes().name + " is not shown slice by slice."};
  auto without = keptAlone(acquired, keptOf(*loaded, *face), cancel);
  if (!without) return without.error();
  return FacelessSeries(*std::move(without), series.files, *std::move(source));
}

std::optional<StoredSlice> FacelessSeries::pixels(std::size_t n) const {
  const DicomSourceFile& file = source_.file(int(n));
  const DicomSourceFrame& frame = source_.frame(int(n));
  if (file.isMultiFrame()) return {};
  auto made = storedSlice(*volume_, int(n), StoredAs{frame.slope, frame.intercept, file.isSigned}, false);
  const bool isSame = made && made->isSigned == file.isSigned && isNear(made->slope, frame.slope) &&
                      isNear(made->intercept, frame.intercept);
  return isSame ? std::move(made) : std::nullopt;
}

}  // namespace volumen
