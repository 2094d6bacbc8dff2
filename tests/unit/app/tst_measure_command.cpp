// Guards slices.md 4 and 5: `volumen measure` prints the numbers of every shape as JSON and names shapes that
// it refuses. resources/docs/measure.md lists every kind and field.
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <cmath>

#include "tests/fixtures/fixtures.h"
#include "tests/unit/app/measure_case.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestMeasureCommand : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void numbersOfEveryKind_data();
  void numbersOfEveryKind();
  void shapesKeepTheirOrderAndNames();
  void unitsAreTheStudys();
  void petIsSuv_data();
  void petIsSuv();
  void anSuvThatCannotBeHadIsRefused();
  void whyThereIsNoSuvIsTold();
  void drawnVolumeOfBone();
  void refused_data();
  void refused();
  void documentHasEveryKindAndField();
};

namespace {

// The value is i on 16 x 16 x 16 voxels of 1 mm. x in mm is i - 7.5.
const QString ramp = QStringLiteral("phantom:ramp:16");

constexpr const char* onZero = R"("plane": {"centre": [0, 0, 0.5], "right": [1, 0, 0], "down": [0, 1, 0]}})";

}  // namespace

void TestMeasureCommand::numbersOfEveryKind_data() {
  QTest::addColumn<QByteArray>("shape");
  QTest::addColumn<QByteArray>("numbers");  // JSON; other numbers are not checked
  const auto row = [](const char* name, const QByteArray& shape, const char* numbers) {
    QTest::newRow(name) << shape << QByteArray(numbers);
  };
  row("length", R"({"kind": "length", "points": [[0, 0, 0], [3, 4, 0]]})",
      R"({"number": 5, "unit": "mm", "plusMinus": 0.8164965809277260})");
  // (1 + 1) / 12 + 2 * 1.5^2 / 3 at both ends
  row("length on a soft surface", R"({"kind": "length", "points": [[0, 0, 0], [3, 4, 0]], "softMm": 1.5})",
      R"({"number": 5, "unit": "mm", "plusMinus": 2.5819888974716112})");
  row("polyline", R"({"kind": "polyline", "points": [[0, 0, 0], [3, 4, 0], [3, 4, 2]]})",
      R"({"number": 7, "unit": "mm", "plusMinus": 1.1547005383792515})");
  row("angle", R"({"kind": "angle", "points": [[2, 0, 0], [0, 0, 0], [-3, 3, 0]]})",
      R"({"number": 135, "unit": "degrees"})");
  row("Cobb", R"({"kind": "cobb", "points": [[2, 0, 0], [0, 0, 0], [5, 5, 0], [8, 8, 0]]})",
      R"({"number": 45, "unit": "degrees"})");
  row("leg axis", R"({"kind": "legAxis", "points": [[0, 0, 9], [0, 0, 0], [3, 0, -3]]})",
      R"({"number": 45, "unit": "degrees", "hka": 135})");
  row("axes", R"({"kind": "bidirectional", "points": [[0, 0, 0], [8, 0, 0], [3, -1, 0], [3, 2, 0]]})",
      R"({"number": 8, "unit": "mm", "short": 3, "product": 24, "productUnit": "mm^2"})");
  row("axes that are none",
      R"({"kind": "bidirectional", "points": [[0, 0, 0], [8, 0, 0], [3, 0, 0], [5, 2, 0]]})",
      R"({"problem": "The short axis must be at right angles to the long one."})");
  row("cardiothoracic ratio",
      R"({"kind": "cardiothoracic", "points": [[0, 0, 0], [6, 0, 0], [-3, 2, 0], [9, 2, 0]]})",
      R"({"number": 0.5, "unit": null, "heart": 6, "thorax": 12, "lengthUnit": "mm"})");
  row("label", R"({"kind": "label", "name": "T4", "points": [[0, 0, 0]]})",
      R"({"name": "T4", "problem": "A label has no number."})");
  row("rectangle", QByteArray(R"({"kind": "rectangle", "points": [[-2, -2, 0.5], [2, 1, 0.5]], )") + onZero,
      R"({"number": 12, "unit": "mm^2", "voxels": 12, "mean": 7.5, "sd": 1.118033988749895, "min": 6, "max": 9,
          "valueUnit": null})");
  row("ellipse", QByteArray(R"({"kind": "ellipse", "points": [[-1, -1, 0.5], [1, 1, 0.5]], )") + onZero,
      R"({"number": 3.141592653589793, "voxels": 4, "mean": 7.5, "sd": 0.5, "min": 7, "max": 8})");
  row("freehand",
      QByteArray(R"({"kind": "freehand", "points": [[-2, -2, 0.5], [2, -2, 0.5], [2, 2, 0.5]], )") + onZero,
      R"({"number": 8, "unit": "mm^2", "min": 6, "max": 9})");
  row("no voxel inside",
      QByteArray(R"({"kind": "rectangle", "points": [[0, 0, 0.5], [0.2, 0.2, 0.5]], )") + onZero,
      R"({"unit": "mm^2", "voxels": 0, "problem": "no voxel inside"})");
  row("probe", R"({"kind": "probe", "points": [[-4.4, 3.2, 1]]})",
      R"({"number": 3, "unit": null, "index": [3, 11, 9], "voxelCentre": [-4.5, 3.5, 1.5],
          "point": [-4.4, 3.2, 1], "padding": false})");
  row("volume", R"({"kind": "volume", "range": [3, 6]})",
      R"({"number": 1.024, "unit": "ml", "voxels": 1024, "range": [3, 6], "valueUnit": null})");
  row("volume, open", R"({"kind": "volume", "range": [null, 6]})", R"({"voxels": 1792, "range": [null, 6]})");
  row("arrow", R"({"kind": "arrow", "name": "here", "points": [[0, 0, 0], [9, 9, 0]]})",
      R"({"name": "here", "problem": "An arrow has no number."})");
  row("a probe outside", R"({"kind": "probe", "points": [[99, 0, 0]]})",
      R"({"problem": "The point lies outside the volume."})");
}

