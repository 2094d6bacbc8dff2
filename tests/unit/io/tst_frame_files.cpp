// Guards slices.md 2 to 4: the statements of data/dicom-2d/README.md about its pictures: values, greys,
// colours, overlays, pixel sizes, regions, clips.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/frame_of.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestFrameFiles : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void greyPixels_data();
  void greyPixels();
  void greysOnOffer_data();
  void greysOnOffer();
  void colourPixels_data();
  void colourPixels();
  void sizesOfPixels_data();
  void sizesOfPixels();
  void overlays_data();
  void overlays();
  void slicesSayWhereTheyLie();
  void ultrasoundRegions();
  void clips_data();
  void clips();
  void paddingAndShutterOfMammograms();
  void pictureWithoutPixelsIsSaid();
};

namespace {

constexpr const char* folder = "dicom-2d/";

Result<Frame> frameAt(const QString& file, int n = 0) {
  return frameOf(dataPath(folder + file.toStdString()), n);
}

/// Evaluates the README's formulas, independently of the program.
double byteOf(double value, const GreyMapping& mapping) {
  double y = 0;
  const auto [c, w] = mapping.window;
  if (!mapping.table.grey.empty()) {
    const double last = double(mapping.table.grey.size() - 1);
    y = mapping.table.grey[std::size_t(std::clamp(value - mapping.table.first, 0.0, last))];
  } else if (mapping.function == WindowFunction::sigmoid) {
    y = 1 / (1 + std::exp(-4 * (value - c) / w));
  } else {
    y = std::clamp((value - (c - 0.5)) / (w - 1) + 0.5, 0.0, 1.0);
  }
  return std::floor(255 * (mapping.inverted ? 1 - y : y) + 0.5);
}

}  // namespace

void TestFrameFiles::greyPixels_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<int>("frame");
  QTest::addColumn<QPoint>("at");
  QTest::addColumn<int>("value");
  QTest::addColumn<QList<int>>("greys");
  QTest::addColumn<bool>("lossy");
  const auto row = [](const char* file, int frame, QPoint at, int value, QList<int> greys,
                      bool lossy = false) {
    QTest::addRow("%s frame %d at %d,%d", file, frame, at.x(), at.y())
        << QString::fromLatin1(file) << frame << at << value << greys << lossy;
  };
  row("cr-chest-mono1-jpeg8.dcm", 0, {1005, 600}, 59, {183}, true);
  row("cr-chest-mono1-jpeg8.dcm", 0, {500, 900}, 222, {19}, true);
  row("cr-chest-mono1-jpeg8.dcm", 0, {100, 100}, 242, {0}, true);
  row("cr-dental-mono1-modalitylut.dcm", 0, {988, 700}, 376, {});
  row("cr-dental-mono1-modalitylut.dcm", 0, {400, 900}, 398, {});
  row("cr-dental-mono1-modalitylut.dcm", 0, {100, 60}, 1023, {});
  row("cr-hip-mono2-jpeg12.dcm", 0, {880, 1070}, 410, {102}, true);
  row("cr-hip-mono2-jpeg12.dcm", 0, {500, 600}, 510, {127}, true);
  row("cr-hip-mono2-jpeg12.dcm", 0, {1500, 1500}, 885, {221}, true);
  row("ct-two-windows.dcm", 0, {256, 256}, 202, {246, 85});
  row("ct-two-windows.dcm", 0, {160, 190}, 141, {202, 75});
  row("ct-two-windows.dcm", 0, {10, 10}, 68, {148, 63});
  row("mg-sigmoid-voilut3.dcm", 0, {2000, 1500}, 2608, {115, 93, 137, 115, 93, 137});
  row("mg-sigmoid-voilut3.dcm", 0, {2200, 1200}, 2407, {64, 42, 89, 64, 42, 89});
  row("mg-sigmoid-voilut3.dcm", 0, {1800, 1100}, 2549, {99, 75, 123, 99, 75, 123});
  row("mg-ermf-overlay-shutter.dcm", 0, {659, 394}, 1436, {89});
  row("mg-ermf-overlay-shutter.dcm", 0, {300, 600}, 1370, {85});
  row("mg-ermf-overlay-shutter.dcm", 0, {1200, 20}, 3713, {231});
  row("xa-96frames.dcm", 0, {256, 256}, 73, {}, true);
  row("xa-96frames.dcm", 47, {150, 150}, 124, {}, true);
  row("xa-96frames.dcm", 95, {400, 120}, 39, {}, true);
  row("ot-overlays-embedded.dcm", 0, {81, 56}, 2200, {});
  row("ot-overlays-embedded.dcm", 0, {213, 150}, 1879, {});
  row("ot-overlays-embedded.dcm", 0, {453, 511}, 3630, {});
}

