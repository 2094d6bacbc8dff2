// Guards design.md 11: several 3D views, each with its own scene, share one set of voxels.
#include <QMenu>
#include <set>

#include "tests/ui/gestures.h"
#include "tests/ui/journey.h"
#include "tests/unit/suite.h"
#include "ui/views/flat_view.h"
#include "ui/views/view_grid.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr ViewId leftView = firstComparedId, rightView = firstComparedId + 1;

// Two 3D views of one series side by side, chosen in the views' own menus.
struct TwoVolumes {
  std::vector<std::weak_ptr<StoredVoxels>> made;  // written by the render thread until it waits
  Journey w{{}, services()};

  Services services() {
    Services services = realServices();
    services.makeDraw = [this, real = services.makeDraw](const VoxelsPtr& voxels) {
      made.push_back(voxels);
      return real(voxels);
    };
    return services;
  }
  Session& session() { return w.window.session(); }
  View* view(ViewId id) { return w.window.views()->viewOf(id); }
  VolumeView* volume(ViewId id) { return qobject_cast<VolumeView*>(view(id)); }
  bool isDrawn(ViewId id) {
    return QTest::qWaitFor([&] { return volume(id) && volume(id)->picture().size() == volume(id)->pixels(); },
                           longest);
  }
  // Chooses an entry of its context menu.
  bool choose(ViewId id, const char* action) {
    const char* name = volume(id) ? "volumeMenu" : "flatMenu";
    QTest::mouseClick(view(id), Qt::RightButton, {}, {90, 90});
    auto* menu = w.child<QMenu>(name);
    if (!menu) return false;
    QAction* entry = nullptr;
    for (QAction* each : menu->actions())
      if (each->objectName() == QLatin1String(action) && each->isEnabled()) entry = each;
    if (entry) entry->trigger();
    delete menu;
    return entry;
  }
  bool shown() {
    w.window.open({QStringLiteral("phantom:ct-head:48")});
    if (!w.settle()) return false;
    w.child<QAction>("layoutTwo")->trigger();
    const Series series = *seriesIn(session().workspace(), leftView);
    session().setFocus(rightView);
    session().showAgain(series, rightView);
    return choose(leftView, "show3D") && isDrawn(leftView) && choose(rightView, "show3D") &&
           isDrawn(rightView);
  }
  /// Waits until both views have the same width. With an odd number of pixels one is wider.
  bool open() {
    if (!shown()) return false;
    const auto isEven = [this] { return volume(leftView)->width() == volume(rightView)->width(); };
    if (!isEven()) w.window.resize(w.window.width() + 1, w.window.height());
    return QTest::qWaitFor(isEven, longest);
  }
};

}  // namespace

class TestVolumeViews : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aViewShowsWhatItsMenuSays();
  void eachHasItsOwnScene();
  void panelsWorkOnTheOneInFocus();
  void theyShareOneSetOfVoxels();
  void whatIsCutGoesFromAll();
  void viewsOfTheGroupStayAsTheyAre();
  void closingTheSeriesMakesThemPlanesAgain();
  void fourAreDrawn();
};

void TestVolumeViews::aViewShowsWhatItsMenuSays() {
  TwoVolumes t;
  QVERIFY(t.open());
  t.w.shot("two-volumes");
  QVERIFY(t.choose(leftView, "showCoronal"));
  QVERIFY(t.session().workspace().view(leftView).kind == ViewKind::coronal);
  auto* flat = qobject_cast<FlatView*>(t.view(leftView));
  QVERIFY(flat && flat->isVisible());
  QTRY_VERIFY_WITH_TIMEOUT(flat->picture().size() == flat->pixels(), longest);
  QVERIFY(flat->overlays().topRight.contains(QStringLiteral("Coronal, reformatted")));
  t.w.shot("plane-and-volume");
  t.w.child<QAction>("undo")->trigger();
  QVERIFY(t.session().workspace().view(leftView).kind == ViewKind::volume);
  QVERIFY(t.volume(leftView)->isVisible() && !flat->isVisible());
  QVERIFY(t.isDrawn(leftView));
}

void TestVolumeViews::eachHasItsOwnScene() {
  TwoVolumes t;
  QVERIFY(t.open());
  const Scene before = t.session().sceneOf(rightView), other = t.session().sceneOf(leftView);
  QVERIFY2(before == other, "the second begins as the one that the panels work on");
  // The window system may cause further requests for new views. Waits until both are at rest and equal.
  QTRY_VERIFY_WITH_TIMEOUT(t.volume(leftView)->picture() == t.volume(rightView)->picture(), longest);
  drag(t.volume(leftView), {60, 60}, {110, 80});
  QVERIFY(t.session().sceneOf(leftView) != other);
  QVERIFY(t.session().sceneOf(rightView) == before);
  QCOMPARE(t.session().workspace().focus, leftView);
  // Keys and the menu bar act only on the view in focus.
  QVERIFY(!t.w.after("viewLeft").isNull());
  QVERIFY(t.session().sceneOf(rightView) == before);
  QVERIFY(t.volume(rightView)->picture() != t.volume(leftView)->picture());
  // Undo redraws the view even if the other one is in focus.
  const QImage turned = t.volume(leftView)->picture();
  t.session().setFocus(rightView);
  t.w.child<QAction>("undo")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(t.volume(leftView)->picture() != turned, longest);
}

