// Guards a second series over the first, colour maps, and the layout in which a series opens. Real events on
// a real PET and its CT.
#include <QComboBox>
#include <QInputDialog>
#include <QMenu>
#include <QSlider>
#include <QTreeWidget>

#include "tests/ui/fusion_window.h"
#include "tests/ui/gestures.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/tools/tool.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/camera_moves.h"
#include "ui/workspace/windows.h"

using namespace volumen;
using volumen::tests::fusedFolder;
using volumen::tests::Journey;
using volumen::tests::longest;
using volumen::tests::PetCtWindow;
using volumen::tests::UsualLayouts;

namespace {

// The CT of a study, with its PET only in the list.
struct CtAlone : PetCtWindow {
  CtAlone() : PetCtWindow(QStringList{fusedFolder("ct")}) {
    window.document().loader.open(fusedFolder("pet"));
  }

  bool opened() {
    return QTest::qWaitFor(
        [this] { return window.session().series() && window.document().open.volumes().size() == 2; },
        longest);
  }
  // Clicks a series. If `again`, the click is the second of a double-click.
  void choose(const QString& what, bool again = false) {
    auto* tree = child<QTreeWidget>("studyTree");
    for (QTreeWidgetItemIterator it(tree); *it; ++it)
      if ((*it)->text(0).startsWith(what) && (*it)->childCount() == 0) {
        const QRect place = tree->visualItemRect(*it);
        if (again)
          QTest::mouseDClick(tree->viewport(), Qt::LeftButton, {}, place.center());
        else
          QTest::mouseClick(tree->viewport(), Qt::LeftButton, {}, place.center());
        return;
      }
    QFAIL("not in the list");
  }
  // Opens the menu as a press on its title does and returns an entry.
  QAction* entry(const char* menu, const QString& text) {
    auto* shown = child<QMenu>(menu);
    Q_EMIT shown->aboutToShow();
    for (QAction* action : shown->actions())
      if (action->text().startsWith(text)) return action;
    return nullptr;
  }
};

}  // namespace

class TestFusion : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void seriesOpenInTheirUsualLayout_data();
  void seriesOpenInTheirUsualLayout();
  void aLayoutThatWasChosenComesBack();
  void petOpensOverItsCt();
  void aDoubleClickChoosesOnce();
  void projectionAndSlicesHaveOneWindow();
  void overlaysAreChosenMixedAndUndone();
  void anotherFrameOfReferenceIsNoOverlay();
  void colourMapsAreShown();
  void aClickIn3dSetsTheCrosshair();
};

void TestFusion::seriesOpenInTheirUsualLayout_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<QByteArray>("layout");
  QTest::newRow("CT: planes and 3D") << QStringLiteral("ct-chest-lidc0314-138")
                                     << QByteArray(layoutName(Layout::planes));
  QTest::newRow("MR: planes and 3D") << QStringLiteral("mr-head-ge-mprage-130")
                                     << QByteArray(layoutName(Layout::planes));
  QTest::newRow("six slices: one view")
      << QStringLiteral("dicom-geometry/mr-enh-siemens-xa10") << QByteArray(layoutName(Layout::one));
}

void TestFusion::seriesOpenInTheirUsualLayout() {
  QFETCH(QString, path);
  QFETCH(QByteArray, layout);
  const std::string data = tests::dataPath(path.toStdString());
  NEED_DATA(data);
  const UsualLayouts usual;
  Journey w({QString::fromStdString(data)});
  QTRY_VERIFY_WITH_TIMEOUT(w.window.session().series() != nullptr, longest);
  QCOMPARE(QByteArray(layoutName(w.window.session().workspace().layout)), layout);
  QVERIFY2(!w.child<QAction>("undo")->isEnabled(), "opening is no step");
}

void TestFusion::aLayoutThatWasChosenComesBack() {
  const UsualLayouts usual;
  {
    Journey w({QStringLiteral("phantom:ct-head:64")});
    QTRY_VERIFY_WITH_TIMEOUT(w.window.session().series() != nullptr, longest);
    w.child<QAction>("layoutBesidePlanes")->trigger();
    w.window.close();
  }
  Journey again({QStringLiteral("phantom:ct-head:64")});
  QTRY_VERIFY_WITH_TIMEOUT(again.window.session().series() != nullptr, longest);
  QCOMPARE(again.window.session().workspace().layout, Layout::besidePlanes);
}

