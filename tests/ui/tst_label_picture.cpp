// Guards how labels are drawn in slices: a twin that looks at many places of each pixel, one by one, and
// closed forms: straight borders at any zoom, labels that touch, single voxels of a part of a pixel.
#include <QImage>
#include <map>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"
#include "ui/controller/segment_layer.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr int twinPlaces = 8;  // of the twin, along each side of a pixel
constexpr QRgb redLabel = qRgb(255, 0, 0), blueLabel = qRgb(0, 0, 255);

VoxelGeometry cubeGrid(int edge) {
  VoxelGeometry grid;
  grid.size = glm::ivec3(edge);
  return grid;
}

// With the label that `labelOf` gives each voxel.
template <class LabelOf>
SegmentLayer layerOf(const VoxelGeometry& grid, const LabelOf& labelOf) {
  LabelEdit edit{LabelMap(grid)};
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i) edit.set({i, j, k}, std::uint8_t(labelOf({i, j, k})));
  SegmentLayer layer;
  layer.labels = std::make_shared<const LabelMap>(edit.done());
  return layer;
}

SlicePlane planeThrough(glm::dvec3 centre, double mm, double degrees, Interpolation interpolation) {
  const double turned = degrees * 3.14159265358979 / 180;
  SlicePlane plane;
  plane.centre = centre;
  plane.right = {std::cos(turned), std::sin(turned), 0};
  plane.down = {-std::sin(turned), std::cos(turned), 0};
  plane.mmPerPixel = mm;
  plane.size = {60, 50};
  plane.interpolation = interpolation;
  return plane;
}

QImage labelsOver(QRgb under, const SlicePlane& plane, const SegmentLayer& layer) {
  QImage picture(plane.size.x, plane.size.y, QImage::Format_RGB32);
  picture.fill(under);
  return withSegments(picture, plane, layer);
}

// The number of the layer's label at a place of the picture, from 1; 0: of none.
int shownAt(const SegmentLayer& layer, const SlicePlane& plane, glm::dvec2 pPixel) {
  const VoxelGeometry& grid = layer.labels->geometry();
  const glm::dvec3 v = grid.voxelFromPatient(plane.patientFromPixel(pPixel));
  for (int a = 0; a < 3; ++a)
    if (v[a] < -0.5 || v[a] >= grid.size[a] - 0.5) return 0;
  const auto shownOf = [&](glm::ivec3 voxel) {
    const glm::ivec3 held = glm::clamp(voxel, glm::ivec3(0), grid.size - 1);
    const auto found = std::ranges::find(layer.shown, layer.labels->at(held), &SegmentLayer::Shown::segment);
    return found == layer.shown.end() ? 0 : int(found - layer.shown.begin()) + 1;
  };
  if (plane.interpolation == Interpolation::nearest) return shownOf(glm::ivec3(glm::floor(v + 0.5)));
  std::map<int, double> shares;
  for (int c = 0; c < 8; ++c) {
    const glm::ivec3 voxel = glm::ivec3(glm::floor(v)) + glm::ivec3(c & 1, c >> 1 & 1, c >> 2);
    const glm::dvec3 share = 1.0 - glm::abs(v - glm::dvec3(voxel));
    shares[shownOf(voxel)] += share.x * share.y * share.z;
  }
  return std::ranges::max_element(shares, {}, [](const auto& shown) { return shown.second; })->first;
}

// What many places of each pixel show.
struct LabelTwin {
  const SegmentLayer& layer;
  glm::ivec2 size;
  std::vector<int> shown;  // of the places