void TestFrameFiles::greyPixels() {
  NEED_DATA(dataPath());
  QFETCH(QString, file);
  QFETCH(int, frame);
  QFETCH(QPoint, at);
  QFETCH(int, value);
  QFETCH(QList<int>, greys);
  QFETCH(bool, lossy);
  const Result<Frame> f = frameAt(file, frame);
  QVERIFY2(f.ok(), f.ok() ? "" : f.message().c_str());
  const double found = double(valueAt(*f, at.x(), at.y()));
  // Decoders of lossy streams differ by 2. Greys of LUTs equal those of the sigmoids to within 1.
  QVERIFY2(std::abs(found - value) <= (lossy ? 2 : 0), qPrintable(QString::number(found)));
  QVERIFY(f->greys.size() >= std::size_t(std::max<qsizetype>(1, greys.size())));
  for (qsizetype n = 0; n < greys.size(); ++n) {
    const double grey = byteOf(found, f->greys[std::size_t(n)].mapping);
    QVERIFY2(std::abs(grey - greys[n]) <= (lossy ? 2 : 1), qPrintable(QString::number(grey)));
  }
}

void TestFrameFiles::greysOnOffer_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<QStringList>("names");
  QTest::addColumn<WindowFunction>("function");
  QTest::addColumn<bool>("inverted");
  const auto row = [](const char* file, QStringList names, WindowFunction function, bool inverted) {
    QTest::newRow(file) << QString::fromLatin1(file) << names << function << inverted;
  };
  const QString none;
  const auto words = [](const char* text) { return QString::fromLatin1(text).split(u' '); };
  row("cr-dental-mono1-modalitylut.dcm", {none}, WindowFunction::linearExact, true);
  row("cr-hip-mono2-jpeg12.dcm", {none}, WindowFunction::linear, false);
  row("ct-two-windows.dcm", words("WINDOW1 WINDOW2"), WindowFunction::linear, false);
  row("mg-sigmoid-voilut3.dcm", words("NORMAL HARDER SOFTER NORMAL HARDER SOFTER"), WindowFunction::sigmoid,
      false);
  row("xa-96frames.dcm", {none}, WindowFunction::linearExact, false);
}

void TestFrameFiles::greysOnOffer() {
  NEED_DATA(dataPath());
  QFETCH(QString, file);
  QFETCH(QStringList, names);
  QFETCH(WindowFunction, function);
  QFETCH(bool, inverted);
  const Result<Frame> f = frameAt(file);
  QVERIFY(f.ok());
  QStringList found;
  for (const NamedGrey& grey : f->greys) {
    found << QString::fromStdString(grey.name);
    QCOMPARE(grey.mapping.inverted, inverted);
  }
  QCOMPARE(found, names);
  QCOMPARE(f->greys[0].mapping.function, function);
  const bool hasNone = file.startsWith(QStringLiteral("xa-")) || file.startsWith(QStringLiteral("cr-dental"));
  QCOMPARE(f->greys[0].ofValues, hasNone);
}

void TestFrameFiles::colourPixels_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<int>("frame");
  QTest::addColumn<QPoint>("at");
  QTest::addColumn<QList<int>>("rgb");
  const auto row = [](const char* file, int frame, QPoint at, QList<int> rgb) {
    QTest::addRow("%s frame %d at %d,%d", file, frame, at.x(), at.y())
        << QString::fromLatin1(file) << frame << at << rgb;
  };
  row("us-cine-aspect-regions.dcm", 0, {190, 65}, {113, 188, 209});
  row("us-cine-aspect-regions.dcm", 33, {190, 65}, {112, 188, 201});
  row("us-cine-aspect-regions.dcm", 0, {184, 399}, {4, 186, 86});
  row("us-cine-aspect-regions.dcm", 33, {184, 399}, {4, 186, 86});
  row("us-cine-aspect-regions.dcm", 0, {260, 200}, {39, 39, 39});
  row("us-cine-aspect-regions.dcm", 33, {260, 200}, {23, 23, 23});
  row("us-palette-cine-10.dcm", 0, {290, 200}, {21, 170, 153});
  row("us-palette-cine-10.dcm", 0, {560, 60}, {121, 40, 30});
  row("us-palette-cine-10.dcm", 0, {10, 10}, {0, 0, 0});
  row("us-palette-cine-10.dcm", 9, {290, 200}, {208, 20, 52});
  row("sc-rgb-41.dcm", 0, {38, 37}, {232, 209, 39});
  row("sc-rgb-41.dcm", 0, {39, 37}, {215, 199, 70});
  row("sc-rgb-41.dcm", 0, {0, 0}, {67, 67, 67});
}