void TestMeasureCommand::numbersOfEveryKind() {
  QFETCH(QByteArray, shape);
  QFETCH(QByteArray, numbers);
  const QJsonObject found = measuredShape(ramp, '[' + shape + ']');
  const QJsonObject wanted = QJsonDocument::fromJson(numbers).object();
  QVERIFY(!wanted.isEmpty());
  for (const QString& key : wanted.keys()) {
    QVERIFY2(found.contains(key), qPrintable(key));
    if (wanted[key].isDouble())
      QVERIFY2(std::abs(found[key].toDouble() - wanted[key].toDouble()) < 1e-12, qPrintable(key));
    else
      QCOMPARE(found[key], wanted[key]);
  }
  QCOMPARE(found.contains(QStringLiteral("mean")), wanted.contains(QStringLiteral("min")));
}

void TestMeasureCommand::shapesKeepTheirOrderAndNames() {
  const Outcome done = measuredShapes(ramp, R"([{"kind": "probe", "points": [[0, 0, 0]], "name": "one"},
      {"kind": "angle", "points": [[0, 0, 0], [0, 0, 0], [0, 0, 0]], "name": "two"},
      {"kind": "length", "points": [[0, 0, 0], [1, 0, 0]]}])");
  QVERIFY2(done.status == 0, done.err.constData());
  QCOMPARE(done.err, QByteArray());
  const QJsonDocument all = QJsonDocument::fromJson(done.out);
  QCOMPARE(all[QStringLiteral("series")].toString(), ramp);
  const QJsonArray list = all[QStringLiteral("measurements")].toArray();
  QCOMPARE(list.size(), 3);
  QCOMPARE(list[0][QStringLiteral("name")].toString(), QStringLiteral("one"));
  QCOMPARE(list[1][QStringLiteral("name")].toString(), QStringLiteral("two"));
  QVERIFY(list[1][QStringLiteral("problem")].toString().contains(QLatin1String("no angle")));
  QCOMPARE(list[2][QStringLiteral("number")].toDouble(), 1.0);
}

void TestMeasureCommand::unitsAreTheStudys() {
  const std::string chest = dataPath("ct-chest-lidc0314-138");
  NEED_DATA(chest);
  const QJsonObject probe = measuredShape(QString::fromStdString(chest),
                                          R"([{"kind": "probe", "points": [[-200.9, -58.9, -679.5]]}])");
  QCOMPARE(probe[QStringLiteral("unit")].toString(), QStringLiteral("HU"));
  QCOMPARE(probe[QStringLiteral("index")].toArray(), (QJsonArray{0, 0, 0}));
}

void TestMeasureCommand::petIsSuv_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<QString>("option");  // value of --unit, empty for none
  QTest::addColumn<QString>("unit");
  QTest::addColumn<double>("mean");
  const auto row = [](const char* path, const char* option, const char* unit, double mean) {
    QTest::addRow("%s %s", path, option)
        << QString::fromLatin1(path) << QString::fromLatin1(option) << QString::fromLatin1(unit) << mean;
  };
  row("c28-suv-bqml", "", "SUVbw", 0.584255);
  row("c28-suv-bqml", "SUVbw", "SUVbw", 0.584255);
  row("c28-suv-bqml", "file", "Bq/ml", 2000);
  row("c28-suv-cnts-factor", "", "SUVbw", 1);
}

