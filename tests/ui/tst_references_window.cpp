// Guards window.md "Objects that refer to pictures": they are listed, presentation states, key images,
// reports, contours and segmentations reach the screen, by real events on real files; pixels are those that
// the data's README states.
#include <QDockWidget>
#include <QMenu>
#include <QSlider>
#include <QTemporaryDir>
#include <QTextBrowser>
#include <QTreeWidget>
#include <cmath>

#include "tests/fixtures/fixtures.h"
#include "tests/ui/gestures.h"
#include "tests/ui/journey.h"
#include "tests/unit/suite.h"
#include "ui/controller/open_session.h"
#include "ui/panels/report_dialog.h"
#include "ui/panels/studies_panel.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

const char* const ct = "dicom-pydicom/test_files/CT_small.dcm";
const char* const presentation = "dicom-2d/made-here/pr-on-CT_small.dcm";
const char* const keyObjects = "dicom-2d/made-here/ko-on-CT_small.dcm";

// A window on files of the data.
struct References2d : Journey {
  explicit References2d(const std::vector<const char*>& files) {
    window.resize(1440, 900);
    QStringList paths;
    for (const char* file : files) paths << QString::fromStdString(dataPath(file));
    window.open(paths);
  }

  Session& session() { return window.session(); }
  const Workspace& workspace() { return session().workspace(); }
  SliceView* view(ViewId id = axialViewId) { return window.views()->sliceView(id); }
  QTreeWidget* tree(const char* name = "studyTree") { return child<QTreeWidget>(name); }
  QTreeWidgetItem* item(const char* text, const char* list = "studyTree") {
    return tree(list)->findItems(QLatin1String(text), Qt::MatchContains | Qt::MatchRecursive).value(0);
  }
  bool has(const char* text, const char* list = "studyTree") {
    return QTest::qWaitFor([&] { return item(text, list) != nullptr; }, longest);
  }
  void click(const char* text, const char* list = "studyTree") {
    tree(list)->scrollToItem(item(text, list));
    QTest::mouseClick(tree(list)->viewport(), Qt::LeftButton, {},
                      tree(list)->visualItemRect(item(text, list)).center());
  }
  // On the box before it.
  void tick(const char* text, const char* list) {
    tree(list)->setCurrentItem(item(text, list));
    QTest::keyClick(tree(list), Qt::Key_Space);
  }
  bool shows(const std::function<bool(const SliceView&)>& what, ViewId id = axialViewId) {
    return QTest::qWaitFor(
        [&] {
          const SliceView* v = view(id);
          return v && v->isVisible() && v->shown() && !v->picture().isNull() && what(*v);
        },
        longest);
  }
  bool showsFrame() {
    return shows([](const SliceView& v) { return v.frame() != nullptr; });
  }
  bool isPresented(bool wanted = true) {
    return shows([&](const SliceView& v) { return v.frame() && v.frame()->how.has_value() == wanted; });
  }
  // On screen once the picture is that of the workspace.
  QRgb seen(int column, int row) {
    SliceView* v = view();
    const auto isWhole = [&] { return v->picture().size() == v->pixels(); };
    if (!QTest::qWaitFor(isWhole, longest)) return 0;
    const glm::dvec2 at =
        v->plane()->pixelFromPatient(v->frame()->geometry().patientFromVoxel({column, row, 0}));
    return v->picture().pixel(int(at.x), int(at.y));
  }
  // Waits for the picture after something was done.
  bool after(const std::function<void()>& act, ViewId id = axialViewId) {
    QSignalSpy shown(view(id), &SliceView::settled);
    act();
    return !shown.isEmpty() || shown.wait(longest);
  }
  bool looksAtPixels() {
    return after([&] {
      session().change(QStringLiteral("test"), [&](Workspace& w) {
        w.view(axialViewId).flats[view()->state().series].nearest = true;
      });
    });
  }
  // A right click's menu.
  QMenu* menu(SliceView* on) {
    QTest::mouseClick(on, Qt::RightButton, {}, {200, 300});
    return QTest::qWaitFor([&] { return child<QMenu>("flatMenu") != nullptr; }, longest)
               ? child<QMenu>("flatMenu")
               : nullptr;
  }
  bool saysOnView(const char* text, ViewId id = axialViewId) {
    const Overlays o = view(id)->overlays();
    return (o.topRight + o.topLeft).join(QLatin1Char('\n')).contains(QString::fromUtf8(text));
  }
};

