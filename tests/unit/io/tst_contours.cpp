// Guards import.md: regions and contours of an RT Structure Set are read as written, in patient mm.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>

#include "io/contours.h"
#include "io/open.h"
#include "tests/fixtures/cpu_timer.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/io/dicom_objects.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestContours : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aRealTumourIsReadWhole();
  void aRealPlanIsReadWhole();
  void contoursLieOnTheSlicesOfTheirCt();
  void areaIsThatOfThePolygon_data();
  void areaIsThatOfThePolygon();
  void aMillionPointsAreRead();
  void whatBelongsToNothingIsLeftOut();
};

namespace {

DcmItem& addRegion(DcmItem& data, const char* number) {
  put(addItem(data, 0x3006, 0x0020), 0x3006, 0x0022, number);
  DcmItem& contours = addItem(data, 0x3006, 0x0039);
  put(contours, 0x3006, 0x0084, number);
  return contours;
}

void addContour(DcmItem& region, const char* type, const std::string& points) {
  DcmItem& contour = addItem(region, 0x3006, 0x0040);
  put(contour, 0x3006, 0x0042, type);
  put(contour, 0x3006, 0x0050, points);
}

}  // namespace

void TestContours::aRealTumourIsReadWhole() {
  NEED_DATA(dataPath());
  const Result<StructureSet> set = loadContours(dataPath("pet-ct/sts019-rtstruct-ct.dcm"));
  QVERIFY2(set, set ? "" : set.message().c_str());
  QVERIFY(set->warnings.empty());
  QCOMPARE(set->regions.size(), std::size_t(1));
  const RegionOfInterest& tumour = set->regions[0];
  QCOMPARE(tumour.number, 1);
  QCOMPARE(tumour.name, std::string("GTV_Mass_CT"));
  QCOMPARE(tumour.type, std::string("GTV"));
  QCOMPARE(*tumour.colour, glm::u8vec3(255, 0, 0));
  QCOMPARE(tumour.contours.size(), std::size_t(15));
  double area = 0;
  for (const Contour& c : tumour.contours) {
    QVERIFY(c.type == Contour::Type::closedPlanar && c.pictures.size() == 1);
    area += areaOf(c);
  }
  // the expected area is rounded
  QVERIFY2(std::abs(area - 5312.0) < 0.05, qPrintable(QString::number(area)));
  QVERIFY(std::abs(area * 3.27 / 1000 - 17.37) < 0.005);
  const auto middle = std::ranges::find_if(
      tumour.contours, [](const Contour& c) { return std::abs(c.points[0].z + 150.42) < 1e-6; });
  QVERIFY(middle != tumour.contours.end());
  QCOMPARE(middle->points.size(), std::size_t(274));
  QVERIFY2(std::abs(areaOf(*middle) - 519.96) < 0.005, qPrintable(QString::number(areaOf(*middle))));
  const auto [left, right] = std::ranges::minmax(middle->points, {}, &glm::dvec3::x);
  const auto [front, back] = std::ranges::minmax(middle->points, {}, &glm::dvec3::y);
  QVERIFY(std::abs(left.x + 35.4) < 5e-4 && std::abs(right.x + 6.104) < 5e-4);
  QVERIFY(std::abs(front.y + 89.356) < 5e-4 && std::abs(back.y + 64.941) < 5e-4);
}

void TestContours::aRealPlanIsReadWhole() {
  NEED_DATA(dataPath());
  const Result<StructureSet> set = loadContours(dataPath("dicom-pydicom/test_files/rtstruct.dcm"));
  QVERIFY2(set, set ? "" : set.message().c_str());
  QCOMPARE(set->regions.size(), std::size_t(3));
  QCOMPARE(set->regions[0].name, std::string("patient"));
  QCOMPARE(set->regions[0].contours.size(), std::size_t(3));
  QCOMPARE(set->regions[0].contours[1].points.size(), std::size_t(6));
  QVERIFY(set->regions[2].contours.at(0).type == Contour::Type::point);
}

void TestContours::contoursLieOnTheSlicesOfTheirCt() {
  NEED_DATA(dataPath());
  const Result<Study> study = openStudy(dataPath("pet-ct"));
  const Result<StructureSet> set = loadContours(dataPath("pet-ct/sts019-rtstruct-ct.dcm"));
  QVERIFY(study.ok() && set.ok());
  const auto ct = std::ranges::find_if(
      study->volumes, [](const Series& s) { return s.modality == "CT" && s.acquired.size.z == 47; });
  QVERIFY(ct != study->volumes.end());
  for (const Contour& c : set->regions[0].contours) {
    const double k = ct->acquired.voxelFromPatient(c.points[0]).z;
    QVERIFY(std::abs(k - std::round(k)) < 1e-3 && std::round(k) >= 16 && std::round(k) <= 30);
  }
  // The pictures that it names were cropped away. It is placed by its coordinates alone.
  const auto object = std::ranges::find(study->derived, DerivedKind::contours, &DerivedObject::kind);
  QVERIFY(object != study->derived.end());
  QCOMPARE(object->notHere, std::size_t(179));
  QCOMPARE(
      object->frameOfReferenceUid.empty() ? set->regions[0].frameOfReferenceUid : object->frameOfReferenceUid,
      ct->frameOfReferenceUid);
}

