// Guards the list of segments: any number, each added, named, coloured, hidden, locked and removed by hand in
// one undo step. Also guards how slices show them and what is exported.
#include <QColorDialog>
#include <QElapsedTimer>
#include <QFileDialog>
#include <QLineEdit>
#include <QSlider>
#include <QTemporaryDir>

#include "results/segments/region_colours.h"
#include "tests/ui/segment_window.h"
#include "tests/ui/two_series.h"
#include "tests/unit/suite.h"
#include "ui/controller/segment_layer.h"
#include "ui/widgets/banner.h"
#include "ui/workspace/series_segments.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentList : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void segmentsAreAddedAndNamed();
  void eyeAndLockAreTicked();
  void colourAndOpacityAreSet();
  void aClickChoosesTheOneThatIsWorkedOn();
  void aCopyHasItsVoxelsInAnotherMap();
  void aSegmentGoesWithItsVoxels();
  void whatCannotBeDoneSaysWhy();
  void theListSaysHowLargeTheyAre();
  void slicesShowThem();
  void theyAreCarriedOntoAnotherPlane();
  void aLargePictureTakesMilliseconds();
  void slicesShowThoseOfTheSeriesOverThem();
  void aRangeIsTintedWhileItIsTyped();
  void theyAreExportedByTheirEnding();
};

void TestSegmentList::segmentsAreAddedAndNamed() {
  SegmentWindow w;
  const Workspace before = w.workspace();
  QVERIFY(w.press("segmentAdd") && w.press("segmentAdd"));
  QCOMPARE(w.count(), std::size_t(2));
  QCOMPARE(w.segment(0).label, std::string("Segment 1"));
  QCOMPARE(w.current().number, 2);
  QVERIFY(w.segment(0).colour && w.segment(1).colour && w.segment(0).colour != w.segment(1).colour);
  const int steps = w.steps();
  w.list()->setFocus();
  QTest::keyClick(w.list(), Qt::Key_F2);
  auto* field = w.list()->findChild<QLineEdit*>();
  QVERIFY(field);
  field->setText(QStringLiteral("B\u00e4ll"));
  QTest::keyClick(field, Qt::Key_Return);
  QTRY_COMPARE(w.segment(1).label, std::string("B\xc3\xa4ll"));
  QCOMPARE(w.steps(), steps + 1);
  QCOMPARE(w.list()->topLevelItem(1)->text(0), QStringLiteral("B\u00e4ll"));
  w.undo();
  QCOMPARE(w.list()->topLevelItem(1)->text(0), QStringLiteral("Segment 2"));
  w.undo(), w.undo();
  QVERIFY(w.workspace() == before);
  QCOMPARE(w.list()->topLevelItemCount(), 0);
}

void TestSegmentList::eyeAndLockAreTicked() {
  SegmentWindow w;
  QVERIFY(w.press("segmentAdd"));
  const Workspace added = w.workspace();
  const int steps = w.steps();
  w.tick(0, 0);
  QVERIFY(!w.current().visible && !w.current().locked);
  w.tick(0, 1);
  QVERIFY(!w.current().visible && w.current().locked);
  QCOMPARE(w.steps(), steps + 2);
  w.tick(0, 0), w.tick(0, 1);
  QVERIFY(w.workspace() == added);
  QCOMPARE(w.steps(), steps + 4);
  while (w.steps() > steps) w.undo();
  QVERIFY(w.workspace() == added);
  QCOMPARE(w.list()->topLevelItem(0)->checkState(0), Qt::Checked);
}

void TestSegmentList::colourAndOpacityAreSet() {
  SegmentWindow w;
  QVERIFY(w.press("segmentAdd"));
  const int steps = w.steps();
  w.click("segmentColour");
  auto* dialog = w.child<QColorDialog>("colourDialog");
  QVERIFY(dialog);
  for (const QColor colour : {QColor(1, 2, 3), QColor(200, 100, 50)}) dialog->setCurrentColor(colour);
  dialog->accept();
  QVERIFY(w.current().colour == glm::u8vec3(200, 100, 50));
  QCOMPARE(w.steps(), steps + 1);
  auto* slider = w.child<QSlider>("segmentFill");
  slider->setFocus();
  QTest::keyClick(slider, Qt::Key_Home);
  QCOMPARE(w.current().opacity, 0.0);
  w.undo();
  QCOMPARE(w.current().opacity, 1.0);
  QCOMPARE(slider->value(), 100);
}

