// Guards that segments are mixed into slices as it is defined, pixel by pixel.
#include "tests/fixtures/seeds.h"
#include "tests/ui/chance_slices.h"
#include "tests/unit/suite.h"
#include "ui/controller/picture_underneath.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Pixel by pixel, each voxel looked for by itself.
QImage segmentsByPixel(const SliceRequest& request) {
  QImage picture = (*drawUnderneath(request)).convertToFormat(QImage::Format_RGB32);
  const SlicePlane& plane = request.plane;
  const auto mix = [](QRgb under, QRgb over, double part) {
    const auto channel = [&](int a, int b) { return int(std::lround((1 - part) * a + part * b)); };
    return qRgb(channel(qRed(under), qRed(over)), channel(qGreen(under), qGreen(over)),
                channel(qBlue(under), qBlue(over)));
  };
  const auto voxelOf = [&](const VoxelGeometry& grid, int x, int y) -> std::optional<glm::ivec3> {
    const glm::dvec3 v = grid.voxelFromPatient(plane.patientFromPixel({x + 0.5, y + 0.5})) + 0.5;
    if (glm::any(glm::lessThan(v, glm::dvec3(0))) ||
        glm::any(glm::greaterThanEqual(v, glm::dvec3(grid.size))))
      return {};
    return glm::ivec3(v);
  };
  for (const SegmentLayer& layer : request.segments) {
    const auto labelAt = [&](int x, int y) {
      const auto voxel = voxelOf(layer.labels->geometry(), x, y);
      const std::uint8_t label = voxel ? layer.labels->at(*voxel) : 0;
      return label == 1 || label == 3 ? int(label) : 0;
    };
    const QImage under = picture;
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x) {
        const int label = labelAt(x, y);
        if (label == 0) continue;
        bool isOutline = false;
        for (const QPoint by : {QPoint(-1, 0), QPoint(1, 0), QPoint(0, -1), QPoint(0, 1)})
          if (picture.rect().contains(QPoint(x, y) + by))
            isOutline |= labelAt(x + by.x(), y + by.y()) != label;
        const double part = layer.opacity * 0.7;
        picture.setPixel(
            x, y,
            mix(under.pixel(x, y), qRgb(200, 20 * label, 90), isOutline ? std::min(1.0, 2 * part) : part));
      }
  }
  return picture;
}

}  // namespace

class TestLabelPicture : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void segmentsAreThoseOfATwin();
};

void TestLabelPicture::segmentsAreThoseOfATwin() {
  const std::vector<VolumePtr> volumes{shearedRamp(0), shearedRamp(60)};
  const Seeds seeds = seedsOf(40, 2000);
  int tinted = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    SliceRequest request = requestUnder(volumes[0], chance);
    request.segments.push_back(chanceSegments(chance, volumes[0]->geometry()));
    const Result<QImage> picture = drawSlice(request);
    QVERIFY(picture);
    const QImage expected = segmentsByPixel(request);
    QVERIFY2(*picture == expected, qPrintable(QStringLiteral("seed %1").arg(seed)));
    tinted += expected != (*drawUnderneath(request)).convertToFormat(QImage::Format_RGB32) ? 1 : 0;
  }
  QVERIFY(tinted > seeds.count / 2);
}

VOLUMEN_TEST(TestLabelPicture);
#include "tst_label_picture.moc"
