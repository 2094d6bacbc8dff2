// Guards design.md 4 and 7: exit statuses, sentences and files of the command line as users and scripts meet
// it.
#include <QFile>
#include <QImage>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QRegularExpression>
#include <QTemporaryDir>

#include "io/worker/sandbox.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestCommands : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void wrongUsageIsASentenceAndStatus2_data();
  void wrongUsageIsASentenceAndStatus2();
  void whatFailsIsASentenceAndStatus1_data();
  void whatFailsIsASentenceAndStatus1();
  void tooLittleMemoryIsASentence_data();
  void tooLittleMemoryIsASentence();
  void everyCommandHasHelp_data();
  void everyCommandHasHelp();
  void renderWritesAPictureThatSaysHowItWasMade();
  void statsHoldTheStages();
  void aPictureSaysHowFarItMayBeOff_data();
  void aPictureSaysHowFarItMayBeOff();
  void aLargePictureSaysWhatAPilotFound();
  void theSceneInUseDrawsTheSamePicture();
  void sameBytes_data();
  void sameBytes();
  void turntableWritesOnePictureAView();
  void infoIsOneJsonObject();
  void infoHasFactorsToSuv();
  void convertKeepsValuesAndGeometry();
  void controlCharactersDoNotReachTheTerminal();

 private:
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  QTemporaryDir folder_;
};

void TestCommands::wrongUsageIsASentenceAndStatus2_data() {
  QTest::addColumn<QString>("line");
  for (const char* line : {"draw",
                           "render",
                           "render phantom:sphere",
                           "render phantom:sphere -o a.jpg",
                           "render phantom:sphere -o a.png --size 12",
                           "render phantom:sphere -o a.png --size 0x5",
                           "render phantom:sphere -o a.png --step 1 --quality high",
                           "render phantom:sphere -o a.png --reference --step 1",
                           "render phantom:sphere -o a.png --method reference --quality high",
                           "render phantom:sphere -o a.png --precision 12",
                           "render phantom:sphere -o a.png --precision 8 --resampler gl",
                           "render phantom:sphere -o a.png --precision 8 --reference",
                           "render phantom:sphere -o a.png --method gpu --resampler cpu",
                           "render phantom:sphere -o a.png --method preshaded --mode mip",
                           "render phantom:sphere -o a.png --blending 8",
                           "render phantom:sphere -o a.png --method blend --blending 8 --mode average",
                           "render phantom:sphere -o a.png --shader phong --map-lookup nearest",
                           "render phantom:sphere -o a.png --step 0",
                           "render phantom:sphere -o a.png --stop-at 2",
                           "render phantom:sphere -o a.png --tolerance 0",
                           "render phantom:sphere -o a.png --tolerance 0.1 --step 1",
                           "render phantom:sphere -o a.png --gradient roberts",
                           "render phantom:sphere -o a.png --curve-table 1",
                           "render phantom:sphere -o a.png --reference --stop-at 0",
                           "render phantom:sphere -o a.png --no-such-option",
                           "render phantom:sphere -o a.png --view above",
                           "render phantom:sphere -o a.png --preset a --scene b",
                           "render phantom:sphere -o a.png --preset CT-Bonez",
                           "info",
                           "convert phantom:sphere -o a.xyz"})
    QTest::newRow(line) << QString::fromLatin1(line);
}

void TestCommands::wrongUsageIsASentenceAndStatus2() {
  QFETCH(QString, line);
  const Outcome a = runProgram(line);
  QCOMPARE(a.status, 2);
  QVERIFY(!a.err.isEmpty());
  QVERIFY(a.out.isEmpty());
}

void TestCommands::whatFailsIsASentenceAndStatus1_data() {
  QTest::addColumn<QString>("line");
  QTest::addColumn<QString>("named");
  const auto row = [](const char* line, const char* named) {
    QTest::newRow(line) << QString::fromLatin1(line) << QString::fromLatin1(named);
  };
  row("render /no/such/folder -o a.png", "/no/such/folder");
  row("render phantom:unicorn -o a.png", "unicorn");
  row("render phantom:sphere:16 --scene /no/scene.json -o a.png", "/no/scene.json");
  row("render phantom:sphere:16 -o /no/such/folder/a.png", "/no/such/folder");
  row("render phantom:sphere:16 --series 7 -o a.png", "7");
  row("info /etc/os-release", "os-release");
}

void TestCommands::whatFailsIsASentenceAndStatus1() {
  QFETCH(QString, line);
  QFETCH(QString, named);
  const Outcome a = runProgram(line);
  QCOMPARE(a.status, 1);
  QVERIFY2(a.err.startsWith("volumen: ") || a.out.contains(named.toUtf8()), a.err);
  QVERIFY2((a.err + a.out).contains(named.toUtf8()), a.err);
}

