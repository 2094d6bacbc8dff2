// Guards viewer/segment/pixel_outlines.h: outlines along pixel edges enclose exactly the pixels, by both
// filling rules, with holes, islands in them and pixels that touch at corners.
#include <cmath>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"
#include "viewer/segment/pixel_outlines.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

using Pixels = std::vector<std::uint8_t>;

Outlines centred(const std::vector<std::vector<glm::ivec2>>& outlines) {
  Outlines all;
  for (const auto& outline : outlines) {
    all.emplace_back();
    for (const glm::ivec2 p : outline) all.back().push_back(glm::dvec2(p) - 0.5);
  }
  return all;
}

// Positive where an outline runs clockwise on screen.
double signedArea(const std::vector<glm::ivec2>& outline) {
  double twice = 0;
  for (std::size_t n = 0; n < outline.size(); ++n) {
    const glm::dvec2 a(outline[n]), b(outline[(n + 1) % outline.size()]);
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

Pixels pixelsOf(const char* drawn) {
  Pixels pixels;
  for (; *drawn; ++drawn)
    if (*drawn != ' ') pixels.push_back(*drawn == '#');
  return pixels;
}

}  // namespace

class TestPixelOutlines : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void eachPartHasOneOutline_data();
  void eachPartHasOneOutline();
  void randomPixelsComeBack();
  void ringsOfTwoOutlinesAreHollow();
  void areasOfSlantedOutlinesAreNear();
  void tooManyCrossingsGiveNothing();
};

void TestPixelOutlines::eachPartHasOneOutline_data() {
  QTest::addColumn<QByteArray>("drawn");
  QTest::addColumn<int>("outlines");
  QTest::addColumn<int>("points");
  const auto row = [](const char* name, const char* drawn, int outlines, int points) {
    QTest::newRow(name) << QByteArray(drawn) << outlines << points;
  };
  row("nothing", "..... ..... ..... ..... .....", 0, 0);
  row("one pixel at the edge", "#.... ..... ..... ..... .....", 1, 4);
  row("everything", "##### ##### ##### ##### #####", 1, 4);
  row("pixels that touch at a corner are two parts", "#.... .#... ..... ..... .....", 2, 8);
  // A channel adds two points where it begins; the corner where it ends is passed twice.
  row("a hole is joined by a keyhole", "##### ##### ##.## ##### #####", 1, 4 + 4 + 2);
  row("two holes that touch at a corner are one", "##### #.### ##.## ##### #####", 1, 14);
  row("an island in a hole is a part", "##### #...# #.#.# #...# #####", 2, 4 + 4 + 2 + 4);
}

void TestPixelOutlines::eachPartHasOneOutline() {
  QFETCH(QByteArray, drawn);
  QFETCH(int, outlines);
  QFETCH(int, points);
  const Pixels pixels = pixelsOf(drawn);
  const auto found = pixelOutlines(pixels, {5, 5});
  QCOMPARE(int(found.size()), outlines);
  int count = 0;
  for (const auto& outline : found) count += int(outline.size());
  QCOMPARE(count, points);
  QCOMPARE(filledEvenOdd(centred(found), {5, 5}), pixels);
}

void TestPixelOutlines::randomPixelsComeBack() {
  const Seeds seeds = seedsOf(3000, 200000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const glm::ivec2 size(1 + chance.below(14), 1 + chance.below(14));
    const double share = chance.share();
    Pixels pixels;
    double count = 0, area = 0;
    for (int n = 0; n < size.x * size.y; ++n) {
      pixels.push_back(chance.share() < share);
      count += pixels.back();
    }
    const auto outlines = pixelOutlines(pixels, size);
    const QByteArray which = QByteArray::number(seed);
    for (const auto& outline : outlines) {
      area += signedArea(outline);
      for (std::size_t n = 0; n < outline.size(); ++n) {
        const glm::ivec2 step = outline[(n + 1) % outline.size()] - outline[n];
        QVERIFY2((step.x == 0) != (step.y == 0), which.constData());
      }
    }
    // Non-zero winding and even-odd agree where no point is wound twice: the signed area counts it.
    QVERIFY2(area == count, which.constData());
    QVERIFY2(filledEvenOdd(centred(outlines), size) == pixels, which.constData());
    QVERIFY2(std::abs(evenOddArea(centred(outlines)) - count) < 1e-9, which.constData());
  }
}

void TestPixelOutlines::ringsOfTwoOutlinesAreHollow() {
  const Outlines ring{{{-0.5, -0.5}, {4.5, -0.5}, {4.5, 4.5}, {-0.5, 4.5}},
                      {{1.5, 1.5}, {2.5, 1.5}, {2.5, 2.5}, {1.5, 2.5}}};
  QCOMPARE(filledEvenOdd(ring, {5, 5}), pixelsOf("##### ##### ##.## ##### #####"));
  QVERIFY(std::abs(evenOddArea(ring) - 24) < 1e-9);
}

void TestPixelOutlines::areasOfSlantedOutlinesAreNear() {
  Outlines circle(1);
  for (int n = 0; n < 360; ++n)
    circle[0].emplace_back(50 + 20 * std::cos(n * M_PI / 180), 50 + 20 * std::sin(n * M_PI / 180));
  QVERIFY(std::abs(evenOddArea(circle) / (M_PI * 400) - 1) < 1e-3);
  for (glm::dvec2& p : circle[0]) p *= 1e-6;
  QVERIFY(std::abs(evenOddArea(circle) / (M_PI * 400e-12) - 1) < 1e-3);
}

void TestPixelOutlines::tooManyCrossingsGiveNothing() {
  Outlines zigzag(1);
  for (int n = 0; n < 40000; ++n) zigzag[0].emplace_back(n % 7, n % 2 ? -1e9 : 1e9);
  QVERIFY(filledEvenOdd(zigzag, {4, 1000}).empty());
  QCOMPARE(evenOddArea(zigzag), 0.0);
  QCOMPARE(filledEvenOdd({}, {2, 2}), Pixels(4, 0));
}

VOLUMEN_TEST(TestPixelOutlines);
#include "tst_pixel_outlines.moc"
