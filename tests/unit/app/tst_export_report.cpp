// Guards export.md: `volumen export --as sr` writes the numbers of `volumen measure`, on the right images,
// and
// --as ko the chosen images; both are valid DICOM in the study of the images.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <glm/geometric.hpp>

#include "io/open.h"
#include "io/report.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/app/export_case.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"
#include "viewer/measure/shape_json.h"

using namespace volumen;
using namespace volumen::tests;

class TestExportReport : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void numbersAndImagesAreTheMeasured_data();
  void numbersAndImagesAreTheMeasured();
  void shapesAcrossSlicesAreInThePatient();
  void shapesOnFramesNameThem();
  void shapesWithoutNumberAreLeftOut();
  void segmentsAreReported();
  void namesOfPatientsStay_data();
  void namesOfPatientsStay();

 private:
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  QString writtenShapes(const std::vector<Shape>& shapes) const;
  QTemporaryDir folder_;
};

namespace {

// A slice as acquired near the middle of a series, and the grid that shapes are measured on.
struct MiddleSlice {
  VoxelGeometry grid;
  int drawn = 0, acquired = 0;  // its index in the grid, and in the series
};

MiddleSlice middleOf(const Series& series) {
  if (!series.regular) return {series.acquired, series.acquired.size.z / 2, series.acquired.size.z / 2};
  int drawn = series.regular->geometry.size.z / 2;
  while (series.regular->copies[std::size_t(drawn)] < 0) ++drawn;
  return {series.regular->geometry, drawn, series.regular->copies[std::size_t(drawn)]};
}

// Shapes of all kinds that have a place, with their points on one slice.
std::vector<Shape> shapesOn(const MiddleSlice& slice) {
  const auto at = [&](double a, double b) {
    const glm::dvec2 middle = glm::dvec2(slice.grid.size / 2), unit = glm::dvec2(slice.grid.size) / 32.0;
    return slice.grid.patientFromVoxel({middle + unit * glm::dvec2(a, b), slice.drawn});
  };
  const glm::dmat3& step = slice.grid.patientFromVoxelStep;
  const ShapePlane plane{at(0, 0), glm::normalize(step[0]), glm::normalize(step[1])};
  const std::vector<glm::dvec3> bent = {at(-1, 0), at(2, 1), at(2, 3)};
  const std::vector<glm::dvec3> lines = {at(-1, 0), at(2, 1), at(-3, 2), at(2, 3)};
  const std::vector<glm::dvec3> box = {at(-1, -1), at(1, 2)};
  return {{ShapeKind::length, "lesion 1", {at(-1, 0), at(2, 1)}, {}, {}, {}},
          {ShapeKind::polyline, "", bent, {}, {}, {}},
          {ShapeKind::openCurve, "", bent, {}, {}, {}},
          {ShapeKind::angle, "", bent, {}, {}, {}},
          {ShapeKind::cobb, "", lines, {}, {}, {}},
          {ShapeKind::legAxis, "", bent, {}, {}, {}},
          {ShapeKind::cardiothoracic, "", lines, {}, {}, {}},
          {ShapeKind::bidirectional, "", {at(0, -2), at(0, 1), at(-1, 0), at(3, 0)}, {}, {}, {}},
          {ShapeKind::ellipse, "Länge 長さ", box, plane, {}, {}},
          {ShapeKind::rectangle, "", box, plane, {}, {}},
          {ShapeKind::freehand, "", bent, plane, {}, {}},
          {ShapeKind::probe, "", {at(1, 1)}, {}, {}, {}}};
}

// Returns the numbers that a report must have for a shape, in their order.
std::vector<double> numbersOf(const QJsonObject& measured) {
  const auto number = [&](const char* name) { return measured[QLatin1String(name)].toDouble(); };
  const QString kind = measured[QStringLiteral("kind")].toString();
  if (kind == QLatin1String("legAxis")) return {number("hka")};
  if (kind == QLatin1String("bidirectional")) return {number("number"), number("short")};
  std::vector<double> all = {number("number")};
  if (measured.contains(QStringLiteral("mean")))
    for (const char* name : {"mean", "sd", "min", "max"}) all.push_back(number(name));
  return all;
}

std::vector<std::string> meaningsOf(const MeasurementGroup& group) {
  std::vector<std::string> names;
  for (const ReportMeasurement& m : group.measurements) names.push_back(m.name.meaning);
  return names;
}

}  // namespace

