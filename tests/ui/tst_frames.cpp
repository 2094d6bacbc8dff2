// Guards slices.md 2 in the window: frames, by real events on real files. Pixels on screen are those that the
// README of the data states.
#include <QMenu>

#include "tests/ui/frames_window.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using volumen::tests::clipFile;
using volumen::tests::Frames;
using volumen::tests::longest;

namespace {

bool areNear(QRgb a, QRgb b, int within) {
  return std::abs(qRed(a) - qRed(b)) <= within && std::abs(qGreen(a) - qGreen(b)) <= within &&
         std::abs(qBlue(a) - qBlue(b)) <= within;
}

QRgb grey(int value) { return qRgb(value, value, value); }

// A pixel's colour as README.md of the data states it.
struct Probe {
  int frame;
  QPoint pixel;
  QRgb colour;
};

}  // namespace

class TestFrames : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void pixelsAreThoseOfTheFile_data();
  void pixelsAreThoseOfTheFile();
  void viewsSayWhatTheyShow_data();
  void viewsSayWhatTheyShow();
  void theShapeIsTheFiles();
  void overlaysAreWhiteAndCanGo_data();
  void overlaysAreWhiteAndCanGo();
  void digitsChooseWindowsAndTables();
  void aDragMakesItALinearWindow();
  void coloursHaveNoWindow();
  void invertedAndBack();
  void theMenuOffersWindows();
};

void TestFrames::pixelsAreThoseOfTheFile_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<std::vector<Probe>>("probes");
  QTest::addColumn<int>("within");     // tolerance for files with lossy compression
  QTest::addColumn<double>("window");  // white at this value; 0 for the file's own window
  const auto row = [](const char* file, int within, double window, std::vector<Probe> probes) {
    QTest::newRow(file) << QString::fromLatin1(file) << probes << within << window;
  };
  row("cr-chest-mono1-jpeg8.dcm", 2, 0,
      {{0, {1005, 600}, grey(183)}, {0, {500, 900}, grey(19)}, {0, {100, 100}, grey(0)}});
  row("cr-hip-mono2-jpeg12.dcm", 1, 0, {{0, {1500, 1500}, grey(221)}, {0, {880, 1070}, grey(102)}});
  row("mg-sigmoid-voilut3.dcm", 0, 0,
      {{0, {2000, 1500}, grey(115)}, {0, {2200, 1200}, grey(64)}, {0, {100, 100}, grey(0)}});
  row("mg-ermf-overlay-shutter.dcm", 0, 0, {{0, {659, 394}, grey(89)}, {0, {1200, 20}, grey(231)}});
  row("xa-96frames.dcm", 1, 255,
      {{0, {256, 256}, grey(73)}, {47, {150, 150}, grey(124)}, {95, {400, 120}, grey(39)}});
  row("ot-overlays-embedded.dcm", 0, 4095, {{0, {81, 56}, grey(137)}, {0, {453, 511}, grey(226)}});
  row(clipFile, 5, 0,
      {{0, {190, 65}, qRgb(113, 188, 209)},
       {33, {190, 65}, qRgb(112, 188, 201)},
       {33, {260, 200}, qRgb(23, 23, 23)}});
  row("us-palette-cine-10.dcm", 0, 0,
      {{0, {290, 200}, qRgb(21, 170, 153)}, {9, {290, 200}, qRgb(208, 20, 52)}});
  row("sc-rgb-41.dcm", 0, 0, {{0, {38, 37}, qRgb(232, 209, 39)}, {0, {0, 0}, grey(67)}});
}

void TestFrames::pixelsAreThoseOfTheFile() {
  NEED_FILES();
  QFETCH(QString, file);
  QFETCH(std::vector<Probe>, probes);
  QFETCH(int, within);
  QFETCH(double, window);
  const QByteArray name = file.toLatin1();
  Frames w({name.constData()});
  QVERIFY(w.shows());
  QVERIFY(!w.child<Banner>("banner")->isVisible());
  if (window > 0)  // LINEAR from black at 0 to white at this value
    QVERIFY(w.after([&] {
      w.session().change(QStringLiteral("test"), [&](Workspace& after) {
        after.series.edit(after.series.begin()->first).window = Window{(window + 1) / 2, window + 1};
      });
    }));
  for (const Probe& probe : probes) {
    const int steps = probe.frame - w.look().frame;
    if (steps != 0) QVERIFY(w.after([&] { w.view()->scroll(steps); }));
    QCOMPARE(tests::frameIn(w.view())->key.index, probe.frame);
    const QRgb seen = w.seen(probe.pixel.x(), probe.pixel.y());
    QVERIFY2(areNear(seen, probe.colour, within), qPrintable(QColor(seen).name()));
  }
}