QAction* actionNamed(QMenu* menu, const char* text) {
  for (QAction* action : menu->actions())
    if (action->text().contains(QLatin1String(text))) return action;
  return nullptr;
}

#define NEED_REFERENCES() NEED_DATA(dataPath("dicom-2d"))

}  // namespace

class TestReferencesWindow : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theListTellsThem_data();
  void theListTellsThem();
  void theyAreCountedAgainWhenMoreIsOpen();
  void aKeyObjectGoesToItsPicture();
  void aReportIsRead();
  void aReportSaysWhatIsNotHere();
  void pixelsOfAPresentationState();
  void presentationStatesAreChosenInTheMenu();
  void aPresentationStateIsInTheSession();
  void aPictureWithoutPixelsIsNamed();
  void keyImagesAreMarkedAndListed();
  void oneAfterTheOther();
  void contoursLieOnTheirSlices();
  void contoursAreCutByOtherPlanes();
  void segmentsAreTinted();
  void lettersOfProjections_data();
  void lettersOfProjections();
};

void TestReferencesWindow::theListTellsThem_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<QString>("name");
  QTest::addColumn<QString>("details");
  const auto row = [](const char* file, const char* name, const char* details) {
    QTest::newRow(file) << QString::fromLatin1(file) << QString::fromLatin1(name)
                        << QString::fromLatin1(details);
  };
  row(presentation, "Presentation state: TEST", "its picture is not here");
  row(keyObjects, "Key objects: Of Interest", "its picture is not here");
  row("dicom-2d/sr-tid1500-on-CT_small.dcm", "Report: Imaging Measurement Report", "its picture is not here");
  row("dicom-2d/seg-overlap-on-CT2.dcm", "Segmentation: ISO_IR 192", "none of its 4 pictures is here");
  row("pet-ct/sts019-rtstruct-ct.dcm", "Contours: RTstruct", "none of its 179 pictures is here");
}

void TestReferencesWindow::theListTellsThem() {
  NEED_REFERENCES();
  QFETCH(QString, file);
  QFETCH(QString, name);
  QFETCH(QString, details);
  References2d w({file.toLatin1().constData()});
  QVERIFY(w.has(name.toLatin1().constData()));
  const QStringList lines = w.item(name.toLatin1().constData())->text(0).split(QLatin1Char('\n'));
  QCOMPARE(lines.front(), name);
  QVERIFY2(lines.back().endsWith(details), qPrintable(lines.back()));
  QVERIFY2(w.item(name.toLatin1().constData())->parent() != nullptr, "it stands under its study");
}

void TestReferencesWindow::theyAreCountedAgainWhenMoreIsOpen() {
  NEED_REFERENCES();
  References2d w({keyObjects});
  QVERIFY(w.has("its picture is not here"));
  w.window.open({QString::fromStdString(dataPath(ct))});
  QTRY_VERIFY_WITH_TIMEOUT(!w.item("its picture is not here"), longest);
  QVERIFY(w.item("Key objects: Of Interest"));
}

void TestReferencesWindow::aKeyObjectGoesToItsPicture() {
  NEED_REFERENCES();
  References2d w({"dicom-2d/sc-rgb-41.dcm", ct, keyObjects});
  QVERIFY(w.has("Key objects: Of Interest") && w.has("CT (1)") && w.showsFrame());
  w.click("Key objects: Of Interest");
  QVERIFY(w.shows([](const SliceView& v) {
    return v.frame() && v.frame()->slice->series.modality == "CT" &&
           v.frame()->key.series == v.state().series;
  }));
  QVERIFY(w.saysOnView("\u2605 Key image"));
  QCOMPARE(w.workspace().keyImages.size(), std::size_t(0));
  w.shot("key-object");
}