void TestSegmentList::aClickChoosesTheOneThatIsWorkedOn() {
  SegmentWindow w;
  QVERIFY(w.make(800, 1200) && w.make(400, 600));
  const QString core = w.child<QLabel>("segmentResult")->text();
  QVERIFY2(core.contains(QStringLiteral("mean 500")), qPrintable(core));
  QVERIFY(w.choose(0));
  QCOMPARE(w.current().number, 1);
  const QString balls = w.child<QLabel>("segmentResult")->text();
  QVERIFY2(balls.contains(QStringLiteral("mean 1000")), qPrintable(balls));
  w.undo();
  QVERIFY(w.idle());
  QCOMPARE(w.current().number, 2);
  QCOMPARE(w.list()->currentItem(), w.list()->topLevelItem(1));
  QCOMPARE(w.child<QLabel>("segmentResult")->text(), core);
}

void TestSegmentList::aCopyHasItsVoxelsInAnotherMap() {
  SegmentWindow w;
  QVERIFY(w.make(800, 1200));
  w.session().change(QStringLiteral("test"), withSegmentChanged(w.workspace(), w.series(), 1, [](Segment& s) {
                       s.label = "Bone";
                       s.type = {"272673000", "SCT", "Bone"};
                     }));
  const Workspace one = w.workspace();
  const SegmentMap first = *w.map();
  const BitMask bone = w.mask(1);
  QVERIFY(w.press("segmentDuplicate"));
  QCOMPARE(w.workspace().segmentMaps.size(), std::size_t(2));
  QVERIFY(*segmentMapOf(w.workspace(), w.series(), 0) == first);
  QCOMPARE(w.map()->number, 1);
  QCOMPARE(w.current().label, std::string("Bone (2)"));
  QVERIFY(w.current().type == first.segments[0].type && w.current().colour != first.segments[0].colour);
  QVERIFY(w.mask(w.current().number) == bone);
  QCOMPARE(w.list()->topLevelItem(1)->text(2), w.list()->topLevelItem(0)->text(2));
  w.undo();
  QVERIFY(w.workspace() == one);
}

void TestSegmentList::aSegmentGoesWithItsVoxels() {
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  const Workspace both = w.workspace();
  const BitMask core = w.mask(2);
  QVERIFY(w.press("segmentRemove"));
  QCOMPARE(w.count(), std::size_t(1));
  QVERIFY(w.voxels(1) == 0 && w.mask(2) == core);
  w.list()->setFocus();
  QTest::keyClick(w.list(), Qt::Key_Delete);
  QVERIFY(w.idle());
  QVERIFY2(w.workspace().segmentMaps.empty(), "the last takes the map with it");
  w.undo(), w.undo();
  QVERIFY(w.workspace() == both);
}

void TestSegmentList::whatCannotBeDoneSaysWhy() {
  SegmentWindow w;
  const auto says = [&](const char* name, const char* why) {
    const QAbstractButton* button = w.button(name);
    return !button->isEnabled() && button->toolTip().contains(QLatin1String(why));
  };
  QVERIFY(says("segmentRemove", "no segment yet") && says("segmentReplace", "Make or add a segment"));
  QVERIFY(says("segmentStep-grow", "Make or add a segment"));
  QVERIFY(!w.child<QAction>("exportSegments")->isEnabled());
  QVERIFY(says("segmentSave", "no segment yet"));
  QVERIFY(w.press("segmentAdd"));
  QVERIFY(w.button("segmentRemove")->isEnabled() && w.button("segmentSave")->isEnabled());
  w.chooseStep("add");
  QVERIFY(says("segmentApply", "no other segment"));
  w.tick(0, 1);
  QVERIFY(says("segmentRemove", "is locked") && says("segmentStep-grow", "is locked") &&
          says("segmentReplace", "is locked"));
}

