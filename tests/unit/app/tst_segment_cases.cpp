// Guards segment.md on ../shared/data/segment-cases: files of segments through the command line. CASES.tsv
// there lists the expected results.
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "io/load.h"
#include "io/open.h"
#include "io/segmentation.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/app/segment_case.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentCases : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aLabelMapHoldsSegments();
  void aLabelMapIsListedAsSegmentation();
  void unevenSlicesAreMarkedByTheirOwnValues_data();
  void unevenSlicesAreMarkedByTheirOwnValues();
  void aHeadInThinAndThickSlicesIsMarkedByItsValues();
  void unevenSlicesComeBackAsTheyWent();
  void unevenSlicesKeepTheirVolume_data();
  void unevenSlicesKeepTheirVolume();
  void slicesWithoutVoxelsAreNamed();
  void whatASegmentIsOfStays_data();
  void whatASegmentIsOfStays();
  void recipesSayThatTheyMadeIt_data();
  void recipesSayThatTheyMadeIt();
};

namespace {

QString caseAt(const char* name) {
  return QString::fromStdString(dataPath(std::string("segment-cases/") + name));
}

QString tinyCt() { return QString::fromStdString(dataPath("dicom-geometry/ct-tiny-23x38x3/image")); }

/// Returns the number of set pixels of a segment for each frame position along z, mm.
QString pixelsByPlace(const QString& path, std::size_t segment = 0) {
  const Result<Segmentation> s = loadSegmentation(path.toStdString());
  if (!s) return QString::fromStdString(s.message());
  std::map<double, int> pixels;
  for (std::size_t n = 0; n < s->frames.size(); ++n)
    for (int y = 0; y < s->size.y && s->frames[n].segment == segment; ++y)
      for (int x = 0; x < s->size.x; ++x) pixels[s->frames[n].origin.z] += s->isSet(n, x, y);
  QStringList texts;
  for (const auto& [z, count] : pixels) texts << QStringLiteral("%1: %2").arg(z).arg(count);
  return texts.join(QStringLiteral(", "));
}

/// Returns the ml of the first segment: each frame reaches half way to the next ones, and at the ends half of
/// the smallest distance outwards.
double mlByPlaces(const QString& path) {
  const Result<Segmentation> s = loadSegmentation(path.toStdString());
  if (!s) return -1;
  const glm::dvec3 normal = glm::cross(s->right, s->down);
  std::map<double, double> area;  // mm^2 by place along the normal
  for (std::size_t n = 0; n < s->frames.size(); ++n)
    for (int y = 0; y < s->size.y; ++y)
      for (int x = 0; x < s->size.x; ++x)
        area[glm::dot(s->frames[n].origin, normal)] += s->isSet(n, x, y) ? s->mm.x * s->mm.y : 0;
  const std::vector<std::pair<double, double>> planes(area.begin(), area.end());
  double mm3 = 0, least = HUGE_VAL;
  for (std::size_t n = 0; n + 1 < planes.size(); ++n) {
    const double distance = planes[n + 1].first - planes[n].first;
    mm3 += distance / 2 * (planes[n].second + planes[n + 1].second);
    least = std::min(least, distance);
  }
  return (mm3 + least / 2 * (planes.front().second + planes.back().second)) / 1000;
}

/// Returns the ml of the first segment of a file by `volumen measure`.
double mlMeasured(const QString& series, const QString& segments) {
  const Outcome a = runProgram({QStringLiteral("measure"), series, QStringLiteral("--segments"), segments});
  const QJsonValue ml =
      QJsonDocument::fromJson(a.out)[QStringLiteral("segments")][0][QStringLiteral("millilitres")];
  return ml.toDouble(-1);
}

Segment firstSegmentOf(const QString& path) {
  const Result<Segmentation> s = loadSegmentation(path.toStdString());
  return s && !s->segments.empty() ? s->segments[0] : Segment{};
}

/// Returns name and voxel count of each segment as `volumen segment` reports them.
QStringList voxelsTold(const Outcome& done) {
  QStringList texts;
  for (const QJsonValue& segment :
       QJsonDocument::fromJson(done.out).object()[QStringLiteral("segments")].toArray())
    texts << QStringLiteral("%1 %2")
                 .arg(segment[QStringLiteral("name")].toString())
                 .arg(segment[QStringLiteral("voxels")].toInt());
  return texts;
}

}  // namespace