void TestReferencesWindow::aReportIsRead() {
  NEED_REFERENCES();
  References2d w({"dicom-2d/sr-tid1500-groups-on-CT_small.dcm", "dicom-2d/sc-rgb-41.dcm", ct});
  QVERIFY(w.has("Report") && w.has("CT (1)") && w.showsFrame());
  w.click("Report");
  QTRY_VERIFY_WITH_TIMEOUT(w.child<ReportDialog>("reportDialog"), longest);
  auto* text = w.child<QTextBrowser>("reportText");
  const QString said = text->toPlainText();
  for (const char* part : {"LungNodule0001", "10 mm", "Aorta0001", "20 mm", "-119.07", "HU", "Vertebra0001",
                           "200 mm\u00b3", "123.5, 234.1, -23.7 mm"})
    QVERIFY2(said.contains(QString::fromUtf8(part)), qPrintable(said));
  if (const QString shots = qEnvironmentVariable("VOLUMEN_SHOTS"); !shots.isEmpty())
    w.child<ReportDialog>("reportDialog")->grab().save(shots + QStringLiteral("/report.png"));
  // By the keyboard, as a mouse would: to the first link, and on it.
  text->setFocus();
  QTest::keyClick(text, Qt::Key_Tab);
  QTest::keyClick(text, Qt::Key_Return);
  QVERIFY(w.shows([](const SliceView& v) { return v.frame() && v.frame()->slice->series.modality == "CT"; }));
}

void TestReferencesWindow::aReportSaysWhatIsNotHere() {
  NEED_REFERENCES();
  References2d w({"dicom-2d/sr-tid1500-on-CT_small.dcm"});
  QVERIFY(w.has("Report"));
  QVERIFY2(w.child<Banner>("banner")->isHidden(), "there is something to see");
  w.click("Report");
  QTRY_VERIFY_WITH_TIMEOUT(w.child<ReportDialog>("reportDialog"), longest);
  auto* text = w.child<QTextBrowser>("reportText");
  QVERIFY2(text->toPlainText().contains(QStringLiteral("is not here")), qPrintable(text->toPlainText()));
  QVERIFY(!text->toHtml().contains(QStringLiteral("href")));
}

void TestReferencesWindow::pixelsOfAPresentationState() {
  NEED_REFERENCES();
  References2d w({ct, presentation});
  QVERIFY(w.has("Presentation state: TEST") && w.has("CT (1)"));
  w.click("Presentation state: TEST");
  QVERIFY(w.isPresented() && w.looksAtPixels());
  const auto isGrey = [&](int column, int row, int grey) {
    const QRgb seen = w.seen(column, row);
    return qRed(seen) == grey && qGreen(seen) == grey && qBlue(seen) == grey;
  };
  QVERIFY2(isGrey(51, 51, 157), qPrintable(QString::number(w.seen(51, 51), 16)));
  QVERIFY2(isGrey(64, 64, 50), qPrintable(QString::number(w.seen(64, 64), 16)));
  QVERIFY2(isGrey(20, 11, 0), "under the shutter");
  // Pixel (x, y) is drawn at (y, x).
  SliceView* view = w.view();
  const auto at = [&](int column, int row) {
    return view->plane()->pixelFromPatient(view->frame()->geometry().patientFromVoxel({column, row, 0}));
  };
  QVERIFY(at(10, 100).x > at(10, 20).x && at(100, 10).y > at(20, 10).y);
  QVERIFY(std::abs(at(10, 100).y - at(10, 20).y) < 1e-6);
  // The circle about (64, 64) of radius 20, drawn over the picture.
  const QImage screen = view->grab().toImage();
  const double ratio = view->devicePixelRatioF();
  const auto brightest = [&](glm::dvec2 p) {
    int most = 0;
    for (int dy = -2; dy <= 2; ++dy)
      for (int dx = -2; dx <= 2; ++dx)
        most = std::max(most, qGray(screen.pixel(int(p.x / ratio) + dx, int(p.y / ratio) + dy)));
    return most;
  };
  const auto ofCorner = [&](double x, double y) {  // 0, 0 is the corner of the first pixel
    return view->plane()->pixelFromPatient(view->frame()->geometry().patientFromVoxel({x - 0.5, y - 0.5, 0}));
  };
  for (const double angle : {0.3, 1.9, 3.5, 5.1}) {
    const glm::dvec2 p = ofCorner(64 + 20 * std::cos(angle), 64 + 20 * std::sin(angle));
    QVERIFY2(brightest(p) > 230, qPrintable(QString::number(brightest(p))));
  }
  QVERIFY(w.saysOnView("Presentation TEST"));
  w.shot("presentation");
}

