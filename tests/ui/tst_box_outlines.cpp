// Guards that a check box is visible in a list, ticked or not, in both themes. Part of it has a contrast of
// at least 3 with its surroundings (WCAG 2.1, 1.4.11).
#include <cmath>

#include "tests/ui/clean_settings.h"
#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr double leastContrast = 3;

// Returns the relative luminance of WCAG 2.1.
double luminanceOf(QRgb colour) {
  const auto linear = [](int value) {
    const double v = value / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(qRed(colour)) + 0.7152 * linear(qGreen(colour)) + 0.0722 * linear(qBlue(colour));
}

// Returns the highest contrast of any pixel with the background, which is in the corner.
double contrastIn(const QImage& image) {
  const double ground = luminanceOf(image.pixel(1, 1));
  double most = 1;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const double seen = luminanceOf(image.pixel(x, y));
      most = std::max(most, (std::max(seen, ground) + 0.05) / (std::min(seen, ground) + 0.05));
    }
  return most;
}

}  // namespace

class TestBoxOutlines : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void boxesAreSeen_data();
  void boxesAreSeen();
};

void TestBoxOutlines::boxesAreSeen_data() {
  QTest::addColumn<Theme>("theme");
  QTest::newRow("dark") << Theme::dark;
  QTest::newRow("light") << Theme::light;
}

void TestBoxOutlines::boxesAreSeen() {
  QFETCH(Theme, theme);
  SegmentWindow w;
  w.session().prefer([theme](Preferences& p) { p.theme = theme; });
  QVERIFY(w.makeBoth());
  constexpr int lock = 1;  // column with only a check box
  const auto contrast = [&](int row) {
    const QRect cell = w.list()->visualRect(w.list()->model()->index(row, lock));
    return contrastIn(w.list()->viewport()->grab(cell).toImage());
  };
  QCOMPARE(w.list()->currentIndex().row(), 0);
  for (const int row : {0, 1})
    QVERIFY2(contrast(row) >= leastContrast, qPrintable(QString::number(contrast(row))));
  w.tick(1, lock);
  QVERIFY(w.segment(1).locked);
  for (const int row : {0, 1})
    QVERIFY2(contrast(row) >= leastContrast, qPrintable(QString::number(contrast(row))));
}

VOLUMEN_TEST(TestBoxOutlines);
#include "tst_box_outlines.moc"
