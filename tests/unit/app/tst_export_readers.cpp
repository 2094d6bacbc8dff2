// Guards export.md: other programs read what `volumen export` writes. The code of OHIF (npm packages dcmjs
// and @cornerstonejs/adapters) reads the numbers of `volumen measure` and the voxels of segments.
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <cmath>

#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestExportReaders : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void measurementsComeBackToLife();
  void segmentsHaveTheirVoxels();

 private:
  QString at(const char* name) const { return folder_.filePath(QLatin1String(name)); }
  // Returns the content that the reader finds in a file.
  QJsonObject readBy(const QStringList& arguments) const;

  QTemporaryDir folder_;
  const QString npm_ = qEnvironmentVariable("VOLUMEN_NPM");
  QString source_;
};

void TestExportReaders::initTestCase() {
  if (npm_.isEmpty())
    QSKIP("VOLUMEN_NPM names no folder with the packages of npm that read reports (tests/README.md)");
  const std::string data = dataPath("ct-chest-lidc0314-138");
  NEED_DATA(data);
  source_ = QString::fromStdString(data);
  const QString script = npm_ + QStringLiteral("/readers.mjs");
  QFile::remove(script);
  QVERIFY(QFile::copy(QStringLiteral(VOLUMEN_SOURCE_DIR "/tests/interop/readers.mjs"), script));
}

QJsonObject TestExportReaders::readBy(const QStringList& arguments) const {
  QProcess node;
  node.setWorkingDirectory(npm_);
  node.start(QStringLiteral("node"), QStringList{QStringLiteral("readers.mjs")} + arguments);
  if (!node.waitForFinished(300000)) return {};
  return QJsonDocument::fromJson(node.readAllStandardOutput()).object();
}

void TestExportReaders::measurementsComeBackToLife() {
  QFile shapes(at("shapes.json"));
  QVERIFY(shapes.open(QIODevice::WriteOnly));
  shapes.write(R"([{"kind": "length", "points": [[-20, 100, -599.8], [15, 130, -599.8]]},
    {"kind": "ellipse", "points": [[0, 100, -599.8], [40, 160, -599.8]],
     "plane": {"centre": [0, 0, -599.8], "right": [1, 0, 0], "down": [0, 1, 0]}},
    {"kind": "angle", "points": [[0, 100, -599.8], [40, 160, -599.8], [80, 100, -599.8]]},
    {"kind": "probe", "points": [[0, 100, -599.8]]}])");
  shapes.close();
  const QStringList what = {source_, QStringLiteral("--roi"), shapes.fileName()};
  const Outcome measured = runProgram(QStringList{QStringLiteral("measure")} + what);
  const Outcome written = runProgram(
      QStringList{QStringLiteral("export")} + what +
      QStringList{QStringLiteral("--as"), QStringLiteral("sr"), QStringLiteral("-o"), at("sr.dcm")});
  QVERIFY2(written.status == measured.status, written.err);
  const auto known = QJsonDocument::fromJson(measured.out)[QStringLiteral("measurements")];
  const QJsonObject read = readBy({QStringLiteral("sr"), at("sr.dcm")});
  const auto differs = [&](const char* tool, const char* stat, int shape, const char* number) {
    const double value =
        read[QLatin1String(tool)][0][QStringLiteral("stats")][QLatin1String(stat)].toDouble(HUGE_VAL);
    return qAbs(value - known[shape][QLatin1String(number)].toDouble()) / qAbs(value);
  };
  constexpr double digits = 1e-13;  // the precision of a decimal string
  QVERIFY(differs("Length", "length", 0, "number") < digits);
  QVERIFY(differs("EllipticalROI", "area", 1, "number") < digits);
  QVERIFY(differs("EllipticalROI", "mean", 1, "mean") < digits);
  QVERIFY(differs("Angle", "angle", 2, "number") < digits);
  QVERIFY(differs("Probe", "value", 3, "number") < digits);
  // The reader counts in pixels of 0.78125 mm. The centre of the first pixel is at -201, -59 mm.
  const QJsonArray end = read[QStringLiteral("Length")][0][QStringLiteral("points")][0].toArray();
  QVERIFY(qAbs(end[0].toDouble() - (-20 + 201) / 0.78125) < 1e-3);
  QVERIFY(qAbs(end[1].toDouble() - (100 + 59) / 0.78125) < 1e-3);
}

void TestExportReaders::segmentsHaveTheirVoxels() {
  const Outcome made = runProgram({QStringLiteral("segment"), source_, QStringLiteral("--range"),
                                   QStringLiteral("300:3000"), QStringLiteral("-o"), at("bone.dcm")});
  QVERIFY2(made.status == 0 || made.status == 3, made.err);
  const Outcome measured =
      runProgram({QStringLiteral("measure"), source_, QStringLiteral("--segments"), at("bone.dcm")});
  const double voxels =
      QJsonDocument::fromJson(measured.out)[QStringLiteral("segments")][0][QStringLiteral("voxels")]
          .toDouble();
  QVERIFY(voxels > 1000);
  const QJsonObject read = readBy({QStringLiteral("seg"), at("bone.dcm"), source_});
  QCOMPARE(read[QStringLiteral("voxels")].toObject(), (QJsonObject{{QStringLiteral("1"), voxels}}));
}

VOLUMEN_TEST(TestExportReaders);
#include "tst_export_readers.moc"