QString TestExportReport::writtenShapes(const std::vector<Shape>& shapes) const {
  QFile file(at("shapes.json"));
  if (!file.open(QIODevice::WriteOnly)) return {};
  file.write(QByteArray::fromStdString(shapesToJson(shapes)));
  return file.fileName();
}

void TestExportReport::numbersAndImagesAreTheMeasured_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<QString>("unit");      // of values
  QTest::addColumn<QString>("quantity");  // of a probe
  QTest::addColumn<bool>("isOnPixels");
  const auto row = [](const char* name, const char* path, const char* unit, const char* quantity,
                      bool isOnPixels = true) {
    QTest::newRow(name) << QString::fromLatin1(path) << QString::fromLatin1(unit)
                        << QString::fromLatin1(quantity) << isOnPixels;
  };
  row("CT", "ct-chest-lidc0314-138", "[hnsf'U]", "Attenuation Coefficient");
  row("MR, oblique", "mr-head-ge-mprage-130", "1", "Mean");
  row("MR, a slice is missing", "mr-head-siemens-gap-175", "1", "Mean");
  row("PET", "pet-ct/pet-bqml-fdg.dcm", "g/ml{SUVbw}", "SUVbw");
  row("MR, enhanced multi-frame", "dicom-geometry/mr-enh-philips-phmag", "1", "Mean");
  row("CT, tilted, uneven slices", "dicom-geometry/ct-ge-tilt-varspacing-28", "[hnsf'U]",
      "Attenuation Coefficient");
  row("a mosaic's tiles have no pixels of their own", "dicom-geometry/mr-mosaic-siemens", "1", "Mean", false);
}

void TestExportReport::numbersAndImagesAreTheMeasured() {
  NEED_DATA(dataPath());
  QFETCH(QString, path);
  QFETCH(QString, unit);
  QFETCH(QString, quantity);
  QFETCH(bool, isOnPixels);
  path = QString::fromStdString(dataPath(path.toStdString()));
  const Result<Study> study = openStudy(path.toStdString());
  QVERIFY(study.ok() && !study->volumes.empty());
  const Series& series = study->volumes.front();
  const MiddleSlice slice = middleOf(series);
  const std::vector<Shape> shapes = shapesOn(slice);
  const QString json = writtenShapes(shapes), file = folder_.filePath(QLatin1String(QTest::currentDataTag()));
  const QStringList what = {path, QStringLiteral("--roi"), json, QStringLiteral("--series"),
                            QString::fromStdString(series.id)};
  const Outcome measured = runProgram(QStringList{QStringLiteral("measure")} + what);
  const Outcome exported =
      runProgram(QStringList{QStringLiteral("export")} + what +
                 QStringList{QStringLiteral("--as"), QStringLiteral("sr"), QStringLiteral("-o"), file});
  QVERIFY2(exported.status == measured.status, exported.err);
  const QJsonArray numbers = QJsonDocument::fromJson(measured.out)[QStringLiteral("measurements")].toArray();
  const Result<Report> report = loadReport(file.toStdString());
  QVERIFY2(report, report ? "" : report.message().c_str());
  QCOMPARE(report->title.value, std::string("126000"));
  QCOMPARE(report->groups.size(), shapes.size());
  QCOMPARE(numbers.size(), qsizetype(shapes.size()));
  for (std::size_t n = 0; n < shapes.size(); ++n) {
    const MeasurementGroup& group = report->groups[n];
    std::vector<double> values;
    for (const ReportMeasurement& m : group.measurements) values.push_back(*m.value);
    if (shapes[n].plane && unit.contains(QLatin1String("SUV"))) values.pop_back();  // the peak comes last
    QCOMPARE(values, numbersOf(numbers[qsizetype(n)].toObject()));
    const ReportShape& drawn = group.measurements[0].shapes.at(0);
    QCOMPARE(drawn.inPatient, !isOnPixels);
    QCOMPARE(group.shapes.size(), std::size_t(shapes[n].plane ? 1 : 0));
    const ReferencedPicture& picture = isOnPixels ? drawn.pictures.at(0) : group.pictures.at(0);
    QCOMPARE(picture.sopInstanceUid, series.sopInstanceUids[std::size_t(slice.acquired)]);
    const bool isMultiFrame = isOnPixels && series.sopInstanceUids.size() > 1 &&
                              series.sopInstanceUids[0] == series.sopInstanceUids[1];
    if (isMultiFrame) QCOMPARE(picture.frames, std::vector{series.frames[std::size_t(slice.acquired)]});
    const bool isFirst = shapes[n].kind == ShapeKind::length;
    if (!isFirst) continue;
    for (int end = 0; end < 2; ++end) {
      const glm::dvec3 p = shapes[n].points[std::size_t(end)];
      const glm::dvec3 wanted =
          isOnPixels ? slice.grid.voxelFromPatient(p) + glm::dvec3(0.5, 0.5, -slice.drawn) : p;
      QVERIFY(glm::distance(drawn.points[std::size_t(end)], wanted) < 1e-3);
    }
  }
  QCOMPARE(report->groups[0].trackingId, std::string("Cornerstone3DTools@^0.1.0:Length:lesion 1"));
  QCOMPARE(report->groups[0].finding.meaning, std::string("lesion 1"));
  QCOMPARE(report->groups[3].measurements[0].shapes[0].points.size(), std::size_t(4));
  const MeasurementGroup& ellipse = report->groups[8];
  QCOMPARE(ellipse.trackingId, std::string("Cornerstone3DTools@^0.1.0:EllipticalROI:Länge 長さ"));
  QCOMPARE(ellipse.measurements[0].unit.value, std::string("mm2"));
  QCOMPARE(ellipse.measurements[1].unit.value, unit.toStdString());
  std::vector<std::string> names = {"Area", "Mean", "Standard Deviation", "Minimum", "Maximum"};
  if (unit.contains(QLatin1String("SUV"))) names.emplace_back("Peak Value Within ROI");
  QCOMPARE(meaningsOf(ellipse), names);
  const auto& corners = report->groups[9].measurements[0].shapes[0].points;
  QVERIFY(corners.size() == 5 && corners.front() == corners.back());
  QCOMPARE(meaningsOf(report->groups[7]), (std::vector<std::string>{"Long Axis", "Short Axis"}));
  QCOMPARE(meaningsOf(report->groups[11]), std::vector{quantity.toStdString()});
  NEED_DCIODVFY();
  QCOMPARE(newErrors(file, series.files[0]), QStringList());
}