// Method preshaded needs 16 bytes for each of 46 million voxels.
void TestCommands::tooLittleMemoryIsASentence_data() {
  QTest::addColumn<quint64>("limit");
  QTest::addColumn<int>("status");
  QTest::addColumn<QByteArray>("says");
  QTest::newRow("a reduced copy is drawn")
      << quint64(650'000'000) << 0 << QByteArray("Drawn from a reduced copy");
  QTest::newRow("nothing is drawn") << quint64(300'000'000) << 1 << QByteArray("ct-head:384: ");
}

void TestCommands::tooLittleMemoryIsASentence() {
  QFETCH(quint64, limit);
  QFETCH(int, status);
  QFETCH(QByteArray, says);
  if (volumen::worker::sanitized) QSKIP("sanitizers reserve more than any limit");
  const QString png = at("none.png");
  const auto line =
      QStringLiteral("render phantom:ct-head:384 --method preshaded --size 16x16 --threads 2 -o %1");
  const Outcome a = runProgram(QProcess::splitCommand(line.arg(png)), limit);
  QVERIFY2(a.status == status, a.err);
  QVERIFY2(a.err.contains(says) && a.err.contains(" MiB of memory, and "), a.err);
  QCOMPARE(QFile::exists(png), status == 0);
  QFile::remove(png);
}

void TestCommands::everyCommandHasHelp_data() {
  QTest::addColumn<QString>("line");
  for (const char* line : {"--help", "render --help", "info --help", "convert --help", "open --help",
                           "segment --help", "slice --help", "bench --help", "accuracy --help"})
    QTest::newRow(line) << QString::fromLatin1(line);
}

void TestCommands::everyCommandHasHelp() {
  QFETCH(QString, line);
  const Outcome a = runProgram(line);
  QCOMPARE(a.status, 0);
  QVERIFY(a.out.contains("Usage"));
}

void TestCommands::renderWritesAPictureThatSaysHowItWasMade() {
  const QString png = at("a.png");
  const Outcome a = runProgram(QStringLiteral("render phantom:ct-head:48 --size 64x48 -o %1").arg(png));
  QCOMPARE(a.status, 0);
  QCOMPARE(a.out.trimmed(), png.toUtf8());
  const QImage image(png);
  QCOMPARE(image.size(), QSize(64, 48));
  QCOMPARE(image.text(QStringLiteral("volumen-level")), QStringLiteral("standard"));
  QVERIFY(image.text(QStringLiteral("volumen-scene")).contains(QStringLiteral("transferFunction")));
  // The head is in the middle on black.
  QVERIFY(qGray(image.pixel(32, 24)) > 20);
  QCOMPARE(qGray(image.pixel(0, 0)), 0);
}

void TestCommands::statsHoldTheStages() {
  const QString stats = at("stats.json");
  QCOMPARE(
      runProgram(QStringLiteral("render phantom:ct-head:48 --size 64x64 --frames 3 --stats %1").arg(stats))
          .status,
      0);
  const QJsonObject all = QJsonDocument::fromJson(contentsOf(stats)).object();
  const QJsonObject stages = all[QStringLiteral("stagesMs")].toObject();
  for (const char* stage : {"load", "gradients", "plan", "resample", "shade", "gl", "total"})
    QVERIFY2(stages.contains(QLatin1String(stage)), stage);
  QCOMPARE(all[QStringLiteral("framesMs")].toArray().size(), 3);
  QVERIFY(all[QStringLiteral("samples")].toObject()[QStringLiteral("composited")].toInt() > 0);
  QVERIFY(all[QStringLiteral("plan")].toArray().size() > 5);
}

void TestCommands::aPictureSaysHowFarItMayBeOff_data() {
  QTest::addColumn<QString>("options");
  QTest::addColumn<QString>("text");     // text of the PNG, a regular expression
  QTest::addColumn<QString>("unknown");  // sentence if there is no estimate
  const auto row = [](const char* name, const char* options, const char* text, const char* unknown) {
    QTest::newRow(name) << QString::fromLatin1(options) << QString::fromLatin1(text)
                        << QString::fromLatin1(unknown);
  };
  const char* numbers = "at most [0-9.]+/255, 99th percentile [0-9.]+/255, PSNR at least [0-9]+ dB";
  row("standard", "", numbers, "");
  row("exact", "--quality exact", "at most (1|0.[0-9]+)/255, 99th percentile 0.[0-9]+/255, .*", "");
  row("a draft", "--quality draft", "",
      "The picture was sampled at fixed steps, which do not tell how far off each pixel is.");
  const QString withMap = QStringLiteral("--quality draft --error-map ") + at("draft-error.nrrd");
  row("a draft whose error map is asked for", qPrintable(withMap), numbers, "");
  row("what it does not hold", "--gradient central",
      "at most [^;]*; without that of another gradient operator", "");
  row("a projection", "--mode mip", "none but the rounding of floats", "");
  row("plain steps", "--step 1", "",
      "The picture was sampled at fixed steps, which do not tell how far off each pixel is.");
  row("the reference", "--reference", "", "The reference is within 0.05/255 of the limit by itself.");
}

