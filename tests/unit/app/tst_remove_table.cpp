// Guards design.md 4: `render` and `segment --remove-table`, and the sample study from the cache.
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>

#include "io/files/write_volume.h"
#include "tests/fixtures/ct_with_table.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestRemoveTable : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void thePictureIsThatOfThePatientAlone();
  void thePictureSaysSo();
  void segmentsAreOfThePatientAlone();
  void otherValuesAreRefused_data();
  void otherValuesAreRefused();
  void theChestLosesItsTable();
  void theSampleStudyIsKept();
};

namespace {

struct Files {
  QTemporaryDir dir;
  QString with = dir.filePath(QStringLiteral("with.nrrd")),
          alone = dir.filePath(QStringLiteral("alone.nrrd")), out = dir.filePath(QStringLiteral("a.nrrd"));

  Files() {
    for (const auto& [path, table] : {std::pair(with, true), std::pair(alone, false)})
      if (!writeVolume(*CtWithTable::volume(table), path.toStdString())) qFatal("cannot write");
  }
};

QByteArray picture(const QString& volume, const QString& out, const char* more = "") {
  const Outcome done =
      runProgram(QStringLiteral("render %1 -o %2 --preset CT-Muscle --view posterior --size 60x60 %3")
                     .arg(volume, out, QLatin1String(more)));
  return done.status == 0 ? contentsOf(out) : done.err;
}

}  // namespace

void TestRemoveTable::thePictureIsThatOfThePatientAlone() {
  const Files f;
  const QByteArray with = picture(f.with, f.out), alone = picture(f.alone, f.out);
  QVERIFY(with != alone);
  QVERIFY2(picture(f.with, f.out, "--remove-table") == alone, "the same bytes as of a file without a table");
}

void TestRemoveTable::thePictureSaysSo() {
  const Files f;
  const QString png = f.dir.filePath(QStringLiteral("a.png"));
  const Outcome done =
      runProgram(QStringLiteral("render %1 -o %2 --size 20x20 --remove-table --explain").arg(f.with, png));
  QCOMPARE(done.status, 0);
  QVERIFY(done.out.contains("on   cut: table removed; "));
  QVERIFY(contentsOf(png).contains("volumen-cut"));
  QVERIFY(!runProgram(QStringLiteral("render %1 --explain").arg(f.with)).out.contains("table removed"));
}

void TestRemoveTable::segmentsAreOfThePatientAlone() {
  const Files f;
  const auto voxels = [&](const char* more, const char* range = "390:410") {
    const QString out = f.dir.filePath(QStringLiteral("a.seg.nrrd"));
    const Outcome done = runProgram(QStringLiteral("segment %1 --range=%2 --json -o %3 %4")
                                        .arg(f.with, QLatin1String(range), out, QLatin1String(more)));
    return QJsonDocument::fromJson(done.out)[QStringLiteral("segments")]
        .toArray()[0][QStringLiteral("voxels")]
        .toInt(-1);
  };
  QCOMPARE(voxels(""), CtWithTable::size.x * 3 * CtWithTable::size.z);
  QCOMPARE(voxels("--remove-table"), 0);
  // Removed voxels are shown as air but do not count as air.
  QVERIFY(voxels("--remove-table", "-1100:-900") < voxels("", "-1100:-900"));
}

void TestRemoveTable::otherValuesAreRefused_data() {
  QTest::addColumn<QString>("command");
  QTest::newRow("render") << QStringLiteral("render phantom:sphere:16 --remove-table -o %1/a.png");
  QTest::newRow("segment") << QStringLiteral(
      "segment phantom:sphere:16 --range 1:2 --remove-table -o %1/a.seg.nrrd");
}

void TestRemoveTable::otherValuesAreRefused() {
  QFETCH(QString, command);
  const QTemporaryDir dir;
  const Outcome done = runProgram(command.arg(dir.path()));
  QCOMPARE(done.status, 1);
  QVERIFY2(done.err.contains("not Hounsfield units"), done.err.constData());
  QVERIFY(QDir(dir.path()).isEmpty());
}

// Removes the table of a real chest, whose shell has some hundred HU. Compact bone remains.
void TestRemoveTable::theChestLosesItsTable() {
  const std::string chest = dataPath("ct-chest-lidc0314-138");
  NEED_DATA(chest);
  const QTemporaryDir dir;
  const auto voxels = [&](const char* range, const char* more) {
    const Outcome done = runProgram(
        QStringLiteral("segment %1 --range %2 --json -o %3/a.seg.nrrd %4")
            .arg(QString::fromStdString(chest), QLatin1String(range), dir.path(), QLatin1String(more)));
    return QJsonDocument::fromJson(done.out)[QStringLiteral("segments")]
        .toArray()[0][QStringLiteral("voxels")]
        .toDouble();
  };
  const double before = voxels("-300:", ""), after = voxels("-300:", "--remove-table");
  QVERIFY2(after < 0.97 * before && after > 0.8 * before, qPrintable(QString::number(after / before)));
  const double bone = voxels("1000:", ""), boneAfter = voxels("1000:", "--remove-table");
  QVERIFY2(boneAfter > 0.99 * bone, qPrintable(QString::number(boneAfter / bone)));
}

void TestRemoveTable::theSampleStudyIsKept() {
  const QTemporaryDir cache;
  const QByteArray before = qgetenv("XDG_CACHE_HOME");
  qputenv("XDG_CACHE_HOME", cache.path().toLocal8Bit());
  const QString command =
      QStringLiteral("segment phantom:ct-head --range 300: -o %1/a.seg.nrrd").arg(cache.path());
  const Outcome made = runProgram(command);
  const QByteArray labels = contentsOf(cache.filePath(QStringLiteral("a.seg.nrrd")));
  const QString kept = cache.filePath(QStringLiteral("volumen/ct-head.values"));
  QVERIFY2(QFile::exists(kept), made.err.constData());
  const Outcome read = runProgram(command);
  QCOMPARE(read.status, 0);
  QCOMPARE(read.out, made.out);
  QVERIFY(contentsOf(cache.filePath(QStringLiteral("a.seg.nrrd"))) == labels);
  qputenv("XDG_CACHE_HOME", before);
  if (before.isEmpty()) qunsetenv("XDG_CACHE_HOME");
}

VOLUMEN_TEST(TestRemoveTable);
#include "tst_remove_table.moc"