  LabelTwin(const SegmentLayer& of, const SlicePlane& plane) : layer(of), size(twinPlaces * plane.size) {
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x)
        shown.push_back(shownAt(layer, plane, (glm::dvec2(x, y) + 0.5) / double(twinPlaces)));
  }
  int at(int x, int y) const { return shown[std::size_t(y) * std::size_t(size.x) + std::size_t(x)]; }
  // Whether a place of the picture within 1.5 pixels shows something else.
  bool isOutline(int x, int y) const {
    constexpr int reach = twinPlaces * 3 / 2;
    for (int j = std::max(0, y - reach); j <= std::min(size.y - 1, y + reach); ++j)
      for (int i = std::max(0, x - reach); i <= std::min(size.x - 1, x + reach); ++i)
        if ((i - x) * (i - x) + (j - y) * (j - y) <= reach * reach && at(i, j) != at(x, y)) return true;
    return false;
  }
  // How many places of a pixel show each.
  std::map<int, int> counts(int x, int y) const {
    std::map<int, int> found;
    for (int n = 0; n < twinPlaces * twinPlaces; ++n)
      ++found[at(x * twinPlaces + n % twinPlaces, y * twinPlaces + n / twinPlaces)];
    return found;
  }
  bool isAll(int x, int y, int reach, int number) const {
    for (int j = std::max(0, y - reach); j <= std::min(size.y / twinPlaces - 1, y + reach); ++j)
      for (int i = std::max(0, x - reach); i <= std::min(size.x / twinPlaces - 1, x + reach); ++i)
        if (const auto met = counts(i, j); met.size() > 1 || !met.contains(number)) return false;
    return true;
  }
  // Whether a label covers less than a little more than half a pixel, and no pixel beside it as a whole.
  bool isThin(int x, int y) const {
    for (const auto& [number, count] : counts(x, y)) {
      if (number == 0 || count > 0.6 * twinPlaces * twinPlaces) continue;
      bool isBesideWhole = false;
      for (int j = std::max(0, y - 1); j <= std::min(size.y / twinPlaces - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(size.x / twinPlaces - 1, x + 1); ++i)
          isBesideWhole |= isAll(i, j, 0, number);
      if (!isBesideWhole) return true;
    }
    return false;
  }
  glm::dvec3 colour(int x, int y, QRgb under) const {
    glm::dvec3 sum(0);
    const glm::dvec3 below(qRed(under), qGreen(under), qBlue(under));
    for (int n = 0; n < twinPlaces * twinPlaces; ++n) {
      const int i = x * twinPlaces + n % twinPlaces, j = y * twinPlaces + n / twinPlaces;
      if (at(i, j) == 0) {
        sum += below;
        continue;
      }
      const SegmentLayer::Shown& as = layer.shown[std::size_t(at(i, j)) - 1];
      const double inside = layer.opacity * as.opacity,
                   part = isOutline(i, j) ? std::min(1.0, 2 * inside) : inside;
      sum += (1 - part) * below + part * glm::dvec3(qRed(as.colour), qGreen(as.colour), qBlue(as.colour));
    }
    return sum / double(twinPlaces * twinPlaces);
  }
};

SegmentLayer ballsByChance(Chance& chance) {
  VoxelGeometry grid = cubeGrid(30);
  for (int a = 0; a < 3; ++a) grid.patientFromVoxelStep[a] += 0.3 * chance.vector();
  grid.origin = -0.5 * (grid.patientFromVoxelStep * glm::dvec3(grid.size));
  std::array<glm::dvec4, 5> balls;
  for (glm::dvec4& ball : balls) ball = {15.0 + 6.0 * chance.vector(), chance.between(3, 8)};
  SegmentLayer layer = layerOf(grid, [&](glm::ivec3 voxel) {
    for (std::size_t n = 0; n < balls.size(); ++n)
      if (glm::length(glm::dvec3(voxel) - glm::dvec3(balls[n])) < balls[n].w) return int(n % 3) + 1;
    return 0;
  });
  layer.shown = {{3, qRgb(200, 20, 90), 0.7}, {1, qRgb(20, 220, 40), 1}};  // 2 is hidden
  layer.opacity = chance.between(0.2, 0.6);
  return layer;
}

}  // namespace

class TestLabelPicture : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void pixelsAreThoseOfATwin_data();
  void pixelsAreThoseOfATwin();
  void straightBorders_data();
  void straightBorders();
  void labelsThatTouchLeaveNoGap_data();
  void labelsThatTouchLeaveNoGap();
  void aVoxelIsSeenAtAnyZoom_data();
  void aVoxelIsSeenAtAnyZoom();
};

