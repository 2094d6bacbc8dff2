// Guards slices.md 5: `volumen slice --plane frame --presentation` shows the frame of a presentation state as
// the state says. `volumen info` lists objects that refer to pictures.
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QImage>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <memory>

#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestSlicePresentation : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init();
  void picturesAreShownAsTheStateSays_data();
  void picturesAreShownAsTheStateSays();
  void graphicsAreDrawnWhereTheyBelong();
  void textsAreTheSameWithAnyFonts_data();
  void textsAreTheSameWithAnyFonts();
  void valuesAreTurnedToo();
  void aNumberMeansTheListOfInfo();
  void whatCannotBeMeantIsRefused_data();
  void whatCannotBeMeantIsRefused();
  void infoListsThemInText();
  void infoTellsWhatTheyHold_data();
  void infoTellsWhatTheyHold();

 private:
  QString at(const char* name) const { return folder_->filePath(QLatin1String(name)); }
  QStringList sliceInto(const char* out) const {
    return {QStringLiteral("slice"), at("study"),          QStringLiteral("--plane"),
            QStringLiteral("frame"), QStringLiteral("-o"), at(out)};
  }
  Outcome slice(const QStringList& more, const char* out) const { return runProgram(sliceInto(out) + more); }
  std::unique_ptr<QTemporaryDir> folder_;
};

namespace {

QString data(const char* name) { return QString::fromStdString(dataPath(name)); }

QStringList madeState() {
  return {QStringLiteral("--presentation"), data("dicom-2d/made-here/pr-on-CT_small.dcm")};
}

QJsonObject infoOf(const QString& path) {
  const Outcome a =
      runProgram({QStringLiteral("info"), path, QStringLiteral("--json"), QStringLiteral("--values")});
  return QJsonDocument::fromJson(a.out).object();
}

}  // namespace

// Makes a study of the picture, its state, its key object and a report.
void TestSlicePresentation::init() {
  NEED_DATA(dataPath());
  folder_ = std::make_unique<QTemporaryDir>();
  QVERIFY(QDir().mkpath(at("study")));
  for (const char* file : {"dicom-pydicom/test_files/CT_small.dcm", "dicom-2d/made-here/pr-on-CT_small.dcm",
                           "dicom-2d/made-here/ko-on-CT_small.dcm", "dicom-2d/sr-tid1500-on-CT_small.dcm"})
    QVERIFY(QFile::copy(data(file), at("study") + QLatin1Char('/') + QFileInfo(data(file)).fileName()));
}

void TestSlicePresentation::picturesAreShownAsTheStateSays_data() {
  QTest::addColumn<int>("x");  // in the picture as acquired; it is drawn at y, x
  QTest::addColumn<int>("y");
  QTest::addColumn<int>("grey");
  QTest::newRow("soft tissue, 70 HU") << 51 << 51 << 157;
  QTest::newRow("bone, 904 HU") << 64 << 64 << 50;
  QTest::newRow("under the shutter") << 20 << 11 << 0;
}

void TestSlicePresentation::picturesAreShownAsTheStateSays() {
  QFETCH(int, x);
  QFETCH(int, y);
  QFETCH(int, grey);
  const Outcome done = slice(madeState() << QStringLiteral("--no-graphics"), "a.png");
  QVERIFY2(done.status == 0, done.err.constData());
  const QImage picture(at("a.png"));
  QCOMPARE(picture.size(), QSize(128, 128));
  QCOMPARE(qRed(picture.pixel(y, x)), grey);
}