void TestSegmentList::theListSaysHowLargeTheyAre() {
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  const auto ml = [&](int row) { return w.list()->topLevelItem(row)->text(2); };
  const auto expected = [](std::int64_t voxels) { return QLocale().toString(double(voxels) / 1000, 'f', 2); };
  QCOMPARE(ml(0), expected(voxelsWhere([](glm::dvec3 p) { return isShell(p) || isSmall(p); })));
  QCOMPARE(ml(1), expected(voxelsWhere(isCore)));
}

// In the middle of the core, the inside has half its colour and the edge all of it. It is grey beside, and if
// hidden.
void TestSegmentList::slicesShowThem() {
  SegmentWindow w;
  w.session().change(QStringLiteral("test"), [&](Workspace& after) {
    after.crosshairs.editOrAdd(frameOfReference(*after.series.at(w.series()).series)).at = glm::dvec3(-5);
  });
  const auto at = [&](glm::dvec3 p) {
    const glm::dvec2 pixel = w.view()->plane()->pixelFromPatient(p);
    return w.view()->picture().pixel(int(pixel.x), int(pixel.y));
  };
  const auto isGrey = [](QRgb c) { return qRed(c) == qGreen(c) && qGreen(c) == qBlue(c); };
  QVERIFY(w.make(400, 600));
  const glm::dvec3 middle(-5, -5, -5), beside(5, -5, -5);
  QTRY_VERIFY_WITH_TIMEOUT(!isGrey(at(middle)), longest);
  QVERIFY(isGrey(at(beside)));
  w.shot("segments-in-slices");
  w.tick(0, 0);
  QTRY_VERIFY_WITH_TIMEOUT(isGrey(at(middle)), longest);
  w.undo();
  QTRY_VERIFY_WITH_TIMEOUT(!isGrey(at(middle)), longest);
}

// A map is shown on a plane of another patient space, as if the plane lay in its own.
void TestSegmentList::theyAreCarriedOntoAnotherPlane() {
  VoxelGeometry grid;
  grid.size = {20, 20, 20};
  LabelEdit edit{LabelMap(grid)};
  for (int k = 4; k < 15; ++k)
    for (int j = 6; j < 12; ++j) edit.set({j, k, 10}, 7);
  SegmentLayer layer;
  layer.labels = std::make_shared<const LabelMap>(edit.done());
  layer.shown = {{7, qRgb(0, 255, 0), 1}};
  SlicePlane plane;
  plane.size = {40, 40};
  plane.centre = {10.25, 10.25, 10};
  QImage black(40, 40, QImage::Format_Grayscale8);
  black.fill(0);
  const QImage there = withSegments(black, plane, layer);
  layer.fromPlane.translation = {100, -50, 30};
  plane.centre -= layer.fromPlane.translation;
  QVERIFY(withSegments(black, plane, layer) == there);
  QVERIFY(there != black.convertToFormat(QImage::Format_RGB32));
}

// Three segments cover all of 512 x 512 pixels, on a turned plane. The time is printed; the bound is that of
// a slow build on a loaded machine.
void TestSegmentList::aLargePictureTakesMilliseconds() {
  VoxelGeometry grid;
  grid.size = {256, 256, 64};
  LabelMap map(grid);
  for (std::uint8_t label = 1; label <= 3; ++label) {
    BitMask slab(grid);
    for (int k = 20 * label - 20; k < 20 * label; ++k)
      for (int j = 0; j < 256; ++j)
        for (std::uint64_t& word : slab.row(j, k)) word = ~std::uint64_t(0);
    map = withLabel(map, label, slab);
  }
  SegmentLayer layer;
  layer.labels = std::make_shared<const LabelMap>(std::move(map));
  layer.shown = {{1, qRgb(255, 0, 0), 1}, {2, qRgb(0, 255, 0), 1}, {3, qRgb(0, 0, 255), 1}};
  layer.opacity = 0.5;
  SlicePlane plane;
  plane.size = {512, 512};
  plane.mmPerPixel = 0.45;
  plane.centre = grid.centre();
  plane.right = glm::normalize(glm::dvec3(1, 0.1, 0.05));
  plane.down = glm::normalize(glm::cross(glm::dvec3(0, 0.1, 1), plane.right));
  QImage picture(512, 512, QImage::Format_RGB32);
  picture.fill(Qt::gray);
  qint64 least = 1'000'000;
  for (int n = 0; n < 5; ++n) {
    QElapsedTimer timer;
    timer.start();
    QVERIFY(withSegments(picture, plane, layer) != picture);
    least = std::min(least, timer.elapsed());
  }
  qInfo("three segments over 512 x 512 pixels: %lld ms", static_cast<long long>(least));
  QVERIFY2(least < 150, qPrintable(QString::number(least)));
}

