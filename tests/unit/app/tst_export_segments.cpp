// Guards export.md: `volumen export --as rtstruct` writes segments that `volumen measure` reads back with the
// same volumes.
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>

#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestExportSegments : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void volumesComeBack();
  void whatIsThereStays();
  void wrongWordsAreUsage_data();
  void wrongWordsAreUsage();

 private:
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  Outcome exported(const QStringList& options) const {
    return runProgram(QStringList{QStringLiteral("export"), source_, QStringLiteral("-o"), at("rt.dcm")} +
                      options);
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
};

void TestExportSegments::initTestCase() {
  const std::string data = dataPath("mr-head-ge-mprage-130");
  NEED_DATA(data);
  source_ = QString::fromStdString(data);
  const Outcome a = runProgram({QStringLiteral("segment"), source_, QStringLiteral("--range"),
                                QStringLiteral("300:4000"), QStringLiteral("-o"), at("bright.seg.nrrd")});
  QVERIFY2(a.status == 0, a.err);
}

void TestExportSegments::volumesComeBack() {
  const Outcome a = exported({QStringLiteral("--as"), QStringLiteral("rtstruct"),
                              QStringLiteral("--segments"), at("bright.seg.nrrd")});
  QVERIFY2(a.status == 0, a.err);
  const double ml = millilitres(at("bright.seg.nrrd"));
  QVERIFY(ml > 1);
  QVERIFY2(qAbs(millilitres(at("rt.dcm")) - ml) < 0.01 * ml, a.err);
}

void TestExportSegments::whatIsThereStays() {
  const QByteArray before = contentsOf(at("rt.dcm"));
  QVERIFY(!before.isEmpty());
  const Outcome a = exported({QStringLiteral("--as"), QStringLiteral("rtstruct"),
                              QStringLiteral("--segments"), at("bright.seg.nrrd")});
  QCOMPARE(a.status, 1);
  QVERIFY2(a.err.contains("is there already"), a.err);
  QCOMPARE(contentsOf(at("rt.dcm")), before);
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
}

void TestExportSegments::wrongWordsAreUsage() {
  QFETCH(QStringList, options);
  QFETCH(QByteArray, says);
  const Outcome a = exported(options);
  QTEST(a.status, "status");
  QVERIFY2(a.err.contains(says), a.err);
}

VOLUMEN_TEST(TestExportSegments);
#include "tst_export_segments.moc"
