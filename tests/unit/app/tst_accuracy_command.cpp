// Guards design.md 4 and 6: `accuracy` writes CSV, JSON and pictures of the study without a display.
#include <QDir>
#include <QFile>
#include <QImage>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestAccuracyCommand : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void writesTheStudy();
  void wrongUsageIsRefused_data();
  void wrongUsageIsRefused();
  void failureIsASentence_data();
  void failureIsASentence();
  void noiseIsEstimatedWithinThePromise();
};

namespace {

Outcome runAccuracy(const QString& line) { return runProgram(QStringLiteral("accuracy ") + line); }

}  // namespace

void TestAccuracyCommand::writesTheStudy() {
  const QTemporaryDir parent;
  const QString folder = parent.filePath(QStringLiteral("new/study"));
  const Outcome done =
      runAccuracy(QStringLiteral("phantom:ct-head:32 --size 40x30 --frames 1 --pixels 300 --knob "
                                 "level --knob \"map, nearest\" -o %1")
                      .arg(folder));
  QCOMPARE(done.status, 0);
  QVERIFY2(done.err.isEmpty(), done.err);
  const QDir written(folder);
  QCOMPARE(done.out.count('\n'), 5);
  QCOMPARE(written.entryList(QDir::Files).size(), 5);
  const QJsonObject all =
      QJsonDocument::fromJson(contentsOf(written.filePath(QStringLiteral("study.json")))).object();
  const QJsonArray rows = all[QStringLiteral("rows")].toArray();
  QCOMPARE(rows.size(), 1 + 4 + 3);  // the base, the levels, three sizes of the map
  QCOMPARE(contentsOf(written.filePath(QStringLiteral("study.csv"))).count('\n'), rows.size() + 1);
  QVERIFY(all[QStringLiteral("reference")].toObject()[QStringLiteral("text")].toString().startsWith(
      QStringLiteral("300 of 1200 pixels, one of each cell of a 20 x 15 grid")));
  // Level exact has a smaller error than draft.
  QCOMPARE(rows[1].toObject()[QStringLiteral("value")].toString(), QStringLiteral("draft"));
  QVERIFY(rows[4].toObject()[QStringLiteral("rmse")].toDouble() <
          rows[1].toObject()[QStringLiteral("rmse")].toDouble());
  for (const char* name : {"error-time.png", "knobs.png", "differences.png"}) {
    const QImage picture(written.filePath(QString::fromLatin1(name)));
    QVERIFY2(picture.width() > 600 && picture.height() > 200, name);
    // The picture is not all white.
    int coloured = 0;
    for (int y = 0; y < picture.height(); y += 2)
      for (int x = 0; x < picture.width(); x += 2) coloured += qGray(picture.pixel(x, y)) < 200;
    QVERIFY2(coloured > 500, name);
  }
}

void TestAccuracyCommand::wrongUsageIsRefused_data() {
  QTest::addColumn<QString>("line");
  for (const char* line :
       {"phantom:sphere:16", "-o /tmp/x", "phantom:sphere:16 -o /tmp/x --knob zoom",
        "phantom:sphere:16 -o /tmp/x --frames 0", "phantom:sphere:16 -o /tmp/x --pixels 0",
        "phantom:sphere:16 -o /tmp/x --step 1", "phantom:sphere:16 -o /tmp/x --size 40000x2",
        "phantom:sphere:16 -o /tmp/x --size 0x3"})
    QTest::newRow(line) << QString::fromLatin1(line);
}

void TestAccuracyCommand::wrongUsageIsRefused() {
  QFETCH(QString, line);
  const Outcome done = runAccuracy(line);
  QCOMPARE(done.status, 2);
  QVERIFY(!done.err.isEmpty() && done.out.isEmpty());
}

void TestAccuracyCommand::failureIsASentence_data() {
  QTest::addColumn<QString>("line");
  QTest::addColumn<QString>("named");
  QTest::newRow("no such volume") << "/no/such/volume.nrrd -o %1"
                                  << "/no/such/volume.nrrd";
  QTest::newRow("no such folder can be made") << "phantom:sphere:16 -o /proc/nowhere"
                                              << "/proc/nowhere";
  QTest::newRow("no such scene") << "phantom:sphere:16 --scene /no/scene.json -o %1"
                                 << "/no/scene.json";
}

void TestAccuracyCommand::failureIsASentence() {
  QFETCH(QString, line);
  QFETCH(QString, named);
  const QTemporaryDir folder;
  const Outcome done = runAccuracy(line.contains(QLatin1String("%1")) ? line.arg(folder.path()) : line);
  QCOMPARE(done.status, 1);
  QVERIFY2(done.err.contains(named.toUtf8()), done.err);
  QVERIFY(QDir(folder.path()).entryList(QDir::Files).isEmpty());
}

// Rays through noise pass through hundreds of faint parts, whose errors add up to 34 dB.
void TestAccuracyCommand::noiseIsEstimatedWithinThePromise() {
  const QTemporaryDir folder;
  const auto at = [&](const char* name) { return folder.filePath(QString::fromLatin1(name)); };
  QFile noise(at("noise.nrrd"));
  QVERIFY(noise.open(QIODevice::WriteOnly));
  noise.write(
      "NRRD0004\ntype: short\ndimension: 3\nsizes: 48 48 48\nendian: little\nencoding: raw\n"
      "space: left-posterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n\n");
  Chance chance(5);
  std::vector<qint16> values(48 * 48 * 48);
  for (qint16& value : values) value = qint16(chance.below(900) - 700);
  noise.write(reinterpret_cast<const char*>(values.data()), qint64(2 * values.size()));
  noise.close();
  QFile scene(at("skin-and-bone.json"));
  QVERIFY(scene.open(QIODevice::WriteOnly));
  scene.write(
      R"({"volumenScene": 1, "transferFunction": {"unitDistance": 0.78, "points": [
          {"value": -700, "colour": [1, 1, 1], "opacity": 0}, {"value": -500, "colour": [1, 1, 1], "opacity": 0.06},
          {"value": -150, "colour": [1, 1, 1], "opacity": 0.06}, {"value": -50, "colour": [1, 1, 1], "opacity": 0},
          {"value": 150, "colour": [1, 1, 1], "opacity": 0}, {"value": 300, "colour": [1, 1, 1], "opacity": 0.7}]}, "shading": {"lit": true}})");
  scene.close();
  const Outcome a =
      runProgram(QStringLiteral("render %1 --scene %2 --size 48x48 --stats %3 -o %4")
                     .arg(noise.fileName(), scene.fileName(), at("noise.json"), at("noise.png")));
  QVERIFY2(a.status == 0, a.err);
  const QJsonObject stats = QJsonDocument::fromJson(contentsOf(at("noise.json"))).object();
  const QJsonValue error = stats[QStringLiteral("error")];
  QVERIFY2(error[QLatin1String("psnrDb")].toDouble() == 42, contentsOf(at("noise.json")));
  QVERIFY(error[QLatin1String("percentile99")].toDouble() <= 8);
}

VOLUMEN_TEST(TestAccuracyCommand);
#include "tst_accuracy_command.moc"