void TestSegmentCases::aLabelMapHoldsSegments() {
  NEED_DATA(dataPath("segment-cases"));
  const Outcome done = runSegment(
      {tinyCt(), QStringLiteral("--json"), QStringLiteral("--from"), caseAt("labelmap/labelmap.dcm")});
  QVERIFY2(done.status == 0, done.err.constData());
  QCOMPARE(voxelsTold(done), (QStringList{QStringLiteral("セグ1 485"), QStringLiteral("セグ2 247"),
                                          QStringLiteral("セグ3 526")}));
}

void TestSegmentCases::aLabelMapIsListedAsSegmentation() {
  NEED_DATA(dataPath("segment-cases"));
  const Outcome done =
      runProgram({QStringLiteral("info"), QStringLiteral("--json"), caseAt("labelmap/labelmap.dcm")});
  const QJsonObject all = QJsonDocument::fromJson(done.out).object();
  QVERIFY2(all[QStringLiteral("volumes")].toArray().isEmpty(), done.out.constData());
  const QJsonArray references = all[QStringLiteral("references")].toArray();
  QCOMPARE(references.size(), 1);
  QCOMPARE(references[0][QStringLiteral("kind")].toString(), QStringLiteral("segmentation"));
  QCOMPARE(references[0][QStringLiteral("pictures")].toArray().size(), 3);
}

void TestSegmentCases::unevenSlicesAreMarkedByTheirOwnValues_data() {
  QTest::addColumn<QByteArray>("steps");
  QTest::addColumn<QString>("places");
  const QString all = QStringLiteral("0: 400, 8: 400, 16: 400, 30: 400");
  const auto row = [](const char* name, const char* steps, const QString& places) {
    QTest::newRow(name) << QByteArray(steps) << places;
  };
  row("a range", R"({"step": "range", "segment": "A", "low": 200})", all);
  row("a range that interpolated values hardly reach", R"({"step": "range", "segment": "A", "low": 290})",
      all);
  row("the largest of its parts",
      R"({"step": "range", "segment": "A", "low": 50}, {"step": "largest", "segment": "A"})",
      QStringLiteral("0: 400, 4: 400, 8: 400, 9: 400, 16: 400, 23: 400, 30: 400"));
  row("one range without another",
      R"({"step": "range", "segment": "A", "low": 50}, {"step": "range", "segment": "B", "low": 200},
         {"step": "subtract", "segment": "A", "other": "B"})",
      QStringLiteral("4: 400, 9: 400, 23: 400"));
  row("a lesion about a place",
      R"({"step": "ball", "segment": "B", "at": [[8, 13, 4]], "radiusMm": 40},
         {"step": "lesion", "segment": "A", "in": "B", "by": "value", "value": 50})",
      QStringLiteral("0: 400, 4: 400, 8: 400, 9: 400, 16: 400, 23: 400, 30: 400"));
}

// Of 30 mm of slices 4, 4, 1, 7, 7 and 7 mm apart, every other one has 300 and the others 100 HU.
void TestSegmentCases::unevenSlicesAreMarkedByTheirOwnValues() {
  NEED_DATA(dataPath("segment-cases"));
  QFETCH(QByteArray, steps);
  QFETCH(QString, places);
  const QTemporaryDir folder;
  const QString recipe = folder.filePath(QStringLiteral("r.json")),
                seg = folder.filePath(QStringLiteral("s.dcm"));
  writeBytes(recipe, R"({"volumenRecipe": 1, "segments": [{"name": "A"}], "steps": [)" + steps + "]}");
  const Outcome done =
      runSegment({caseAt("uneven"), QStringLiteral("--recipe"), recipe, QStringLiteral("-o"), seg});
  QVERIFY2(done.status == 0 && !done.err.contains("no voxels of their own"), done.err.constData());
  QCOMPARE(pixelsByPlace(seg), places);
}

