// Guards `volumen export --as series --roi`: slices at right angles to a curve, at true places in the
// patient, with the values of `volumen slice`, as a valid series of the study.
#include <QDir>
#include <QTemporaryDir>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/app/export_case.h"
#include "tests/unit/app/series_case.h"
#include "tests/unit/suite.h"
#include "viewer/measure/shape_json.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

using glm::dvec3;

constexpr const char* chestCt = "ct-chest-lidc0314-138";
const dvec3 amid(0, 100, -540);  // in the chest

Shape curveThrough(const std::vector<dvec3>& points, const char* name = "Aorta") {
  return {ShapeKind::openCurve, name, points, {}, {}, {}};
}

// The place of a slice as its file has it.
struct StoredPlace {
  dvec3 centre, right, down;
};

StoredPlace placeIn(StoredFile& file) {
  const auto at = file.numbers(DCM_ImagePositionPatient), to = file.numbers(DCM_ImageOrientationPatient),
             mm = file.numbers(DCM_PixelSpacing);
  if (at.size() != 3 || to.size() != 6 || mm.size() != 2) return {};
  StoredPlace place{{}, {to[0], to[1], to[2]}, {to[3], to[4], to[5]}};
  place.centre = dvec3(at[0], at[1], at[2]) + 0.5 * mm[1] * (file.number(DCM_Columns, 0) - 1) * place.right +
                 0.5 * mm[0] * (file.number(DCM_Rows, 0) - 1) * place.down;
  return place;
}

}  // namespace

class TestExportCurve : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void straightCurvesGiveStacks_data();
  void straightCurvesGiveStacks();
  void slicesFollowAnArc();
  void slicesTurnAsLittleAsPossible();
  void partsAreTakenAwayBefore();
  void theSeriesIsNewInItsStudy();
  void wrongInputIsRefused_data();
  void wrongInputIsRefused();

 private:
  // Writes shapes into a file.
  QString fileOf(const std::vector<Shape>& shapes) const {
    QFile file(folder_.filePath(QStringLiteral("shapes.json")));
    const std::string text = shapesToJson(shapes);
    if (!file.open(QIODevice::WriteOnly) || file.write(text.data(), qint64(text.size())) < 0) return {};
    return file.fileName();
  }
  Outcome exported(const QString& source, const QString& shapes, const QString& options,
                   const QString& folder) const {
    return runProgram(QStringList{QStringLiteral("export"), source, QStringLiteral("--as"),
                                  QStringLiteral("series"), QStringLiteral("--roi"), shapes,
                                  QStringLiteral("-o"), folder} +
                      options.split(QLatin1Char(' '), Qt::SkipEmptyParts));
  }

  QTemporaryDir folder_;
};

void TestExportCurve::straightCurvesGiveStacks_data() {
  QTest::addColumn<dvec3>("to");  // from `amid`
  QTest::addColumn<QString>("options");
  QTest::addColumn<dvec3>("right");
  QTest::addColumn<dvec3>("down");
  QTest::addColumn<double>("distance");  // along right x down
  QTest::addColumn<int>("count");
  const dvec3 left(1, 0, 0), back(0, 1, 0), head(0, 0, 1);
  const QString every = QStringLiteral("--spacing 10");
  QTest::newRow("up: axial") << 50.0 * head << every << left << back << 10.0 << 6;
  QTest::newRow("down: seen from below all the same") << -49.0 * head << every << left << back << -10.0 << 5;
  QTest::newRow("to the back: coronal") << 40.0 * back << every << left << -head << 10.0 << 5;
  QTest::newRow("to the front: coronal") << -40.0 * back << every << left << -head << -10.0 << 5;
  QTest::newRow("to the right: sagittal") << -40.0 * left << every << back << -head << 10.0 << 5;
  QTest::newRow("to the left: sagittal") << 40.0 * left << every << back << -head << -10.0 << 5;
  QTest::newRow("slabs one after the other")
      << 25.0 * head << QStringLiteral("--slab 6 --slab-mode mean") << left << back << 6.0 << 5;
  QTest::newRow("of a size") << 20.0 * head << QStringLiteral("--spacing 10 --size 40x30 --mm-per-pixel 1")
                             << left << back << 10.0 << 3;
  QTest::newRow("shorter than the spacing: one slice") << 9.0 * head << every << left << back << 10.0 << 1;
}

