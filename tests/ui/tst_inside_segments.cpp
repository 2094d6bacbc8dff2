// Guards masking of the volume by segments in 3D views, by real events. The picture equals that of a volume
// cut by hand, while slices and segments stay whole. Masking is undone, saved, and follows segments.
#include "tests/ui/paint_window.h"
#include "tests/ui/session_folder.h"
#include "tests/unit/suite.h"
#include "ui/workspace/series_segments.h"
#include "viewer/segment/morphology.h"
#include "viewer/segment/range.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

using Tissue = TissueShown::Where;

// Segment 1 is the balls, segment 2 the core. Keeps the picture at rest of the 3D view.
struct TissueWindow : PaintWindow {
  std::optional<ScreenPicture> rest;

  TissueWindow() {
    QObject::connect(window.view(), &VolumeView::drawn, window.view(), [this](const ScreenPicture& picture) {
      if (picture.atRest) rest = picture;
    });
  }

  QComboBox* where() { return child<QComboBox>("segmentTissue"); }
  QDoubleSpinBox* margin() { return child<QDoubleSpinBox>("segmentTissueMargin"); }
  void showTissue(Tissue tissue) {
    const Qt::Key keys[] = {Qt::Key_Home, Qt::Key_Down, Qt::Key_End};  // Down: from the first entry
    QTest::keyClick(where(), keys[int(tissue)]);
  }
  void setMargin(int mm) {
    margin()->setFocus();
    QTest::keyClick(margin(), Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(margin(), QString::number(mm));
    QTest::keyClick(margin(), Qt::Key_Return);
  }
  /// Takes a brush for the core, with tissue shown only inside it. Returns false if that fails.
  bool takeBrushForCore() {
    if (!makeBoth() || !choose(1)) return false;
    tick(0, 0);
    showTissue(Tissue::inside);
    show(throughMiddle());
    setBrush(true, 6);
    take("paintTool");
    return idle();
  }
  VolumePtr whole() { return session().seriesNamed(series())->volume; }
  LoadedSeriesPtr left() {
    const auto& made = scenes().tissues().entries();
    return made.empty() || !made.front().value ? nullptr : made.front().value->left;
  }
  /// Returns the voxels kept. Valid only while some are masked.
  const BitMask& voxelsLeft() { return *scenes().tissues().entries().front().value->voxels; }

  // Returns the picture at rest of the present scene, or null if there is none.
  QImage picture() {
    const auto isOfNow = [this] {
      if (!rest || rest->image.size() != window.view()->pixels()) return false;
      Scene now = scenes().scene(sceneViewId);
      if (!now.camera) now.camera = rest->scene.camera;
      return rest->scene == now && rest->volume == scenes().series(sceneViewId)->volume;
    };
    return idle() && QTest::qWaitFor(isOfNow, longest) ? rest->image : QImage();
  }
  // Renders the same scene of a volume that is 0, its lowest value, outside `kept`.
  QImage byHand(const BitMask& kept) {
    const VolumePtr all = whole();
    const VolumePtr some = volumeOf<std::int16_t>(glm::ivec3(40), glm::dmat3(1), [&](glm::dvec3 p) {
      const glm::ivec3 v(p);
      return kept.at(v) ? double(all->value(v.x, v.y, v.z)) : 0.0;
    });
    RenderOptions options;
    options.size = {rest->image.width(), rest->image.height()};
    options.quality = rest->quality;
    const Result<Drawn> drawn =
        drawWithCaches(std::make_shared<StoredVoxels>(some))(rest->scene, options, {});
    return drawn ? toImage(drawn->picture) : QImage();
  }
  // Computes voxels within a distance by brute force over all voxels of the mask.
  BitMask nearSlowly(const BitMask& mask, double mm) {
    std::vector<glm::ivec3> in;
    BitMask made(mask.geometry());
    const auto each = [&](const auto& visit) {
      for (int k = 0; k < 40; ++k)
        for (int j = 0; j < 40; ++j)
          for (int i = 0; i < 40; ++i) visit(glm::ivec3(i, j, k));
    };
    each([&](glm::ivec3 v) {
      if (mask.at(v)) in.push_back(v);
    });
    each([&](glm::ivec3 v) {
      made.set(v, std::ranges::any_of(
                      in, [&](glm::ivec3 b) { return glm::distance(glm::dvec3(v), glm::dvec3(b)) <= mm; }));
    });
    return made;
  }
};

}  // namespace