void TestFrameFiles::colourPixels() {
  NEED_DATA(dataPath());
  QFETCH(QString, file);
  QFETCH(int, frame);
  QFETCH(QPoint, at);
  QFETCH(QList<int>, rgb);
  const Result<Frame> f = frameAt(file, frame);
  QVERIFY2(f.ok(), f.ok() ? "" : f.message().c_str());
  QVERIFY(f->colour() && f->greys.empty() && f->values.empty());
  const int allowed = file.startsWith(QLatin1String("us-cine")) ? 5 : 0;  // lossy, as its README says
  for (int c = 0; c < 3; ++c) {
    const int found = f->rgb[std::size_t(3 * (at.y() * f->size.x + at.x()) + c)];
    QVERIFY2(std::abs(found - rgb[c]) <= allowed, qPrintable(QString::number(found)));
  }
}

void TestFrameFiles::sizesOfPixels_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<double>("x");
  QTest::addColumn<double>("y");
  QTest::addColumn<PixelSizeKind>("kind");
  const auto row = [](const char* file, double x, double y, PixelSizeKind kind) {
    QTest::newRow(file) << QString::fromLatin1(file) << x << y << kind;
  };
  row("cr-chest-mono1-jpeg8.dcm", 0.175, 0.175, PixelSizeKind::atDetector);
  row("cr-hip-mono2-jpeg12.dcm", 0.2, 0.2, PixelSizeKind::atDetector);
  row("ct-two-windows.dcm", 0.287109375, 0.287109375, PixelSizeKind::patient);
  row("mg-sigmoid-voilut3.dcm", 0.09409090909091, 0.09409090909091, PixelSizeKind::atDetector);
  row("mg-ermf-overlay-shutter.dcm", 0.081469, 0.081469, PixelSizeKind::magnified);
  row("xa-96frames.dcm", 1, 1, PixelSizeKind::unknown);
  row("us-cine-aspect-regions.dcm", 1, 0.8, PixelSizeKind::unknown);
}

void TestFrameFiles::sizesOfPixels() {
  NEED_DATA(dataPath());
  QFETCH(QString, file);
  QFETCH(double, x);
  QFETCH(double, y);
  QFETCH(PixelSizeKind, kind);
  const Result<Frame> f = frameAt(file);
  QVERIFY(f.ok());
  QCOMPARE(f->pixel.kind, kind);
  QVERIFY(std::abs(f->pixel.mm.x - x) < 1e-6 && std::abs(f->pixel.mm.y - y) < 1e-6);
}

void TestFrameFiles::overlays_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<QList<int>>("bits");
  QTest::addColumn<QList<QRect>>("places");
  QTest::newRow("data and unused bits")
      << QStringLiteral("ot-overlays-embedded.dcm") << QList<int>{532, 537, 603, 606}
      << QList<QRect>{{QPoint(126, 136), QPoint(366, 146)},
                      {QPoint(126, 179), QPoint(366, 189)},
                      {QPoint(115, 221), QPoint(376, 231)},
                      {QPoint(113, 263), QPoint(374, 273)}};
  QTest::newRow("cut at the border") << QStringLiteral("mg-ermf-overlay-shutter.dcm") << QList<int>{185, 149}
                                     << QList<QRect>{{QPoint(408, 703), QPoint(508, 787)},
                                                     {QPoint(0, 0), QPoint(74, 74)}};
}

void TestFrameFiles::overlays() {
  NEED_DATA(dataPath());
  QFETCH(QString, file);
  QFETCH(QList<int>, bits);
  QFETCH(QList<QRect>, places);
  const Result<Frame> f = frameAt(file);
  QVERIFY(f.ok());
  QVERIFY2(f->warnings.empty(), f->warnings.empty() ? "" : f->warnings[0].c_str());
  QCOMPARE(f->overlays.size(), std::size_t(bits.size()));
  for (qsizetype n = 0; n < bits.size(); ++n) {
    const std::vector<std::uint8_t>& mask = f->overlays[std::size_t(n)].mask;
    QCOMPARE(mask.size(), f->values.size());
    QCOMPARE(int(std::count(mask.begin(), mask.end(), 1)), bits[n]);
    QRect place;
    for (int i = 0; i < int(mask.size()); ++i)
      if (mask[std::size_t(i)]) place |= QRect(i % f->size.x, i / f->size.x, 1, 1);
    QCOMPARE(place.top(), places[n].top());
    QCOMPARE(place.bottom(), places[n].bottom());
    QVERIFY2(places[n].contains(place), qPrintable(QString::number(place.left())));
  }
}