void TestSlicePresentation::graphicsAreDrawnWhereTheyBelong() {
  QCOMPARE(slice(madeState(), "with.png").status, 0);
  QCOMPARE(slice(madeState() << QStringLiteral("--no-graphics"), "without.png").status, 0);
  const QImage with(at("with.png")), without(at("without.png"));
  const auto differs = [&](int x, int y) {  // within a pixel of a position in the picture as acquired
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (with.pixel(y + dy, x + dx) != without.pixel(y + dy, x + dx)) return true;
    return false;
  };
  QVERIFY(differs(64, 44) && differs(84, 64) && differs(64, 84) && differs(44, 64));  // circle of radius 20
  QVERIFY(differs(26, 51) && differs(51, 76) && differs(40, 51));                     // polyline
  QVERIFY(differs(90, 40));                                                           // point
  QVERIFY(!differs(74, 64) && !differs(100, 100));             // beside outlines of texts
  QVERIFY(differs(6, 6) || differs(5, 12) || differs(6, 20));  // text in the displayed picture's upper left
}

void TestSlicePresentation::textsAreTheSameWithAnyFonts_data() {
  QTest::addColumn<QString>("fonts");
  for (const char* fonts : {"noto", "cantarell"}) QTest::newRow(fonts) << QString::fromLatin1(fonts);
}

void TestSlicePresentation::textsAreTheSameWithAnyFonts() {
  QFETCH(QString, fonts);
  const auto drawn = [this](const QString& with) {
    const std::optional<Outcome> a = runWithFonts(with, sliceInto("fonts.png") + madeState());
    QByteArrayList made;
    if (a) made << (a->status == 0 ? contentsOf(at("fonts.png")) : a->err);
    return made;
  };
  const QByteArrayList asHere = drawn(QStringLiteral("dejavu")), there = drawn(fonts);
  if (there.isEmpty()) QSKIP("fonts-noto-core or fonts-cantarell is not installed");
  QVERIFY(asHere.value(0).startsWith("\x89PNG"));
  QCOMPARE(there, asHere);
}

void TestSlicePresentation::valuesAreTurnedToo() {
  QCOMPARE(slice(madeState(), "a.nrrd").status, 0);
  QCOMPARE(slice({}, "acquired.nrrd").status, 0);
  const auto floats = [&](const char* name) {
    const QByteArray all = contentsOf(at(name));
    return all.mid(all.indexOf("\n\n") + 2);
  };
  const QByteArray turned = floats("a.nrrd"), acquired = floats("acquired.nrrd");
  QCOMPARE(turned.size(), 128 * 128 * 4);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x)
      if (turned.mid(4 * (x * 128 + y), 4) != acquired.mid(4 * (y * 128 + x), 4)) QFAIL("a value elsewhere");
}

void TestSlicePresentation::aNumberMeansTheListOfInfo() {
  const QJsonArray listed = infoOf(at("study"))[QStringLiteral("references")].toArray();
  QCOMPARE(listed.size(), 3);
  for (qsizetype n = 0; n < listed.size(); ++n) {
    const bool isState = listed[n].toObject()[QStringLiteral("kind")] == QStringLiteral("presentation state");
    const Outcome done = slice({QStringLiteral("--presentation"), QString::number(n + 1)}, "numbered.png");
    QCOMPARE(done.status, isState ? 0 : 1);
    QCOMPARE(listed[n].toObject()[QStringLiteral("date")].toString().count(QLatin1Char('-')), 2);
    if (!isState) QVERIFY2(done.err.contains("it holds no presentation state."), done.err.constData());
  }
}

void TestSlicePresentation::whatCannotBeMeantIsRefused_data() {
  QTest::addColumn<QString>("path");  // path of the pictures
  QTest::addColumn<QString>("options");
  QTest::addColumn<int>("status");
  QTest::addColumn<QString>("says");
  const QString made = QStringLiteral(" --presentation ") + data("dicom-2d/made-here/pr-on-CT_small.dcm");
  const QString frame = QStringLiteral("--plane frame");
  QTest::newRow("other pictures") << data("dicom-2d/ct-two-windows.dcm") << frame + made << 1
                                  << QStringLiteral(
                                         "holds none of the pictures that the presentation state refers to.");
  QTest::newRow("another frame") << data("dicom-2d/ct-two-windows.dcm")
                                 << frame + made + QStringLiteral(" --index 0") << 1
                                 << QStringLiteral("the presentation state refers to other pictures.");
  QTest::newRow("a picture without pixels")
      << data("dicom-2d/pr-without-pixels") << frame + QStringLiteral(" --presentation 1") << 1
      << QStringLiteral("cr.dcm: DICOM file without pixel data (CR).");
  QTest::newRow("no such number") << data("dicom-2d/pr-without-pixels")
                                  << frame + QStringLiteral(" --presentation 2") << 1
                                  << QStringLiteral("from 1 to 1.");
  QTest::newRow("no such file") << data("dicom-2d/ct-two-windows.dcm")
                                << frame + QStringLiteral(" --presentation /nowhere/at/all") << 1
                                << QStringLiteral("/nowhere/at/all: ");
  QTest::newRow("a plane") << data("dicom-2d/ct-two-windows.dcm") << QStringLiteral("--plane axial") + made
                           << 2 << QStringLiteral("--plane frame");
}