// 64 pixels of the CT are 50 mm.
void TestExportCurve::straightCurvesGiveStacks() {
  QFETCH(dvec3, to);
  QFETCH(QString, options);
  QFETCH(dvec3, right);
  QFETCH(dvec3, down);
  QFETCH(double, distance);
  QFETCH(int, count);
  const std::string path = dataPath(chestCt);
  NEED_DATA(path);
  const QTemporaryDir folder;
  const QString out = folder.filePath(QStringLiteral("out")), from = QString::fromStdString(path);
  const Outcome a = exported(from, fileOf({curveThrough({amid, amid + to})}), options, out);
  QVERIFY2(a.status == 0, a.err);
  TwinPlane first;
  first.centre = amid, first.right = right, first.down = down;
  first.size = {64, 64}, first.mmPerPixel = 0.78125;
  if (options.contains(QLatin1String("--size"))) first.size = {40, 30}, first.mmPerPixel = 1;
  if (options.contains(QLatin1String("--slab"))) first.slabMm = 6, first.slab = TwinSlab::mean;
  const QString fault = stackFaults(out, from, {}, {first, count, distance}, {count - 1});
  QVERIFY2(fault.isEmpty(), qPrintable(fault));
}

// Of a half circle in an axial plane: each slice stands upright on it.
void TestExportCurve::slicesFollowAnArc() {
  const std::string path = dataPath(chestCt);
  NEED_DATA(path);
  constexpr double radius = 40, every = 7;
  const auto onArc = [&](double angle) { return amid + radius * dvec3(std::cos(angle), std::sin(angle), 0); };
  std::vector<dvec3> points;
  for (int n = 0; n <= 36; ++n) points.push_back(onArc(n * std::numbers::pi / 36));
  const QTemporaryDir folder;
  const QString out = folder.filePath(QStringLiteral("out")), from = QString::fromStdString(path);
  const Outcome a = exported(from, fileOf({curveThrough(points)}), QStringLiteral("--spacing 7"), out);
  QVERIFY2(a.status == 0, a.err);
  const QStringList files = storedFilesIn(out);
  QCOMPARE(files.size(), qsizetype(radius * std::numbers::pi / every) + 1);
  for (int n = 0; n < files.size(); ++n) {
    StoredFile file(files[n]);
    const StoredPlace place = placeIn(file);
    const double angle = n * every / radius;
    QVERIFY(glm::distance(place.centre, onArc(angle)) < 0.02);
    QVERIFY(glm::distance(place.right, dvec3(std::cos(angle), std::sin(angle), 0)) < 0.005);
    QVERIFY(glm::distance(place.down, dvec3(0, 0, -1)) < 1e-6);
    QVERIFY(std::abs(file.number(DCM_SliceLocation, -1) - n * every) < 1e-6);
    QVERIFY(!file.file.getDataset()->tagExists(DCM_SpacingBetweenSlices));
  }
  const QString middle = folder.filePath(QStringLiteral("middle"));
  QVERIFY(QDir().mkpath(middle) && QFile::copy(files[9], middle + QStringLiteral("/9.dcm")));
  StoredFile file(files[9]);
  const StoredPlace place = placeIn(file);
  TwinPlane plane;
  plane.centre = place.centre, plane.right = place.right, plane.down = place.down;
  plane.size = {64, 64}, plane.mmPerPixel = 0.78125;
  const QString fault = stackFaults(middle, from, {}, {plane, 1, 1}, {0});
  QVERIFY2(fault.isEmpty(), qPrintable(fault));
}

