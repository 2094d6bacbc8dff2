// Guards colour maps and overlaid layers.
#include <cmath>
#include <limits>

#include "tests/unit/suite.h"
#include "viewer/slice/colour_map.h"

using namespace volumen;

namespace {

quint32 rgb(int r, int g, int b) { return 0xff000000u | quint32(r) << 16 | quint32(g) << 8 | quint32(b); }
int red(quint32 c) { return c >> 16 & 0xff; }
int green(quint32 c) { return c >> 8 & 0xff; }
int blue(quint32 c) { return c & 0xff; }

}  // namespace

class TestColourMap : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void mapsRunThroughTheirPalettes_data();
  void mapsRunThroughTheirPalettes();
  void namesAreReadBack();
  void layersAreMixed_data();
  void layersAreMixed();
};

void TestColourMap::mapsRunThroughTheirPalettes_data() {
  QTest::addColumn<int>("map");
  QTest::addColumn<int>("entry");
  QTest::addColumn<quint32>("colour");
  const auto row = [](const char* name, ColourMap map, int entry, quint32 colour) {
    QTest::addRow("%s, entry %d", name, entry) << int(map) << entry << colour;
  };
  for (const int entry : {0, 77, 255}) row("grey", ColourMap::grey, entry, rgb(entry, entry, entry));
  // Entries of PS3.6 B.1.1 and B.1.2.
  row("hot iron", ColourMap::hotIron, 0, rgb(0, 0, 0));
  row("hot iron", ColourMap::hotIron, 64, rgb(128, 0, 0));
  row("hot iron", ColourMap::hotIron, 128, rgb(255, 0, 0));
  row("hot iron", ColourMap::hotIron, 160, rgb(255, 64, 0));
  row("hot iron", ColourMap::hotIron, 223, rgb(255, 190, 128));
  row("hot iron", ColourMap::hotIron, 255, rgb(255, 255, 255));
  row("PET", ColourMap::pet, 32, rgb(0, 65, 63));
  row("PET", ColourMap::pet, 96, rgb(65, 63, 191));
  row("PET", ColourMap::pet, 128, rgb(128, 0, 255));
  row("PET", ColourMap::pet, 160, rgb(191, 64, 128));
  row("PET", ColourMap::pet, 192, rgb(255, 128, 0));
  row("PET", ColourMap::pet, 224, rgb(255, 192, 129));
  row("rainbow", ColourMap::rainbow, 0, rgb(0, 0, 255));
  row("rainbow", ColourMap::rainbow, 128, rgb(0, 255, 0));
  row("rainbow", ColourMap::rainbow, 255, rgb(255, 0, 0));
}

void TestColourMap::mapsRunThroughTheirPalettes() {
  QFETCH(int, map);
  QFETCH(int, entry);
  QFETCH(quint32, colour);
  const quint32 found = colourTable(ColourMap(map))[std::size_t(entry)];
  const int off = std::max({std::abs(red(found) - red(colour)), std::abs(green(found) - green(colour)),
                            std::abs(blue(found) - blue(colour))});
  QVERIFY2(off <= 3, qPrintable(QString::number(found, 16)));
  QCOMPARE(found >> 24, 255u);
}

void TestColourMap::namesAreReadBack() {
  for (const ColourMap map : colourMaps()) QCOMPARE(colourMapNamed(colourMapName(map)), std::optional(map));
  QVERIFY(!colourMapNamed("jet"));
}

void TestColourMap::layersAreMixed_data() {
  QTest::addColumn<float>("value");
  QTest::addColumn<double>("opacity");
  QTest::addColumn<quint32>("mixed");
  // The layer is over mid grey. The window 0..255 maps each value to its own byte.
  QTest::newRow("nothing where there is no value")
      << std::numeric_limits<float>::quiet_NaN() << 1.0 << rgb(128, 128, 128);
  QTest::newRow("nothing at the lower end") << 0.0f << 1.0 << rgb(128, 128, 128);
  QTest::newRow("all of it at the upper end") << 255.0f << 1.0 << rgb(255, 255, 255);
  QTest::newRow("half of it") << 128.0f << 0.5 << rgb(192, 64, 64);
  QTest::newRow("half faded in") << 32.0f << 1.0 << rgb(96, 64, 64);
  QTest::newRow("not at all") << 255.0f << 0.0 << rgb(128, 128, 128);
}

void TestColourMap::layersAreMixed() {
  QFETCH(float, value);
  QFETCH(double, opacity);
  QFETCH(quint32, mixed);
  std::uint32_t pixel = rgb(128, 128, 128);
  GreyMapping grey;
  grey.window = {127.5, 255};
  layOver({&pixel, 1}, {&value, 1}, grey, ColourMap::hotIron, opacity);
  const auto near = [](int a, int b) { return std::abs(a - b) <= 1; };  // allows for rounding
  QVERIFY2(near(red(pixel), red(mixed)) && near(green(pixel), green(mixed)) && near(blue(pixel), blue(mixed)),
           qPrintable(QString::number(pixel, 16)));
}

VOLUMEN_TEST(TestColourMap);
#include "tst_colour_map.moc"
