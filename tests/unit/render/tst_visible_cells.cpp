// Guards design.md 5, empty blocks, cell by cell: a cell is skipped exactly if no density between its eight
// voxels has opacity.
#include <algorithm>
#include <random>

#include "tests/unit/suite.h"
#include "viewer/acceleration/visible_cells.h"
#include "viewer/scene/scene.h"
#include "viewer/volume/parallel.h"

using namespace volumen;

namespace {

struct Grid {
  glm::ivec3 size;
  std::vector<std::int16_t> stored;
  std::uint16_t flip;

  int at(glm::ivec3 p) const {
    p = glm::min(p, size - 1);
    return std::int16_t(stored[(std::size_t(p.z) * size.y + p.y) * size.x + p.x] ^ flip);
  }
};

// Returns waves of -60 .. 60 with some noise, and a constant corner.
Grid wavy(glm::ivec3 size, std::uint16_t flip) {
  Grid g{size, {}, flip};
  std::minstd_rand random(3);
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const double wave = 50 * std::sin(0.4 * i + 0.3 * j) * std::cos(0.5 * k) + double(random() % 20) - 10;
        const bool corner = i < 6 && j < 6;
        g.stored.push_back(std::int16_t(std::int16_t(corner ? 0 : std::lround(wave)) ^ flip));
      }
  return g;
}

// Returns the values plus 70 as bytes. Each is the last of `stride` bytes.
std::vector<std::uint8_t> bytesOf(const Grid& g, int stride) {
  std::vector<std::uint8_t> bytes(stride * g.stored.size());
  for (std::size_t n = 0; n < g.stored.size(); ++n)
    bytes[stride * n + stride - 1] = std::uint8_t(g.stored[n] + 70);
  return bytes;
}

TransferFunction curveOf(const std::vector<std::pair<float, double>>& points) {
  TransferFunction curve;
  curve.points.clear();
  for (const auto& [value, opacity] : points) curve.points.push_back({value, {1, 1, 1}, opacity});
  return curve;
}

// Returns whether any density from `low` to `high` has opacity, tested in steps of one third.
bool anyVisible(const TransferFunction& curve, int low, int high) {
  const auto& points = curve.points;
  for (int n = 3 * low; n <= 3 * high; ++n) {
    const double d = n / 3.0;
    std::size_t behind = 0;
    while (behind < points.size() && double(points[behind].value) <= d) ++behind;
    double opacity = behind == 0 ? points.front().opacity : points[behind - 1].opacity;
    if (behind > 0 && behind < points.size()) {
      const auto &a = points[behind - 1], &b = points[behind];
      opacity += (b.opacity - a.opacity) * (d - double(a.value)) / (double(b.value) - double(a.value));
    }
    if (opacity > 0) return true;
  }
  return false;
}

bool cellOf(const VisibleCells& cells, glm::ivec3 p) {
  const glm::ivec3 block = p / VisibleCells::edge, in = p % VisibleCells::edge, count = cells.count();
  const int index = (block.z * count.y + block.y) * count.x + block.x;
  return cells.words()[2 * index + in.z / 2] >> (in.x + 4 * in.y + 16 * (in.z % 2)) & 1;
}

}  // namespace

class TestVisibleCells : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cellsAreThoseThatHoldOpacity_data();
  void cellsAreThoseThatHoldOpacity();
  void onlyWhatWasAskedForIsLookedInto_data();
  void onlyWhatWasAskedForIsLookedInto();
  void withoutDensitiesVisibleBlocksCountWhole();
};

void TestVisibleCells::cellsAreThoseThatHoldOpacity_data() {
  using Points = std::vector<std::pair<float, double>>;
  QTest::addColumn<Points>("points");
  QTest::addColumn<int>("x");
  QTest::addColumn<bool>("isUnsigned");
  QTest::addColumn<int>("bytes");  // 0 for 16 bits
  const std::pair<const char*, Points> curves[] = {
      {"a ramp that begins at the background", {{0, 0}, {30, 0.5}}},
      {"a ramp downwards", {{-20, 0.5}, {0, 0}}},
      {"a step on a stored value", {{20, 0}, {20, 0.4}}},
      {"a step between two", {{19.5f, 0}, {19.5f, 0.4}}},
      {"a peak between two values", {{10.34f, 0}, {10.5f, 1}, {10.8f, 0}}},
      {"two spans", {{-40, 0.2}, {-30, 0}, {35, 0}, {40, 0.7}}},
      {"nothing", {{0, 0}, {10, 0}}},
      {"all", {{0, 0.1}, {10, 0.2}}},
  };
  for (const auto& [name, points] : curves)
    for (const int x : {150, 23, 8, 5, 1})
      for (const int bytes : {0, 1, 4})
        QTest::addRow("%s, %d voxels along x, %s", name, x,
                      bytes == 0   ? "16 bits"
                      : bytes == 1 ? "bytes"
                                   : "one byte in four")
            << points << x << (x == 8 && bytes == 0) << bytes;
}