void TestFrames::viewsSayWhatTheyShow_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<QString>("title");
  QTest::addColumn<QString>("pixels");
  QTest::addColumn<QString>("window");
  QTest::addColumn<QPoint>("pixel");
  QTest::addColumn<QString>("said");
  QTest::addColumn<bool>("hasBar");
  const auto row = [](const char* file, const char* title, const char* pixels, const char* window,
                      QPoint pixel, const char* said, bool hasBar) {
    QTest::newRow(file) << QString::fromLatin1(file) << QString::fromLatin1(title)
                        << QString::fromLatin1(pixels) << QString::fromLatin1(window) << pixel
                        << QString::fromLatin1(said) << hasBar;
  };
  row("cr-chest-mono1-jpeg8.dcm", "Frame 1 / 1", "0.175 mm a pixel, at detector|Lossy 12.7:1",
      "W 255.1 L 114.5", {1000, 600}, "60 at 1000, 600 px (175.0, 105.0 mm, at detector)", true);
  row("cr-hip-mono2-jpeg12.dcm", "Frame 1 / 1", "0.2 mm a pixel, at detector|Lossy 35:1", "W 1024 L 511",
      {880, 1070}, "410 at 880, 1070 px (176.0, 214.0 mm, at detector)", true);
  row("mg-ermf-overlay-shutter.dcm", "Frame 1 / 1", "0.08147 mm a pixel, magnification corrected",
      "W 4096 L 2048", {659, 394}, "1436 at 659, 394 px (53.7, 32.1 mm, magnification corrected)", true);
  row("mg-sigmoid-voilut3.dcm", "Frame 1 / 1", "0.09409 mm a pixel, at detector", "W 900 L 2653, sigmoid",
      {2000, 1500}, "2608 at 2000, 1500 px (188.2, 141.1 mm, at detector)", true);
  row(clipFile, "Frame 1 / 34", "mm in regions, else px|Lossy", "", {142, 104},
      "R 0 G 0 B 0 at 142, 104 px (28.6, 22.9 mm in its region)", false);
  row("us-palette-cine-10.dcm", "Frame 1 / 10", "not calibrated: px", "", {290, 200},
      "R 21 G 170 B 153 at 290, 200 px", false);
}

void TestFrames::viewsSayWhatTheyShow() {
  NEED_FILES();
  QFETCH(QString, file);
  QFETCH(QString, title);
  QFETCH(QString, pixels);
  QFETCH(QString, window);
  QFETCH(QPoint, pixel);
  QFETCH(QString, said);
  QFETCH(bool, hasBar);
  const QByteArray name = file.toLatin1();
  Frames w({name.constData()});
  QVERIFY(w.shows());
  const Overlays over = w.view()->overlays();
  QCOMPARE(over.topRight, QStringList(title) + pixels.split(QLatin1Char('|')));
  QCOMPARE(over.bottomRight, window);
  QCOMPARE(over.mmPerPixel > 0, hasBar);
  // Only the mammograms among them state their orientation (TestDerivedWindow::lettersOfProjections).
  QCOMPARE((over.left + over.right + over.top + over.bottom).isEmpty(), !file.startsWith(u"mg-"));
  // Values may differ by 1 or 2 after lossy compression.
  const QString text = w.said(pixel.x(), pixel.y());
  QCOMPARE(text.section(QStringLiteral(" at "), 1), said.section(QStringLiteral(" at "), 1));
  if (!file.contains(QStringLiteral("cine-aspect")) && !file.contains(QStringLiteral("chest")))
    QCOMPARE(text, said);
  QTest::qWait(0);
  w.shot(name.constData());
}

void TestFrames::theShapeIsTheFiles() {
  NEED_FILES();
  Frames w({clipFile});
  QVERIFY(w.shows());
  const SlicePlane plane = *w.view()->plane();
  const VoxelGeometry& geometry = tests::frameIn(w.view())->geometry();
  const glm::dvec2 across = plane.pixelFromPatient(geometry.patientFromVoxel({479.5, 429.5, 0})) -
                            plane.pixelFromPatient(geometry.patientFromVoxel({-0.5, -0.5, 0}));
  QVERIFY(std::abs(across.y / across.x - 430 * 0.8 / 480) < 1e-9);
}

void TestFrames::overlaysAreWhiteAndCanGo_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<int>("bits");
  // Overlapping bits of two planes count once. Pixels that are already white do not count.
  QTest::newRow("in unused bits and beside")
      << QStringLiteral("ot-overlays-embedded.dcm") << 532 + 537 + 603 + 606;
  QTest::newRow("beyond the border") << QStringLiteral("mg-ermf-overlay-shutter.dcm") << 185 + 149;
}

