// Guards design.md 11: several 3D views, each with a scene of its own, over one set of voxels.
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

constexpr ViewId left = firstComparedId, right = firstComparedId + 1;

// Two views beside each other, by the views' own menus both 3D, of one series.
struct TwoVolumes {
  std::vector<std::weak_ptr<StoredVoxels>> made;  // of the render thread until it waits
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
  // By a right click into it.
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
  bool open() {
    w.window.open({QStringLiteral("phantom:ct-head:48")});
    if (!w.settle()) return false;
    w.child<QAction>("layoutTwo")->trigger();
    const Series series = *seriesIn(session().workspace(), left);
    session().setFocus(right);
    session().showAgain(series, right);
    return choose(left, "show3D") && isDrawn(left) && choose(right, "show3D") && isDrawn(right);
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
  QVERIFY(t.choose(left, "showCoronal"));
  QVERIFY(t.session().workspace().view(left).kind == ViewKind::coronal);
  auto* flat = qobject_cast<FlatView*>(t.view(left));
  QVERIFY(flat && flat->isVisible());
  QTRY_VERIFY_WITH_TIMEOUT(flat->picture().size() == flat->pixels(), longest);
  QVERIFY(flat->overlays().topRight.contains(QStringLiteral("Coronal, reformatted")));
  t.w.shot("plane-and-volume");
  t.w.child<QAction>("undo")->trigger();
  QVERIFY(t.session().workspace().view(left).kind == ViewKind::volume);
  QVERIFY(t.volume(left)->isVisible() && !flat->isVisible());
  QVERIFY(t.isDrawn(left));
}

void TestVolumeViews::eachHasItsOwnScene() {
  TwoVolumes t;
  QVERIFY(t.open());
  const Scene before = t.session().sceneOf(right), other = t.session().sceneOf(left);
  QVERIFY2(before == other, "the second begins as the one that the panels work on");
  // What the window system does to new views may ask for pictures once more: until both are at rest, and
  // alike.
  QTRY_VERIFY_WITH_TIMEOUT(t.volume(left)->picture() == t.volume(right)->picture(), longest);
  drag(t.volume(left), {60, 60}, {110, 80});
  QVERIFY(t.session().sceneOf(left) != other);
  QVERIFY(t.session().sceneOf(right) == before);
  QCOMPARE(t.session().workspace().focus, left);
  // By key and from the menu bar, in the view in focus alone.
  QVERIFY(!t.w.after("viewLeft").isNull());
  QVERIFY(t.session().sceneOf(right) == before);
  QVERIFY(t.volume(right)->picture() != t.volume(left)->picture());
  // Undone although the other one is in focus: it is drawn all the same.
  const QImage turned = t.volume(left)->picture();
  t.session().setFocus(right);
  t.w.child<QAction>("undo")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(t.volume(left)->picture() != turned, longest);
}

void TestVolumeViews::panelsWorkOnTheOneInFocus() {
  TwoVolumes t;
  QVERIFY(t.open());
  for (const ViewId id : {left, right}) {
    QTest::mouseClick(t.volume(id), Qt::LeftButton, {}, {60, 60});
    QCOMPARE(t.w.window.view(), t.volume(id));
    QVERIFY(t.session().scene() == t.session().sceneOf(id));
    const ViewId other = id == left ? right : left;
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
  QCOMPARE((*sets.begin())->volume(), t.session().seriesOf(left)->volume);
  QCOMPARE(t.session().seriesOf(left)->volume, t.session().seriesOf(right)->volume);
}

void TestVolumeViews::whatIsCutGoesFromAll() {
  TwoVolumes t;
  QVERIFY(t.open());
  const VolumePtr before = t.session().seriesOf(left)->volume;
  t.w.child<QAction>("scissorsTool")->trigger();
  const QPoint centre = t.volume(right)->rect().center();
  const QImage cut = t.w.after([&] {
    QTest::mousePress(t.volume(right), Qt::LeftButton, {}, centre - QPoint(25, 25));
    for (const QPoint by : {QPoint(25, -25), QPoint(25, 25), QPoint(-25, 25)})
      QTest::mouseEvent(QTest::MouseMove, t.volume(right), Qt::LeftButton, {}, centre + by);
    QTest::mouseRelease(t.volume(right), Qt::LeftButton, {}, centre - QPoint(25, 25));
  });
  QVERIFY(!cut.isNull());
  // A picture of before may have come to rest in between.
  const auto isCut = [&] {
    return t.session().seriesOf(right) && t.session().seriesOf(right)->volume != before;
  };
  QVERIFY(QTest::qWaitFor(isCut, longest));
  const VolumePtr after = t.session().seriesOf(right)->volume;
  QCOMPARE(t.session().seriesOf(left)->volume, after);
  // Both look the same at last: one scene, one volume, one size.
  QTRY_VERIFY_WITH_TIMEOUT(t.volume(left)->picture() == t.volume(right)->picture(), longest);
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
  t.session().close({keyOf(*seriesIn(t.session().workspace(), left))});
  for (const ViewId id : {left, right}) QVERIFY(t.session().workspace().view(id).kind == ViewKind::axial);
  QVERIFY(t.session().workspace().series.empty());
}

void TestVolumeViews::fourAreDrawn() {
  TwoVolumes t;
  QVERIFY(t.open());
  t.w.child<QAction>("layoutFour")->trigger();
  const Series series = *seriesIn(t.session().workspace(), left);
  const ViewId behind = left + 4;
  for (ViewId id = right + 1; id < behind; ++id) {
    t.session().setFocus(id);
    QVERIFY(t.session().showAgain(series, id));
    QVERIFY(t.choose(id, "show3D"));
  }
  for (ViewId id = left; id < behind; ++id) QVERIFY(t.isDrawn(id));
  t.w.shot("four-volumes");
}

VOLUMEN_TEST(TestVolumeViews);
#include "tst_volume_views.moc"
