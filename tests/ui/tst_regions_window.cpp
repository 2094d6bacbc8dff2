// Guards window.md "Open objects that refer to pictures": contours and segments lie over slices. Real events
// on real files.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QTemporaryDir>
#include <cmath>

#include "tests/ui/derived_2d.h"
#include "tests/unit/suite.h"
#include "ui/workspace/flat_plane.h"

using namespace volumen;
using namespace volumen::tests;

class TestRegionsWindow : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void contoursLieOnTheirSlices();
  void contoursAreCutByOtherPlanes();
  void segmentsAreTinted();
  void whatIsWrongWithThemIsTold();
};

void TestRegionsWindow::contoursLieOnTheirSlices() {
  NEED_DATA(dataPath("pet-ct"));
  openAlone(false);
  References2d w({"pet-ct/sts019-ct", "pet-ct/sts019-rtstruct-ct.dcm"});
  QVERIFY(w.has("Contours: RTstruct"));
  QVERIFY(w.shows([](const FlatView&) { return true; }));
  // Sums red in units of full red pixels, so that strokes between pixels count the same.
  const auto red = [&](ViewId id) {
    const QImage screen = w.view(id)->grab().toImage();
    int sum = 0;
    for (int y = 0; y < screen.height(); ++y)
      for (int x = 0; x < screen.width(); ++x) {
        const QRgb c = screen.pixel(x, y);
        const int redder = qRed(c) - std::max(qGreen(c), qBlue(c));
        sum += redder > 100 ? redder : 0;
      }
    return sum / 255;
  };
  const auto goTo = [&](double z) {
    const LoadedSeriesPtr shown = w.session().seriesOf(axialViewId);
    Crosshair crosshair = crosshairOf(w.workspace(), *shown);
    crosshair.at.z = z;
    w.session().change(
        QStringLiteral("test"),
        withCrosshair(w.workspace(), axialViewId, frameOfReference(shown->series), crosshair, crosshair));
  };
  goTo(-150.42);
  const int lines = red(axialViewId);  // lines of the crosshair, which are no contours
  w.click("Contours: RTstruct");
  QTRY_VERIFY_WITH_TIMEOUT(w.item("GTV_Mass_CT", "regionList"), longest);
  QTRY_VERIFY_WITH_TIMEOUT(red(axialViewId) > lines + 100, longest);
  w.shot("contours");
  // Beyond the last contour, at z -127.53, there is none.
  goTo(-127.53 + 3.27);
  QVERIFY(red(axialViewId) <= lines);
  goTo(-127.53 + 0.4 * 3.27);
  QVERIFY2(red(axialViewId) > lines + 50, "within half a spacing it is still the contour's");
  goTo(-150.42);
  w.tick("GTV_Mass_CT", "regionList");
  QTRY_VERIFY_WITH_TIMEOUT(red(axialViewId) <= lines, longest);
  w.child<QAction>("undo")->trigger();
  QVERIFY(red(axialViewId) > lines + 100);
  openAlone();
}

void TestRegionsWindow::contoursAreCutByOtherPlanes() {
  NEED_DATA(dataPath("pet-ct"));
  openAlone(false);
  References2d w({"pet-ct/sts019-ct", "pet-ct/sts019-rtstruct-ct.dcm"});
  QVERIFY(w.has("Contours: RTstruct"));
  QVERIFY(w.shows([](const FlatView&) { return true; }, coronalViewId));
  w.click("Contours: RTstruct");
  QTRY_VERIFY_WITH_TIMEOUT(w.item("GTV_Mass_CT", "regionList"), longest);
  const auto row = w.item("GTV_Mass_CT", "regionList");
  w.tree("regionList")->scrollToItem(row);
  const QPoint middle = w.tree("regionList")->visualItemRect(row).center();
  QTest::mouseClick(w.tree("regionList")->viewport(), Qt::LeftButton, {}, middle);
  QTest::mouseDClick(w.tree("regionList")->viewport(), Qt::LeftButton, {}, middle);
  const LoadedSeriesPtr shown = w.session().seriesOf(axialViewId);
  // The contour at z -150.42, x -35.400 .. -6.104, y -89.356 .. -64.941, is the middle one.
  const glm::dvec3 at = crosshairOf(w.workspace(), *shown).at;
  QVERIFY2(std::abs(at.z + 150.42) < 1e-2 && at.x > -35.4 && at.x < -6.1 && at.y > -89.36 && at.y < -64.94,
           qPrintable(QStringLiteral("%1 %2 %3").arg(at.x).arg(at.y).arg(at.z)));
  QVERIFY(w.shows([](const FlatView&) { return true; }, sagittalViewId));
  w.shot("contours-cut");
  openAlone();
}