// Frames that follow the normal of this helix (Frenet) turn by 0.04 from slice to slice.
void TestExportCurve::slicesTurnAsLittleAsPossible() {
  std::vector<dvec3> points;
  for (int n = 0; n <= 72; ++n) {
    const double angle = n * std::numbers::pi / 18;
    points.emplace_back(20 * std::cos(angle), 20 * std::sin(angle), 30 * angle / std::numbers::pi - 60);
  }
  const QTemporaryDir folder;
  const QString out = folder.filePath(QStringLiteral("out"));
  const Outcome a = exported(QStringLiteral("phantom:ct-head:24"), fileOf({curveThrough(points)}),
                             QStringLiteral("--spacing 2 --size 8x8"), out);
  QVERIFY2(a.status == 0, a.err);
  const QStringList files = storedFilesIn(out);
  QVERIFY(files.size() > 100);
  StoredFile first(files[0]);
  StoredPlace last = placeIn(first);
  for (int n = 1; n < files.size(); ++n) {
    StoredFile file(files[n]);
    const StoredPlace next = placeIn(file);
    QVERIFY(std::abs(glm::dot(next.down, last.right)) < 0.004);
    QVERIFY(glm::dot(next.down, last.down) > 0.99);
    last = next;
  }
}

// Without the bones nothing in a slice through the spine is dense.
void TestExportCurve::partsAreTakenAwayBefore() {
  const QString source = QStringLiteral("phantom:ct-head:32"),
                bone = folder_.filePath(QStringLiteral("b.seg.nrrd"));
  const Outcome made = runProgram(QStringLiteral("segment %1 --range 300: -o %2").arg(source, bone));
  QVERIFY2(made.status == 0, made.err);
  const QString shapes = fileOf({curveThrough({{0, -30, 0}, {0, 30, 0}})});
  const auto highest = [&](const QString& options, const char* name) {
    const QString out = folder_.filePath(QString::fromLatin1(name));
    const Outcome a = exported(
        source, shapes, QStringLiteral("--spacing 20 --size 100x100 --mm-per-pixel 2 ") + options, out);
    if (a.status != 0) qWarning("%s", a.err.constData());
    double most = -HUGE_VAL;
    for (const QString& file : storedFilesIn(out)) {
      const std::vector<double> values = StoredFile(file).values();
      most = std::max(most, *std::ranges::max_element(values));
    }
    return most;
  };
  QVERIFY(highest({}, "with") > 300);
  QVERIFY(highest(QStringLiteral("--without-segments --segments ") + bone, "without") <= 300.5);
}

void TestExportCurve::theSeriesIsNewInItsStudy() {
  const std::string path = dataPath(chestCt);
  NEED_DATA(path);
  const QTemporaryDir folder;
  const QString out = folder.filePath(QStringLiteral("out"));
  const std::vector<dvec3> points{amid, amid + dvec3(10, 20, 20), amid + dvec3(-10, 40, 60)};
  const Outcome a = exported(QString::fromStdString(path), fileOf({curveThrough(points)}),
                             QStringLiteral("--spacing 12"), out);
  QVERIFY2(a.status == 0, a.err);
  const auto study = openStudy(path);
  QVERIFY(study);
  const Series& from = study->volumes[0];
  const std::set<std::string> known(from.sopInstanceUids.begin(), from.sopInstanceUids.end());
  const QStringList files = storedFilesIn(out);
  QVERIFY(files.size() > 4);
  std::set<std::string> series;
  for (const QString& file : files) {
    StoredFile stored(file);
    series.insert(stored.said(DCM_SeriesInstanceUID));
    QCOMPARE(stored.said(DCM_StudyInstanceUID), from.studyUid);
    QVERIFY(!known.contains(stored.said(DCM_SOPInstanceUID)));
    QCOMPARE(stored.said(DCM_SeriesDescription), std::string("Across Aorta, every 12 mm"));
    QVERIFY(stored.said(DCM_ImageType).starts_with("DERIVED\\SECONDARY\\AXIAL"));
    QVERIFY(stored.said(DCM_DerivationDescription).starts_with("Across Aorta, every 12 mm, resampled"));
    QCOMPARE(stored.number(DCM_SliceThickness, 0), 12.0);
    const std::vector<std::string> named = stored.sources();
    QVERIFY(!named.empty());
    for (const std::string& uid : named) QVERIFY(known.contains(uid));
  }
  QCOMPARE(series.size(), std::size_t(1));
  QVERIFY(!series.contains(from.seriesUid));
  NEED_DCIODVFY();
  const std::string first = storedFilesIn(QString::fromStdString(path)).constFirst().toStdString();
  QCOMPARE(newErrors(files[files.size() / 2], first), QStringList());
}