void TestSlicePresentation::whatCannotBeMeantIsRefused() {
  QFETCH(QString, path);
  QFETCH(QString, options);
  QFETCH(int, status);
  QFETCH(QString, says);
  const Outcome done = runProgram(QStringLiteral("slice %1 %2 -o %3").arg(path, options, at("never.png")));
  QCOMPARE(done.status, status);
  QVERIFY2(done.err.contains(says.toUtf8()), done.err.constData());
  QVERIFY(!QFile::exists(at("never.png")));
}

void TestSlicePresentation::infoListsThemInText() {
  const Outcome here = runProgram({QStringLiteral("info"), at("study")});
  QCOMPARE(here.status, 0);
  QVERIFY2(here.out.contains("Objects that refer to pictures\n"), here.out.constData());
  QVERIFY2(here.out.contains("key objects, Of Interest, made for a test; refers to 1 picture\n"),
           here.out.constData());
  QVERIFY2(!here.out.contains("not an image") && !here.out.contains("not here"), here.out.constData());
  const Outcome cropped = runProgram({QStringLiteral("info"), data("pet-ct/sts019-rtstruct-ct.dcm")});
  QCOMPARE(cropped.status, 1);
  QVERIFY2(cropped.out.contains("refers to 179 pictures, which are not here\n"), cropped.out.constData());
}

void TestSlicePresentation::infoTellsWhatTheyHold_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<QString>("holds");
  QTest::newRow("presentation state")
      << data("dicom-2d/made-here/pr-on-CT_small.dcm") << QStringLiteral("\"rotation\":90");
  QTest::newRow("key objects") << data("dicom-2d/made-here/ko-on-CT_small.dcm")
                               << QStringLiteral("\"value\":\"113000\"");
  QTest::newRow("report") << data("dicom-2d/sr-tid1500-groups-on-CT_small.dcm")
                          << QStringLiteral("\"trackingId\":\"LungNodule0001\"");
  QTest::newRow("contours") << data("pet-ct/sts019-rtstruct-ct.dcm")
                            << QStringLiteral("\"name\":\"GTV_Mass_CT\"");
  QTest::newRow("segmentation") << data("dicom-2d/seg-on-CT_small.dcm") << QStringLiteral("\"pixels\":1832");
}

void TestSlicePresentation::infoTellsWhatTheyHold() {
  QFETCH(QString, file);
  QFETCH(QString, holds);
  const QJsonArray listed = infoOf(file)[QStringLiteral("references")].toArray();
  QCOMPARE(listed.size(), 1);
  const QJsonObject object = listed[0].toObject();
  QCOMPARE(object[QStringLiteral("kind")].toString(), QLatin1String(QTest::currentDataTag()));
  QCOMPARE(object[QStringLiteral("notHere")].toInt(), object[QStringLiteral("pictures")].toArray().size());
  const QByteArray contents =
      QJsonDocument(object[QStringLiteral("contents")].toObject()).toJson(QJsonDocument::Compact);
  QVERIFY2(contents.contains(holds.toUtf8()), contents.left(2000).constData());
}

VOLUMEN_TEST(TestSlicePresentation);
#include "tst_slice_presentation.moc"
