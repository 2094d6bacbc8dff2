// Guards import.md: measurement groups of TID 1500 and key images of TID 2010 are read as written.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include "io/report.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/io/dicom_objects.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestReports : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void groupsAreThoseOfTheFile_data();
  void groupsAreThoseOfTheFile();
  void whatIsSaidOfANumberStandsWithIt();
  void keyObjectsNameTheirPictures();
  void shapesOfMeasurementsAreTheirs();
  void shapesWithWrongPointsAreLeftOut_data();
  void shapesWithWrongPointsAreLeftOut();
  void aReportWithoutGroupsHasNone();
};

namespace {

const char* const groupsFile = "dicom-2d/sr-tid1500-groups-on-CT_small.dcm";

DcmItem& content(DcmItem& in, const char* type, const char* code) {
  DcmItem& item = addItem(in, 0x0040, 0xa730);
  put(item, 0x0040, 0xa040, type);
  put(addItem(item, 0x0040, 0xa043), 0x0008, 0x0100, code);
  return item;
}

void addGraphic(DcmItem& item, const char* type, const std::vector<float>& numbers) {
  put(item, 0x0070, 0x0023, type);
  putFloats(item, 0x0070, 0x0022, numbers);
}

Result<Report> reportOf(const std::function<void(DcmItem&)>& group) {
  const DicomFolder folder;
  writeObject(folder.path("sr"), reportClass,
              [&](DcmItem& data) { group(content(data, "CONTAINER", "125007")); });
  return loadReport(folder.path("sr"));
}

}  // namespace

void TestReports::groupsAreThoseOfTheFile_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<int>("group");
  QTest::addColumn<QString>("words");  // tracking id, finding, site, name, unit
  QTest::addColumn<double>("value");
  QTest::addColumn<QString>("shape");
  const auto row = [](const char* name, const char* file, int group, const char* words, double value,
                      const char* shape) {
    QTest::newRow(name) << QString::fromLatin1(file) << group << QString::fromLatin1(words) << value
                        << QString::fromLatin1(shape);
  };
  row("a histogram's mean, no shape", groupsFile, 0, "Image0001|||Intensity Histogram Mean|[hnsf'U]",
      -119.07385253906, "");
  row("a nodule", groupsFile, 1, "LungNodule0001|Nodule|Lung|Diameter|mm", 10, "circle 45 55 0 45 65 0");
  row("an aorta", groupsFile, 2, "Aorta0001|Aorta||Diameter|mm", 20,
      "polyline 25 45 0 45 45 0 45 65 0 25 65 0");
  row("a vertebra in the patient", groupsFile, 3, "Vertebra0001|Vertebra||Volume|mm3", 200,
      "point 123.5 234.1 -23.7");
  row("a spinal cord", "dicom-2d/sr-tid1500-on-CT_small.dcm", 0,
      "Planar ROI Measurements|Spinal cord|Cervico-thoracic spine|Area of defined region|cm2", 1.7,
      "circle 58 52 0 58 41 0");
}

void TestReports::groupsAreThoseOfTheFile() {
  NEED_DATA(dataPath());
  QFETCH(QString, file);
  QFETCH(int, group);
  QFETCH(QString, words);
  QFETCH(double, value);
  QFETCH(QString, shape);
  const Result<Report> report = loadReport(dataPath(file.toStdString()));
  QVERIFY2(report, report ? "" : report.message().c_str());
  QVERIFY(report->warnings.empty());
  QCOMPARE(report->title.meaning, std::string("Imaging Measurement Report"));
  QCOMPARE(report->groups.size(), std::size_t(file == QLatin1String(groupsFile) ? 4 : 1));
  const MeasurementGroup& g = report->groups[std::size_t(group)];
  QCOMPARE(g.measurements.size(), std::size_t(1));
  const ReportMeasurement& m = g.measurements[0];
  QStringList said;
  for (const std::string& word :
       {g.trackingId, g.finding.meaning, g.site.meaning, m.name.meaning, m.unit.value})
    said << QString::fromStdString(word);
  QCOMPARE(said.join(QLatin1Char('|')), words);
  QCOMPARE(*m.value, value);
  QVERIFY(g.trackingUid.starts_with("1.2.826.0.1.3680043."));
  QCOMPARE(g.shapes.size(), std::size_t(shape.isEmpty() ? 0 : 1));
  if (shape.isEmpty()) return;
  const ReportShape& s = g.shapes[0];
  QString drawn = QString::fromLatin1(typeName(s.type));
  for (const glm::dvec3 p : s.points)
    for (int c = 0; c < 3; ++c) drawn += QLatin1Char(' ') + QString::number(p[c], 'g', 6);
  QCOMPARE(drawn, shape);
  QCOMPARE(s.inPatient, g.trackingId == "Vertebra0001");
  if (s.inPatient)
    QCOMPARE(s.frameOfReferenceUid, std::string("1.3.6.1.4.1.5962.1.4.1.1.20040119072730.12322"));
  else
    QCOMPARE(s.pictures.at(0).sopInstanceUid, std::string("1.3.6.1.4.1.5962.1.1.1.1.1.20040119072730.12322"));
}