void TestVisibleCells::cellsAreThoseThatHoldOpacity() {
  using Points = std::vector<std::pair<float, double>>;
  QFETCH(Points, points);
  QFETCH(int, x);
  QFETCH(bool, isUnsigned);
  QFETCH(int, bytes);
  const Grid g = wavy({x, 10, 7}, isUnsigned ? 0x8000 : 0);
  const TransferFunction curve = curveOf(points);
  const DensityScale scale = bytes ? DensityScale{1, -70, 0, 140} : DensityScale{1, 0, -70, 70};
  const std::vector<std::uint8_t> in8 = bytes ? bytesOf(g, bytes) : std::vector<std::uint8_t>{};
  VisibleCells cells;
  const glm::ivec3 blocks = (g.size + 3) / 4;
  const StoredDensities densities =
      bytes ? StoredDensities{.in8 = in8.data() + bytes - 1, .stride8 = bytes, .rowVoxels = x}
            : StoredDensities{.in16 = g.stored.data(), .flip = g.flip, .rowVoxels = x};
  cells.begin(g.size, densities, makeCurveTable(curve, scale),
              std::vector<std::uint8_t>(std::size_t(blocks.x) * blocks.y * blocks.z, 1));
  parallelFor(8, 0, [&](auto, auto) { cells.lookInto(glm::vec3(0), glm::vec3(g.size - 1)); });
  for (int k = 0; k < g.size.z; ++k)
    for (int j = 0; j < g.size.y; ++j)
      for (int i = 0; i < g.size.x; ++i) {
        int low = 32767, high = -32768;
        for (int n = 0; n < 8; ++n) {
          const int v = g.at({i + (n & 1), j + (n >> 1 & 1), k + (n >> 2)});
          low = std::min(low, v), high = std::max(high, v);
        }
        QVERIFY2(
            cellOf(cells, {i, j, k}) == anyVisible(curve, low, high),
            qPrintable(QStringLiteral("cell %1 %2 %3 of %4 .. %5").arg(i).arg(j).arg(k).arg(low).arg(high)));
      }
}

void TestVisibleCells::onlyWhatWasAskedForIsLookedInto_data() {
  QTest::addColumn<int>("x");
  QTest::addColumn<float>("low");
  QTest::addColumn<float>("high");
  QTest::newRow("one block") << 16 << 4.5f << 7.9f;
  QTest::newRow("blocks 31 to 33 of a long row") << 270 << 127.5f << 132.0f;
  QTest::newRow("32 blocks") << 270 << 128.0f << 255.5f;
  QTest::newRow("a whole row") << 270 << 0.0f << 269.0f;
}

void TestVisibleCells::onlyWhatWasAskedForIsLookedInto() {
  QFETCH(int, x);
  QFETCH(float, low);
  QFETCH(float, high);
  const Grid g = wavy({x, 16, 16}, 0);
  const int row = (x + 3) / 4;
  VisibleCells cells;
  cells.begin(g.size, {.in16 = g.stored.data(), .rowVoxels = x},
              makeCurveTable(curveOf({{-100, 1}}), {1, 0, -70, 70}),
              std::vector<std::uint8_t>(std::size_t(16) * row, 1));
  cells.lookInto({low, 4, 9}, {high, 5, 9});
  for (int n = 0; n < 16 * row; ++n) {
    const bool asked = n / row == 2 * 4 + 1 && n % row >= int(low) / 4 && n % row <= int(high) / 4;
    QCOMPARE(cells.words()[2 * n], asked ? -1 : 0);
  }
}

void TestVisibleCells::withoutDensitiesVisibleBlocksCountWhole() {
  VisibleCells cells;
  cells.begin({8, 4, 4}, {}, makeCurveTable(curveOf({{0, 1}}), {1, 0, -70, 70}), {0, 1});
  cells.lookInto({0, 0, 0}, {7, 3, 3});
  QCOMPARE(cells.words()[0], 0);
  QCOMPARE(cells.words()[2], -1);
  QCOMPARE(cells.words()[3], -1);
}

VOLUMEN_TEST(TestVisibleCells);
#include "tst_visible_cells.moc"