void TestFrames::overlaysAreWhiteAndCanGo() {
  NEED_FILES();
  QFETCH(QString, file);
  QFETCH(int, bits);
  const QByteArray name = file.toLatin1();
  Frames w({name.constData()});
  w.window.resize(1900, 1100);  // shows the whole picture pixel for pixel
  QVERIFY(w.shows());
  const glm::ivec3 size = tests::frameIn(w.view())->geometry().size;
  w.seen(size.x / 2, size.y / 2);
  // Makes the picture below the overlays black.
  QVERIFY(w.after([&] {
    w.session().change(QStringLiteral("test"), [&](Workspace& after) {
      after.series.edit(after.series.begin()->first).window = Window{10000, 20000};
    });
  }));
  const QImage with = w.view()->picture();
  QVERIFY(w.after([&] { w.child<QAction>("overlaysAndShutters")->trigger(); }));
  const QImage without = w.view()->picture();
  int changed = 0;
  for (int y = 0; y < with.height(); ++y)
    for (int x = 0; x < with.width(); ++x) {
      if (with.pixel(x, y) == without.pixel(x, y)) continue;
      ++changed;
      QCOMPARE(qGray(with.pixel(x, y)), 255);
    }
  QCOMPARE(changed, bits);
  QVERIFY(w.after([&] { w.child<QAction>("undo")->trigger(); }));
  QVERIFY(w.look().layers);
}

void TestFrames::digitsChooseWindowsAndTables() {
  NEED_FILES();
  Frames w({"mg-sigmoid-voilut3.dcm"});
  QVERIFY(w.shows());
  const std::tuple<Qt::Key, const char*, int> choices[] = {
      {Qt::Key_2, "W 750 L 2713, sigmoid", 93}, {Qt::Key_3, "W 1050 L 2569, sigmoid", 137},
      {Qt::Key_4, "LUT NORMAL", 115},           {Qt::Key_5, "LUT HARDER", 93},
      {Qt::Key_6, "LUT SOFTER", 137},           {Qt::Key_0, "W 900 L 2653, sigmoid", 115}};
  for (const auto& [key, text, value] : choices) {
    QVERIFY(w.press(key));
    QCOMPARE(w.view()->overlays().bottomRight, QLatin1String(text));
    const QRgb seen = w.seen(2000, 1500);
    // A table of 12 bits and its sigmoid may be rounded differently.
    QVERIFY2(areNear(seen, grey(value), 1), qPrintable(QColor(seen).name()));
  }
}

void TestFrames::aDragMakesItALinearWindow() {
  NEED_FILES();
  Frames w({"mg-sigmoid-voilut3.dcm"});
  QVERIFY(w.shows());
  QVERIFY(w.press(Qt::Key_5));
  QVERIFY(w.press(Qt::Key_1));
  QVERIFY(w.after([&] { tests::drag(w.view(), {50, 50}, {90, 50}); }));
  QCOMPARE(w.view()->overlays().bottomRight, QStringLiteral("W 1350 L 2653"));
  const double value = (2407 - 2652.5) / 1349 + 0.5;
  QCOMPARE(qGray(w.seen(2200, 1200)), int(255 * value + 0.5));
  QTest::keyClick(w.view(), Qt::Key_0);
  QCOMPARE(w.view()->overlays().bottomRight, QStringLiteral("W 900 L 2653, sigmoid"));
}

void TestFrames::coloursHaveNoWindow() {
  NEED_FILES();
  Frames w({"sc-rgb-41.dcm"});
  QVERIFY(w.shows());
  tests::drag(w.view(), {50, 50}, {150, 90});
  QTest::keyClick(w.view(), Qt::Key_1);
  QVERIFY(!w.workspace().series.begin()->second.window);
  QVERIFY(w.view()->overlays().bottomRight.isEmpty());
}

void TestFrames::invertedAndBack() {
  NEED_FILES();
  Frames w({"cr-hip-mono2-jpeg12.dcm"});
  QVERIFY(w.shows());
  const QRgb before = w.seen(880, 1070);
  QVERIFY(w.press(Qt::Key_I));
  const QRgb after = w.seen(880, 1070);
  QVERIFY2(std::abs(qGray(before) + qGray(after) - 255) <= 1, "both are rounded");
  w.child<QAction>("undo")->trigger();
  w.child<QAction>("undo")->trigger();
  QVERIFY(!w.look().inverted);
}

void TestFrames::theMenuOffersWindows() {
  NEED_FILES();
  Frames w({"mg-sigmoid-voilut3.dcm"});
  QVERIFY(w.shows());
  const FlatLook before = w.look();
  QTest::mouseClick(w.view(), Qt::RightButton, {}, {100, 100});
  auto* menu = w.child<QMenu>("flatMenu");
  QVERIFY(menu && menu->isVisible());
  QVERIFY2(w.look() == before, "a click zooms nothing");
  for (QAction* action : menu->actions())
    if (action->text().startsWith(QStringLiteral("HARDER, LUT")))
      QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(action).center());
  QCOMPARE(w.view()->overlays().bottomRight, QStringLiteral("LUT HARDER"));
}

VOLUMEN_TEST(TestFrames);
#include "tst_frames.moc"