void TestContours::areaIsThatOfThePolygon_data() {
  QTest::addColumn<QString>("type");
  QTest::addColumn<QString>("points");
  QTest::addColumn<double>("area");
  const auto row = [](const char* name, const char* type, const char* points, double area) {
    QTest::newRow(name) << QString::fromLatin1(type) << QString::fromLatin1(points) << area;
  };
  row("a square of 2 mm", "CLOSED_PLANAR", "0\\0\\5\\2\\0\\5\\2\\2\\5\\0\\2\\5", 4);
  row("the other way round", "CLOSED_PLANAR", "0\\2\\5\\2\\2\\5\\2\\0\\5\\0\\0\\5", 4);
  row("upright", "CLOSEDPLANAR_XOR", "7\\0\\0\\7\\3\\0\\7\\3\\4\\7\\0\\4", 12);
  row("with a dent", "CLOSED_PLANAR", "0\\0\\0\\4\\0\\0\\4\\4\\0\\2\\2\\0\\0\\4\\0", 12);
  row("a line", "OPEN_PLANAR", "0\\0\\5\\2\\0\\5\\2\\2\\5", 0);
  row("two points", "CLOSED_PLANAR", "0\\0\\5\\2\\0\\5", 0);
}

void TestContours::areaIsThatOfThePolygon() {
  QFETCH(QString, type);
  QFETCH(QString, points);
  QFETCH(double, area);
  const DicomFolder folder;
  writeObject(folder.path("rt"), structureSetClass, [&](DcmItem& data) {
    addContour(addRegion(data, "1"), qPrintable(type), points.toStdString());
  });
  const Result<StructureSet> set = loadContours(folder.path("rt"));
  QVERIFY2(set, set ? "" : set.message().c_str());
  QCOMPARE(areaOf(set->regions.at(0).contours.at(0)), area);
}

// 19 MB are in one element, as only implicit VR can write it.
void TestContours::aMillionPointsAreRead() {
  const DicomFolder folder;
  std::string points = "0\\0\\0";
  for (int n = 1; n < 1000000; ++n) points += "\\" + std::to_string(n) + "\\-0.25\\1";
  writeObject(
      folder.path("rt"), structureSetClass,
      [&](DcmItem& data) { addContour(addRegion(data, "1"), "OPEN_NONPLANAR", points); }, true);
  const CpuTimer timer;
  const Result<StructureSet> set = loadContours(folder.path("rt"));
  QVERIFY2(set, set ? "" : set.message().c_str());
  QCOMPARE(set->regions.at(0).contours.at(0).points.size(), std::size_t(1000000));
  QCOMPARE(set->regions[0].contours[0].points.back(), glm::dvec3(999999, -0.25, 1));
  QVERIFY2(timer.elapsed() < 10000, "slow");  // 0.2 s on two idle cores
}

void TestContours::whatBelongsToNothingIsLeftOut() {
  const DicomFolder folder;
  writeObject(folder.path("rt"), structureSetClass, [&](DcmItem& data) {
    DcmItem& region = addRegion(data, "1");
    addContour(region, "CLOSED_PLANAR", "0\\0\\5\\2\\0\\5\\2\\2");  // the third point has only two numbers
    addContour(region, "SPIRAL", "0\\0\\5");
    addContour(region, "POINT", "0\\0\\x");
    addContour(region, "POINT", "1\\2\\3");
    put(addItem(data, 0x3006, 0x0020), 0x3006, 0x0022, "1");  // repeats the number
    put(addItem(data, 0x3006, 0x0039), 0x3006, 0x0084, "7");  // names no region
  });
  const Result<StructureSet> set = loadContours(folder.path("rt"));
  QVERIFY2(set, set ? "" : set.message().c_str());
  QCOMPARE(set->regions.size(), std::size_t(1));
  QCOMPARE(set->regions[0].contours.size(), std::size_t(1));
  QCOMPARE(set->warnings.size(), std::size_t(3));
}

VOLUMEN_TEST(TestContours);
#include "tst_contours.moc"
