// Guards slices.md 4: the numbers of `volumen measure` for shapes on pictures as acquired.
#include <QJsonDocument>
#include <QJsonObject>
#include <cmath>

#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/app/measure_case.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestMeasureFrames : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void petOnFramesIsSuv();
  void framesAsAcquired_data();
  void framesAsAcquired();
  void numbersComeInTheOrderOfTheShapes();
};

void TestMeasureFrames::petOnFramesIsSuv() {
  const std::string path = dataPath("field-cases/c28-suv-bqml");
  NEED_DATA(path);
  const volumen::Result<volumen::Study> study = volumen::openStudy(path);
  QVERIFY(study.ok());
  const QByteArray shape = R"([{"kind": "probe", "points": [[2, 2]], "frame": {"instance": ")" +
                           QByteArray::fromStdString(study->volumes.at(0).sopInstanceUids[1]) +
                           R"(", "number": 0}}])";
  const QJsonObject probe = measuredShape(QString::fromStdString(path), shape);
  QVERIFY(std::abs(probe[QStringLiteral("number")].toDouble() - 0.584255) < 1e-6);
  QCOMPARE(probe[QStringLiteral("unit")].toString(), QStringLiteral("SUVbw"));
}

void TestMeasureFrames::framesAsAcquired_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<QByteArray>("shape");    // without its frame
  QTest::addColumn<QByteArray>("numbers");  // JSON, within 1e-5 of each number
  const auto row = [](const char* name, const char* file, const char* shape, const char* numbers) {
    QTest::newRow(name) << QString::fromLatin1(file) << QByteArray(shape) << QByteArray(numbers);
  };
  // 2 (2 s^2 / 12)^(1/2) with the pixel's extent s along the line.
  row("at the detector", "cr-chest-mono1-jpeg8.dcm", R"("length", "points": [[100, 900], [1100, 900]])",
      R"({"number": 175, "unit": "mm", "calibration": "at detector", "plusMinus": 0.14288690166})");
  row("magnification corrected", "mg-ermf-overlay-shutter.dcm",
      R"("length", "points": [[10, 5], [10, 1005]])",
      R"({"number": 81.46923, "unit": "mm", "calibration": "magnification corrected"})");
  row("an area at the detector", "cr-chest-mono1-jpeg8.dcm",
      R"("rectangle", "points": [[100, 900], [200, 1100]])",
      R"({"number": 612.5, "unit": "mm^2", "calibration": "at detector", "pixels": 20000})");
  row("no size", "xa-96frames.dcm", R"("length", "points": [[0, 0], [30, 40]])",
      R"({"number": 50, "unit": "px", "calibration": null})");
  row("in the patient", "ct-two-windows.dcm", R"("length", "points": [[0, 0], [300, 400]])",
      R"({"number": 143.5546875, "unit": "mm", "calibration": null})");
  row("values of CT", "ct-two-windows.dcm", R"("probe", "points": [[256.4, 255.6]])",
      R"({"number": 202, "unit": "HU", "index": [256, 256], "point": [256.4, 255.6], "padding": false})");
  row("one pixel inside", "ct-two-windows.dcm", R"("rectangle", "points": [[159.5, 189.5], [160.5, 190.5]])",
      R"({"pixels": 1, "mean": 141, "sd": 0, "min": 141, "max": 141, "valueUnit": "HU"})");
  row("no pixel inside", "ct-two-windows.dcm", R"("ellipse", "points": [[10.2, 10.2], [10.8, 10.8]])",
      R"({"pixels": 0, "problem": "no pixel inside"})");
  row("after the modality LUT", "cr-dental-mono1-modalitylut.dcm", R"("probe", "points": [[988, 700]])",
      R"({"number": 376, "unit": null})");
  row("padding", "mg-sigmoid-voilut3.dcm", R"("probe", "points": [[100, 100]])",
      R"({"number": 0, "padding": true})");
  row("padding is left out", "mg-sigmoid-voilut3.dcm", R"("rectangle", "points": [[90, 90], [110, 110]])",
      R"({"pixels": 0, "problem": "no pixel inside"})");
  const char* const clip = "us-cine-aspect-regions.dcm";
  row("ultrasound: across in its region", clip, R"("length", "points": [[100, 200], [200, 200]])",
      R"({"number": 28.5714, "unit": "mm", "calibration": null})");
  row("ultrasound: down in its region", clip, R"("length", "points": [[100, 200], [100, 300]])",
      R"({"number": 22.8571, "unit": "mm"})");
  row("ultrasound: an area takes both", clip, R"("rectangle", "points": [[100, 200], [200, 300]])",
      R"({"number": 653.0594, "unit": "mm^2"})");
  row("ultrasound: out of every region", clip, R"("length", "points": [[100, 360], [200, 360]])",
      R"({"number": 100, "unit": "px"})");
  row("ultrasound: one end outside", clip, R"("length", "points": [[100, 300], [100, 360]])",
      R"({"number": 60, "unit": "px"})");
  row("ultrasound: time is no length", clip, R"("length", "points": [[100, 390], [200, 390]])",
      R"({"number": 100, "unit": "px", "across": {"number": 0.502315, "unit": "s"}})");
  row("ultrasound: when", clip, R"("probe", "points": [[140, 390]])",
      R"({"across": {"number": 0.502315, "unit": "s"}})");
  // atan(0.8): the picture is drawn 0.8 times as high.
  row("ultrasound: angles of what is seen", clip,
      R"("angle", "points": [[300, 360], [200, 360], [300, 460]])",
      R"({"number": 38.6598083, "unit": "degrees"})");
  row("colours", clip, R"("probe", "points": [[184, 399]])", R"({"number": null, "unit": null})");
  row("an area of colours", clip, R"("rectangle", "points": [[0, 400], [20, 410]])",
      R"({"number": 200, "unit": "px^2", "pixels": null, "mean": null, "problem": null})");
  row("outside", clip, R"("probe", "points": [[479.6, 0]])",
      R"({"problem": "The point lies outside the picture."})");
}