void TestFusion::petOpensOverItsCt() {
  NEED_DATA(tests::dataPath("pet-ct"));
  const UsualLayouts usual;
  CtAlone w;
  QVERIFY(w.opened());
  QCOMPARE(w.modality(w.workspace().view(axialViewId).series), std::string("CT"));
  w.choose(QStringLiteral("PT IBSI"));
  QTRY_COMPARE_WITH_TIMEOUT(w.modality(w.workspace().view(sceneViewId).series), std::string("PT"), longest);
  for (const ViewId id : {axialViewId, coronalViewId, sagittalViewId}) {
    QCOMPARE(w.modality(w.workspace().view(id).series), std::string("CT"));
    QCOMPARE(w.modality(w.look(id).overlay), std::string("PT"));
  }
  // The hottest voxel (dicom-2d/README.md) is shown over the CT in the hot iron colour map.
  FlatView* axial = w.window.views()->viewAs<FlatView>(axialViewId);
  const LoadedSeriesPtr ct = w.window.session().seriesOf(axialViewId);
  moveCrosshair(w.window.session(), axialViewId, *ct, {}, {-7.0312, -82.0312, -140.65});
  // The initial window is 0 to 7 SUVbw, in which the voxel would be white.
  const LoadedSeriesPtr pet = w.window.session().series();
  const double perSuv = 1 / pet->series.suv.bodyWeight.value();
  const Window first = flatWindow(w.workspace().series.at(keyOf(pet->series)), *pet);
  QVERIFY(std::abs(first.centre / perSuv - 3.5) < 1e-9 && std::abs(first.width / perSuv + 7) < 1e-9);
  w.window.session().change(QStringLiteral("test"), [&](Workspace& workspace) {
    workspace.series.edit(keyOf(pet->series)).window = Window{10 * perSuv, -20 * perSuv};
  });
  const auto at = [&] {
    const glm::dvec2 p = axial->plane()->pixelFromPatient({-7.0312, -82.0312, -140.65});
    return axial->picture().pixel(int(p.x), int(p.y));
  };
  QTRY_VERIFY_WITH_TIMEOUT(axial->picture().format() == QImage::Format_RGB32 && qRed(at()) > qBlue(at()) + 20,
                           longest);
  QSignalSpy hovered(axial, &View::hovered);
  const glm::dvec2 p =
      axial->plane()->pixelFromPatient({-7.0312, -82.0312, -140.65}) / axial->devicePixelRatioF();
  tests::hover(axial, {p.x, p.y});
  const QString text = hovered.last().first().toString();
  QVERIFY2(text.contains(QStringLiteral(" HU | 16.3")) && text.contains(QStringLiteral("SUV")),
           qPrintable(text));
  if (qEnvironmentVariableIsSet("VOLUMEN_SHOTS")) {
    QVERIFY(!w.after([&] { w.window.resize(1440, 900); }).isNull());
    QTest::qWait(500);
    w.shot("window-fusion");
  }
  for (int n = 0; n < 3; ++n) w.child<QAction>("undo")->trigger();
  QCOMPARE(w.modality(w.workspace().view(sceneViewId).series), std::string("CT"));
  QVERIFY(w.look(axialViewId).overlay.empty());
}

void TestFusion::aDoubleClickChoosesOnce() {
  NEED_DATA(tests::dataPath("pet-ct"));
  const UsualLayouts usual;
  CtAlone w;
  QVERIFY(w.opened());
  w.choose(QStringLiteral("PT IBSI"));
  QTRY_COMPARE_WITH_TIMEOUT(w.modality(w.workspace().view(sceneViewId).series), std::string("PT"), longest);
  w.choose(QStringLiteral("PT IBSI"), true);  // the second click, after the series is read
  QCOMPARE(w.modality(w.workspace().view(axialViewId).series), std::string("CT"));
  QCOMPARE(w.modality(w.look(axialViewId).overlay), std::string("PT"));
  QCOMPARE(w.window.session().undoStack().count(), 1);
}

// Holds after opening and for the preset. A window set by hand and saved as a user preset stays.
void TestFusion::projectionAndSlicesHaveOneWindow() {
  NEED_DATA(tests::dataPath("pet-ct"));
  PetCtWindow w(QStringList{fusedFolder("pet")});
  Session& session = w.window.session();
  QTRY_VERIFY_WITH_TIMEOUT(session.series() != nullptr, longest);
  const LoadedSeriesPtr pet = session.series();
  const Window ofPlanes = flatWindow(w.workspace().series.at(keyOf(pet->series)), *pet);
  const double suv = 1 / pet->series.suv.bodyWeight.value();
  QVERIFY(std::abs(endsOf(ofPlanes).dark - 7 * suv) < 1e-9 && std::abs(endsOf(ofPlanes).bright) < 1e-9);
  QCOMPARE(session.scene().mode, Mode::mip);
  QCOMPARE(session.scene().window, std::optional(ofPlanes));
  const Window wider{7.5 * suv, -15 * suv};
  session.edit(QStringLiteral("test"), [&](Scene& scene) { scene.window = wider; });
  w.child<QAction>("savePreset")->trigger();
  auto* dialog = w.child<QInputDialog>("presetNameDialog");
  QVERIFY(dialog && dialog->isVisible());
  QTest::keyClicks(dialog->findChild<QLineEdit*>(), QStringLiteral("to 15"));
  QTest::keyClick(dialog, Qt::Key_Return);
  auto* box = w.child<QComboBox>("presets");
  const auto choose = [&](const char* preset) {
    Q_EMIT box->activated(box->findData(QLatin1String(preset)));
    return QTest::qWaitFor([&] { return session.state().preset->name == preset; }, longest);
  };
  QVERIFY(choose("PET-MIP"));
  QCOMPARE(session.scene().window, std::optional(ofPlanes));
  QVERIFY(choose("to 15"));
  QCOMPARE(session.scene().window, std::optional(wider));
  w.child<QAction>("deletePreset")->trigger();
  QVERIFY(choose("auto"));
  QCOMPARE(session.scene().window, std::optional(ofPlanes));
}