void TestReports::whatIsSaidOfANumberStandsWithIt() {
  NEED_DATA(dataPath());
  const Result<Report> cord = loadReport(dataPath("dicom-2d/sr-tid1500-on-CT_small.dcm"));
  const Result<Report> groups = loadReport(dataPath(groupsFile));
  QVERIFY(cord.ok() && groups.ok());
  const auto& properties = cord->groups[0].measurements[0].properties;
  QCOMPARE(properties.size(), std::size_t(2));
  QCOMPARE(properties[1].name.meaning, std::string("Level of Significance"));
  QCOMPARE(properties[1].value.meaning, std::string("Not significant"));
  const auto& evaluations = groups->groups[1].evaluations;
  QCOMPARE(evaluations.size(), std::size_t(1));
  QCOMPARE(evaluations[0].value.meaning, std::string("Not significant"));
}

void TestReports::keyObjectsNameTheirPictures() {
  NEED_DATA(dataPath());
  const Result<KeyObjects> keys = loadKeyObjects(dataPath("dicom-2d/made-here/ko-on-CT_small.dcm"));
  QVERIFY2(keys, keys ? "" : keys.message().c_str());
  QCOMPARE(keys->title.value, std::string("113000"));
  QCOMPARE(keys->title.scheme, std::string("DCM"));
  QCOMPARE(keys->title.meaning, std::string("Of Interest"));
  QCOMPARE(keys->text, std::string("made for a test"));
  QCOMPARE(keys->pictures.size(), std::size_t(1));
  QCOMPARE(keys->pictures[0].sopInstanceUid, std::string("1.3.6.1.4.1.5962.1.1.1.1.1.20040119072730.12322"));
  const Result<Report> asReport = loadReport(dataPath("dicom-2d/made-here/ko-on-CT_small.dcm"));
  QVERIFY(!asReport.ok() && asReport.message().ends_with("it holds no report."));
}

void TestReports::shapesOfMeasurementsAreTheirs() {
  const Result<Report> report = reportOf([](DcmItem& group) {
    DcmItem& number = content(group, "NUM", "410668003");
    addGraphic(content(number, "SCOORD", "121055"), "POLYLINE", {1, 2, 3, 4});
    content(group, "NUM", "1").putAndInsertOFStringArray(DCM_TextValue, "no number");
  });
  QVERIFY(report.ok() && report->groups.at(0).shapes.empty());
  QCOMPARE(report->groups[0].measurements.at(0).shapes.at(0).points.at(1), glm::dvec3(3, 4, 0));
  QVERIFY(!report->groups[0].measurements.at(1).value);
}

void TestReports::shapesWithWrongPointsAreLeftOut_data() {
  QTest::addColumn<QString>("space");
  QTest::addColumn<QString>("type");
  QTest::addColumn<QList<float>>("numbers");
  const auto row = [](const char* name, const char* space, const char* type, const QList<float>& numbers) {
    QTest::newRow(name) << QString::fromLatin1(space) << QString::fromLatin1(type) << numbers;
  };
  row("half a point", "SCOORD", "POLYLINE", {1, 2, 3, 4, 5});
  row("a circle of three points", "SCOORD", "CIRCLE", {1, 2, 3, 4, 5, 6});
  row("an ellipse of two points", "SCOORD", "ELLIPSE", {1, 2, 3, 4});
  row("no points", "SCOORD", "MULTIPOINT", {});
  row("an unknown type", "SCOORD", "SPIRAL", {1, 2});
  row("two numbers in the patient", "SCOORD3D", "POINT", {1, 2});
  row("infinity", "SCOORD3D", "POINT", {1, 2, INFINITY});
}

void TestReports::shapesWithWrongPointsAreLeftOut() {
  QFETCH(QString, space);
  QFETCH(QString, type);
  QFETCH(QList<float>, numbers);
  const Result<Report> report = reportOf([&](DcmItem& group) {
    DcmItem& item = content(group, qPrintable(space), "111030");
    put(item, 0x0070, 0x0023, type.toStdString());
    if (!numbers.isEmpty()) putFloats(item, 0x0070, 0x0022, {numbers.begin(), numbers.end()});
  });
  QVERIFY(report.ok() && report->groups.at(0).shapes.empty());
  QCOMPARE(report->warnings.size(), std::size_t(1));
  QVERIFY(report->warnings[0].find(type.toStdString()) != std::string::npos);
}

void TestReports::aReportWithoutGroupsHasNone() {
  NEED_DATA(dataPath());
  const Result<Report> report = loadReport(dataPath("dicom-pydicom/test_files/test-SR.dcm"));
  QVERIFY2(report, report ? "" : report.message().c_str());
  QVERIFY(report->groups.empty() && !report->title.meaning.empty());
}

VOLUMEN_TEST(TestReports);
#include "tst_reports.moc"
