// Guards segments in 3D views, by real events. Shown segments are drawn as render() draws the scene, in their
// colour and opacity, without masked tissue. They are picked, undone, saved and opened.
#include <QTextBrowser>

#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "ui/workspace/camera_moves.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/series_segments.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr glm::dvec3 pSmall(12), pHollow(-5);  // centres of the balls
constexpr double offItsVoxels = 1;             // mm that a surface may differ from its ball

// The balls as segments, without the volume unless `volumeShown`. The hollow ball and the small ball are red,
// the core is green.
struct In3dWindow : SegmentWindow {
  std::optional<ScreenPicture> rest;  // last picture at rest

  explicit In3dWindow(bool volumeShown = false) {
    QObject::connect(window.view(), &VolumeView::drawn, window.view(), [this](const ScreenPicture& picture) {
      if (picture.atRest) rest = picture;
    });
    if (!volumeShown)
      session().edit(QStringLiteral("nothing"), [](Scene& s) {
        for (CurvePoint& p : s.transferFunction.points) p.opacity = 0;
      });
  }

  VolumeView* scene() { return window.view(); }
  // Returns true once the picture at rest is that of the present scene.
  bool isDrawn() {
    return idle() && QTest::qWaitFor(
                         [this] {
                           if (!rest) return false;
                           Scene now = scenes().scene(sceneViewId);
                           if (!now.camera) now.camera = rest->scene.camera;
                           return rest->scene == now && rest->image.size() == scene()->pixels();
                         },
                         longest);
  }
  // Returns the picture at rest, or null if there is none.
  QImage picture() { return isDrawn() ? rest->image : QImage(); }
  void set(int number, const std::function<void(Segment&)>& change) {
    session().change(QStringLiteral("test"), withSegmentChanged(workspace(), series(), number, change));
  }
  bool makeColoured() {
    if (!makeBoth()) return false;
    set(1, [](Segment& s) { s.colour = glm::u8vec3(255, 0, 0); });
    set(2, [](Segment& s) { s.colour = glm::u8vec3(0, 255, 0); });
    return isDrawn();
  }
  QPointF pixelOf(glm::dvec3 p) {
    const glm::dvec2 at = seenAt(scene()->camera(), {double(scene()->width()), double(scene()->height())}, p);
    return QPointF(at.x, at.y).toPoint();
  }
  QColor at(glm::dvec3 p) { return rest->image.pixelColor(pixelOf(p).toPoint()); }
  bool isRed(glm::dvec3 p) { return at(p).red() > at(p).green() + 40; }
  bool isGreen(glm::dvec3 p) { return at(p).green() > at(p).red() + 40; }
  bool isBlack(glm::dvec3 p) { return at(p) == QColor(Qt::black); }
  const OccupancyField* field(int number) {
    for (const SurfaceFields::Entry& made : scenes().surfaces().entries())
      if (made.key.number == number) return made.value.get();
    return nullptr;
  }
};

// Renders the scene of a picture with render().
QImage renderOf(const ScreenPicture& picture) {
  RenderOptions options;
  options.size = {picture.image.width(), picture.image.height()};
  options.quality = picture.quality;
  const Draw draw = drawWithCaches(std::make_shared<StoredVoxels>(picture.volume));
  const Result<Drawn> drawn = draw(picture.scene, options, {});
  return drawn ? toImage(drawn->picture) : QImage();
}

}  // namespace

class TestSegmentsIn3d : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsShownIsDrawn();
  void allOfThemAreInSlicesAlone();
  void colourAndOpacityAreThoseOfTheSegment();
  void aPictureIsThatOfItsScene_data();
  void aPictureIsThatOfItsScene();
  void changedVoxelsAreDrawnAnew();
  void onlyWhatChangedIsMadeAgain();
  void allViewsOfTheSeriesDrawThem();
  void thePointerSeesThem();
  void toolsOfTheSurfaceWorkOnThem();
  void whatIsCutIsMissing();
  void projectionsSayThatTheyShowNone();
  void effectsNameWhatWasCancelled();
};

