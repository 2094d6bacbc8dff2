// Guards the cached slice under tints and segments. It equals a new drawing whatever a request changes, and
// it holds no volume. Segments and tints are blended as defined, pixel by pixel.
#include "tests/fixtures/seeds.h"
#include "tests/ui/chance_slices.h"
#include "tests/unit/suite.h"
#include "ui/controller/picture_underneath.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Changes one random part of the request.
void changePart(SliceRequest& request, Chance& chance, const std::vector<VolumePtr>& volumes) {
  switch (chance.below(6)) {
    case 0:
      request.plane = chancePlane(chance);
      break;
    case 1:
      request.layers.front().volume = volumes[std::size_t(chance.below(2))];
      break;
    case 2:
      request.layers.resize(1);
      if (chance.oneIn(2)) request.layers.push_back(plainLayer(volumes[1], 0.4));
      break;
    case 3:
      std::erase_if(request.layers, [](const SliceLayer& layer) { return layer.tinted.has_value(); });
      if (chance.oneIn(2)) {
        request.layers.push_back(plainLayer(volumes[0], 0.5));
        request.layers.back().tinted = TintedRange{{chance.between(-100, 100), 200}, qRgb(255, 80, 0)};
      }
      break;
    default:
      request.segments.clear();
      if (chance.oneIn(3)) return;
      request.segments.push_back(chanceSegments(chance, volumes[0]->geometry()));
  }
}

}  // namespace

class TestPictureUnderneath : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void keptOrDrawnAnewItIsTheSame();
  void aVolumeIsLetGo();
};

void TestPictureUnderneath::keptOrDrawnAnewItIsTheSame() {
  const std::vector<VolumePtr> volumes{shearedRamp(0), shearedRamp(60)};
  const Seeds seeds = seedsOf(5, 100);
  int kept = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    PictureUnderneath underneath;
    SliceRequest request = requestUnder(volumes[0], chance);
    const void* last = nullptr;
    for (int n = 0; n < 40; ++n) {
      changePart(request, chance, volumes);
      const Result<QImage> picture = underneath.of(request), anew = drawUnderneath(request);
      QVERIFY(picture && anew);
      QVERIFY2(*picture == *anew, qPrintable(QStringLiteral("seed %1, change %2").arg(seed).arg(n)));
      kept += std::exchange(last, picture->constBits()) == picture->constBits() ? 1 : 0;
    }
  }
  QVERIFY(kept > 20);  // the cache is used
}

void TestPictureUnderneath::aVolumeIsLetGo() {
  VolumePtr volume = shearedRamp(0);
  const std::weak_ptr<const Volume> left = volume;
  PictureUnderneath underneath;
  Chance chance{1};
  QVERIFY(underneath.of(requestUnder(std::exchange(volume, nullptr), chance)));
  QVERIFY(left.expired());
}

VOLUMEN_TEST(TestPictureUnderneath);
#include "tst_picture_underneath.moc"
