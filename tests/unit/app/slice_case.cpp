#include "tests/unit/app/slice_case.h"

#include <QImage>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "io/load.h"
#include "io/open.h"
#include "io/study/choose.h"
#include "tests/fixtures/program.h"

namespace volumen::tests {

namespace {

QString text(double x) { return QString::number(x, 'g', 17); }
QString text(glm::dvec3 v) { return QStringLiteral("%1,%2,%3").arg(text(v.x), text(v.y), text(v.z)); }

/// Reads an attached NRRD of raw float32 with sizes W H.
SliceFile readFloats(const QByteArray& file) {
  const qsizetype end = file.indexOf("\n\n");
  const QList<QByteArray> lines = file.left(end).split('\n');
  SliceFile slice;
  for (const char* needed : {"type: float", "dimension: 2", "encoding: raw", "endian: little"})
    if (!lines.contains(needed))
      slice.failure += QStringLiteral("no line \"%1\"; ").arg(QLatin1String(needed));
  for (const QByteArray& line : lines)
    if (line.startsWith("sizes: ")) {
      const QList<QByteArray> sizes = line.mid(7).split(' ');
      if (sizes.size() == 2) slice.size = {sizes[0].toInt(), sizes[1].toInt()};
    }
  slice.values.resize(std::size_t(slice.size.x) * slice.size.y);
  const qsizetype bytes = qsizetype(slice.values.size() * sizeof(float));
  if (file.size() - (end + 2) != bytes)
    slice.failure += QStringLiteral("%1 bytes of values").arg(file.size() - (end + 2));
  else
    std::memcpy(slice.values.data(), file.constData() + end + 2, std::size_t(bytes));
  return slice;
}

/// Returns 1e-4 of the range plus four units in the last place of the largest value, as files hold float32.
double toleranceOf(const Volume& volume) {
  double low = volume.valueAt(0), high = low;
  for (std::int64_t n = 0; n < volume.geometry().voxelCount(); ++n) {
    low = std::min<double>(low, volume.valueAt(n));
    high = std::max<double>(high, volume.valueAt(n));
  }
  return 1e-4 * (high - low) + std::ldexp(std::max(std::abs(low), std::abs(high)), -22);
}

bool same(double a, double b, double tolerance) {
  return std::isnan(a) || std::isnan(b) ? std::isnan(a) == std::isnan(b) : std::abs(a - b) <= tolerance;
}

/// Returns whether --print-plane reported this plane.
bool isToldAs(const QByteArray& json, const TwinPlane& plane) {
  const QJsonObject told = QJsonDocument::fromJson(json).object();
  const auto near = [&](const char* name, glm::dvec3 wanted) {
    const QJsonArray v = told[QLatin1String(name)].toArray();
    return v.size() == 3 &&
           glm::length(glm::dvec3(v[0].toDouble(), v[1].toDouble(), v[2].toDouble()) - wanted) <= 1e-9;
  };
  const QJsonArray size = told[QStringLiteral("size")].toArray();
  return near("centre", plane.centre) && near("right", plane.right) && near("down", plane.down) &&
         std::abs(told[QStringLiteral("mmPerPixel")].toDouble() - plane.mmPerPixel) <= 1e-12 &&
         size == QJsonArray{plane.size.x, plane.size.y} &&
         told[QStringLiteral("slabMm")].toDouble() == plane.slabMm &&
         told[QStringLiteral("average")].toBool() == plane.average;
}

/// Returns whether the twin gives this pixel value after some shift of all samples.
bool sameWhenShifted(float value, const Volume& volume, const TwinPlane& plane, glm::ivec2 pixel,
                     double tolerance) {
  for (int n = 0; n < 27; ++n) {
    const glm::dvec3 shift = (glm::dvec3(n % 3, n / 3 % 3, n / 9) - 1.0) * 1e-6;
    if (same(value, twinPixel(volume, plane, pixel, shift), tolerance)) return true;
  }
  return false;
}

}  // namespace

SliceFile runSlice(const QString& path, const QStringList& options) {
  const QTemporaryDir folder;
  const QString file = folder.filePath(QStringLiteral("a.nrrd"));
  const Outcome done = runProgram(QStringList{QStringLiteral("slice"), path, QStringLiteral("-o"), file,
                                              QStringLiteral("--print-plane")} +
                                  options);
  if (done.status != 0)
    return {QStringLiteral("status %1: %2").arg(done.status).arg(QString::fromUtf8(done.err)), {}, {}, {}};
  SliceFile slice = readFloats(contentsOf(file));
  slice.plane = done.out;
  return slice;
}

QStringList samplingOptions(const TwinPlane& plane) {
  static const char* const slabs[] = {"max", "min", "mean"};
  static const char* const interpolations[] = {"linear", "nearest", "cubic"};
  QStringList options{QStringLiteral("--interpolation"),
                      QString::fromLatin1(interpolations[int(plane.interpolation)])};
  if (plane.slabMm > 0)
    options << QStringLiteral("--slab") << text(plane.slabMm) << QStringLiteral("--slab-mode")
            << QString::fromLatin1(slabs[int(plane.slab)]);
  if (plane.average) options << QStringLiteral("--average");
  return options;
}

QStringList planeOptions(const TwinPlane& plane) {
  return samplingOptions(plane) << QStringLiteral("--centre") << text(plane.centre)
                                << QStringLiteral("--right") << text(plane.right) << QStringLiteral("--down")
                                << text(plane.down) << QStringLiteral("--mm-per-pixel")
                                << text(plane.mmPerPixel) << QStringLiteral("--size")
                                << QStringLiteral("%1x%2").arg(plane.size.x).arg(plane.size.y);
}

QString faultsOf(const SliceFile& slice, const Volume& volume, const TwinPlane& plane) {
  if (slice.failure.contains(QLatin1String("lies outside of the volume"))) {
    const auto isOutside = [](float value) { return std::isnan(value); };
    if (std::ranges::all_of(twinSlice(volume, plane), isOutside)) return {};
  }
  if (!slice.failure.isEmpty()) return slice.failure;
  if (!isToldAs(slice.plane, plane))
    return QStringLiteral("--print-plane: ") + QString::fromUtf8(slice.plane);
  if (slice.size != plane.size)
    return QStringLiteral("%1 x %2 pixels, the twin has %3 x %4")
        .arg(slice.size.x)
        .arg(slice.size.y)
        .arg(plane.size.x)
        .arg(plane.size.y);
  const std::vector<float> twin = twinSlice(volume, plane);
  const double tolerance = toleranceOf(volume);
  int wrong = 0;
  QString first;
  for (int n = 0; n < int(twin.size()); ++n) {
    const glm::ivec2 pixel(n % plane.size.x, n / plane.size.x);
    if (same(slice.values[n], twin[n], tolerance) ||
        sameWhenShifted(slice.values[n], volume, plane, pixel, tolerance))
      continue;
    if (wrong++ == 0)
      first = QStringLiteral("pixel (%1, %2) is %3, the twin's %4")
                  .arg(pixel.x)
                  .arg(pixel.y)
                  .arg(slice.values[n])
                  .arg(twin[n]);
  }
  return wrong == 0 ? QString()
                    : QStringLiteral("%1 of %2 pixels; %3").arg(wrong).arg(twin.size()).arg(first);
}

VolumePtr volumeAt(const std::string& path) {
  if (path.empty()) return nullptr;
  const Result<Study> study = openStudy(path);
  if (!study) throw std::runtime_error(study.message());
  const Result<std::size_t> chosen = chooseSeries(*study, {});
  if (!chosen) throw std::runtime_error(chosen.message());
  const Result<Loaded> loaded = loadSeries(study->volumes[*chosen]);
  if (!loaded) throw std::runtime_error(loaded.message());
  return loaded->drawn;
}

QString greyFaults(const QString& png, const SliceFile& slice, Window window, bool linearExact) {
  const QImage image(png);
  if (image.width() != slice.size.x || image.height() != slice.size.y)
    return QStringLiteral("a picture of %1 x %2").arg(image.width()).arg(image.height());
  for (int y = 0; y < slice.size.y; ++y)
    for (int x = 0; x < slice.size.x; ++x) {
      const float value = slice.values[std::size_t(y) * slice.size.x + x];
      const double grey = std::isnan(value) ? 0 : twinGrey(value, window, linearExact);
      const QRgb shown = image.pixel(x, y);
      const bool either = qRed(shown) == int(std::floor(grey + 0.5 - 1e-3)) ||
                          qRed(shown) == int(std::floor(grey + 0.5 + 1e-3));
      if (!either || qGreen(shown) != qRed(shown) || qBlue(shown) != qRed(shown))
        return QStringLiteral("pixel (%1, %2) of value %3 is %4, the twin's %5")
            .arg(x)
            .arg(y)
            .arg(value)
            .arg(qRed(shown))
            .arg(grey);
    }
  return {};
}

}  // namespace volumen::tests