class TestInsideSegments : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void itIsAskedForOnlyWithSegments();
  void thePictureIsThatOfAVolumeCutByHand_data();
  void thePictureIsThatOfAVolumeCutByHand();
  void slicesAndNumbersAreOfTheWhole();
  void lightIsThatOfTheWhole();
  void segmentsAreFollowed();
  void aStrokeCountsOnceItEnds();
  void aStrokeThatIsGivenUpBeginsNothing();
  void aCancelledOneIsNotBegunAgain();
  void aSeriesIsClosedMeanwhile();
  void aSessionKeepsIt();
};

void TestInsideSegments::itIsAskedForOnlyWithSegments() {
  TissueWindow w;
  QVERIFY(!w.where()->isEnabled() && !w.margin()->isEnabled());
  QVERIFY(w.where()->toolTip().contains(QStringLiteral("no segment")));
  QVERIFY(w.margin()->toolTip().contains(QStringLiteral("no segment")));
  QVERIFY(w.makeBoth());
  QVERIFY(w.where()->isEnabled() && !w.margin()->isEnabled());
  w.showTissue(Tissue::inside);
  QVERIFY(w.margin()->isEnabled());
}

void TestInsideSegments::thePictureIsThatOfAVolumeCutByHand_data() {
  QTest::addColumn<int>("hidden");  // row of the segment list
  QTest::addColumn<Tissue>("where");
  QTest::addColumn<int>("marginMm");
  QTest::addColumn<bool>("in3d");
  QTest::newRow("the core alone") << 0 << Tissue::inside << 0 << false;
  QTest::newRow("the core and what is near") << 0 << Tissue::inside << 3 << false;
  QTest::newRow("without the balls") << 1 << Tissue::outside << 0 << false;
  QTest::newRow("without the balls and what is near") << 1 << Tissue::outside << 3 << false;
  QTest::newRow("the core stays a surface") << 0 << Tissue::inside << 2 << true;
  QTest::newRow("the balls stay surfaces") << 1 << Tissue::outside << 1 << true;
}

void TestInsideSegments::thePictureIsThatOfAVolumeCutByHand() {
  QFETCH(int, hidden);
  QFETCH(Tissue, where);
  QFETCH(int, marginMm);
  QFETCH(bool, in3d);
  TissueWindow w;
  QVERIFY(w.makeBoth());
  w.tick(hidden, 0);
  if (!in3d) w.click("segmentsIn3d");
  w.session().change(QStringLiteral("test"), withSegmentChanged(w.workspace(), w.series(), 2 - hidden,
                                                                [](Segment& s) { s.opacity = 0.5; }));
  const BitMask shown = w.mask(2 - hidden);
  const QImage whole = w.picture();
  QVERIFY(!whole.isNull());
  const int steps = w.steps();
  w.showTissue(where);
  QCOMPARE(w.steps(), steps + 1);
  if (marginMm > 0) w.setMargin(marginMm);
  QCOMPARE(w.steps(), steps + (marginMm > 0 ? 2 : 1));
  const QImage drawn = w.picture();
  QVERIFY(!drawn.isNull() && drawn != whole);
  const BitMask near = w.nearSlowly(shown, marginMm);
  QVERIFY(drawn == w.byHand(where == Tissue::inside ? near : inverted(near)));
  QCOMPARE(w.rest->scene.segments.size(), std::size_t(in3d ? 1 : 0));
  w.shot("inside-segments");
  for (int n = w.steps(); n > steps; --n) w.undo();
  QCOMPARE(w.where()->currentIndex(), 0);
  QVERIFY(w.picture() == whole);
  while (w.steps() < steps + (marginMm > 0 ? 2 : 1)) w.redo();
  QCOMPARE(w.margin()->value(), double(marginMm));
  QVERIFY(w.picture() == drawn);
}