void TestMeasureCommand::petIsSuv() {
  const std::string cases = dataPath("field-cases");
  NEED_DATA(cases);
  QFETCH(QString, path);
  QFETCH(QString, option);
  QFETCH(QString, unit);
  QFETCH(double, mean);
  const QStringList more = option.isEmpty() ? QStringList() : QStringList{QStringLiteral("--unit"), option};
  const Outcome done = measuredShapes(QString::fromStdString(cases) + QLatin1Char('/') + path, R"([
      {"kind": "rectangle", "points": [[0.5, 0.5, 1], [5.5, 5.5, 1]],
       "plane": {"centre": [3, 3, 1], "right": [1, 0, 0], "down": [0, 1, 0]}},
      {"kind": "probe", "points": [[2, 2, 1]]}, {"kind": "volume", "range": [1000, null]}])",
                                      more);
  QVERIFY2(done.status == 0, done.err.constData());
  const QJsonArray all = QJsonDocument::fromJson(done.out)[QStringLiteral("measurements")].toArray();
  const auto near = [](const QJsonValue& value, double x) {
    return std::abs(value.toDouble() / x - 1) < 1e-6;
  };
  for (const char* key : {"mean", "min", "max"}) QVERIFY2(near(all[0][QLatin1String(key)], mean), key);
  QCOMPARE(all[0][QStringLiteral("unit")].toString(), QStringLiteral("mm^2"));
  QCOMPARE(all[0].toObject().contains(QStringLiteral("suvPeak")), unit.startsWith(QStringLiteral("SUV")));
  QCOMPARE(all[0][QStringLiteral("valueUnit")].toString(), unit);
  QVERIFY(near(all[1][QStringLiteral("number")], mean));
  QCOMPARE(all[1][QStringLiteral("unit")].toString(), unit);
  // Ranges are given in the unit of the file and reported in the unit of the other numbers.
  QCOMPARE(all[2][QStringLiteral("valueUnit")].toString(), unit);
  QVERIFY(near(all[2][QStringLiteral("range")][0], mean / 2));
}

void TestMeasureCommand::anSuvThatCannotBeHadIsRefused() {
  const std::string path = dataPath("field-cases/c28-suv-bqml");
  NEED_DATA(path);
  const QByteArray probe = R"([{"kind": "probe", "points": [[2, 2, 1]]}])";
  const Outcome lean = measuredShapes(QString::fromStdString(path), probe,
                                      {QStringLiteral("--unit"), QStringLiteral("SUVlbm")});
  QCOMPARE(lean.status, 1);
  QVERIFY2(lean.err.contains("no SUVlbm: PatientSize (0010,1020) is missing."), lean.err.constData());
  const Outcome ct = measuredShapes(ramp, probe, {QStringLiteral("--unit"), QStringLiteral("SUVbw")});
  QCOMPARE(ct.status, 1);
  QVERIFY2(ct.err.contains("it is no PET series."), ct.err.constData());
}

void TestMeasureCommand::whyThereIsNoSuvIsTold() {
  const std::string path = dataPath("field-cases/c66q-frame-reference-time");
  NEED_DATA(path);
  const Outcome done =
      measuredShapes(QString::fromStdString(path), R"([{"kind": "volume", "range": [0, null]}])");
  QVERIFY2(done.status == 0, done.err.constData());
  const QString why = QJsonDocument::fromJson(done.out)[QStringLiteral("noSuv")].toString();
  QVERIFY2(why.startsWith(QStringLiteral("no SUV: ")) && why.contains(QStringLiteral("(0")), qPrintable(why));
  QVERIFY2(done.err.contains(why.toUtf8() + "."), done.err.constData());
}

// Counted and drawn volumes of bone agree within the roughness of its surface.
void TestMeasureCommand::drawnVolumeOfBone() {
  const QJsonObject bone =
      measuredShape(QStringLiteral("phantom:ct-head:64"), R"([{"kind": "volume", "range": [300, null]}])");
  const double number = bone[QStringLiteral("number")].toDouble(),
               drawn = bone[QStringLiteral("drawn")].toDouble();
  QVERIFY(number > 100 && std::abs(drawn - number) < 0.1 * number);
  QVERIFY(std::abs(bone[QStringLiteral("difference")].toDouble() - (drawn - number)) < 1e-9);
}