void TestReferencesWindow::presentationStatesAreChosenInTheMenu() {
  NEED_REFERENCES();
  References2d w({ct, presentation});
  QVERIFY(w.has("Presentation state: TEST") && w.has("CT (1)"));
  w.click("Presentation state: TEST");
  QVERIFY(w.isPresented());
  QMenu* menu = w.menu(w.view());
  QVERIFY(menu);
  auto* choices = menu->findChild<QMenu*>(QStringLiteral("presentationMenu"));
  QVERIFY(choices);
  QVERIFY(actionNamed(choices, "TEST") && actionNamed(choices, "TEST")->isChecked());
  actionNamed(choices, "None")->trigger();
  menu->close();
  QVERIFY(w.isPresented(false));
  QVERIFY(w.workspace().view(axialViewId).flats.at(w.view()->state().series).presentation.empty());
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.isPresented(true));
}

void TestReferencesWindow::aPresentationStateIsInTheSession() {
  NEED_REFERENCES();
  References2d w({ct, presentation});
  QVERIFY(w.has("Presentation state: TEST") && w.has("CT (1)"));
  w.click("Presentation state: TEST");
  QVERIFY(w.isPresented());
  const QTemporaryDir folder;
  const QString file = folder.filePath(QStringLiteral("s.volumen"));
  QVERIFY(saveSession(file.toStdString(), w.workspace()));
  // Its own file alone is read again: the studies of the session name the picture only.
  References2d again({});
  again.window.open({file});
  QVERIFY(again.isPresented());
}

void TestReferencesWindow::aPictureWithoutPixelsIsNamed() {
  NEED_REFERENCES();
  References2d w({"dicom-2d/pr-without-pixels"});
  QVERIFY(w.has("Presentation state: PRESENTATION"));
  w.child<Banner>("banner")->hide();
  w.click("Presentation state: PRESENTATION");
  const QString said = w.child<Banner>("banner")->sentence();
  QVERIFY2(said.contains(QStringLiteral("can be shown")) && said.contains(QStringLiteral("cr.dcm")) &&
               said.contains(QStringLiteral("without pixel data")),
           qPrintable(said));
  QVERIFY(w.workspace().series.empty());
}

void TestReferencesWindow::keyImagesAreMarkedAndListed() {
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
  // Only on its own frame.
  QVERIFY(w.after([&] { QTest::keyClick(w.view(), Qt::Key_Down); }));
  QVERIFY(!w.saysOnView("Key image"));
  w.child<QAction>("undo")->trigger();
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.workspace().keyImages.empty());
  w.child<QAction>("redo")->trigger();
  QCOMPARE(w.workspace().keyImages.size(), std::size_t(1));
  QVERIFY(w.shows([](const SliceView& v) { return v.frame() && v.frame()->key.index == 1; }));
  QTest::keyClick(&w.window, Qt::Key_K);
  QVERIFY(w.workspace().keyImages.empty() && !w.item("frame 2", "keyImageList"));
}