// Compares with the numbers in the data's README.
void TestMeasureFrames::framesAsAcquired() {
  NEED_DATA(dataPath("dicom-2d"));
  QFETCH(QString, file);
  QFETCH(QByteArray, shape);
  QFETCH(QByteArray, numbers);
  const QString path = QString::fromStdString(dataPath("dicom-2d")) + u'/' + file;
  const auto study = volumen::openStudy(path.toStdString());
  QVERIFY(study.ok());
  const std::string instance = study->images.empty() ? study->volumes.front().sopInstanceUids.front()
                                                     : study->images.front().sopInstanceUid;
  const QJsonObject found =
      measuredShape(path, R"([{"frame": {"instance": ")" + QByteArray::fromStdString(instance) +
                              R"("}, "kind": )" + shape + "}]");
  const QJsonObject wanted = QJsonDocument::fromJson(numbers).object();
  QVERIFY(!wanted.isEmpty());
  const auto isNear = [](const QJsonValue& a, const QJsonValue& b) {
    return a.isDouble() && b.isDouble()
               ? std::abs(a.toDouble() - b.toDouble()) <= 1e-5 * std::max(1.0, std::abs(b.toDouble()))
               : a == b;
  };
  for (const QString& key : wanted.keys()) {
    if (wanted[key].isNull()) {
      QVERIFY2(found[key].isNull() || found[key].isUndefined(), qPrintable(key));
    } else if (wanted[key].isObject()) {
      QVERIFY(isNear(found[key][QStringLiteral("number")], wanted[key][QStringLiteral("number")]));
      QCOMPARE(found[key][QStringLiteral("unit")], wanted[key][QStringLiteral("unit")]);
    } else {
      QVERIFY2(isNear(found[key], wanted[key]), QJsonDocument(found).toJson().constData());
    }
  }
}

// Shapes of one frame are measured together.
void TestMeasureFrames::numbersComeInTheOrderOfTheShapes() {
  const std::string path = dataPath("dicom-2d/xa-96frames.dcm");
  NEED_DATA(path);
  const QString clip = QString::fromStdString(path);
  const auto study = volumen::openStudy(path);
  QVERIFY(study.ok());
  const std::string instance = study->images.front().sopInstanceUid;
  const auto probe = [&](int frame, int x) {
    return QStringLiteral(
               R"({"kind": "probe", "points": [[%1, 200]], "frame": {"instance": "%2", "number": %3}})")
        .arg(x)
        .arg(QString::fromStdString(instance))
        .arg(frame)
        .toUtf8();
  };
  const std::pair<int, int> probes[] = {{95, 200}, {3, 210}, {95, 220}, {0, 230}, {3, 240}};
  QByteArrayList shapes;
  for (const auto& [frame, x] : probes) shapes << probe(frame, x);
  const auto all = QJsonDocument::fromJson(
      measuredShapes(clip, '[' + shapes.join(',') + ']').out)[QStringLiteral("measurements")];
  for (int n = 0; n < int(std::size(probes)); ++n)
    QCOMPARE(all[n].toObject(), measuredShape(clip, '[' + shapes[n] + ']'));
}

VOLUMEN_TEST(TestMeasureFrames);
#include "tst_measure_frames.moc"