// A PET over a CT has its ball as a segment, which is shown at the same position in its colour.
void TestSegmentList::slicesShowThoseOfTheSeriesOverThem() {
  const LoadedSeriesPtr pet = petIn("A");
  MeasureWindow w(ballIn("A"));
  w.session().keep(pet);
  w.session().change(QStringLiteral("test"), withOverlay(w.session().workspace(), axialViewId, &pet->series));
  const auto layers = [&] { return w.view()->requestFor(w.view()->pixels())->segments; };
  QVERIFY(layers().empty());
  const VoxelGeometry& grid = pet->volume->geometry();
  BitMask ball(grid);
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i)
        if (pet->volume->value(i, j, k) > 0) ball.set({i, j, k});
  Segment segment;
  segment.number = 5;
  segment.colour = glm::u8vec3(0, 255, 0);
  w.session().change(QStringLiteral("test"),
                     withSegmentMap(w.session().workspace(),
                                    {keyOf(pet->series),
                                     {segment},
                                     std::make_shared<const LabelMap>(withLabel(LabelMap(grid), 5, ball)),
                                     {}}));
  QCOMPARE(layers().size(), std::size_t(1));
  QVERIFY(layers().front().fromPlane == Rigid{});
  const auto at = [&](glm::dvec3 p) {
    const glm::dvec2 pixel = w.view()->plane()->pixelFromPatient(p);
    return w.view()->picture().pixel(int(pixel.x), int(pixel.y));
  };
  const glm::dvec3 middle = w.view()->plane()->centre;
  const auto isGreen = [&](QRgb c) { return qGreen(c) > qRed(c) + 20 && qGreen(c) > qBlue(c) + 20; };
  QTRY_VERIFY_WITH_TIMEOUT(isGreen(at(middle)), longest);
  QVERIFY(!isGreen(at(middle + glm::dvec3(13, 0, 0))));
  w.undo();
  QVERIFY(layers().empty());
}

void TestSegmentList::aRangeIsTintedWhileItIsTyped() {
  SegmentWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  QCOMPARE(w.coloured(), 0);
  auto* low = w.child<QDoubleSpinBox>("segmentLow");
  low->setFocus();
  QTest::keyClick(low, Qt::Key_A, Qt::ControlModifier);
  QTest::keyClicks(low, QStringLiteral("-5"));  // includes air
  QTRY_VERIFY_WITH_TIMEOUT(w.coloured() > 100, longest);
  QVERIFY(w.workspace().segmentMaps.empty());
  w.view()->setFocus();
  QTRY_COMPARE_WITH_TIMEOUT(w.coloured(), 0, longest);
}

void TestSegmentList::theyAreExportedByTheirEnding() {
  const QTemporaryDir folder;
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  w.child<QAction>("exportSegments")->trigger();
  answer(w, "segmentDialog", folder.filePath(QStringLiteral("a.xyz")));
  QTRY_VERIFY_WITH_TIMEOUT(w.child<Banner>("banner")->sentence().contains(QStringLiteral(".seg.nrrd")),
                           longest);
  QVERIFY(!QFile::exists(folder.filePath(QStringLiteral("a.xyz"))));
  const QString path = folder.filePath(QStringLiteral("both.seg.nrrd"));
  w.child<QAction>("exportSegments")->trigger();
  answer(w, "segmentDialog", path);
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(path), longest);
  QFile file(path);
  QVERIFY(file.open(QIODevice::ReadOnly));
  const QByteArray head = file.read(4000);
  QVERIFY(head.contains("Segment0_Name:=800 to 1200 HU") && head.contains("Segment1_Name:=400 to 600 HU"));
}

VOLUMEN_TEST(TestSegmentList);
#include "tst_segment_list.moc"
