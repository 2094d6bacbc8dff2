// Guards design.md 8 and picture.md 8 on real series: a series opens from the direction that shows most, and
// as its modality is usually read.
#include <QComboBox>
#include <QLabel>

#include "tests/fixtures/fixtures.h"
#include "tests/ui/clean_settings.h"
#include "tests/ui/gestures.h"
#include "tests/ui/journey.h"
#include "tests/unit/suite.h"
#include "ui/workspace/camera_moves.h"

using namespace volumen;
using volumen::tests::Journey;

class TestFirstPictures : public tests::CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void aSeriesOpensAsItIsRead_data();
  void aSeriesOpensAsItIsRead();
  void theChestIsProjectedWindowedAndPointedAt();
};

void TestFirstPictures::aSeriesOpensAsItIsRead_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<QString>("view");
  QTest::addColumn<int>("mode");
  QTest::addColumn<QString>("unit");
  const auto row = [](const char* name, const char* path, const char* view, Mode mode, const char* unit) {
    QTest::newRow(name) << QString::fromLatin1(path) << QString::fromLatin1(view) << int(mode)
                        << QString::fromLatin1(unit);
  };
  row("thin functional MR", "dicom-geometry/mr-fmri-ge-50", "inferior", Mode::mip, "");
  row("few slices far apart", "dicom-geometry/mr-qt2-multiecho-7", "inferior", Mode::mip, "");
  row("PET", "pet-ct/sts019-pet", "anterior", Mode::mip, "SUV");
  row("PET, one slice", "pet-ct/pet-bqml-fdg.dcm", "inferior", Mode::mip, "Bq/ml");
  row("MR of a head", "mr-head-siemens-gap-175", "anterior", Mode::mip, "");
  row("CT of a head, tilted", "dicom-geometry/ct-ge-tilt-varspacing-28", "anterior", Mode::composite, "HU");
  row("one slice", "dicom-ts-cornerstone/CT1_J2KR", "inferior", Mode::composite, "HU");
}

void TestFirstPictures::aSeriesOpensAsItIsRead() {
  QFETCH(QString, path);
  QFETCH(QString, view);
  QFETCH(int, mode);
  QFETCH(QString, unit);
  const std::string data = tests::dataPath(path.toStdString());
  NEED_DATA(data);
  Journey w({QString::fromStdString(data)});
  Session& session = w.window.session();
  session.prefer([](Preferences& p) { p.tableIn3d = true; });  // otherwise a second picture follows the first
  QTRY_VERIFY_WITH_TIMEOUT(!session.workspace().series.empty(), tests::longest);
  // A series that opens as frames has a 3D picture, too.
  if (QAction* asFrames = w.child<QAction>("showAsFrames"); asFrames->isChecked()) {
    asFrames->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(session.series() != nullptr, tests::longest);
    session.setFocus(sceneViewId);
  }
  QVERIFY(w.settle());
  w.shot(QTest::currentDataTag());
  QCOMPARE(int(w.window.session().scene().mode), mode);
  QCOMPARE(QString::fromStdString(w.window.session().series()->series.unit), unit);
  const auto nameOfView = [&] { return QString::fromStdString(viewName(w.window.view()->camera())); };
  const QString first = nameOfView();
  // A tilted stack is seen along its normal, which has no name.
  if (!first.isEmpty()) QCOMPARE(first, view);
  const bool pet = w.window.session().series()->series.modality == "PT";
  const QImage picture = w.window.view()->picture();
  QCOMPARE(qGray(picture.pixel(3, 3)), pet ? 255 : 0);
  // After a turn, the reset restores the first view.
  w.after("viewRight");
  w.after("resetView");
  QCOMPARE(nameOfView(), first);
  QVERIFY(w.window.view()->picture() == picture);
}

void TestFirstPictures::theChestIsProjectedWindowedAndPointedAt() {
  const std::string data = tests::dataPath("ct-chest-lidc0314-138");
  NEED_DATA(data);
  tests::openAlone();
  Journey w({QString::fromStdString(data)});
  w.window.session().prefer([](Preferences& p) { p.tableIn3d = true; });
  QVERIFY(w.settle());
  w.shot("chest");
  VolumeView* view = w.window.view();
  const QImage first = view->picture();
  auto* hover = w.child<QLabel>("hoverText");
  QVERIFY(hover);
  const auto valueAt = [&](QPoint at) {
    tests::hover(view, QPointF(at) + QPointF(0.5, 0.5));  // centre of the pixel's ray
    return hover->text().section(QLatin1Char(' '), 0, 0).toDouble();
  };
  // Where the picture is bright, no value below the foot of the curve is seen.
  const double foot = 152;  // foot of CT-Bones
  int seen = 0;
  for (int y = 60; y < view->height() - 60; y += 20)
    for (int x = 60; x < view->width() - 60; x += 20)
      if (qGray(first.pixel(x, y)) > 120) {
        const double value = valueAt({x, y});
        QVERIFY2(value >= foot, qPrintable(hover->text()));
        ++seen;
      }
  QVERIFY(seen > 10);

  auto* mode = w.child<QComboBox>("mode");
  const QImage mip = w.after([&] {
    mode->setFocus();
    QTest::keyClick(mode, Qt::Key_Down);
  });
  w.shot("chest-mip");
  QVERIFY(mip != first);
  QTest::keyClick(view, Qt::Key_W);
  const QPointF from(view->rect().center());
  const QImage brighter = w.after([&] { tests::drag(view, from, from - QPointF(0, 30)); });
  QVERIFY(brighter != mip);
  w.shot("chest-mip-windowed");
  QVERIFY(w.after("undo") == mip);
  const QImage back = w.after("undo");
  QVERIFY(w.window.session().scene() == w.window.session().series()->firstScene);
  QCOMPARE(back.size(), first.size());
  QVERIFY(back == first);
  if (!qEnvironmentVariableIsSet("VOLUMEN_SHOTS")) return;  // saves the README's picture
  w.after([&] { w.window.resize(1440, 900); });
  w.after("layoutPlanes");
  QTest::qWait(500);
  w.shot("window");
}

VOLUMEN_TEST(TestFirstPictures);
#include "tst_first_pictures.moc"
