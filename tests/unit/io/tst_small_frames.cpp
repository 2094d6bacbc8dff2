// Guards slices.md 2 (frames for small pictures): large grey frames come as the means of blocks, by the
// windows of the whole frame; others come as they are.
#include "io/frames.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSmallFrames : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void largeOnesAreMeans_data();
  void largeOnesAreMeans();
  void smallOnesComeAsTheyAre();
};

namespace {

constexpr int columns = 203, rows = 97;

Series pictureIn(const DicomFolder& folder) {
  DicomPicture picture;
  picture.columns = columns;
  picture.rows = rows;
  for (int n = 0; n < columns * rows; ++n) picture.pixels.push_back(std::uint16_t(n * 7 % 1000));
  folder.add("a", picture);
  return folder.open().volumes.at(0);
}

}  // namespace

void TestSmallFrames::largeOnesAreMeans_data() {
  QTest::addColumn<int>("edge");
  QTest::addColumn<int>("block");
  QTest::newRow("blocks of 2") << 20 << 2;
  QTest::newRow("blocks of 5") << 10 << 5;
}

void TestSmallFrames::largeOnesAreMeans() {
  QFETCH(int, edge);
  QFETCH(int, block);
  const DicomFolder folder;
  const Series series = pictureIn(folder);
  const Result<Frame> whole = loadFrame(series, 0), small = loadSmallFrame(series, 0, edge);
  QVERIFY(whole.ok() && small.ok());
  const glm::ivec2 size = (whole->size + block - 1) / block;
  QVERIFY(small->size == size);
  QCOMPARE(small->pixel.mm.x, block * whole->pixel.mm.x);
  QVERIFY(small->greys[0].mapping == whole->greys[0].mapping);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      double sum = 0;
      int count = 0;
      for (int j = y * block; j < std::min(rows, (y + 1) * block); ++j)
        for (int i = x * block; i < std::min(columns, (x + 1) * block); ++i)
          sum += double(whole->values[std::size_t(j * columns + i)]), ++count;
      const float mean = small->values[std::size_t(y * size.x + x)];
      QVERIFY(std::abs(double(mean) - sum / count) < 1e-3);
    }
}

void TestSmallFrames::smallOnesComeAsTheyAre() {
  const DicomFolder folder;
  const Series series = pictureIn(folder);
  const Result<Frame> whole = loadFrame(series, 0), small = loadSmallFrame(series, 0, 60);
  QVERIFY(whole.ok() && small.ok());
  QVERIFY(small->size == whole->size && small->values.floats() == whole->values.floats());
}

VOLUMEN_TEST(TestSmallFrames);
#include "tst_small_frames.moc"