void TestLabelPicture::pixelsAreThoseOfATwin_data() {
  QTest::addColumn<int>("seed");
  const Seeds seeds = seedsOf(12, 200);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) QTest::addRow("seed %d", seed) << seed;
}

// Deep inside and far outside it is the same; at borders, where 4 x 4 places are looked at and the outline is
// found by what pixels are covered, the same within `most` of 255 levels, and on average within `usual`.
void TestLabelPicture::pixelsAreThoseOfATwin() {
  QFETCH(int, seed);
  constexpr double most = 60, usual = 3;
  Chance chance{std::uint64_t(seed)};
  const SegmentLayer layer = ballsByChance(chance);
  SlicePlane plane = planeThrough(4.0 * chance.vector(), chance.between(0.1, 0.7), 0,
                                  chance.oneIn(2) ? Interpolation::nearest : Interpolation::linear);
  plane.right = glm::normalize(glm::dvec3(1, chance.between(-1, 1), chance.between(-0.5, 0.5)));
  plane.down = glm::normalize(glm::cross(glm::dvec3(0, 0.3, 1), plane.right));
  const QRgb under = qRgb(100, 100, 100);
  const QImage picture = labelsOver(under, plane, layer);
  const LabelTwin twin(layer, plane);
  double sum = 0, largest = 0;
  int atBorders = 0;
  for (int y = 0; y < plane.size.y; ++y)
    for (int x = 0; x < plane.size.x; ++x) {
      const int middle = twin.at(x * twinPlaces + twinPlaces / 2, y * twinPlaces + twinPlaces / 2);
      if (twin.isThin(x, y)) continue;
      const QRgb seen = picture.pixel(x, y);
      const glm::dvec3 off =
          glm::abs(twin.colour(x, y, under) - glm::dvec3(qRed(seen), qGreen(seen), qBlue(seen)));
      const double worst = std::max({off.x, off.y, off.z});
      if (twin.isAll(x, y, 2, middle)) {
        QVERIFY2(worst <= 0.5001, qPrintable(QStringLiteral("%1 %2: %3").arg(x).arg(y).arg(worst)));
        continue;
      }
      sum += worst, ++atBorders;
      largest = std::max(largest, worst);
    }
  QVERIFY2(largest <= most, qPrintable(QString::number(largest)));
  QVERIFY2(sum <= usual * atBorders, qPrintable(QString::number(sum / atBorders)));
}

void TestLabelPicture::straightBorders_data() {
  QTest::addColumn<double>("mm");
  QTest::addColumn<double>("degrees");
  QTest::addColumn<bool>("nearest");
  for (const double mm : {0.02, 0.13, 0.6, 1.3, 2.4})
    for (const double degrees : {0.0, 17.0, 45.0, 100.0})
      for (const bool nearest : {false, true})
        QTest::addRow("%g mm a pixel, turned by %g, %s", mm, degrees, nearest ? "nearest" : "linear")
            << mm << degrees << nearest;
}

// The face between voxels 99 and 100 is 0.27 pixels off the middle of the picture. What 4 x 4 places of a
// pixel can be off is an eighth of a pixel.
void TestLabelPicture::straightBorders() {
  QFETCH(double, mm);
  QFETCH(double, degrees);
  QFETCH(bool, nearest);
  VoxelGeometry slab;
  slab.size = {200, 200, 2};
  SegmentLayer layer = layerOf(slab, [](glm::ivec3 voxel) { return voxel.x < 100 ? 1 : 0; });
  layer.shown = {{1, redLabel, 1}};
  const SlicePlane plane = planeThrough({99.5 - 0.27 * mm, 100, 0}, mm, degrees,
                                        nearest ? Interpolation::nearest : Interpolation::linear);
  layer.opacity = 1;
  const QImage whole = labelsOver(qRgb(0, 0, 0), plane, layer);
  layer.opacity = 0.25;
  const QImage outlined = labelsOver(qRgb(0, 0, 0), plane, layer);
  double off = 0, widthSum = 0;
  int pixels = 0;
  for (int y = 0; y < plane.size.y; ++y)
    for (int x = 0; x < plane.size.x; ++x) {
      const double inside = (99.5 - plane.patientFromPixel({x + 0.5, y + 0.5}).x) / mm;  // pixels
      if (std::abs(inside) > 10) continue;
      const double covered = qRed(whole.pixel(x, y)) / 255.0, shown = qRed(outlined.pixel(x, y)) / 255.0;
      QVERIFY2(std::abs(covered - std::clamp(inside + 0.5, 0.0, 1.0)) < 0.25,
               qPrintable(QString::number(covered)));
      off += covered - std::clamp(inside + 0.5, 0.0, 1.0);
      widthSum += (shown - 0.25 * covered) / 0.25;
      ++pixels;
    }
  QVERIFY(pixels > 500);
  // In pixels of distance from the border.
  const double border = off / pixels * 20, width = widthSum / pixels * 20;
  QVERIFY2(std::abs(border) < 0.13, qPrintable(QString::number(border)));
  QVERIFY2(std::abs(width - 1.5) < 0.2, qPrintable(QString::number(width)));
}