void TestExportReport::shapesAcrossSlicesAreInThePatient() {
  NEED_DATA(dataPath());
  const std::string path = dataPath("mr-head-ge-mprage-130");
  const Result<Study> study = openStudy(path);
  QVERIFY(study.ok());
  const Series& series = study->volumes.front();
  const glm::dvec3 from = series.acquired.patientFromVoxel({100, 90, 3}),
                   to = series.acquired.patientFromVoxel({120, 110, 40});
  const QString json = writtenShapes({{ShapeKind::length, "", {from, to}, {}, {}, {}}});
  const Outcome done =
      runProgram({QStringLiteral("export"), QString::fromStdString(path), QStringLiteral("--as"),
                  QStringLiteral("sr"), QStringLiteral("--roi"), json, QStringLiteral("-o"), at("deep.dcm")});
  QVERIFY2(done.status == 0, done.err);
  const Result<Report> report = loadReport(at("deep.dcm").toStdString());
  QVERIFY(report);
  const MeasurementGroup& group = report->groups.at(0);
  const ReportShape& line = group.measurements.at(0).shapes.at(0);
  QVERIFY(line.inPatient && line.pictures.empty());
  QCOMPARE(line.frameOfReferenceUid, series.frameOfReferenceUid);
  QVERIFY(glm::distance(line.points.at(0), from) < 1e-4 && glm::distance(line.points.at(1), to) < 1e-4);
  QVERIFY(std::abs(*group.measurements[0].value - glm::distance(from, to)) < 1e-6);
  QCOMPARE(group.pictures.size(), std::size_t(2));
  QCOMPARE(group.pictures[0].sopInstanceUid, series.sopInstanceUids[3]);
  QCOMPARE(group.pictures[1].sopInstanceUid, series.sopInstanceUids[40]);
  DcmFileFormat file;
  QVERIFY(file.loadFile(at("deep.dcm").toUtf8().constData()).good());
  QCOMPARE(textIn(*file.getDataset(), DCM_SOPClassUID), std::string(UID_Comprehensive3DSRStorage));
}