void TestRegionsWindow::segmentsAreTinted() {
  NEED_REFERENCES();
  References2d w({ct, "dicom-2d/seg-on-CT_small.dcm"});
  QVERIFY(w.has("Segmentation") && w.has("CT (1)"));
  w.child<QAction>("showAsFrames")->trigger();
  if (!w.view() || !w.view()->isVisible()) w.click("CT (1)");
  QTRY_VERIFY_WITH_TIMEOUT(w.child<QAction>("showAsFrames")->isEnabled(), longest);
  if (!w.child<QAction>("showAsFrames")->isChecked()) w.child<QAction>("showAsFrames")->trigger();
  QVERIFY(w.showsFrame() && w.looksAtPixels());
  const auto tinted = [&] {
    int count = 0;
    for (int y = 0; y < 128; ++y)
      for (int x = 0; x < 128; ++x) {
        const QRgb c = w.seen(x, y);
        count += qRed(c) != qGreen(c) || qGreen(c) != qBlue(c);
      }
    return count;
  };
  QCOMPARE(tinted(), 0);
  w.click("Segmentation");
  QTRY_COMPARE_WITH_TIMEOUT(tinted(), 1832, longest);
  w.shot("segments");
  auto* slider = w.child<QSlider>("segmentOpacity");
  slider->setFocus();
  QVERIFY(w.after([&] { QTest::keyClick(slider, Qt::Key_End); }));
  const RegionsLook look = w.workspace().regions.begin()->second;
  QCOMPARE(look.opacity, 1.0);
  w.tick("first segment", "regionList");
  QTRY_COMPARE_WITH_TIMEOUT(tinted(), 0, longest);
  w.child<QAction>("undo")->trigger();
  QTRY_COMPARE_WITH_TIMEOUT(tinted(), 1832, longest);
}

// Writes its single frame twice.
void TestRegionsWindow::whatIsWrongWithThemIsTold() {
  NEED_REFERENCES();
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("twice.dcm"));
  DcmFileFormat file;
  QVERIFY(file.loadFile(dataPath("dicom-2d/seg-on-CT_small.dcm").c_str()).good());
  DcmDataset& data = *file.getDataset();
  DcmSequenceOfItems* frames = nullptr;
  QVERIFY(data.findAndGetSequence(DCM_PerFrameFunctionalGroupsSequence, frames).good());
  QCOMPARE(frames->card(), 1ul);
  QVERIFY(frames->append(new DcmItem(*frames->getItem(0))).good());
  QVERIFY(data.putAndInsertString(DCM_NumberOfFrames, "2").good());
  const Uint8* bits = nullptr;
  unsigned long count = 0;
  QVERIFY(data.findAndGetUint8Array(DCM_PixelData, bits, &count).good());
  std::vector<Uint8> twice(bits, bits + count);
  twice.insert(twice.end(), bits, bits + count);
  QVERIFY(data.putAndInsertUint8Array(DCM_PixelData, twice.data(), count * 2).good());
  QVERIFY(file.saveFile(path.toUtf8().constData()).good());
  References2d w({});
  w.window.open({QString::fromStdString(dataPath(ct)), path});
  QVERIFY(w.has("Segmentation"));
  w.click("Segmentation");
  QVERIFY(w.has("first segment", "regionList"));
  QTreeWidgetItem* note = w.item("repeat a place of their segment (1)", "regionList");
  QVERIFY(note && note->text(0).startsWith(QStringLiteral("! Frames of ")));
  const Workspace before = w.workspace();
  QTest::mouseDClick(w.tree("regionList")->viewport(), Qt::LeftButton, {},
                     w.tree("regionList")->visualItemRect(note).center());
  QVERIFY(w.workspace() == before);
}

VOLUMEN_TEST(TestRegionsWindow);
#include "tst_regions_window.moc"