void TestLabelPicture::labelsThatTouchLeaveNoGap_data() {
  QTest::addColumn<double>("mm");
  QTest::addColumn<bool>("nearest");
  for (const double mm : {0.07, 0.3, 1.0, 1.7})
    for (const bool nearest : {false, true})
      QTest::addRow("%g mm a pixel, %s", mm, nearest ? "nearest" : "linear") << mm << nearest;
}

// Every voxel has one of three labels, by chance: all is their colour.
void TestLabelPicture::labelsThatTouchLeaveNoGap() {
  QFETCH(double, mm);
  QFETCH(bool, nearest);
  Chance chance{7};
  SegmentLayer layer = layerOf(cubeGrid(120), [&](glm::ivec3) { return 1 + chance.below(3); });
  layer.shown = {{1, blueLabel, 1}, {2, blueLabel, 1}, {3, blueLabel, 1}};
  SlicePlane plane =
      planeThrough(glm::dvec3(59.37), mm, 31, nearest ? Interpolation::nearest : Interpolation::linear);
  plane.down = glm::normalize(plane.down + glm::dvec3(0, 0, 0.2));
  plane.size = {40, 40};
  layer.opacity = 1;
  QImage all(plane.size.x, plane.size.y, QImage::Format_RGB32);
  all.fill(blueLabel);
  QVERIFY(labelsOver(qRgb(255, 255, 255), plane, layer) == all);
}

void TestLabelPicture::aVoxelIsSeenAtAnyZoom_data() {
  QTest::addColumn<double>("mm");
  QTest::addColumn<bool>("nearest");
  for (const double mm : {0.1, 0.5, 0.9, 1.0, 1.4, 2.3, 5.0, 11.0})
    for (const bool nearest : {false, true})
      QTest::addRow("%g mm a pixel, %s", mm, nearest ? "nearest" : "linear") << mm << nearest;
}

void TestLabelPicture::aVoxelIsSeenAtAnyZoom() {
  QFETCH(double, mm);
  QFETCH(bool, nearest);
  SegmentLayer layer =
      layerOf(cubeGrid(21), [](glm::ivec3 voxel) { return voxel == glm::ivec3(10) ? 1 : 0; });
  layer.shown = {{1, redLabel, 1}};
  layer.opacity = 0.5;
  Chance chance{3};
  for (int n = 0; n < 30; ++n) {
    const glm::dvec2 by = mm * glm::dvec2(chance.between(-3, 3), chance.between(-3, 3));
    const QImage picture = labelsOver(qRgb(0, 0, 0),
                                      planeThrough({10 + by.x, 10 + by.y, 10}, mm, chance.between(0, 90),
                                                   nearest ? Interpolation::nearest : Interpolation::linear),
                                      layer);
    int strongest = 0, seen = 0;
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x) {
        strongest = std::max(strongest, qRed(picture.pixel(x, y)));
        seen += qRed(picture.pixel(x, y)) > 0 ? 1 : 0;
      }
    QVERIFY2(strongest > 120, qPrintable(QString::number(strongest)));
    QVERIFY2(mm < 1 || seen <= 9, qPrintable(QString::number(seen)));
  }
}

VOLUMEN_TEST(TestLabelPicture);
#include "tst_label_picture.moc"