void TestSegmentsIn3d::whatIsShownIsDrawn() {
  In3dWindow w;
  const QImage none = w.picture();
  QVERIFY(!none.isNull() && w.isBlack(pSmall));
  QVERIFY(w.makeColoured());
  const QImage both = w.rest->image;
  QVERIFY(w.isRed(pSmall) && w.isRed(pHollow));
  w.shot("segments-in-3d");
  w.tick(0, 0);
  QVERIFY(w.isDrawn());
  QVERIFY2(w.isBlack(pSmall) && w.isGreen(pHollow), "the core is no longer hidden");
  w.tick(1, 0);
  QVERIFY(w.picture() == none);
  w.undo(), w.undo();
  QVERIFY(w.picture() == both);
  w.redo(), w.redo();
  QVERIFY(w.picture() == none);
}

void TestSegmentsIn3d::allOfThemAreInSlicesAlone() {
  In3dWindow w;
  QVERIFY(!w.button("segmentsIn3d")->isEnabled());
  const QImage none = w.picture();
  QVERIFY(w.makeColoured());
  const QImage both = w.rest->image;
  auto* in3d = w.button("segmentsIn3d");
  QVERIFY(in3d->isEnabled() && in3d->isChecked());
  const int steps = w.steps();
  w.click("segmentsIn3d");
  QCOMPARE(w.steps(), steps + 1);
  QVERIFY(!w.map()->in3d && w.segment(0).visible);
  QVERIFY(w.picture() == none);
  w.undo();
  QVERIFY(in3d->isChecked() && w.picture() == both);
  w.redo();
  QVERIFY(!in3d->isChecked() && w.picture() == none);
  // Segments made meanwhile are shown only in slices, too.
  QVERIFY(w.make(400, 600, "segmentReplace"));
  QVERIFY(!w.map()->in3d && w.picture() == none);
  w.click("segmentsIn3d");
  QVERIFY(w.isDrawn() && w.rest->image != none);
}

void TestSegmentsIn3d::colourAndOpacityAreThoseOfTheSegment() {
  In3dWindow w;
  const QImage none = w.picture();
  QVERIFY(w.makeColoured());
  const QImage red = w.rest->image;
  const int bright = w.at(pSmall).red();
  w.set(1, [](Segment& s) { s.colour = glm::u8vec3(0, 255, 0); });
  QVERIFY(w.isDrawn() && w.isGreen(pSmall));
  w.undo();
  QVERIFY(w.picture() == red);
  w.set(1, [](Segment& s) { s.opacity = 0.3; });
  QVERIFY(w.isDrawn());
  QVERIFY2(w.isRed(pSmall) && w.at(pSmall).red() < bright, "what lies behind is black");
  QVERIFY2(w.at(pHollow).green() > 40, "the core is seen through the shell");
  w.set(1, [](Segment& s) { s.opacity = 0; });
  w.tick(1, 0);
  QVERIFY(w.picture() == none);
}

void TestSegmentsIn3d::aPictureIsThatOfItsScene_data() {
  QTest::addColumn<double>("opacity");
  QTest::addColumn<bool>("volumeShown");
  QTest::addColumn<bool>("perspective");
  QTest::addColumn<bool>("clipped");
  QTest::newRow("opaque, alone") << 1.0 << false << false << false;
  QTest::newRow("translucent, alone") << 0.4 << false << false << false;
  QTest::newRow("translucent in the volume, in perspective") << 0.4 << true << true << false;
  QTest::newRow("opaque, cut open") << 1.0 << false << false << true;
  QTest::newRow("translucent, cut open in the volume") << 0.4 << true << false << true;
}

void TestSegmentsIn3d::aPictureIsThatOfItsScene() {
  QFETCH(double, opacity);
  QFETCH(bool, volumeShown);
  QFETCH(bool, perspective);
  QFETCH(bool, clipped);
  In3dWindow w(volumeShown);
  QVERIFY(w.makeColoured());
  w.set(1, [opacity](Segment& s) { s.opacity = opacity; });
  w.session().edit(sceneViewId, QStringLiteral("test"), [&](Scene& s) {
    if (perspective) s.camera = withProjection(w.scene()->camera(), Projection::perspective);
    if (clipped) s.clip.planes = {{{0, -1, 0}, 5}};  // through the middle of the hollow ball
  });
  const QImage drawn = w.picture();
  QVERIFY(!drawn.isNull());
  QCOMPARE(w.rest->factor, 1.0);
  QCOMPARE(w.rest->scene.segments.size(), std::size_t(2));
  QVERIFY(drawn == renderOf(*w.rest));
  ScreenPicture without = *w.rest;
  without.scene.segments.clear();
  QVERIFY(drawn != renderOf(without));
}