void TestFusion::overlaysAreChosenMixedAndUndone() {
  NEED_DATA(tests::dataPath("pet-ct"));
  const UsualLayouts usual;
  CtAlone w;
  QVERIFY(w.opened());
  const Workspace before = w.workspace();
  QAction* pet = w.entry("overlayMenu", QStringLiteral("PT IBSI"));
  QVERIFY(pet && pet->isEnabled());
  pet->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(w.window.session().seriesNamed(w.look(axialViewId).overlay) != nullptr, longest);
  Q_EMIT w.child<QMenu>("overlayMenu")->aboutToShow();
  w.child<QSlider>("overlayOpacity")->setValue(80);
  QCOMPARE(w.look(coronalViewId).overlayOpacity, 0.8);
  w.child<QAction>("overlay_pet")->trigger();
  QCOMPARE(w.look(sagittalViewId).overlayColours, ColourMap::pet);
  QAction* none = w.entry("overlayMenu", QStringLiteral("None"));
  none->trigger();
  QVERIFY(w.look(axialViewId).overlay.empty());
  for (int n = 0; n < 4; ++n) w.child<QAction>("undo")->trigger();
  QVERIFY(w.workspace() == before);
}

void TestFusion::anotherFrameOfReferenceIsNoOverlay() {
  NEED_DATA(tests::dataPath("ct-chest-lidc0314-138"));
  CtAlone w;
  QVERIFY(w.opened());
  w.window.open({QString::fromStdString(tests::dataPath("ct-chest-lidc0314-138"))});
  QTRY_VERIFY_WITH_TIMEOUT(w.child<QTreeWidget>("studyTree")->topLevelItemCount() > 1, longest);
  w.choose(QStringLiteral("PT IBSI"));
  QTRY_COMPARE_WITH_TIMEOUT(w.modality(w.workspace().view(sceneViewId).series), std::string("PT"), longest);
  auto* menu = w.child<QMenu>("overlayMenu");
  Q_EMIT menu->aboutToShow();
  const QList<QAction*> all = menu->actions();
  QVERIFY2(std::ranges::any_of(all,
                               [](QAction* a) {
                                 return a->text().contains(QStringLiteral("another frame of reference")) &&
                                        !a->isEnabled();
                               }),
           "the reason is said");
}

void TestFusion::colourMapsAreShown() {
  Journey w;
  w.window.session().show(tests::ballSeries(32, 10));
  w.child<QAction>("layoutPlanes")->trigger();
  FlatView* axial = w.window.views()->viewAs<FlatView>(axialViewId);
  QTRY_VERIFY_WITH_TIMEOUT(!axial->picture().isNull(), longest);
  auto* menu = w.child<QMenu>("colourMenu");
  Q_EMIT menu->aboutToShow();
  QSignalSpy shown(axial, &FlatView::settled);
  w.child<QAction>("colours_hotIron")->trigger();
  QVERIFY(!shown.isEmpty() || shown.wait(longest));
  const glm::dvec2 air = axial->plane()->pixelFromPatient({-14, -14, 0.5});
  // 0 HU is grey 102 in the window 400 / 40.
  QCOMPARE(axial->picture().pixel(int(air.x), int(air.y)), colourTable(ColourMap::hotIron)[102]);
  w.child<QAction>("undo")->trigger();
  QTRY_COMPARE_WITH_TIMEOUT(axial->picture().pixel(int(air.x), int(air.y)), qRgb(102, 102, 102), longest);
}

void TestFusion::aClickIn3dSetsTheCrosshair() {
  Journey w;
  w.window.session().show(tests::ballSeries(32, 10, {3, -2, 4}));
  VolumeView* view = w.window.view();
  QTest::mouseClick(view, Qt::LeftButton, {}, view->rect().center());
  QVERIFY2(!w.child<QAction>("undo")->isEnabled(), "no plane is on screen");
  QVERIFY(!w.after("layoutPlanes").isNull());
  const auto crosshair = [&] {
    return crosshairOf(w.window.session().workspace(), *w.window.session().series());
  };
  const glm::dvec2 middle =
      seenAt(view->camera(), {double(view->width()), double(view->height())}, {3, -2, 4});
  QTest::mouseClick(view, Qt::LeftButton, {}, QPoint(int(middle.x), int(middle.y)));
  const double radius = glm::length(crosshair().at - glm::dvec3(3, -2, 4));
  QVERIFY2(std::abs(radius - 10) < 1.5, qPrintable(QString::number(radius)));  // one and a half voxel edges
  const Crosshair before = crosshair();
  tests::drag(view, view->rect().center(), view->rect().center() + QPoint(30, 0));
  QVERIFY2(crosshair() == before, "a drag turns and does not set it");
  w.child<QAction>("undo")->trigger();
  w.child<QAction>("undo")->trigger();
  QVERIFY2(crosshair() != before, "undone");
}

VOLUMEN_TEST(TestFusion);
#include "tst_fusion.moc"