// Its 28 tilted slices are 1.1 to 7.4 mm apart.
void TestSegmentCases::aHeadInThinAndThickSlicesIsMarkedByItsValues() {
  NEED_DATA(dataPath("dicom-geometry"));
  const std::string ct = dataPath("dicom-geometry/ct-ge-tilt-varspacing-28");
  const QTemporaryDir folder;
  const QString seg = folder.filePath(QStringLiteral("s.dcm"));
  const Outcome done = runSegment({QString::fromStdString(ct), QStringLiteral("--range"),
                                   QStringLiteral("150:"), QStringLiteral("-o"), seg});
  QVERIFY2(done.status == 0, done.err.constData());
  const auto study = openStudy(ct);
  QVERIFY(study && study->volumes.size() == 1);
  const auto loaded = loadSeries(study->volumes[0]);
  const auto marked = loadSegmentation(seg.toStdString());
  QVERIFY(loaded.ok() && marked.ok());
  const Volume& slices = *loaded->acquired;
  QCOMPARE(marked->frames.size(), std::size_t(slices.size().z));
  for (int k = 0; k < slices.size().z; ++k)
    for (int j = 0; j < slices.size().y; ++j)
      for (int i = 0; i < slices.size().x; ++i)
        if (marked->isSet(std::size_t(k), i, j) != (slices.value(i, j, k) >= 150))
          QFAIL(qPrintable(QStringLiteral("slice %1, pixel %2, %3").arg(k).arg(i).arg(j)));
}

void TestSegmentCases::unevenSlicesComeBackAsTheyWent() {
  NEED_DATA(dataPath("segment-cases"));
  const QTemporaryDir folder;
  const QString first = folder.filePath(QStringLiteral("a.dcm")),
                second = folder.filePath(QStringLiteral("b.dcm"));
  const Outcome made = runSegment(
      {caseAt("uneven"), QStringLiteral("--range"), QStringLiteral("200:"), QStringLiteral("-o"), first});
  QVERIFY2(made.status == 0, made.err.constData());
  QCOMPARE(pixelsByPlace(first), QStringLiteral("0: 400, 8: 400, 16: 400, 30: 400"));
  const Outcome done =
      runSegment({caseAt("uneven"), QStringLiteral("--from"), first, QStringLiteral("-o"), second});
  QVERIFY2(done.status == 0 && !done.err.contains("no voxels of their own"), done.err.constData());
  QCOMPARE(pixelsByPlace(second), pixelsByPlace(first));
}

void TestSegmentCases::unevenSlicesKeepTheirVolume_data() {
  QTest::addColumn<QString>("series");
  QTest::addColumn<QString>("range");
  QTest::newRow("slices 4 and 7 mm apart, tilted")
      << QString::fromStdString(dataPath("dicom-geometry/ct-ge-tilt-varspacing-28"))
      << QStringLiteral("300:5000");
  QTest::newRow("a slice is missing")
      << QString::fromStdString(dataPath("mr-head-siemens-gap-175")) << QStringLiteral("100:5000");
}

// Slices of the even grid between two frames have what the nearest of these has, so no volume is lost.
void TestSegmentCases::unevenSlicesKeepTheirVolume() {
  QFETCH(QString, series);
  QFETCH(QString, range);
  NEED_DATA(series.toStdString());
  const QTemporaryDir folder;
  const QString seg = folder.filePath(QStringLiteral("a.dcm")), rt = folder.filePath(QStringLiteral("r.dcm"));
  const Outcome made = runSegment({series, QStringLiteral("--range"), range, QStringLiteral("-o"), seg});
  QVERIFY2(made.status == 0, made.err.constData());
  const double ml = mlByPlaces(seg), measured = mlMeasured(series, seg);
  QVERIFY2(std::abs(measured - ml) < 0.02 * ml, qPrintable(QStringLiteral("%1, %2").arg(measured).arg(ml)));
  const Outcome contours =
      runProgram({QStringLiteral("export"), series, QStringLiteral("--as"), QStringLiteral("rtstruct"),
                  QStringLiteral("--segments"), seg, QStringLiteral("-o"), rt});
  QVERIFY2(contours.status == 0, contours.err.constData());
  QCOMPARE(mlMeasured(series, rt), measured);
}