void TestSegmentsIn3d::changedVoxelsAreDrawnAnew() {
  In3dWindow w;
  QVERIFY(w.makeColoured());
  const QImage before = w.rest->image;
  QVERIFY(w.step("grow"));
  const QImage grown = w.picture();
  QVERIFY(!grown.isNull() && grown != before);
  QVERIFY(w.step("largest"));
  QVERIFY(w.isDrawn());
  QVERIFY2(w.isBlack(pSmall) && w.isRed(pHollow), "the small ball is an island");
  w.undo();
  QVERIFY(w.picture() == grown);
  w.undo();
  QVERIFY(w.picture() == before);
  QVERIFY(w.press("segmentRemove"));
  QVERIFY(w.isDrawn());
  QVERIFY(w.isBlack(pSmall) && w.isGreen(pHollow) && !w.field(1));
  w.undo();
  QVERIFY(w.picture() == before);
}

void TestSegmentsIn3d::onlyWhatChangedIsMadeAgain() {
  In3dWindow w;
  QVERIFY(w.makeColoured());
  const auto* one = w.field(1);
  const auto* two = w.field(2);
  QVERIFY(one && two);
  // Holds the surfaces, so that no new one gets the same address.
  const std::vector<SurfaceFields::Entry> kept = w.scenes().surfaces().entries();
  w.set(1, [](Segment& s) { s.opacity = 0.5; });
  QVERIFY(w.isDrawn());
  QVERIFY(w.field(1) == one && w.field(2) == two);
  QVERIFY(w.step("largest"));
  QVERIFY(w.field(1) != one && w.field(2) == two);
}

void TestSegmentsIn3d::allViewsOfTheSeriesDrawThem() {
  In3dWindow w;
  QVERIFY(w.makeColoured());
  w.child<QAction>("layoutTwo")->trigger();
  w.session().setFocus(firstComparedId);
  w.session().showAs(firstComparedId, ViewKind::volume);
  auto* other = w.window.views()->viewAs<VolumeView>(firstComparedId);
  QVERIFY(other);
  QTRY_COMPARE_WITH_TIMEOUT(w.scenes().segments(firstComparedId).size(), std::size_t(2), longest);
  const auto isRedThere = [&] {
    const QImage& picture = other->picture();
    if (picture.size() != other->pixels()) return false;
    const glm::dvec2 p = seenAt(other->camera(), {double(other->width()), double(other->height())}, pSmall);
    const QColor c = picture.pixelColor(int(p.x), int(p.y));
    return c.red() > c.green() + 40;
  };
  QTRY_VERIFY_WITH_TIMEOUT(isRedThere(), longest);
  w.set(1, [](Segment& s) { s.visible = false; });
  QTRY_VERIFY_WITH_TIMEOUT(!isRedThere(), longest);
}

void TestSegmentsIn3d::thePointerSeesThem() {
  In3dWindow w;
  const QPointF small = w.pixelOf(pSmall);
  QVERIFY(!w.scene()->pickAt(small));
  QVERIFY(w.makeColoured());
  w.set(1, [](Segment& s) { s.label = "B\xc3\xa4lle"; });
  const auto hit = w.scene()->pickAt(small);
  QVERIFY(hit && hit->pPatient && hit->segment);
  QVERIFY(std::abs(glm::distance(*hit->pPatient, pSmall) - 3) < offItsVoxels);
  QSignalSpy hovered(w.scene(), &VolumeView::hovered);
  hover(w.scene(), small);
  QVERIFY(!hovered.isEmpty());
  const QString said = hovered.last().value(0).toString();
  QVERIFY2(said.startsWith(QString::fromUtf8("B\xc3\xa4lle: ")), qPrintable(said));
  // A click into the view in focus moves the planes to the picked position.
  w.session().setFocus(sceneViewId);
  QTest::mouseClick(w.scene(), Qt::LeftButton, {}, small.toPoint());
  QVERIFY(glm::distance(crosshairOf(w.workspace(), *w.session().series()).at, *hit->pPatient) < 1e-6);
  w.tick(0, 0);
  QVERIFY(!w.scene()->pickAt(small));
}