void TestVolumeViews::panelsWorkOnTheOneInFocus() {
  TwoVolumes t;
  QVERIFY(t.open());
  for (const ViewId id : {leftView, rightView}) {
    QTest::mouseClick(t.volume(id), Qt::LeftButton, {}, {60, 60});
    QCOMPARE(t.w.window.view(), t.volume(id));
    QVERIFY(t.session().scene() == t.session().sceneOf(id));
    const ViewId other = id == leftView ? rightView : leftView;
    const Scene before = t.session().sceneOf(other);
    const bool wasLit = t.session().sceneOf(id).shading.lit;
    const QImage drawn = t.w.after([&] {
      t.session().edit(QStringLiteral("Lighting"), [](Scene& s) { s.shading.lit = !s.shading.lit; });
    });
    QVERIFY(!drawn.isNull());
    QVERIFY(t.session().sceneOf(other) == before);
    QVERIFY(t.session().sceneOf(id).shading.lit != wasLit);
  }
}

void TestVolumeViews::theyShareOneSetOfVoxels() {
  TwoVolumes t;
  QVERIFY(t.open());
  QVERIFY(!t.w.after("viewLeft").isNull());
  QVERIFY2(t.made.size() >= 2, "each view has caches of its own");
  std::set<VoxelsPtr> sets;
  for (const auto& voxels : t.made)
    if (const VoxelsPtr held = voxels.lock()) sets.insert(held);
  QCOMPARE(sets.size(), std::size_t(1));
  QCOMPARE((*sets.begin())->volume(), t.session().seriesOf(leftView)->volume);
  QCOMPARE(t.session().seriesOf(leftView)->volume, t.session().seriesOf(rightView)->volume);
}

void TestVolumeViews::whatIsCutGoesFromAll() {
  TwoVolumes t;
  QVERIFY(t.open());
  const VolumePtr before = t.session().seriesOf(leftView)->volume;
  t.w.child<QAction>("scissorsTool")->trigger();
  const QPoint centre = t.volume(rightView)->rect().center();
  const QImage cut = t.w.after([&] {
    QTest::mousePress(t.volume(rightView), Qt::LeftButton, {}, centre - QPoint(25, 25));
    for (const QPoint by : {QPoint(25, -25), QPoint(25, 25), QPoint(-25, 25)})
      QTest::mouseEvent(QTest::MouseMove, t.volume(rightView), Qt::LeftButton, {}, centre + by);
    QTest::mouseRelease(t.volume(rightView), Qt::LeftButton, {}, centre - QPoint(25, 25));
  });
  QVERIFY(!cut.isNull());
  // A picture of the previous volume may have come to rest in between.
  const auto isCut = [&] {
    return t.session().seriesOf(rightView) && t.session().seriesOf(rightView)->volume != before;
  };
  QVERIFY(QTest::qWaitFor(isCut, longest));
  const VolumePtr after = t.session().seriesOf(rightView)->volume;
  QCOMPARE(t.session().seriesOf(leftView)->volume, after);
  // In the end both look the same: one scene, one volume, one size.
  QTRY_VERIFY_WITH_TIMEOUT(t.volume(leftView)->picture() == t.volume(rightView)->picture(), longest);
  t.w.shot("two-volumes-cut");
}

void TestVolumeViews::viewsOfTheGroupStayAsTheyAre() {
  TwoVolumes t;
  QVERIFY(t.open());
  t.w.child<QAction>("layoutPlanes")->trigger();
  for (const ViewId id : {axialViewId, sceneViewId}) {
    t.session().setFocus(id);
    for (const char* name : {"show3D", "showAxial", "showCoronal", "showSagittal"})
      QVERIFY(!t.w.child<QAction>(name)->isEnabled());
  }
}

void TestVolumeViews::closingTheSeriesMakesThemPlanesAgain() {
  TwoVolumes t;
  QVERIFY(t.open());
  t.session().close({keyOf(*seriesIn(t.session().workspace(), leftView))});
  for (const ViewId id : {leftView, rightView})
    QVERIFY(t.session().workspace().view(id).kind == ViewKind::axial);
  QVERIFY(t.session().workspace().series.empty());
}

void TestVolumeViews::fourAreDrawn() {
  TwoVolumes t;
  QVERIFY(t.open());
  t.w.child<QAction>("layoutFour")->trigger();
  const Series series = *seriesIn(t.session().workspace(), leftView);
  const ViewId behind = leftView + 4;
  for (ViewId id = rightView + 1; id < behind; ++id) {
    t.session().setFocus(id);
    QVERIFY(t.session().showAgain(series, id));
    QVERIFY(t.choose(id, "show3D"));
  }
  for (ViewId id = leftView; id < behind; ++id) QVERIFY(t.isDrawn(id));
  t.w.shot("four-volumes");
}

VOLUMEN_TEST(TestVolumeViews);
#include "tst_volume_views.moc"
