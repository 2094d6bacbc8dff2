// Guards window.md "Open objects that refer to pictures": which contours a plane shows, where it cuts others,
// and which pixels segments tint. Closed forms.
#include <glm/geometric.hpp>
#include <utility>

#include "tests/unit/suite.h"
#include "ui/controller/segment_layer.h"
#include "ui/views/contour_lines.h"

using namespace volumen;

class TestRegionsOverSlices : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void contoursNearThePlaneAreWhole_data();
  void contoursNearThePlaneAreWhole();
  void othersAreCut();
  void onlyWhatIsShownInItsFrame();
  void segmentsTintTheirPixels();
};

namespace {

// Returns a plane of 100 x 100 pixels of 1 mm about `centre`.
SlicePlane planeAt(glm::dvec3 centre, glm::dvec3 right = {1, 0, 0}, glm::dvec3 down = {0, 1, 0}) {
  SlicePlane plane;
  plane.centre = centre;
  plane.right = right;
  plane.down = down;
  plane.size = {100, 100};
  return plane;
}

// Returns a square of 20 mm about the origin, at z 5.
StructureSet square() {
  RegionOfInterest region;
  region.number = 3;
  region.colour = glm::u8vec3(255, 0, 0);
  region.frameOfReferenceUid = "1.2";
  Contour contour;
  contour.points = {{-10, -10, 5}, {10, -10, 5}, {10, 10, 5}, {-10, 10, 5}};
  region.contours = {contour};
  StructureSet set;
  set.regions = {region};
  return set;
}

std::vector<ContourLines> linesIn(const SlicePlane& plane, const RegionsLook& look = {},
                                  const std::string& frame = "1.2") {
  return contourLines(square(), look, frame, plane, 1.5);
}

}  // namespace

void TestRegionsOverSlices::contoursNearThePlaneAreWhole_data() {
  QTest::addColumn<double>("z");
  QTest::addColumn<int>("lines");
  QTest::newRow("in it") << 5.0 << 1;
  QTest::newRow("half a spacing above") << 6.5 << 1;
  QTest::newRow("half a spacing below") << 3.5 << 1;
  QTest::newRow("further above") << 6.6 << 0;
  QTest::newRow("further below") << 3.4 << 0;
}

void TestRegionsOverSlices::contoursNearThePlaneAreWhole() {
  QFETCH(double, z);
  QFETCH(int, lines);
  const auto all = linesIn(planeAt({0, 0, z}));
  QCOMPARE(all.size(), std::size_t(1));
  QCOMPARE(int(all[0].lines.size()), lines);
  QVERIFY(all[0].cuts.empty() && all[0].points.empty());
  QCOMPARE(all[0].colour, QColor(255, 0, 0));
  if (lines == 0) return;
  const QPolygonF closed{QPointF(40, 40), QPointF(60, 40), QPointF(60, 60), QPointF(40, 60), QPointF(40, 40)};
  QCOMPARE(all[0].lines[0], closed);
}

void TestRegionsOverSlices::othersAreCut() {
  // A coronal plane, 4 mm behind the middle, cuts it from x -10 to 10 at z 5.
  const auto all = linesIn(planeAt({0, 4, 0}, {1, 0, 0}, {0, 0, -1}));
  QVERIFY(all[0].lines.empty());
  QCOMPARE(all[0].cuts.size(), std::size_t(1));
  const QLineF cut = all[0].cuts[0];
  QCOMPARE(std::min(cut.x1(), cut.x2()), 40.0);
  QCOMPARE(std::max(cut.x1(), cut.x2()), 60.0);
  QCOMPARE(cut.y1(), 45.0);
  QCOMPARE(cut.y2(), 45.0);
  QVERIFY2(linesIn(planeAt({0, 11, 0}, {1, 0, 0}, {0, 0, -1}))[0].cuts.empty(), "behind it");
}

void TestRegionsOverSlices::onlyWhatIsShownInItsFrame() {
  RegionsLook look;
  QVERIFY2(linesIn(planeAt({0, 0, 5}), look, "1.3").empty(), "another frame of reference");
  QVERIFY2(linesIn(planeAt({0, 0, 5}), look, "").empty(), "none");
  look.shown.editOrAdd(3) = false;
  QVERIFY(linesIn(planeAt({0, 0, 5}), look).empty());
  look.shown.editOrAdd(3) = true;
  QCOMPARE(linesIn(planeAt({0, 0, 5}), look).size(), std::size_t(1));
}

void TestRegionsOverSlices::segmentsTintTheirPixels() {
  // 8 x 4 pixels of 2 mm from (-10, -10, 0), all set, in one plane of 3 mm.
  auto s = std::make_shared<Segmentation>();
  s->size = {8, 4};
  s->mm = {2, 2};
  s->thickness = 3;
  s->segments.resize(1);
  s->frames = {{0, {-10, -10, 0}}};
  s->bits.assign(4, 0xff);
  const SegmentLayer layer{s, {{0, qRgb(200, 0, 0)}}, 0.5};
  QImage grey(100, 100, QImage::Format_Grayscale8);
  grey.fill(100);
  // The inside has half of its colour, the outline all of it.
  const auto tinted = [&](const SlicePlane& plane) {
    const QImage picture = withSegments(grey, plane, layer);
    std::pair count(0, 0);
    for (int y = 0; y < 100; ++y)
      for (int x = 0; x < 100; ++x) {
        const QRgb c = picture.pixel(x, y);
        if (c == qRgb(150, 50, 50)) ++count.first;
        if (c == qRgb(200, 0, 0)) ++count.second;
        if (c != qRgb(150, 50, 50) && c != qRgb(200, 0, 0) && c != qRgb(100, 100, 100))
          return std::pair(-1, -1);
      }
    return count;
  };
  const std::pair block(14 * 6, 16 * 8 - 14 * 6);
  QVERIFY(tinted(planeAt({0, 0, 0})) == block);
  QVERIFY(tinted(planeAt({0, 0, 1.4})) == block);
  QVERIFY(tinted(planeAt({0, 0, 1.6})) == std::pair(0, 0));
  // A coronal plane through it shows the same width, and the plane's thickness as height. It is shifted by
  // half a pixel, so that both faces lie between pixels.
  QVERIFY(tinted(planeAt({0, -8, 0.5}, {1, 0, 0}, {0, 0, -1})) == std::pair(14, 16 * 3 - 14));
}

VOLUMEN_TEST(TestRegionsOverSlices);
#include "tst_regions_over_slices.moc"