void TestMeasureCommand::refused_data() {
  QTest::addColumn<QByteArray>("shapes");
  QTest::addColumn<QByteArray>("sentence");
  const auto row = [](const char* name, const QByteArray& shapes, const char* sentence) {
    QTest::newRow(name) << shapes << QByteArray(sentence);
  };
  row("no JSON", "[", "shapes.json: Not JSON");
  row("no list", "{}", "must be a list of shapes");
  row("no object", "[7]", "[0] must be an object");
  row("no kind", "[{}]", "[0].kind is missing");
  row("unknown kind", R"([{"kind": "circle"}])", "[0].kind must be \"length\" or ");
  row("unknown field", R"([{"kind": "probe", "points": [[0, 0, 0]], "colour": 1}])",
      "[0].colour is unknown; the fields here are kind, name, frame, points, plane");
  row("unknown field of a plane",
      R"([{"kind": "probe", "points": [[0, 0, 0]], "plane": {"centre": [0, 0, 0], "right": [1, 0, 0],
          "down": [0, 1, 0], "up": 1}}])",
      "[0].plane.up is unknown");
  row("half a plane", R"([{"kind": "probe", "points": [[0, 0, 0]], "plane": {"centre": [0, 0, 0]}}])",
      "[0].plane.right is missing");
  row("the second shape", R"([{"kind": "probe", "points": [[0, 0, 0]]}, {"kind": "length"}])",
      "[1].points must hold 2");
  row("points that are no list", R"([{"kind": "probe", "points": 3}])", "[0].points must be a list");
  row("a point of two numbers", R"([{"kind": "probe", "points": [[1, 2]]}])",
      "[0].points[0] must be a list of 3");
  row("a region without a plane", R"([{"kind": "ellipse", "points": [[0, 0, 0], [1, 1, 0]]}])",
      "[0].plane is missing");
  row("points of a volume", R"([{"kind": "volume", "range": [1, 2], "points": []}])",
      "[0].points is unknown");
  row("no range", R"([{"kind": "volume"}])", "[0].range is missing");
  row("half a range", R"([{"kind": "volume", "range": [1]}])", "[0].range must be [low, high]");
  row("a range of words", R"([{"kind": "volume", "range": [1, "2"]}])", "[0].range[1] must be a number");
  row("range upside down", R"([{"kind": "volume", "range": [2, 1]}])", "[0].range must be [low, high]");
  row("half a frame", R"([{"kind": "probe", "points": [[0, 0]], "frame": {"number": 1}}])",
      "[0].frame.instance is missing");
  row("a frame below 0",
      R"([{"kind": "probe", "points": [[0, 0]], "frame": {"instance": "1", "number": -1}}])",
      "[0].frame.number must not be below 0");
  row("mm on a frame", R"([{"kind": "probe", "points": [[0, 0, 0]], "frame": {"instance": "1"}}])",
      "[0].points[0] must be a list of 2");
  row("a plane on a frame",
      R"([{"kind": "probe", "points": [[0, 0]], "frame": {"instance": "1"}, "plane": {}}])",
      "[0].plane is unknown; the fields here are kind, name, frame, points");
  row("softness below nothing", R"([{"kind": "length", "points": [[0, 0, 0], [1, 0, 0]], "softMm": -1}])",
      "[0].softMm must be a number");
  row("softness on a frame",
      R"([{"kind": "probe", "points": [[0, 0]], "frame": {"instance": "1"}, "softMm": 1}])",
      "[0].softMm is unknown");
  row("two points of a leg", R"([{"kind": "legAxis", "points": [[0, 0, 0], [1, 0, 0]]}])",
      "[0].points must hold 3");
  row("a field twice", R"([{"kind": "volume", "kind": "probe"}])", "given twice");
}

void TestMeasureCommand::refused() {
  QFETCH(QByteArray, shapes);
  QFETCH(QByteArray, sentence);
  const Outcome done = measuredShapes(ramp, shapes);
  QCOMPARE(done.status, 1);
  QVERIFY2(done.err.contains(sentence), done.err.constData());
  QVERIFY(done.out.isEmpty());
}

void TestMeasureCommand::documentHasEveryKindAndField() {
  const QByteArray page = contentsOf(QStringLiteral(VOLUMEN_SOURCE_DIR "/resources/docs/measure.md"));
  // The message that refuses a kind lists all kinds.
  const QByteArray refusal = measuredShapes(ramp, R"([{"kind": "?"}])").err;
  const QList<QByteArray> quoted = refusal.left(refusal.indexOf(", not")).split('"');
  QVERIFY(quoted.size() > 17);
  for (qsizetype n = 1; n < quoted.size(); n += 2)
    QVERIFY2(page.contains('`' + quoted[n] + '`'), quoted[n].constData());
  for (const char* shape :
       {R"({"kind": "volume", "range": [3, 6]})", R"({"kind": "probe", "points": [[0, 0, 0]]})",
        R"({"kind": "length", "name": "a", "points": [[0, 0, 0], [1, 0, 0]]})"})
    for (const QString& key : measuredShape(ramp, QByteArray("[") + shape + ']').keys())
      QVERIFY2(page.contains('`' + key.toLatin1() + '`'), qPrintable(key));
}

VOLUMEN_TEST(TestMeasureCommand);
#include "tst_measure_command.moc"