void TestSegmentsIn3d::toolsOfTheSurfaceWorkOnThem() {
  In3dWindow w;
  QVERIFY(w.makeColoured());
  w.session().setFocus(sceneViewId);
  w.MeasureWindow::choose(ShapeKind::length);
  drag(w.scene(), w.pixelOf(pSmall), w.pixelOf(pHollow));
  QCOMPARE(w.all().size(), std::size_t(1));
  const std::vector<glm::dvec3>& ends = w.last().shape.points;
  QVERIFY(std::abs(glm::distance(ends[0], pSmall) - 3) < offItsVoxels);
  QVERIFY(std::abs(glm::distance(ends[1], pHollow) - 10) < offItsVoxels);
  QCOMPARE(w.last().shape.softMm, std::optional(0.0));
}

void TestSegmentsIn3d::whatIsCutIsMissing() {
  In3dWindow w;
  QVERIFY(w.makeColoured());
  const QImage before = w.rest->image;
  const auto labels = w.map()->labels;
  w.session().setFocus(sceneViewId);
  w.child<QAction>("scissorsTool")->trigger();
  const QPointF middle = w.pixelOf(pSmall);
  const double r = std::abs(w.pixelOf(pSmall + glm::dvec3(5, 0, 0)).x() - middle.x());
  QTest::mousePress(w.scene(), Qt::LeftButton, {}, (middle + QPointF(-r, -r)).toPoint());
  for (const QPointF by : {QPointF(r, -r), QPointF(r, r), QPointF(-r, r), QPointF(-r, -r)})
    QTest::mouseEvent(QTest::MouseMove, w.scene(), Qt::LeftButton, {}, (middle + by).toPoint());
  QTest::mouseRelease(w.scene(), Qt::LeftButton, {}, (middle + QPointF(-r, -r)).toPoint());
  QVERIFY(w.isDrawn());
  QVERIFY2(w.isBlack(pSmall) && w.isRed(pHollow), "the small ball is cut away");
  QVERIFY2(w.map()->labels == labels, "its voxels stay");
  w.undo();
  QVERIFY(w.picture() == before);
}

void TestSegmentsIn3d::projectionsSayThatTheyShowNone() {
  In3dWindow w;
  w.session().edit(sceneViewId, QStringLiteral("MIP"), [](Scene& s) { s.mode = Mode::mip; });
  const QImage without = w.picture();
  QVERIFY(w.makeColoured());
  QVERIFY(w.rest->image == without);
  const QString effects = w.child<QTextBrowser>("effectsPanel")->toPlainText();
  QVERIFY2(effects.contains(QStringLiteral("a projection of values has no surfaces")), qPrintable(effects));
}

// The message stays until the check box "In 3D" is turned off and on again.
void TestSegmentsIn3d::effectsNameWhatWasCancelled() {
  In3dWindow w;
  QVERIFY(w.makeColoured());
  const auto effects = [&] { return w.child<QTextBrowser>("effectsPanel")->toPlainText(); };
  QVERIFY(!effects().contains(QStringLiteral("Not drawn in 3D")));
  SegmentMap map = *w.map();
  BitMask mask = w.mask(1);
  mask.set({0, 0, 0});
  w.session().change(QStringLiteral("test"), withSegmentMap(w.workspace(), withMask(map, 1, mask)));
  int cancelled = 0;
  for (const JobRow& row : w.window.jobs().rows())
    if (row.text.contains(QStringLiteral("surfaces"))) w.window.jobs().cancel(row.id), ++cancelled;
  QCOMPARE(cancelled, 1);
  QVERIFY2(effects().contains(QStringLiteral("Making their surfaces was cancelled")), qPrintable(effects()));
  QVERIFY(w.isDrawn() && w.isBlack(pSmall));
  QVERIFY(effects().contains(QStringLiteral("Not drawn in 3D")));
  w.click("segmentsIn3d"), w.click("segmentsIn3d");
  QVERIFY(w.isDrawn() && w.isRed(pSmall));
  QVERIFY(!effects().contains(QStringLiteral("Not drawn in 3D")));
}

VOLUMEN_TEST(TestSegmentsIn3d);
#include "tst_segments_in_3d.moc"