void TestExportReport::shapesOnFramesNameThem() {
  NEED_DATA(dataPath());
  const ShapeFrame third{clipUid, 2};
  const QString json =
      writtenShapes({{ShapeKind::length, "", {{100, 200, 0}, {200, 200, 0}}, {}, {}, third},
                     {ShapeKind::rectangle, "", {{100, 200, 0}, {200, 300, 0}}, ShapePlane{}, {}, third}});
  const Outcome done =
      runProgram({QStringLiteral("export"), QString::fromStdString(dataPath(clip)), QStringLiteral("--as"),
                  QStringLiteral("sr"), QStringLiteral("--roi"), json, QStringLiteral("-o"), at("clip.dcm")});
  QVERIFY2(done.status == 0, done.err);
  const Result<Report> report = loadReport(at("clip.dcm").toStdString());
  QVERIFY(report && report->groups.size() == 2);
  const ReportMeasurement& length = report->groups[0].measurements.at(0);
  QVERIFY(std::abs(*length.value - 28.5714) < 1e-3);  // measure.md: 0.8 times as high as wide
  QCOMPARE(length.shapes.at(0).points, (std::vector<glm::dvec3>{{100.5, 200.5, 0}, {200.5, 200.5, 0}}));
  QCOMPARE(length.shapes[0].pictures.at(0).sopInstanceUid, std::string(clipUid));
  QCOMPARE(length.shapes[0].pictures[0].frames, std::vector{2});
  QVERIFY(std::abs(*report->groups[1].measurements.at(0).value - 653.0612) < 1e-3);
  QCOMPARE(report->groups[1].measurements.size(), std::size_t(1));  // colours have no mean
  NEED_DCIODVFY();
  QCOMPARE(newErrors(at("clip.dcm"), dataPath(clip)), QStringList());
}

void TestExportReport::shapesWithoutNumberAreLeftOut() {
  NEED_DATA(dataPath());
  const ShapeFrame first{clipUid, 0};
  const Shape arrow{ShapeKind::arrow, "look", {{1, 1, 0}, {9, 9, 0}}, {}, {}, first};
  const Shape angle{ShapeKind::angle, "", {{1, 1, 0}, {9, 9, 0}, {20, 1, 0}}, {}, {}, first};
  const auto written = [&](const std::vector<Shape>& shapes, const char* name) {
    return runProgram({QStringLiteral("export"), QString::fromStdString(dataPath(clip)),
                       QStringLiteral("--as"), QStringLiteral("sr"), QStringLiteral("--roi"),
                       writtenShapes(shapes), QStringLiteral("-o"), at(name)});
  };
  const Outcome both = written({arrow, angle}, "both.dcm");
  QVERIFY2(both.status == 0 && both.err.contains("[0] (arrow \"look\") has no number"), both.err);
  QCOMPARE(loadReport(at("both.dcm").toStdString())->groups.size(), std::size_t(1));
  const Outcome none = written({arrow}, "none.dcm");
  QVERIFY2(none.status == 1 && none.err.contains("No shape in it has a number."), none.err);
  QVERIFY(!QFile::exists(at("none.dcm")));
}

