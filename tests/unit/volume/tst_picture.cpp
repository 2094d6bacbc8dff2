// Guards picture.md 6: how a picture's floats become written and displayed bytes.
#include <cmath>
#include <random>

#include "tests/unit/suite.h"
#include "viewer/volume/picture.h"

using namespace volumen;

namespace {

// Returns components between two bytes, most of them close to where rounding changes, and a few out of range.
std::vector<float> pixels(int count) {
  std::mt19937 random(count);
  std::uniform_int_distribution<int> byte(0, 255), towards(0, 2);
  std::uniform_real_distribution<float> part(-0.5f, 0.5f);
  std::vector<float> rgba;
  for (int n = 0; n < 4 * count; ++n) {
    float x = (float(byte(random)) + (n % 3 == 0 ? part(random) : 0.5f)) / 255;
    x = std::nextafter(x, float(towards(random)));
    rgba.push_back(n % 13 == 5 ? -0.25f : n % 17 == 7 ? 1.5f : x);
  }
  return rgba;
}

int rounded(double x) { return int(std::floor(255 * std::clamp(x, 0.0, 1.0) + 0.5)); }

}  // namespace

class TestPicture : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aPixelOfTheScreenIsRoundedAndNotAboveItsAlpha();
  void aFileHoldsStraightColour();
};

// Each count leaves a different remainder of a vector.
void TestPicture::aPixelOfTheScreenIsRoundedAndNotAboveItsAlpha() {
  for (int count = 0; count <= 67; ++count) {
    const std::vector<float> rgba = pixels(count);
    std::vector<std::uint32_t> argb(count + 1, 0x12345678);
    toArgb(rgba.data(), count, argb.data());
    for (int n = 0; n < count; ++n) {
      const auto byte = [&](int c) {
        return std::uint32_t(std::min(rounded(rgba[4 * n + c]), rounded(rgba[4 * n + 3])));
      };
      QCOMPARE(argb[n], byte(3) << 24 | byte(0) << 16 | byte(1) << 8 | byte(2));
    }
    QCOMPARE(argb[count], 0x12345678u);
  }
}

void TestPicture::aFileHoldsStraightColour() {
  Picture picture{{2, 1}, true, {0.25f, 0.5f, 0.1f, 0.5f, 0.0f, 0.0f, 0.0f, 0.0f}};
  QCOMPARE(toBytes(picture), (std::vector<std::uint8_t>{128, 255, 51, 128, 0, 0, 0, 0}));
  picture.transparent = false;
  QCOMPARE(toBytes(picture), (std::vector<std::uint8_t>{64, 128, 26, 0, 0, 0}));
}

VOLUMEN_TEST(TestPicture);
#include "tst_picture.moc"
