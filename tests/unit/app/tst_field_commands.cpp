// Guards import.md and slices.md on ../shared/data/field-cases: units beside numbers, padding that is no
// tissue, lengths in tomosynthesis, and a tilt that written files keep.
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <cmath>

#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestFieldCommands : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void measurements_data();
  void measurements();
  void lengthsOnFrames();
  void paddingIsNotSegmented();
  void tiltIsKeptInWhatIsWritten_data();
  void tiltIsKeptInWhatIsWritten();
  void unitsStandBesideValues();

 private:
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  QJsonObject measured(const QString& path, const QByteArray& shape) const {
    QFile file(at("shapes.json"));
    if (!file.open(QIODevice::WriteOnly)) return {};
    file.write("[" + shape + "]");
    file.close();
    const Outcome done =
        runProgram({QStringLiteral("measure"), path, QStringLiteral("--roi"), file.fileName()});
    return QJsonDocument::fromJson(done.out)[QStringLiteral("measurements")][0].toObject();
  }
  QTemporaryDir folder_;
};

namespace {

QString caseAt(const char* name) {
  return QString::fromStdString(dataPath(std::string("field-cases/") + name));
}

}  // namespace

void TestFieldCommands::measurements_data() {
  QTest::addColumn<QString>("folder");
  QTest::addColumn<QByteArray>("shape");
  QTest::addColumn<QByteArray>("numbers");  // JSON; other numbers are not checked
  const auto row = [](const char* name, const char* folder, const char* shape, const char* numbers) {
    QTest::newRow(name) << QString::fromLatin1(folder) << QByteArray(shape) << QByteArray(numbers);
  };
  row("a diffusion coefficient", "c27-adc-unit", R"({"kind": "probe", "points": [[0, 4, 2]]})",
      R"({"number": 0.001281, "unit": "mm2/s"})");
  row("a dose", "c06-dose-absolute-offsets", R"({"kind": "probe", "points": [[12, 23, -35]]})",
      R"({"number": 3, "unit": "Gy"})");
  row("the volume of padding", "c25-padding", R"({"kind": "volume", "range": [null, -300]})",
      R"({"number": 0, "voxels": 0, "drawn": 0})");
  row("a region without padding", "c25-padding",
      R"({"kind": "rectangle", "points": [[-1, -1, 0], [16, 16, 0]],
          "plane": {"centre": [0, 0, 0], "right": [1, 0, 0], "down": [0, 1, 0]}})",
      R"({"voxels": 192, "min": 0, "max": 150, "mean": 63.333333, "valueUnit": "HU"})");
}

void TestFieldCommands::measurements() {
  NEED_DATA(dataPath());
  QFETCH(QString, folder);
  QFETCH(QByteArray, shape);
  QFETCH(QByteArray, numbers);
  const QJsonObject found = measured(caseAt(folder.toLatin1().constData()), shape);
  const QJsonObject expected = QJsonDocument::fromJson(numbers).object();
  QVERIFY(!expected.isEmpty());
  for (auto it = expected.begin(); it != expected.end(); ++it) {
    const QJsonValue value = found[it.key()];
    const bool same = it->isDouble() ? value.isDouble() && std::abs(value.toDouble() - it->toDouble()) < 1e-6
                                     : value == *it;
    QVERIFY2(same, qPrintable(it.key() + QLatin1Char(' ') + value.toVariant().toString()));
  }
}

// Case c03b: frames give the same lengths as the volume and do not mention a detector.
void TestFieldCommands::lengthsOnFrames() {
  NEED_DATA(dataPath());
  const auto study = openStudy(dataPath("field-cases/c03b-tomosynthesis"));
  QVERIFY(study.ok());
  const QByteArray instance = QByteArray::fromStdString(study->volumes.at(0).sopInstanceUids.at(0));
  const QJsonObject found = measured(caseAt("c03b-tomosynthesis"),
                                     R"({"kind": "length", "points": [[0, 0], [8, 0]],
      "frame": {"instance": ")" + instance +
                                         R"(", "number": 2}})");
  QVERIFY(std::abs(found[QStringLiteral("number")].toDouble() - 0.8) < 1e-9);
  QCOMPARE(found[QStringLiteral("unit")].toString(), QStringLiteral("mm"));
  QVERIFY(!found.contains(QStringLiteral("calibration")) ||
          found[QStringLiteral("calibration")].toString().isEmpty());
}

void TestFieldCommands::paddingIsNotSegmented() {
  NEED_DATA(dataPath());
  const Outcome done = runProgram({QStringLiteral("segment"), caseAt("c25-padding"), QStringLiteral("--json"),
                                   QStringLiteral("--range"), QStringLiteral(":-300"), QStringLiteral("-o"),
                                   at("air.seg.nrrd")});
  QCOMPARE(done.status, 0);
  const QJsonObject json = QJsonDocument::fromJson(done.out).object();
  const QJsonValue air = json[QStringLiteral("segments")].toArray()[0];
  QCOMPARE(air[QStringLiteral("voxels")].toInt(-1), 0);
  QCOMPARE(air[QStringLiteral("millilitres")].toDouble(-1), 0.0);
  QCOMPARE(json[QStringLiteral("unit")].toString(), QStringLiteral("HU"));
}

void TestFieldCommands::tiltIsKeptInWhatIsWritten_data() {
  QTest::addColumn<QString>("command");
  QTest::addColumn<bool>("kept");
  QTest::newRow("convert") << QStringLiteral("convert %1 -o %2/a.nrrd") << true;
  QTest::newRow("convert to DICOM") << QStringLiteral("convert %1 -o %2/copy/") << true;
  QTest::newRow("segment") << QStringLiteral("segment %1 --range 0: -o %2/a.seg.nrrd") << true;
  QTest::newRow("a view") << QStringLiteral("slice %1 -o %2/a.png") << false;
  QTest::newRow("info") << QStringLiteral("info %1") << false;
}

void TestFieldCommands::tiltIsKeptInWhatIsWritten() {
  NEED_DATA(dataPath());
  QFETCH(QString, command);
  QFETCH(bool, kept);
  command.replace(QStringLiteral("%1"), caseAt("c42-tilt-written"));
  const Outcome done = runProgram(command.replace(QStringLiteral("%2"), folder_.path()));
  QVERIFY2(done.status == 0, done.err);
  const QByteArray said = done.out + done.err;
  QCOMPARE(said.count("Gantry tilt of 18.0 degrees, kept in the file."), kept ? 1 : 0);
  QCOMPARE(said.count("Gantry tilt of 18.0 degrees, corrected in 3D."), kept ? 0 : 1);
}

void TestFieldCommands::unitsStandBesideValues() {
  NEED_DATA(dataPath());
  const Outcome done =
      runProgram({QStringLiteral("info"), caseAt("c27-adc-unit"), QStringLiteral("--values")});
  QVERIFY2(done.out.contains("values 0 to 0.002522 mm2/s"), done.out);
}

VOLUMEN_TEST(TestFieldCommands);
#include "tst_field_commands.moc"