// Beside a shape; of segmentations that are no DICOM the sentence says what to write first.
void TestExportReport::segmentsAreReported() {
  NEED_DATA(dataPath());
  const std::string path = dataPath("mr-head-ge-mprage-130");
  const QString source = QString::fromStdString(path);
  for (const char* file : {"bright.dcm", "bright.seg.nrrd"}) {
    const Outcome made = runProgram({QStringLiteral("segment"), source, QStringLiteral("--range"),
                                     QStringLiteral("300:4000"), QStringLiteral("-o"), at(file)});
    QVERIFY2(made.status == 0, made.err);
  }
  const Result<Study> study = openStudy(path);
  QVERIFY(study.ok());
  const Series& series = study->volumes.front();
  const QString json =
      writtenShapes({{ShapeKind::probe, "", {series.acquired.patientFromVoxel({90, 80, 3})}, {}, {}, {}}});
  const QStringList export_ = {QStringLiteral("export"),    source,
                               QStringLiteral("--as"),      QStringLiteral("sr"),
                               QStringLiteral("-o"),        at("segments.dcm"),
                               QStringLiteral("--segments")};
  const Outcome refused = runProgram(export_ + QStringList{at("bright.seg.nrrd")});
  QCOMPARE(refused.status, 1);
  QVERIFY2(refused.err.contains("--as seg"), refused.err);
  const Outcome done = runProgram(export_ + QStringList{at("bright.dcm"), QStringLiteral("--roi"), json});
  QVERIFY2(done.status == 0, done.err);
  const Outcome measured =
      runProgram({QStringLiteral("measure"), source, QStringLiteral("--segments"), at("bright.dcm")});
  const auto known = QJsonDocument::fromJson(measured.out)[QStringLiteral("segments")][0];
  const Result<Report> report = loadReport(at("segments.dcm").toStdString());
  QVERIFY2(report, report ? "" : report.message().c_str());
  QCOMPARE(report->groups.size(), std::size_t(2));
  const MeasurementGroup& group = report->groups[1];
  std::vector<double> values, wanted;
  for (const ReportMeasurement& m : group.measurements) values.push_back(*m.value);
  for (const char* name : {"millilitres", "mean", "sd", "min", "max"})
    wanted.push_back(known[QLatin1String(name)].toDouble());
  QCOMPARE(values, wanted);
  QCOMPARE(group.measurements[0].unit.value, std::string("ml"));
  QCOMPARE(group.pictures.at(0).segments, std::vector{1});
  QVERIFY(group.pictures.size() > 1);
  NEED_DCIODVFY();
  QCOMPARE(newErrors(at("segments.dcm"), series.files[0]), QStringList());
}

void TestExportReport::namesOfPatientsStay_data() {
  QTest::addColumn<QByteArray>("set");
  QTest::addColumn<QByteArray>("name");
  QTest::newRow("Latin-1") << QByteArray("ISO_IR 100")
                           << QByteArray(
                                  "Nu\xf1"
                                  "ez^Jos\xe9");
  QTest::newRow("Japanese") << QByteArray("\\ISO 2022 IR 87")
                            << QByteArray("Yamada^Tarou=\x1b$B;3ED\x1b(B^\x1b$BB@O:\x1b(B");
  QTest::newRow("Korean") << QByteArray("\\ISO 2022 IR 149")
                          << QByteArray("Hong^Gildong=\x1b$)C\xfb\xf3^\x1b$)C\xd1\xce\xd4\xd7");
  QTest::newRow("UTF-8") << QByteArray("ISO_IR 192") << QByteArray("Nuñez^José=山田^太郎");
}

void TestExportReport::namesOfPatientsStay() {
  QFETCH(QByteArray, set);
  QFETCH(QByteArray, name);
  const QTemporaryDir scans;
  DicomPicture picture;
  picture.edit = [&](DcmDataset& data) {
    data.putAndInsertString(DCM_SpecificCharacterSet, set.constData());
    data.putAndInsertString(DCM_PatientName, name.constData());
    data.putAndInsertString(DCM_SOPInstanceUID, "1.2.3.4.5.1");
  };
  writeDicom(scans.filePath(QStringLiteral("a.dcm")).toStdString(), picture);
  const QString json = writtenShapes({{ShapeKind::length, "plain", {{0, 0, 0}, {1, 0, 0}}, {}, {}, {}}});
  const QString options[] = {QStringLiteral("--as sr --roi ") + json,
                             QStringLiteral("--as ko --images 1.2.3.4.5.1")};
  for (const QString& option : options) {
    const QString out = scans.filePath(QStringLiteral("out"));
    const Outcome done = runProgram(QStringLiteral("export %1 %2 -o %3").arg(scans.path(), option, out));
    QVERIFY2(done.status == 0, done.err);
    DcmFileFormat file;
    QVERIFY(file.loadFile(out.toUtf8().constData()).good());
    QCOMPARE(QByteArray::fromStdString(textIn(*file.getDataset(), DCM_SpecificCharacterSet)), set);
    QCOMPARE(QByteArray::fromStdString(textIn(*file.getDataset(), DCM_PatientName)), name);
    QVERIFY(QFile::remove(out));
  }
}

VOLUMEN_TEST(TestExportReport);
#include "tst_export_report.moc"