void TestInsideSegments::slicesAndNumbersAreOfTheWhole() {
  TissueWindow w;
  QVERIFY(w.makeBoth());
  const VolumePtr whole = w.whole();
  w.tick(0, 0);
  w.showTissue(Tissue::inside);
  QVERIFY(w.idle());
  QVERIFY(w.scenes().series(sceneViewId)->volume != whole);
  QVERIFY(w.session().seriesOf(axialViewId)->volume == whole);
  QVERIFY(w.scenes().series(axialViewId)->volume == whole);
  QVERIFY2(w.make(800, 1200), "tissue that is left out is found all the same");
  QCOMPARE(w.voxels(w.current().number), voxelsWhere([](glm::dvec3 p) { return isShell(p) || isSmall(p); }));
}

void TestInsideSegments::lightIsThatOfTheWhole() {
  TissueWindow w;
  QVERIFY(w.makeBoth());
  QVERIFY(!w.picture().isNull());
  QVERIFY(!w.rest->scene.shading.gradientFloor && !w.rest->scene.window);
  w.tick(0, 0);
  w.showTissue(Tissue::inside);
  QVERIFY(!w.picture().isNull());
  const LoadedSeries& series = *w.session().series();
  QCOMPARE(w.rest->scene.shading.gradientFloor, std::optional(series.valueSpread / 32));
  QVERIFY(w.rest->scene.window == series.window);
  QVERIFY2(!w.session().sceneOf(sceneViewId).shading.gradientFloor, "the workspace keeps its scene");
}

void TestInsideSegments::segmentsAreFollowed() {
  TissueWindow w;
  QVERIFY(w.makeBoth());
  w.showTissue(Tissue::inside);
  QVERIFY(w.idle() && w.voxelsLeft() == united(w.mask(1), w.mask(2)));
  w.tick(0, 0);
  QVERIFY(w.idle() && w.voxelsLeft() == w.mask(2));
  QVERIFY(w.choose(1));
  const QImage core = w.picture();
  QVERIFY(w.step("grow"));
  QVERIFY(w.idle() && w.voxelsLeft() == w.mask(2));
  QVERIFY(w.picture() != core);
  w.undo();
  QVERIFY(w.picture() == core);
  // Colours and names do not change the masked volume.
  const LoadedSeriesPtr before = w.left();
  w.session().change(QStringLiteral("test"),
                     withSegmentChanged(w.workspace(), w.series(), 2, [](Segment& s) { s.label = "Kern"; }));
  QVERIFY(w.idle() && w.left() == before);
  QVERIFY(w.SegmentWindow::press("segmentRemove"));
  QVERIFY(w.idle() && w.voxelsLeft().empty());
  QVERIFY(w.SegmentWindow::press("segmentRemove"));
  QVERIFY2(!w.map() && w.scenes().tissues().entries().empty(), "without segments all of it is shown");
  QVERIFY(w.scenes().series(sceneViewId)->volume == w.whole());
  w.undo(), w.undo();
  QVERIFY(w.picture() == core);
}

void TestInsideSegments::aStrokeCountsOnceItEnds() {
  TissueWindow w;
  QVERIFY(w.takeBrushForCore());
  const LoadedSeriesPtr before = w.left();
  const auto labels = w.map()->labels;
  const std::vector<QPoint> way = w.pixelsOf(throughBall, axialViewId);
  w.press(way[0]);
  for (const QPoint at : way) {
    w.move(at);
    QVERIFY(w.idle());
    QVERIFY(w.map()->labels != labels && w.left() == before);
  }
  w.release(way.back());
  QTRY_VERIFY_WITH_TIMEOUT(w.left() != before, longest);
  QVERIFY(w.idle() && w.voxelsLeft() == w.mask(2));
}