void TestReferencesWindow::oneAfterTheOther() {
  NEED_REFERENCES();
  References2d w({"dicom-2d/us-palette-cine-10.dcm"});
  QVERIFY(w.showsFrame());
  const auto frameIs = [&](int index) {
    return w.shows([&](const SliceView& v) { return v.frame() && v.frame()->key.index == index; });
  };
  for (const int index : {2, 7, 4}) {
    w.session().change(QStringLiteral("test"), [&](Workspace& workspace) {
      workspace.view(axialViewId).flats[w.view()->state().series].frame = index;
    });
    QVERIFY(frameIs(index));
    QTest::keyClick(&w.window, Qt::Key_K);
  }
  // In the order of the list, and round again.
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

void TestReferencesWindow::contoursLieOnTheirSlices() {
  NEED_DATA(dataPath("pet-ct"));
  openAlone(false);
  References2d w({"pet-ct/sts019-ct", "pet-ct/sts019-rtstruct-ct.dcm"});
  QVERIFY(w.has("Contours: RTstruct"));
  QVERIFY(w.shows([](const SliceView&) { return true; }));
  const auto red = [&](ViewId id) {
    const QImage screen = w.view(id)->grab().toImage();
    int count = 0;
    for (int y = 0; y < screen.height(); ++y)
      for (int x = 0; x < screen.width(); ++x) {
        const QRgb c = screen.pixel(x, y);
        count += qRed(c) > 180 && qGreen(c) < 60 && qBlue(c) < 60;
      }
    return count;
  };
  const auto goTo = [&](double z) {
    const ShownSeriesPtr shown = w.session().seriesOf(axialViewId);
    Crosshair crosshair = crosshairOf(w.workspace(), *shown);
    crosshair.at.z = z;
    w.session().change(
        QStringLiteral("test"),
        withCrosshair(w.workspace(), axialViewId, frameOfReference(shown->series), crosshair, crosshair));
  };
  goTo(-150.42);
  const int lines = red(axialViewId);  // of the crosshair, which is none of them
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

void TestReferencesWindow::contoursAreCutByOtherPlanes() {
  NEED_DATA(dataPath("pet-ct"));
  openAlone(false);
  References2d w({"pet-ct/sts019-ct", "pet-ct/sts019-rtstruct-ct.dcm"});
  QVERIFY(w.has("Contours: RTstruct"));
  QVERIFY(w.shows([](const SliceView&) { return true; }, coronalViewId));
  w.click("Contours: RTstruct");
  QTRY_VERIFY_WITH_TIMEOUT(w.item("GTV_Mass_CT", "regionList"), longest);
  const auto row = w.item("GTV_Mass_CT", "regionList");
  w.tree("regionList")->scrollToItem(row);
  const QPoint middle = w.tree("regionList")->visualItemRect(row).center();
  QTest::mouseClick(w.tree("regionList")->viewport(), Qt::LeftButton, {}, middle);
  QTest::mouseDClick(w.tree("regionList")->viewport(), Qt::LeftButton, {}, middle);
  const ShownSeriesPtr shown = w.session().seriesOf(axialViewId);
  // The contour at z -150.42, x -35.400 .. -6.104, y -89.356 .. -64.941, is the middle one.
  const glm::dvec3 at = crosshairOf(w.workspace(), *shown).at;
  QVERIFY2(std::abs(at.z + 150.42) < 1e-2 && at.x > -35.4 && at.x < -6.1 && at.y > -89.36 && at.y < -64.94,
           qPrintable(QStringLiteral("%1 %2 %3").arg(at.x).arg(at.y).arg(at.z)));
  QVERIFY(w.shows([](const SliceView&) { return true; }, sagittalViewId));
  w.shot("contours-cut");
  openAlone();
}

void TestReferencesWindow::segmentsAreTinted() {
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

void TestReferencesWindow::lettersOfProjections_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<QStringList>("letters");  // left, right, top, bottom
  QTest::newRow("MLO, P\\FL") << QStringLiteral("dicom-2d/mg-sigmoid-voilut3.dcm")
                              << QStringList{QStringLiteral("A"), QStringLiteral("P"), QStringLiteral("SR"),
                                             QStringLiteral("IL")};
  QTest::newRow("CC, R\\P") << QStringLiteral("dicom-2d/mg-ermf-overlay-shutter.dcm")
                            << QStringList{QStringLiteral("L"), QStringLiteral("R"), QStringLiteral("A"),
                                           QStringLiteral("P")};
  QTest::newRow("not said") << QStringLiteral("dicom-2d/cr-hip-mono2-jpeg12.dcm")
                            << QStringList{QString(), QString(), QString(), QString()};
}

void TestReferencesWindow::lettersOfProjections() {
  NEED_REFERENCES();
  QFETCH(QString, file);
  QFETCH(QStringList, letters);
  References2d w({file.toLatin1().constData()});
  QVERIFY(w.showsFrame());
  const Overlays o = w.view()->overlays();
  QCOMPARE((QStringList{o.left, o.right, o.top, o.bottom}), letters);
  w.shot(qPrintable(QStringLiteral("letters-") + QString::fromLatin1(QTest::currentDataTag()).left(2)));
}

VOLUMEN_TEST(TestReferencesWindow);
#include "tst_references_window.moc"
