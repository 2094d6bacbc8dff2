// Guards export.md: `volumen export --as seg|rtstruct|stl` writes the segments of a file of any of these
// formats, and `volumen measure` reads them back with the same volumes.
#include <QDir>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/app/export_case.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestExportSegments : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void volumesComeBack_data();
  void volumesComeBack();
  void surfacesEncloseTheirSegment();
  void whatIsThereStays_data();
  void whatIsThereStays();
  void wrongWordsAreUsage_data();
  void wrongWordsAreUsage();

 private:
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  Outcome exported(const QString& to, const QStringList& options) const {
    return runProgram(QStringList{QStringLiteral("export"), source_, QStringLiteral("-o"), to} + options);
  }
  Outcome exported(const QString& to, const QString& as, const QString& from) const {
    return exported(to, {QStringLiteral("--as"), as, QStringLiteral("--segments"), from});
  }
  // Returns the volume of the first segment of a file in ml.
  double millilitres(const QString& segments) const {
    const Outcome a =
        runProgram({QStringLiteral("measure"), source_, QStringLiteral("--segments"), segments});
    return QJsonDocument::fromJson(a.out)[QStringLiteral("segments")][0][QStringLiteral("millilitres")]
        .toDouble();
  }

  QTemporaryDir folder_;
  QString source_;
  std::string firstFile_;
};

void TestExportSegments::initTestCase() {
  const std::string data = dataPath("mr-head-ge-mprage-130");
  NEED_DATA(data);
  source_ = QString::fromStdString(data);
  firstFile_ = QDir(source_).entryList(QDir::Files).constFirst().toStdString();
  const Outcome a = runProgram({QStringLiteral("segment"), source_, QStringLiteral("--range"),
                                QStringLiteral("300:4000"), QStringLiteral("-o"), at("bright.seg.nrrd")});
  QVERIFY2(a.status == 0, a.err);
}

void TestExportSegments::volumesComeBack_data() {
  QTest::addColumn<QStringList>("formats");  // one made of the other, from seg.nrrd on
  QTest::newRow("a structure set") << QStringList{QStringLiteral("rtstruct")};
  QTest::newRow("a segmentation") << QStringList{QStringLiteral("seg")};
  QTest::newRow("a structure set of a segmentation")
      << QStringList{QStringLiteral("seg"), QStringLiteral("rtstruct")};
  QTest::newRow("a segmentation of a structure set")
      << QStringList{QStringLiteral("rtstruct"), QStringLiteral("seg")};
}

void TestExportSegments::volumesComeBack() {
  QFETCH(QStringList, formats);
  const QTemporaryDir folder;
  QString from = at("bright.seg.nrrd");
  for (const QString& format : formats) {
    const QString to = folder.filePath(format + QStringLiteral(".dcm"));
    const Outcome a = exported(to, format, from);
    QVERIFY2(a.status == 0, a.err);
    QCOMPARE(a.out, QByteArray("Wrote " + to.toUtf8() + ".\n"));
    if (!QStandardPaths::findExecutable(QStringLiteral("dciodvfy")).isEmpty())
      QCOMPARE(newErrors(to, dataPath("mr-head-ge-mprage-130") + "/" + firstFile_), QStringList());
    from = to;
  }
  const double ml = millilitres(at("bright.seg.nrrd"));
  QVERIFY(ml > 1);
  QVERIFY(qAbs(millilitres(from) - ml) < 0.01 * ml);
}

// The divergence theorem gives the volume inside the triangles of an STL file. The head is bulky enough for
// surface and voxels to agree.
void TestExportSegments::surfacesEncloseTheirSegment() {
  const QTemporaryDir folder;
  const QString to = folder.filePath(QStringLiteral("head.stl"));
  const QString head = folder.filePath(QStringLiteral("head.seg.nrrd"));
  const Outcome made = runProgram({QStringLiteral("segment"), source_, QStringLiteral("--range"),
                                   QStringLiteral("60:4000"), QStringLiteral("-o"), head});
  QVERIFY2(made.status == 0, made.err);
  const Outcome a = exported(to, QStringLiteral("stl"), head);
  QVERIFY2(a.status == 0, a.err);
  QCOMPARE(a.out, QByteArray("Wrote " + to.toUtf8() + ".\n"));
  const QByteArray file = contentsOf(to);
  constexpr qsizetype header = 84, triangle = 50, normal = 12;
  QVERIFY(file.size() > header && (file.size() - header) % triangle == 0);
  double sixfold = 0;
  for (qsizetype at = header; at < file.size(); at += triangle) {
    glm::vec3 corners[3];
    std::memcpy(corners, file.constData() + at + normal, sizeof corners);
    sixfold += glm::dot(glm::dvec3(corners[0]), glm::cross(glm::dvec3(corners[1]), glm::dvec3(corners[2])));
  }
  const double ml = millilitres(head);
  QVERIFY2(std::abs(sixfold / 6000 - ml) < 0.05 * ml, qPrintable(QString::number(sixfold / 6000)));
}

void TestExportSegments::whatIsThereStays_data() {
  QTest::addColumn<QString>("format");
  QTest::addColumn<QString>("name");
  QTest::newRow("a structure set") << QStringLiteral("rtstruct") << QStringLiteral("there.dcm");
  QTest::newRow("a segmentation") << QStringLiteral("seg") << QStringLiteral("there.dcm");
  QTest::newRow("a surface") << QStringLiteral("stl") << QStringLiteral("there.stl");
}

void TestExportSegments::whatIsThereStays() {
  QFETCH(QString, format);
  QFETCH(QString, name);
  const QTemporaryDir folder;
  QFile file(folder.filePath(name));
  QVERIFY(file.open(QIODevice::WriteOnly) && file.write("mine") == 4);
  file.close();
  const Outcome a = exported(file.fileName(), format, at("bright.seg.nrrd"));
  QCOMPARE(a.status, 1);
  QVERIFY2(a.err.contains("is there already"), a.err);
  QCOMPARE(contentsOf(file.fileName()), QByteArray("mine"));
}

void TestExportSegments::wrongWordsAreUsage_data() {
  QTest::addColumn<QStringList>("options");
  QTest::addColumn<int>("status");
  QTest::addColumn<QByteArray>("says");
  const QString as = QStringLiteral("--as"), segments = QStringLiteral("--segments");
  QTest::newRow("no segments") << QStringList{as, QStringLiteral("rtstruct")} << 2
                               << QByteArray("needs --segments FILE");
  QTest::newRow("of another format") << QStringList{as,
                                                    QStringLiteral("ko"),
                                                    QStringLiteral("--images"),
                                                    QStringLiteral("1.2"),
                                                    segments,
                                                    at("x")}
                                     << 2 << QByteArray("--segments does not go with --as ko");
  QTest::newRow("a file that is not there")
      << QStringList{as, QStringLiteral("rtstruct"), segments, at("none.seg.nrrd")} << 1
      << QByteArray("none.seg.nrrd");
  QTest::newRow("a surface that is named as DICOM")
      << QStringList{as, QStringLiteral("stl"), segments, at("bright.seg.nrrd")} << 1
      << QByteArray("ends in .stl");
}

void TestExportSegments::wrongWordsAreUsage() {
  QFETCH(QStringList, options);
  QFETCH(QByteArray, says);
  const Outcome a = exported(at("wrong.dcm"), options);
  QTEST(a.status, "status");
  QVERIFY2(a.err.contains(says), a.err);
  QVERIFY(!QFile::exists(at("wrong.dcm")));
}

VOLUMEN_TEST(TestExportSegments);
#include "tst_export_segments.moc"