void TestFrameFiles::slicesSayWhereTheyLie() {
  NEED_DATA(dataPath());
  const Result<Study> study = openStudy(dataPath("pet-ct/sts019-ct"));
  QVERIFY(study.ok() && study->volumes.size() == 1);
  const Series& ct = study->volumes[0];
  for (const int n : {0, 46}) {
    const Result<Frame> slice = loadFrame(ct, n);
    QVERIFY(slice.ok() && slice->place);
    // The README gives positions to 0.01 mm.
    QVERIFY(glm::distance(slice->place->origin, glm::dvec3(-87.8907, -143.5547, n ? -75.21 : -225.63)) <
            0.01);
    QCOMPARE(slice->place->row, glm::dvec3(1, 0, 0));
    QCOMPARE(slice->place->column, glm::dvec3(0, 1, 0));
  }
  QVERIFY2(!frameAt(QStringLiteral("cr-hip-mono2-jpeg12.dcm"))->place, "a projection lies nowhere");
}

void TestFrameFiles::ultrasoundRegions() {
  NEED_DATA(dataPath());
  const Result<Frame> f = frameAt(QStringLiteral("us-cine-aspect-regions.dcm"));
  QVERIFY(f.ok());
  QCOMPARE(f->regions.size(), std::size_t(2));
  const UltrasoundRegion& tissue = f->regions[0];
  QCOMPARE(tissue.from, glm::ivec2(42, 4));
  QCOMPARE(tissue.to, glm::ivec2(438, 353));
  QCOMPARE(tissue.unitX, 3);
  QCOMPARE(tissue.unitY, 3);
  QVERIFY(std::abs(tissue.delta.x - 0.0285714) < 1e-6 && std::abs(tissue.delta.y - 0.0228571) < 1e-6);
  const UltrasoundRegion& ecg = f->regions[1];
  QCOMPARE(ecg.from, glm::ivec2(40, 374));
  QCOMPARE(ecg.to, glm::ivec2(257, 406));
  QCOMPARE(ecg.unitX, 4);
  QVERIFY(std::abs(ecg.delta.x - 0.00502315) < 1e-8);
}

void TestFrameFiles::clips_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<int>("frames");
  QTest::addColumn<double>("rate");
  QTest::addColumn<QString>("photometric");
  const auto row = [](const char* file, int frames, double rate, const char* photometric) {
    QTest::newRow(file) << QString::fromLatin1(file) << frames << rate << QString::fromLatin1(photometric);
  };
  row("xa-96frames.dcm", 96, 1000 / 33.0, "MONOCHROME2");
  row("us-cine-aspect-regions.dcm", 34, 33, "YBR_FULL_422");
  row("us-palette-cine-10.dcm", 10, 1000 / 76.0, "PALETTE COLOR");
  row("sc-rgb-41.dcm", 1, 0, "RGB");
}

void TestFrameFiles::clips() {
  NEED_DATA(dataPath());
  QFETCH(QString, file);
  QFETCH(int, frames);
  QFETCH(double, rate);
  QFETCH(QString, photometric);
  const Result<Study> study = openStudy(dataPath(folder + file.toStdString()));
  QVERIFY(study.ok() && study->volumes.empty() && study->refused.empty());
  const Image& image = study->images.at(0);
  QCOMPARE(image.frames, frames);
  QVERIFY(std::abs(image.cine.framesPerSecond - rate) < 1e-9);
  QCOMPARE(QString::fromStdString(image.photometric), photometric);
  const Result<Frame> beyond = loadFrame(image, frames);
  QVERIFY(!beyond.ok() && beyond.message().find("there is no frame") != std::string::npos);
  QVERIFY(!loadFrame(image, -1).ok());
}

void TestFrameFiles::paddingAndShutterOfMammograms() {
  NEED_DATA(dataPath());
  const Result<Frame> padded = frameAt(QStringLiteral("mg-sigmoid-voilut3.dcm"));
  QVERIFY(padded.ok() && padded->padding);
  QCOMPARE(*padded->padding, (ValueRange{0, 30}));  // with its PixelPaddingRangeLimit
  QCOMPARE(valueAt(*padded, 100, 100), 0.f);
  const Result<Frame> shut = frameAt(QStringLiteral("mg-ermf-overlay-shutter.dcm"));
  QVERIFY(shut.ok() && shut->shutter.empty());  // its rectangle hides nothing
}

void TestFrameFiles::pictureWithoutPixelsIsSaid() {
  NEED_DATA(dataPath());
  const Result<Study> study = openStudy(dataPath("dicom-2d/pr-without-pixels"));
  QVERIFY(study.ok() && study->volumes.empty() && study->images.empty());
  QCOMPARE(study->other.size(), std::size_t(2));
  for (const Other& other : study->other) QVERIFY(other.kind.find("without pixel data") != std::string::npos);
}

VOLUMEN_TEST(TestFrameFiles);
#include "tst_frame_files.moc"
