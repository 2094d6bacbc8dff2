// Guards window.md "Open objects that refer to pictures": key images are marked, listed and stepped through.
// Real events on real files.
#include <QDir>
#include <QDockWidget>
#include <QLabel>
#include <QTemporaryDir>
#include <algorithm>

#include "io/export/dicom_series.h"
#include "tests/ui/derived_2d.h"
#include "tests/unit/suite.h"
#include "viewer/phantoms/phantoms.h"

using namespace volumen;
using namespace volumen::tests;

class TestKeyImages : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void keyImagesAreMarkedAndListed();
  void oneAfterTheOther();
  void slicesOfAnUnevenStack();
};

void TestKeyImages::keyImagesAreMarkedAndListed() {
  NEED_REFERENCES();
  References2d w({"dicom-2d/us-palette-cine-10.dcm"});
  QVERIFY(w.showsFrame());
  QVERIFY(w.after([&] { QTest::keyClick(w.view(), Qt::Key_Down); }));
  QVERIFY(!w.saysOnView("Key image"));
  QTest::keyClick(&w.window, Qt::Key_K);
  QVERIFY(w.saysOnView("\u2605 Key image"));
  const KeyImage marked = w.workspace().keyImages.at(0);
  QCOMPARE(marked.frame, 1);
  QCOMPARE(marked.sopInstanceUid, w.workspace().series.at(marked.series).series->sopInstanceUids.at(1));
  QVERIFY(w.item("frame 2", "keyImageList"));
  // The mark appears only on its own frame.
  QVERIFY(w.after([&] { QTest::keyClick(w.view(), Qt::Key_Down); }));
  QVERIFY(!w.saysOnView("Key image"));
  w.child<QAction>("undo")->trigger();
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.workspace().keyImages.empty());
  w.child<QAction>("redo")->trigger();
  QCOMPARE(w.workspace().keyImages.size(), std::size_t(1));
  QVERIFY(
      w.shows([](const FlatView& v) { return tests::frameIn(&v) && tests::frameIn(&v)->key.index == 1; }));
  QTest::keyClick(&w.window, Qt::Key_K);
  QVERIFY(w.workspace().keyImages.empty() && !w.item("frame 2", "keyImageList"));
}

void TestKeyImages::oneAfterTheOther() {
  NEED_REFERENCES();
  References2d w({"dicom-2d/us-palette-cine-10.dcm"});
  QVERIFY(w.showsFrame());
  const auto frameIs = [&](int index) {
    return w.shows(
        [&](const FlatView& v) { return tests::frameIn(&v) && tests::frameIn(&v)->key.index == index; });
  };
  for (const int index : {2, 7, 4}) {
    w.session().change(QStringLiteral("test"), [&](Workspace& workspace) {
      workspace.editView(axialViewId).flats.editOrAdd(w.view()->state().series).frame = index;
    });
    QVERIFY(frameIs(index));
    QTest::keyClick(&w.window, Qt::Key_K);
  }
  // Steps in the order of the list, and wraps around.
  for (const int index : {2, 7, 4}) {
    QTest::keyClick(&w.window, Qt::Key_Period);
    QVERIFY(frameIs(index));
  }
  QTest::keyClick(&w.window, Qt::Key_Comma);
  QVERIFY(frameIs(7));
  w.child<QAction>("undo")->trigger();
  QVERIFY(frameIs(4));
  auto* dock = w.child<QDockWidget>("keyImagesDock");
  dock->show();
  dock->raise();
  w.shot("key-images");
  w.click("frame 3", "keyImageList");
  QVERIFY(frameIs(2));
}

// A slice is missing. Acquired slices can be marked and shown as slices, the interpolated one cannot.
void TestKeyImages::slicesOfAnUnevenStack() {
  const QTemporaryDir dir;
  const QString folder = dir.filePath(QStringLiteral("head"));
  QVERIFY(writeDicomSeries(**makePhantom("ct-head:40"), {}, folder.toStdString()));
  const QStringList files = QDir(folder).entryList(QDir::Files, QDir::Name);
  QVERIFY(files.size() > 8 && QFile::remove(folder + QLatin1Char('/') + files[4]));
  References2d w({});
  w.window.open({folder});
  QVERIFY(w.settle());
  w.child<QAction>("layoutPlanes")->trigger();
  QVERIFY(w.shows([](const FlatView& v) { return v.series() != nullptr; }));
  const Series series = w.session().seriesOf(axialViewId)->series;
  QVERIFY(series.regular && series.regular->interpolatedSlices == 1);
  const int slices = series.regular->geometry.size.z;
  QCOMPARE(slices, int(files.size()));
  w.session().setFocus(axialViewId);
  QTest::keyClick(w.view(), Qt::Key_Home);
  QStringList said;
  for (int n = 0; n < slices; ++n) {
    const std::size_t before = w.workspace().keyImages.size();
    QTest::keyClick(&w.window, Qt::Key_K);
    if (w.workspace().keyImages.size() == before)
      said << w.child<QLabel>("toldText")->text();
    else
      QVERIFY(w.saysOnView("\u2605 Key image"));
    QTest::keyClick(w.view(), Qt::Key_Down);
  }
  QCOMPARE(said.size(), 1);
  QVERIFY2(said[0].contains(QStringLiteral("interpolated")), qPrintable(said[0]));
  std::vector<std::string> marked;
  for (const KeyImage& image : w.workspace().keyImages) marked.push_back(image.sopInstanceUid);
  // Marks go from the head down, while the series counts upwards.
  std::ranges::reverse(marked);
  QVERIFY2(marked == series.sopInstanceUids, "each slice as acquired, in their order");
  // The next is the first key image, shown in the same planes and not as a frame.
  QTest::keyClick(&w.window, Qt::Key_Period);
  QVERIFY(!showsFrames(w.view()->state().kind) && w.saysOnView("\u2605 Key image"));
}

VOLUMEN_TEST(TestKeyImages);
#include "tst_key_images.moc"