void TestCommands::aPictureSaysHowFarItMayBeOff() {
  QFETCH(QString, options);
  QFETCH(QString, text);
  QFETCH(QString, unknown);
  const QString png = at("estimate.png"), stats = at("estimate.json");
  const QString line = QStringLiteral("render phantom:ct-head:32 --size 24x24 %1 --stats %2 -o %3");
  const Outcome a = runProgram(line.arg(options, stats, png));
  QVERIFY2(a.status == 0, a.err);
  const QString said = QImage(png).text(QStringLiteral("volumen-error-estimated"));
  QVERIFY2(QRegularExpression(QRegularExpression::anchoredPattern(text)).match(said).hasMatch(),
           qPrintable(said));
  const QJsonObject all = QJsonDocument::fromJson(contentsOf(stats)).object();
  QCOMPARE(all[QStringLiteral("errorUnknown")].toString(), unknown);
  const QJsonValue error = all[QStringLiteral("error")];
  QCOMPARE(error.isNull(), !unknown.isEmpty());
  if (error.isNull()) return;
  const auto number = [&](const char* key) { return error[QLatin1String(key)].toDouble(-1); };
  QVERIFY(number("percentile99") >= 0 && number("percentile99") <= number("maximum"));
  // An error of 0 has no PSNR.
  QCOMPARE(error[QStringLiteral("psnrDb")].isNull(), number("maximum") == 0);
}

void TestCommands::aLargePictureSaysWhatAPilotFound() {
  const QString common = QStringLiteral("render phantom:ct-head:48 --preset CT-X-ray --size ");
  const Outcome explained = runProgram(common + QStringLiteral("400x400 --explain"));
  const QRegularExpression stepsAndErrors(
      QStringLiteral("^on +integration: .*\\b0\\.8\\d* voxel\\b.*\\d rays\\b.*\\d dB\\b.*\\d/255\\b"),
      QRegularExpression::MultilineOption);
  QVERIFY2(QString::fromUtf8(explained.out).contains(stepsAndErrors), explained.out);
  const auto drawn = [&](const char* size) {
    const QString line = common + QStringLiteral("%1 --stats %2 -o %3");
    return runProgram(line.arg(QLatin1String(size), at("pilot.json"), at("pilot.png"))).status == 0
               ? QJsonDocument::fromJson(contentsOf(at("pilot.json"))).object()
               : QJsonObject();
  };
  const auto pilotMs = [](const QJsonObject& stats) {
    return stats[QStringLiteral("stagesMs")].toObject()[QStringLiteral("pilot")].toDouble(-1);
  };
  QVERIFY(pilotMs(drawn("400x400")) > 0);
  const QString key = QStringLiteral("volumen-error-pilot");
  QVERIFY(QImage(at("pilot.png"))
              .text(key)
              .contains(QRegularExpression(QStringLiteral("\\d rays\\b.*\\d dB\\b"))));
  QCOMPARE(pilotMs(drawn("300x300")), 0.0);
  QVERIFY(QImage(at("pilot.png")).text(key).isEmpty());
}

void TestCommands::theSceneInUseDrawsTheSamePicture() {
  const Outcome printed = runProgram(
      QStringLiteral("render phantom:ct-head:48 --size 40x40 --view left --print-scene --explain -o %1")
          .arg(at("b.nrrd")));
  QCOMPARE(printed.status, 0);
  QFile scene(at("scene.json"));
  QVERIFY(scene.open(QIODevice::WriteOnly));
  scene.write(printed.out);
  scene.close();
  QCOMPARE(runProgram(QStringLiteral("render phantom:ct-head:48 --size 40x40 --scene %1 -o %2")
                          .arg(at("scene.json"), at("c.nrrd")))
               .status,
           0);
  QVERIFY(!contentsOf(at("b.nrrd")).isEmpty());
  QCOMPARE(contentsOf(at("c.nrrd")), contentsOf(at("b.nrrd")));
}

void TestCommands::sameBytes_data() {
  QTest::addColumn<QString>("options");
  for (const char* o : {"--threads 1", "--threads 2", "--threads 7", "--threads 16", "--full"})
    QTest::newRow(o) << QString::fromLatin1(o);
}