void TestExportCurve::wrongInputIsRefused_data() {
  QTest::addColumn<QString>("shapes");  // JSON
  QTest::addColumn<QString>("options");
  QTest::addColumn<int>("status");
  QTest::addColumn<QByteArray>("says");
  const QString one = QStringLiteral(R"({"kind": "openCurve", "points": [[0, 0, 0], [0, 0, 30]]})"),
                line = QStringLiteral(R"({"kind": "length", "points": [[0, 0, 0], [0, 0, 30]]})"),
                wide = QStringLiteral(R"({"kind": "openCurve", "points": [[0, 0, -40], [0, 0, 40]]})"),
                beside = QStringLiteral(R"({"kind": "openCurve", "points": [[0, 900, 0], [0, 900, 30]]})"),
                point = QStringLiteral(R"({"kind": "openCurve", "points": [[1, 1, 1], [1, 1, 1]]})"),
                far = QStringLiteral(R"({"kind": "openCurve", "points": [[0, 0, 0], [0, 0, 20000]]})"),
                onFrame = QStringLiteral(
                    R"({"kind": "openCurve", "points": [[1, 1], [9, 9]], "frame": {"instance": "1.2"}})");
  const auto row = [](const char* name, const QString& shapes, const char* options, int status,
                      const char* says) {
    QTest::newRow(name) << QLatin1Char('[') + shapes + QLatin1Char(']') << QString::fromLatin1(options)
                        << status << QByteArray(says);
  };
  row("no curve", line, "", 1, "holds no curve in the patient");
  row("two curves", one + QLatin1Char(',') + one, "", 1, "holds several curves");
  row("a curve on a picture", onFrame, "", 1, "holds no curve in the patient");
  row("a curve that is a point", point, "", 1, "points at two different places");
  row("a curve beyond the patient", far, "", 1, "longer than 10 m");
  row("no spacing", one, "--spacing 0", 2, "--spacing");
  row("more slices than a series can number", wide, "--spacing 0.001", 1, "more than 65535 slices");
  row("a curve beside the volume", beside, "", 1, "No pixel of the slices lies in the volume");
  row("a plane", one, "--plane coronal", 2, "--plane does not go with --roi");
  row("a place", one, "--centre 0,0,0", 2, "--centre does not go with --roi");
  row("directions", one, "--right 1,0,0 --down 0,1,0", 2, "--right does not go with --roi");
  row("another grid", one, "--onto phantom:ct-head:32", 2, "--onto does not go with --roi");
  row("in colour", one, "--overlay phantom:ct-head:32", 2, "--overlay does not go with --roi");
  row("in colours of its own file", one, "--overlay-series 1", 2, "--overlay-series does not go with --roi");
  row("a face", one, "--deface", 2, "--deface");
  row("a window", one, "--window 40,400", 2, "--window");
}

void TestExportCurve::wrongInputIsRefused() {
  QFETCH(QString, shapes);
  QFETCH(QString, options);
  QFETCH(QByteArray, says);
  const QTemporaryDir folder;
  QFile file(folder_.filePath(QStringLiteral("wrong.json")));
  QVERIFY(file.open(QIODevice::WriteOnly) && file.write(shapes.toUtf8()) > 0);
  file.close();
  const Outcome a = exported(QStringLiteral("phantom:ct-head:24"), file.fileName(), options,
                             folder.filePath(QStringLiteral("out")));
  QVERIFY2(a.err.contains(says), a.err);
  QTEST(a.status, "status");
  QVERIFY(QDir(folder.path()).isEmpty(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot));
}

VOLUMEN_TEST(TestExportCurve);
#include "tst_export_curve.moc"