// Steps that consider neighbouring voxels work in the evenly spaced grid.
void TestSegmentCases::slicesWithoutVoxelsAreNamed() {
  NEED_DATA(dataPath("segment-cases"));
  const QTemporaryDir folder;
  const QString recipe = folder.filePath(QStringLiteral("r.json")),
                seg = folder.filePath(QStringLiteral("s.dcm"));
  writeBytes(recipe,
             R"({"volumenRecipe": 1, "segments": [{"name": "A"}], "steps": [
                {"step": "range", "segment": "A", "low": 50}, {"step": "close", "segment": "A"}]})");
  const Outcome done =
      runSegment({caseAt("uneven"), QStringLiteral("--recipe"), recipe, QStringLiteral("-o"), seg});
  QVERIFY2(done.status == 0, done.err.constData());
  QVERIFY2(done.err.contains("no voxels of their own, for what is drawn there is interpolated: 3.dcm, 5.dcm, "
                             "6.dcm."),
           done.err.constData());
}

void TestSegmentCases::whatASegmentIsOfStays_data() {
  QTest::addColumn<QString>("way");
  QTest::newRow("DICOM") << QString();
  QTest::newRow("twice DICOM") << QStringLiteral("between.dcm");
}

void TestSegmentCases::whatASegmentIsOfStays() {
  NEED_DATA(dataPath("segment-cases"));
  QFETCH(QString, way);
  const QTemporaryDir folder;
  const QString came = caseAt("provenance/auto.dcm"), left = folder.filePath(QStringLiteral("y.dcm"));
  QString from = came;
  for (const QString& to : QStringList{way.isEmpty() ? QString() : folder.filePath(way), left}) {
    if (to.isEmpty()) continue;
    const Outcome done = runSegment({tinyCt(), QStringLiteral("--from"), from, QStringLiteral("-o"), to});
    QVERIFY2(done.status == 0, done.err.constData());
    from = to;
  }
  Segment before = firstSegmentOf(came);
  const Segment after = firstSegmentOf(left);
  QCOMPARE(after.algorithmType, SegmentAlgorithm::automatic);
  QCOMPARE(after.algorithm, std::string("nnU-Net v2"));
  QCOMPARE(after.trackingId, std::string("Lesion1"));
  QCOMPARE(after.trackingUid, std::string("1.2.3"));
  QCOMPARE(after.region.value, std::string("39607008"));
  before.colour = after.colour;  // the written segment has no colour
  QVERIFY(after == before);
}

void TestSegmentCases::recipesSayThatTheyMadeIt_data() {
  QTest::addColumn<QStringList>("how");
  QTest::addColumn<int>("type");
  QTest::addColumn<QByteArray>("name");
  QTest::addColumn<QByteArray>("recipe");
  const QStringList own{QStringLiteral("--recipe"), QStringLiteral("r.json")};
  QTest::newRow("one that is built in")
      << QStringList{QStringLiteral("--recipe"), QStringLiteral("body")} << int(SegmentAlgorithm::automatic)
      << QByteArray("Recipe Body") << QByteArray();
  QTest::newRow("a range of values") << QStringList{QStringLiteral("--range"), QStringLiteral("-500:3000")}
                                     << int(SegmentAlgorithm::semiautomatic)
                                     << QByteArray("Values from -500 to 3000") << QByteArray();
  QTest::newRow("places that someone chose")
      << own << int(SegmentAlgorithm::semiautomatic) << QByteArray("Recipe Mine")
      << QByteArray(R"({"volumenRecipe": 1, "name": "Mine", "segments": [{"name": "A"}], "steps": [
                       {"step": "ball", "segment": "A", "at": [[55, 20, -175]], "radiusMm": 5}]})");
}

void TestSegmentCases::recipesSayThatTheyMadeIt() {
  NEED_DATA(dataPath("segment-cases"));
  QFETCH(QStringList, how);
  QFETCH(int, type);
  QFETCH(QByteArray, name);
  QFETCH(QByteArray, recipe);
  const QTemporaryDir folder;
  writeBytes(folder.filePath(QStringLiteral("r.json")), recipe);
  const Outcome done =
      runProgramIn(folder.path(), QStringList{QStringLiteral("segment"), tinyCt()} + how +
                                      QStringList{QStringLiteral("-o"), QStringLiteral("z.dcm")});
  QVERIFY2(done.status == 0, done.err.constData());
  const Segment made = firstSegmentOf(folder.filePath(QStringLiteral("z.dcm")));
  QCOMPARE(int(made.algorithmType), type);
  QCOMPARE(made.algorithm, name.toStdString());
}

VOLUMEN_TEST(TestSegmentCases);
#include "tst_segment_cases.moc"