void TestCommands::sameBytes() {
  QFETCH(QString, options);
  const QString common =
      QStringLiteral("render phantom:ct-head:64 --preset CT-AAA --size 90x70 --projection perspective -o ");
  QCOMPARE(runProgram(common + at("d.nrrd")).status, 0);
  QCOMPARE(runProgram(common + at("e.nrrd") + QLatin1Char(' ') + options).status, 0);
  QCOMPARE(contentsOf(at("e.nrrd")), contentsOf(at("d.nrrd")));
}

void TestCommands::turntableWritesOnePictureAView() {
  QCOMPARE(runProgram(
               QStringLiteral("render phantom:ct-head:32 --size 32x32 --turntable 4 -o %1").arg(at("t.png")))
               .status,
           0);
  QSet<QByteArray> different;
  for (int n = 0; n < 4; ++n)
    different.insert(
        contentsOf(folder_.filePath(QStringLiteral("t-%1.png").arg(n, 3, 10, QLatin1Char('0')))));
  QCOMPARE(different.size(), 4);
  QVERIFY(!different.contains(QByteArray()));
}

void TestCommands::infoIsOneJsonObject() {
  const Outcome a = runProgram(QStringLiteral("info phantom:ramp:16 --json --values"));
  QCOMPARE(a.status, 0);
  const QJsonObject v =
      QJsonDocument::fromJson(a.out).object()[QStringLiteral("volumes")].toArray()[0].toObject();
  QCOMPARE(v[QStringLiteral("dims")].toArray(), (QJsonArray{16, 16, 16}));
  QCOMPARE(v[QStringLiteral("min")].toDouble(), 0.0);
  QCOMPARE(v[QStringLiteral("max")].toDouble(), 15.0);
  QCOMPARE(v[QStringLiteral("mean")].toDouble(), 7.5);
  QCOMPARE(v[QStringLiteral("origin")].toArray(), (QJsonArray{-7.5, -7.5, -7.5}));
  QCOMPARE(v[QStringLiteral("crc32Values")].toString().size(), 8);
}

void TestCommands::infoHasFactorsToSuv() {
  const std::string path = dataPath("field-cases/c28-suv-bqml");
  NEED_DATA(path);
  const QString command = QStringLiteral("info %1").arg(QString::fromStdString(path));
  const QJsonObject suv =
      QJsonDocument::fromJson(runProgram(command + QStringLiteral(" --json"))
                                  .out)[QStringLiteral("volumes")][0][QStringLiteral("suv")]
          .toObject();
  QVERIFY(std::abs(suv[QStringLiteral("bodyWeight")].toDouble() * 2000 - 0.584255) < 1e-6);
  QVERIFY(!suv.contains(QStringLiteral("leanBodyMass")));
  QCOMPARE(suv[QStringLiteral("why")].toString(), QStringLiteral("PatientSize (0010,1020) is missing"));
  const QByteArray text = runProgram(command).out;
  QVERIFY2(text.contains("unit Bq/ml, times 0.000292127 SUVbw"), text.constData());
}

void TestCommands::convertKeepsValuesAndGeometry() {
  const auto facts = [](const QString& path) {
    const Outcome a = runProgram(QStringLiteral("info %1 --json --values").arg(path));
    const QJsonObject v =
        QJsonDocument::fromJson(a.out).object()[QStringLiteral("volumes")].toArray()[0].toObject();
    QJsonArray out;
    for (const char* key : {"dims", "spacing", "origin", "farCorner", "min", "max", "crc32Values"})
      out << v[QLatin1String(key)];
    return out;
  };
  const QJsonArray first = facts(QStringLiteral("phantom:ct-head:32"));
  for (const char* name : {"h.nrrd", "h.mha", "h.nii.gz", "dicom/"}) {
    QCOMPARE(runProgram(QStringLiteral("convert phantom:ct-head:32 -o %1").arg(at(name))).status, 0);
    QCOMPARE(facts(at(name)), first);
  }
}

void TestCommands::controlCharactersDoNotReachTheTerminal() {
  QFile bad(folder_.filePath(QStringLiteral("evil\033[31m.nrrd")));
  QVERIFY(bad.open(QIODevice::WriteOnly));
  bad.write("NRRD0004\nnonsense\n\n");
  bad.close();
  const Outcome a = runProgram(QStringLiteral("info \"%1\"").arg(folder_.path()));
  QVERIFY(!a.out.contains('\033') && !a.err.contains('\033'));
}

VOLUMEN_TEST(TestCommands);
#include "tst_commands.moc"