void TestInsideSegments::aStrokeThatIsGivenUpBeginsNothing() {
  TissueWindow w;
  QVERIFY(w.takeBrushForCore());
  const LoadedSeriesPtr before = w.left();
  int begun = 0;
  QObject::connect(&w.window.jobs(), &Jobs::changed, w.view(), [&] {
    for (const JobRow& row : w.window.jobs().rows()) begun += row.text.startsWith(QStringLiteral("Leaving"));
  });
  const std::vector<QPoint> way = w.pixelsOf(throughBall, axialViewId);
  const auto labels = w.map()->labels;
  w.press(way[0]);
  w.move(way.back());
  QVERIFY(w.map()->labels != labels);
  QTest::keyClick(w.view(), Qt::Key_Escape);
  w.release(way.back());
  QTest::qWait(50);
  QVERIFY(w.idle() && w.map()->labels == labels);
  QCOMPARE(begun, 0);
  QVERIFY(w.left() == before);
}

void TestInsideSegments::aCancelledOneIsNotBegunAgain() {
  TissueWindow w;
  QVERIFY(w.makeBoth());
  w.showTissue(Tissue::inside);
  const std::vector<JobRow> rows = w.window.jobs().rows();
  QCOMPARE(rows.size(), std::size_t(1));
  w.window.jobs().cancel(rows.front().id);
  QTest::qWait(20);
  QVERIFY(w.window.jobs().rows().empty() && !w.left());
  QVERIFY(w.scenes().series(sceneViewId)->volume == w.whole());
  w.setMargin(1);
  QVERIFY(w.idle() && w.left());
}

void TestInsideSegments::aSeriesIsClosedMeanwhile() {
  TissueWindow w;
  QVERIFY(w.makeBoth());
  const SeriesKey series = w.series();
  w.showTissue(Tissue::inside);
  w.session().close({series});
  QVERIFY(w.scenes().tissues().entries().empty());
  QVERIFY(w.idle() && w.scenes().tissues().entries().empty());
}

void TestInsideSegments::aSessionKeepsIt() {
  const SessionFolder folder;
  Journey w({folder.ct()});
  QVERIFY(w.settle());
  Session& session = w.window.session();
  const VolumePtr volume = session.series()->volume;
  const SeriesKey key = keyOf(session.series()->series);
  Workspace with = withNewSegment(session.workspace(), key, volume->geometry(), {});
  with = withSegmentMap(with, withMask(*segmentMapOf(with, key), 1, voxelsInRange(*volume, {690, 710})));
  with = withTissueShown(withSegmentsIn3d(with, key, false), key, {Tissue::inside, 2.5});
  const auto isLeft = [](Journey& j) {
    return QTest::qWaitFor(
        [&] { return j.window.jobs().rows().empty() && j.window.document().drawn.tissue(sceneViewId); },
        longest);
  };
  const QImage whole = w.window.view()->picture();
  w.settled.clear();
  session.change(QStringLiteral("test"), with);
  QVERIFY(isLeft(w) && w.settle());
  QVERIFY(w.window.view()->picture() != whole);
  QVERIFY(folder.save(w));
  Journey again;
  QVERIFY(folder.open(again) && isLeft(again));
  const SegmentMap* map = segmentMapOf(again.window.session().workspace(), key);
  QVERIFY(map && map->tissue == (TissueShown{Tissue::inside, 2.5}));
  QVERIFY(again.window.document().drawn.tissues().entries().front().value->left->volume->stored() ==
          w.window.document().drawn.tissues().entries().front().value->left->volume->stored());
}

VOLUMEN_TEST(TestInsideSegments);
#include "tst_inside_segments.moc"
