// Guards design.md 7: `info` lists pictures that are no volumes. A 3D picture of them is refused with the
// reason.
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestInfoImages : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void imagesStandBesideVolumes();
  void textNamesThem();
  void renderSaysWhyNot();
  void aMosaicIsOneFile();
  void whatVariesIsTold();
};

namespace {

QString clip() { return QString::fromStdString(dataPath("dicom-2d/us-palette-cine-10.dcm")); }

}  // namespace

void TestInfoImages::imagesStandBesideVolumes() {
  NEED_DATA(dataPath());
  const Outcome a = runProgram(QStringLiteral("info %1 --json --values").arg(clip()));
  QCOMPARE(a.status, 0);
  const QJsonObject all = QJsonDocument::fromJson(a.out).object();
  for (const char* empty : {"volumes", "refused", "other"})
    QVERIFY2(all[QLatin1String(empty)].isArray() && all[QLatin1String(empty)].toArray().isEmpty(), empty);
  QCOMPARE(all[QStringLiteral("images")].toArray().size(), 1);
  const QJsonObject image = all[QStringLiteral("images")].toArray()[0].toObject();
  QCOMPARE(image[QStringLiteral("path")].toString(), clip());
  QCOMPARE(image[QStringLiteral("id")], image[QStringLiteral("sopInstanceUid")]);
  QCOMPARE(image[QStringLiteral("frames")].toInt(), 10);
  QCOMPARE(image[QStringLiteral("rows")].toInt(), 430);
  QCOMPARE(image[QStringLiteral("columns")].toInt(), 600);
  QCOMPARE(image[QStringLiteral("photometric")].toString(), QStringLiteral("PALETTE COLOR"));
  QCOMPARE(image[QStringLiteral("modality")].toString(), QStringLiteral("US"));
}

void TestInfoImages::textNamesThem() {
  NEED_DATA(dataPath());
  const Outcome a = runProgram(QStringLiteral("info ") + clip());
  QCOMPARE(a.status, 0);
  QVERIFY2(a.out.startsWith("1 picture is no volume.\n"), a.out);
  QVERIFY2(a.out.contains("us-palette-cine-10.dcm: 600 x 430, 10 frames, PALETTE COLOR; colour image"),
           a.out);
}

void TestInfoImages::renderSaysWhyNot() {
  NEED_DATA(dataPath());
  const Outcome a = runProgram(QStringLiteral("render %1 -o /tmp/never.png").arg(clip()));
  QCOMPARE(a.status, 1);
  QVERIFY2(a.err.contains("colour image (PALETTE COLOR): cannot be shown in 3D."), a.err);
  QVERIFY2(a.err.contains("slice --plane frame` draws its frames."), a.err);
}

void TestInfoImages::aMosaicIsOneFile() {
  NEED_DATA(dataPath());
  const QString mosaics = QString::fromStdString(dataPath("dicom-geometry/mr-mosaic-siemens"));
  const Outcome a = runProgram(QStringLiteral("info ") + mosaics);
  QCOMPARE(a.status, 0);
  QCOMPARE(a.out.count("64 x 64 x 35 voxels"), 3);
  QVERIFY2(!a.out.contains(" files"), a.out);
}

void TestInfoImages::whatVariesIsTold() {
  NEED_DATA(dataPath());
  const auto told = [](const char* path) {
    return runProgram(QStringLiteral("info ") + QString::fromStdString(dataPath(path))).out;
  };
  const QByteArray echoes = told("dicom-geometry/mr-qt2-multiecho-7");
  for (const char* line : {"1  MR 2D 16Echo qT2 (3), TE 20 ms\n", "3  MR 2D 16Echo qT2 (3), TE 60 ms\n"})
    QVERIFY2(echoes.contains(line), echoes);
  const QByteArray directions = told("nrrd-format-tests/slicer/multishell-DWI-451dir.nhdr");
  QVERIFY(directions.contains(", direction 451\n"));
  QVERIFY(directions.contains(".nhdr, b 250, direction 2\n"));
}

VOLUMEN_TEST(TestInfoImages);
#include "tst_info_images.moc"
