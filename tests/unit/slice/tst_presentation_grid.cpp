// Guards slices.md 2: rotated and cropped pictures show each pixel where PS3.3 C.10.4 and C.10.6 put it, with
// annotations in place.
#include <algorithm>
#include <glm/geometric.hpp>

#include "tests/unit/suite.h"
#include "viewer/slice/presentation.h"
#include "viewer/slice/shutter.h"

using namespace volumen;

class TestPresentationGrid : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void pixelsAreTurned_data();
  void pixelsAreTurned();
  void annotationsGoWithTheirPixels_data() { pixelsAreTurned_data(); }
  void annotationsGoWithTheirPixels();
  void areasAreCutOut();
  void outlinesFollowTheirShape();
  void shuttersHideOutsideOfAllShapes();
};

namespace {

constexpr glm::ivec2 size(3, 2);
const std::vector<char> letters{'a', 'b', 'c', 'd', 'e', 'f'};

std::string shown(const FramePresentation& how) {
  const std::vector<char> pixels = presentPixels(PresentedGrid(how, size), letters, size, 1, '.');
  return {pixels.begin(), pixels.end()};
}

FramePresentation turnedBy(int quarters, bool mirrored) {
  FramePresentation how;
  how.turn = {quarters, mirrored};
  return how;
}

}  // namespace

void TestPresentationGrid::pixelsAreTurned_data() {
  QTest::addColumn<int>("quarters");
  QTest::addColumn<bool>("mirrored");
  QTest::addColumn<QString>("picture");  // the picture abc / def as shown
  const char* const rows[][2] = {
      {"abcdef", "cbafed"}, {"daebfc", "adbecf"}, {"fedcba", "defabc"}, {"cfbead", "fcebda"}};
  for (int quarters = 0; quarters < 4; ++quarters)
    for (int mirrored = 0; mirrored < 2; ++mirrored)
      QTest::addRow("%d degrees%s", 90 * quarters, mirrored ? ", then mirrored" : "")
          << quarters << (mirrored == 1) << QString::fromLatin1(rows[quarters][mirrored]);
}

void TestPresentationGrid::pixelsAreTurned() {
  QFETCH(int, quarters);
  QFETCH(bool, mirrored);
  QFETCH(QString, picture);
  const FramePresentation how = turnedBy(quarters, mirrored);
  QCOMPARE(PresentedGrid(how, size).size(), quarters % 2 ? glm::ivec2(2, 3) : glm::ivec2(3, 2));
  QCOMPARE(QString::fromStdString(shown(how)), picture);
}

void TestPresentationGrid::annotationsGoWithTheirPixels() {
  QFETCH(int, quarters);
  QFETCH(bool, mirrored);
  const PresentedGrid grid(turnedBy(quarters, mirrored), size);
  for (int y = 0; y < grid.size().y; ++y)
    for (int x = 0; x < grid.size().x; ++x) {
      const glm::dvec2 centre = glm::dvec2(grid.pixelAt({x, y})) + 0.5;
      QCOMPARE(grid.displayed(centre, AnnotationUnits::pixel), glm::dvec2(x, y) + 0.5);
    }
  // Fractions of the displayed area apply after the rotation.
  QCOMPARE(grid.displayed({1, 0}, AnnotationUnits::display), glm::dvec2(grid.size().x, 0));
}

void TestPresentationGrid::areasAreCutOut() {
  FramePresentation how;
  how.area = PixelBox{{1, 0}, {2, 1}};
  QCOMPARE(shown(how), std::string("bcef"));
  QCOMPARE(PresentedGrid(how, size).displayed({1, 0}, AnnotationUnits::pixel), glm::dvec2(0, 0));
  how.area = PixelBox{{-1, 1}, {1, 2}};
  QCOMPARE(shown(how), std::string(".de..."));
  how.area = PixelBox{{1, 0}, {2, 0}};
  how.turn = {1, false};
  QCOMPARE(shown(how), std::string("bc"));
  QCOMPARE(PresentedGrid(how, size).size(), glm::ivec2(1, 2));
}

void TestPresentationGrid::outlinesFollowTheirShape() {
  Graphic g{GraphicType::circle, AnnotationUnits::pixel, {{64, 64}, {64, 44}}, false, {}};
  for (const glm::dvec2 p : outlineOf(g)) QVERIFY(std::abs(glm::length(p - 64.0) - 20) < 1e-9);
  g = {GraphicType::ellipse, AnnotationUnits::pixel, {{0, 0}, {8, 0}, {4, -2}, {4, 2}}, false, {}};
  for (const glm::dvec2 p : outlineOf(g))
    QVERIFY(std::abs((p.x - 4) * (p.x - 4) / 16 + p.y * p.y / 4 - 1) < 1e-9);
  g = {GraphicType::interpolated, AnnotationUnits::pixel, {{0, 0}, {1, 5}, {2, 0}}, false, {}};
  const std::vector<glm::dvec2> line = outlineOf(g);
  for (const glm::dvec2 p : g.points) QVERIFY(std::find(line.begin(), line.end(), p) != line.end());
  g = {GraphicType::polyline, AnnotationUnits::pixel, {{0, 0}, {1, 5}}, false, {}};
  QVERIFY(outlineOf(g) == g.points);
}

void TestPresentationGrid::shuttersHideOutsideOfAllShapes() {
  ShutterShape rectangle, circle;
  rectangle.from = {2, 1};
  rectangle.to = {5, 4};
  circle.kind = ShutterShape::Kind::circle;
  circle.centre = {3, 3};
  circle.radius = 2;
  const std::vector<std::uint8_t> hidden = hiddenBy({{rectangle, circle}, 0}, {5, 5}, {1, 1});
  std::string drawn;
  for (const std::uint8_t h : hidden) drawn += h ? '#' : '.';
  QCOMPARE(drawn, std::string("##.##"
                              "#...#"
                              "#...."
                              "#...#"
                              "#####"));
  QVERIFY(hiddenBy({}, {5, 5}, {1, 1}).empty());
}

VOLUMEN_TEST(TestPresentationGrid);
#include "tst_presentation_grid.moc"
