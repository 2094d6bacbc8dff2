// Guards DESIGN 8 and SCENE 8 on real series: what is opened is seen from where there is most to see, in the
// way its modality is read.
#include "tests/fixtures/fixtures.h"
#include "tests/ui/journey.h"
#include "tests/unit/suite.h"
#include "ui/session/camera_moves.h"

using namespace volumen;
using volumen::tests::Journey;

class TestFirstPictures : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aSeriesOpensAsItIsRead_data();
  void aSeriesOpensAsItIsRead();
};

void TestFirstPictures::aSeriesOpensAsItIsRead_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<QString>("view");
  QTest::addColumn<int>("mode");
  const auto row = [](const char* name, const char* path, const char* view, Mode mode) {
    QTest::newRow(name) << QString::fromLatin1(path) << QString::fromLatin1(view) << int(mode);
  };
  row("thin functional MR", "dicom-geometry/mr-fmri-ge-50", "inferior", Mode::mip);
  row("few slices far apart", "dicom-geometry/mr-localizer-ge-3plane-21", "inferior", Mode::mip);
  row("PET", "pet-ct/sts019-pet", "anterior", Mode::mip);
  row("MR of a head", "mr-head-siemens-gap-175", "anterior", Mode::mip);
  row("CT of a head, tilted", "dicom-geometry/ct-ge-tilt-varspacing-28", "anterior", Mode::composite);
  row("one slice", "dicom-ts-cornerstone/CT1_J2KR", "inferior", Mode::composite);
}

void TestFirstPictures::aSeriesOpensAsItIsRead() {
  QFETCH(QString, path);
  QFETCH(QString, view);
  QFETCH(int, mode);
  const std::string data = tests::dataPath(path.toStdString());
  NEED_DATA(data);
  Journey w({QString::fromStdString(data)});
  QVERIFY(w.settle());
  w.shot(QTest::currentDataTag());
  QCOMPARE(int(w.window.session().scene().mode), mode);
  const auto nameOfView = [&] { return QString::fromStdString(viewName(w.window.view()->camera())); };
  const QString first = nameOfView();
  // A tilted stack is seen along its normal, which has no name.
  if (!first.isEmpty()) QCOMPARE(first, view);
  const bool pet = w.window.session().series()->series.modality == "PT";
  const QImage picture = w.window.view()->picture();
  QCOMPARE(qGray(picture.pixel(3, 3)), pet ? 255 : 0);
  // Turned away, the reset brings the first view back.
  w.after("viewRight");
  w.after("resetView");
  QCOMPARE(nameOfView(), first);
  QVERIFY(w.window.view()->picture() == picture);
}

VOLUMEN_TEST(TestFirstPictures);
#include "tst_first_pictures.moc"
