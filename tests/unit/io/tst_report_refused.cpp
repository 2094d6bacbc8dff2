// Guards export.md: reports and key objects that DICOM cannot hold are refused with a sentence, and no file
// is replaced.
#include <QDir>
#include <QFile>

#include "io/export/key_objects_dicom.h"
#include "io/export/report_dicom.h"
#include "tests/unit/io/document_study.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestReportRefused : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void badReportsAreRefused_data();
  void badReportsAreRefused();
  void badKeyObjectsAreRefused_data();
  void badKeyObjectsAreRefused();
  void foreignImagesAreRefused();
  void anExistingFileStays();
};

void TestReportRefused::badReportsAreRefused_data() {
  using Edit = std::function<void(Report&)>;
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<QByteArray>("says");
  const auto row = [](const char* name, const char* says, const Edit& edit) {
    QTest::newRow(name) << edit << QByteArray(says);
  };
  const auto length = [](Report& r) -> ReportMeasurement& { return r.groups[0].measurements[0]; };
  row("no group", "no measurement", [](Report& r) { r.groups.clear(); });
  row("no name", "no code", [=](Report& r) { length(r).name = {}; });
  row("no unit", "no unit", [=](Report& r) { length(r).unit = {}; });
  row("not a number", "not finite", [=](Report& r) { length(r).value = NAN; });
  row("infinite", "not finite", [=](Report& r) { length(r).value = INFINITY; });
  row("a point less", "number of points", [=](Report& r) { length(r).shapes[0].points.pop_back(); });
  row("an infinite point", "not finite", [=](Report& r) { length(r).shapes[0].points[0].x = INFINITY; });
  row("a point beyond float", "not finite", [=](Report& r) { length(r).shapes[0].points[0].x = 1e39; });
  row("no image", "names no image", [=](Report& r) { length(r).shapes[0].pictures.clear(); });
  row("an image that is not here", "not here",
      [=](Report& r) { length(r).shapes[0].pictures[0].sopInstanceUid = "1.2"; });
  row("no frame of reference", "frame of reference",
      [=](Report& r) { length(r).shapes[0].inPatient = true; });
  row("a polygon in pixels", "polygon does not exist in pixels",
      [=](Report& r) { length(r).shapes[0].type = ReportShape::Type::polygon; });
  row("a code without scheme", "scheme", [](Report& r) { r.groups[0].finding = {"1", "", "x"}; });
  row("a long scheme", "scheme", [](Report& r) { r.groups[0].finding = {"1", "12345678901234567", "x"}; });
  row("a code of two values", "scheme", [](Report& r) { r.groups[0].finding = {"1\\2", "SCT", "x"}; });
  row("a property without name", "properties", [](Report& r) {
    r.groups[0].evaluations.push_back({{}, {"1", "SCT", "x"}});
  });
}

void TestReportRefused::badReportsAreRefused() {
  QFETCH(std::function<void(Report&)>, edit);
  QFETCH(QByteArray, says);
  const DocumentStudy study;
  const auto source = study.source();
  QVERIFY(source);
  Report report = oneLength(study);
  edit(report);
  const auto done = writeReport(report, *source, study.path("sr"));
  QVERIFY(!done);
  QVERIFY2(done.message().find(says.constData()) != std::string::npos, done.message().c_str());
  QVERIFY(done.message().ends_with('.'));
  QVERIFY(!QFile::exists(QString::fromStdString(study.path("sr"))));
}

void TestReportRefused::badKeyObjectsAreRefused_data() {
  QTest::addColumn<QByteArray>("title");
  QTest::addColumn<int>("frame");  // of the picture with five; below 0: no picture
  QTest::addColumn<QByteArray>("says");
  for (const char* title : {"113001", "113037", "113038", "113039"})
    QTest::newRow(title) << QByteArray(title) << 0 << QByteArray("hide");
  QTest::newRow("no image") << QByteArray("113000") << -1 << QByteArray("no key image");
  QTest::newRow("a frame too many") << QByteArray("113000") << 5 << QByteArray("no frame 6");
}

void TestReportRefused::badKeyObjectsAreRefused() {
  QFETCH(QByteArray, title);
  QFETCH(int, frame);
  QFETCH(QByteArray, says);
  const DocumentStudy study;
  const auto source = study.source();
  QVERIFY(source);
  KeyObjects keys{{title.toStdString(), "DCM", "Title"}, {}, {}};
  if (frame >= 0) keys.pictures.push_back({study.clip(), {}, {frame}, {}});
  const Status done = writeKeyObjects(keys, *source, study.path("ko"));
  QVERIFY(!done);
  QVERIFY2(done.message().find(says.constData()) != std::string::npos, done.message().c_str());
  QVERIFY(!QFile::exists(QString::fromStdString(study.path("ko"))));
}

void TestReportRefused::foreignImagesAreRefused() {
  DicomFolder folder;
  for (const char* study : {"1.2.3.4", "1.2.3.5"}) {
    DicomPicture picture{.seriesUid = std::string(study) + ".1"};
    picture.edit = [&](DcmDataset& data) {
      data.putAndInsertString(DCM_StudyInstanceUID, study);
      data.putAndInsertString(DCM_SOPInstanceUID, (std::string(study) + ".2").c_str());
    };
    folder.add(study, picture);
  }
  const Study study = folder.open();
  const std::vector<std::string> both = {"1.2.3.4.2", "1.2.3.5.2"}, none = {"1.2.3.6"}, one = {"1.2.3.5.2"};
  QVERIFY(readDocumentSource(study, both).message().find("another study") != std::string::npos);
  QVERIFY(readDocumentSource(study, none).message().find("1.2.3.6") != std::string::npos);
  QCOMPARE(readDocumentSource(study, one)->studyUid, std::string("1.2.3.5"));
}

void TestReportRefused::anExistingFileStays() {
  const DocumentStudy study;
  const auto source = study.source();
  QVERIFY(source);
  writeAll(study.path("sr"), {1, 2, 3});
  const auto done = writeReport(oneLength(study), *source, study.path("sr"));
  QVERIFY(!done && done.message().find("is there already") != std::string::npos);
  QCOMPARE(readAll(study.path("sr")), (std::vector<std::uint8_t>{1, 2, 3}));
  QCOMPARE(QDir(QString::fromStdString(study.path("")))
               .entryList({QStringLiteral(".volumen-*")}, QDir::Hidden | QDir::Files)
               .size(),
           0);
}

VOLUMEN_TEST(TestReportRefused);
#include "tst_report_refused.moc"
