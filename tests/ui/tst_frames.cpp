// Guards slices.md 2 in the window: frames as acquired, by real events on real files; pixels on screen are
// those that the data's README states.
#include <QDir>
#include <QDragEnterEvent>
#include <QElapsedTimer>
#include <QMenu>
#include <QMimeData>
#include <QTemporaryDir>
#include <QTreeWidgetItemIterator>
#include <QWheelEvent>
#include <cmath>
#include <set>

#include "tests/fixtures/fixtures.h"
#include "tests/ui/gestures.h"
#include "tests/ui/journey.h"
#include "tests/unit/suite.h"
#include "ui/panels/studies_panel.h"
#include "ui/views/cine_player.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "ui/workspace/cine.h"

using namespace volumen;
using volumen::tests::Journey;
using volumen::tests::longest;

namespace {

QString dataFile(const char* name) {
  return QString::fromStdString(tests::dataPath("dicom-2d") + "/" + name);
}

const char* const clipFile = "us-cine-aspect-regions.dcm";

void wheel(QWidget* on, int notches, Qt::KeyboardModifiers keys = {}) {
  const QPointF middle(on->width() / 2.0, on->height() / 2.0);
  QWheelEvent event(middle, on->mapToGlobal(middle), {}, {0, 120 * notches}, Qt::NoButton, keys,
                    Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(on, &event);
}

// A window on files of the data.
struct Frames : Journey {
  explicit Frames(const std::vector<const char*>& files) {
    window.resize(1440, 900);
    QStringList paths;
    for (const char* file : files) paths << dataFile(file);
    window.open(paths);
  }

  Session& session() { return window.session(); }
  const Workspace& workspace() { return session().workspace(); }
  SliceView* view(ViewId id = axialViewId) { return window.views()->sliceView(id); }
  QTreeWidget* tree() { return child<QTreeWidget>("studyTree"); }
  QTreeWidgetItem* item(const char* text) {
    return tree()->findItems(QLatin1String(text), Qt::MatchContains | Qt::MatchRecursive).value(0);
  }
  FlatLook look(ViewId id = axialViewId) { return flatLookOf(workspace().view(id)); }

  // Whether the frame of the workspace comes on screen.
  bool shows(ViewId id = axialViewId) {
    const auto isThere = [&] {
      const SliceView* v = view(id);
      return v && v->isVisible() && v->frame() && v->frame()->key.series == v->state().series &&
             v->frame()->key.index == look(id).frame && !v->picture().isNull();
    };
    return QTest::qWaitFor(isThere, longest);
  }
  // Waits for the picture after something was done.
  bool after(const std::function<void()>& act, ViewId id = axialViewId) {
    QSignalSpy shown(view(id), &SliceView::settled);
    act();
    return !shown.isEmpty() || shown.wait(longest);
  }
  bool press(Qt::Key key, ViewId id = axialViewId) {
    return after([&] { QTest::keyClick(view(id), key); }, id);
  }
  // What is on screen of a pixel, which is put in the middle of the view, as large as a pixel of the screen.
  QRgb seen(int column, int row, ViewId id = axialViewId) {
    SliceView* v = view(id);
    const VoxelGeometry& geometry = v->frame()->geometry();
    const SlicePlane whole = *v->plane();
    const glm::dvec3 p = geometry.patientFromVoxel({column, row, 0}), from = p - geometry.centre();
    const glm::dvec3 spacing = geometry.spacing();
    const double mm = std::min(spacing.x, spacing.y);
    const glm::dvec2 half = glm::dvec2(whole.size) / 2.0;
    const glm::dvec2 toCentre = half - glm::floor(half) - 0.5;
    FlatLook now = look(id);
    now.zoom *= whole.mmPerPixel / mm;
    now.panMm = glm::dvec2(glm::dot(from, whole.right), glm::dot(from, whole.down)) + toCentre * mm;
    const auto zoomed = [&] {
      session().change(QStringLiteral("test"),
                       [&](Workspace& w) { w.view(id).flats[v->state().series] = now; });
    };
    const bool isThere = std::abs(now.zoom / look(id).zoom - 1) < 1e-12 && now.panMm == look(id).panMm;
    if (!isThere && !after(zoomed, id)) return 0;
    const glm::dvec2 at = v->plane()->pixelFromPatient(p);
    return v->picture().pixel(int(at.x), int(at.y));
  }
  // What the status line says of a pixel under the cursor.
  QString said(int column, int row) {
    SliceView* v = view();
    QString text;
    const auto listening = QObject::connect(v, &View::hovered, v, [&](const QString& t) { text = t; });
    const glm::dvec2 at =
        v->plane()->pixelFromPatient(v->frame()->geometry().patientFromVoxel({column, row, 0}));
    tests::hover(v, QPointF(at.x, at.y) / v->devicePixelRatioF());
    QObject::disconnect(listening);
    return text;
  }
  void choose(const char* text) {
    QTest::mouseClick(tree()->viewport(), Qt::LeftButton, {}, tree()->visualItemRect(item(text)).center());
  }
};

#define NEED_FILES()                      \
  NEED_DATA(tests::dataPath("dicom-2d")); \
  QVERIFY(QDir(QString::fromStdString(tests::dataPath("dicom-2d"))).exists())

bool areNear(QRgb a, QRgb b, int within) {
  return std::abs(qRed(a) - qRed(b)) <= within && std::abs(qGreen(a) - qGreen(b)) <= within &&
         std::abs(qBlue(a) - qBlue(b)) <= within;
}

QRgb grey(int value) { return qRgb(value, value, value); }

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
  void framesAreScrolled();
  void theScrollToolGoesThroughFrames();
  void digitsChooseWindowsAndTables();
  void aDragMakesItALinearWindow();
  void coloursHaveNoWindow();
  void invertedAndBack();
  void theMenuOffersWindows();
  void aClipIsPlayedByTheClock();
  void playingEndsWithAScroll();
  void aClipThatIsTooSlowIsRed();
  void aClipIsDraggedIntoAComparedView();
  void aVolumeAndAClipInTurn();
  void aVolumeIsShownAsFramesAndBack();
  void aPictureIsShownAsASliceAndBack();
  void theListTellsFrames();
  void layoutsSayWhyNothingComes();
  void namesAreHidden();
  void aFileThatWentIsASentence();
};

namespace {

// What README.md of the data says of a pixel.
struct Probe {
  int frame;
  QPoint pixel;
  QRgb colour;
};

}  // namespace

void TestFrames::pixelsAreThoseOfTheFile_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<std::vector<Probe>>("probes");
  QTest::addColumn<int>("within");     // of files that are decoded with a loss
  QTest::addColumn<double>("window");  // from 0 to this; 0: the file's own
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
        after.series.begin()->second.window = Window{(window + 1) / 2, window + 1};
      });
    }));
  for (const Probe& probe : probes) {
    const int steps = probe.frame - w.look().frame;
    if (steps != 0) QVERIFY(w.after([&] { w.view()->scroll(steps); }));
    QCOMPARE(w.view()->frame()->key.index, probe.frame);
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
  row("cr-chest-mono1-jpeg8.dcm", "Frame 1 / 1", "0.175 mm a pixel, at detector", "W 255.1 L 114.5",
      {1000, 600}, "60 at 1000, 600 px (175.0, 105.0 mm, at detector)", true);
  row("cr-hip-mono2-jpeg12.dcm", "Frame 1 / 1", "0.2 mm a pixel, at detector", "W 1024 L 511", {880, 1070},
      "410 at 880, 1070 px (176.0, 214.0 mm, at detector)", true);
  row("mg-ermf-overlay-shutter.dcm", "Frame 1 / 1", "0.08147 mm a pixel, magnification corrected",
      "W 4096 L 2048", {659, 394}, "1436 at 659, 394 px (53.7, 32.1 mm, magnification corrected)", true);
  row("mg-sigmoid-voilut3.dcm", "Frame 1 / 1", "0.09409 mm a pixel, at detector", "W 900 L 2653, sigmoid",
      {2000, 1500}, "2608 at 2000, 1500 px (188.2, 141.1 mm, at detector)", true);
  row(clipFile, "Frame 1 / 34", "not calibrated: px", "", {142, 104},
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
  QCOMPARE(over.topRight, (QStringList{title, pixels}));
  QCOMPARE(over.bottomRight, window);
  QCOMPARE(over.mmPerPixel > 0, hasBar);
  // Of these, mammograms alone say where their sides are (TestReferencesWindow::lettersOfProjections).
  QCOMPARE((over.left + over.right + over.top + over.bottom).isEmpty(), !file.startsWith(u"mg-"));
  // The values of what is compressed with a loss may be 1 or 2 off.
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
  const VoxelGeometry& geometry = w.view()->frame()->geometry();
  const glm::dvec2 across = plane.pixelFromPatient(geometry.patientFromVoxel({479.5, 429.5, 0})) -
                            plane.pixelFromPatient(geometry.patientFromVoxel({-0.5, -0.5, 0}));
  QVERIFY(std::abs(across.y / across.x - 430 * 0.8 / 480) < 1e-9);
}

void TestFrames::overlaysAreWhiteAndCanGo_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<int>("bits");
  // Where bits of two planes meet they count once; what is white already counts not at all.
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
  w.window.resize(1900, 1100);  // the whole picture, pixel for pixel
  QVERIFY(w.shows());
  const glm::ivec3 size = w.view()->frame()->geometry().size;
  w.seen(size.x / 2, size.y / 2);
  // Nothing white below them.
  QVERIFY(w.after([&] {
    w.session().change(QStringLiteral("test"), [&](Workspace& after) {
      after.series.begin()->second.window = Window{10000, 20000};
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

void TestFrames::framesAreScrolled() {
  NEED_FILES();
  Frames w({clipFile});
  QVERIFY(w.shows());
  QVERIFY(w.press(Qt::Key_Down));
  QCOMPARE(w.look().frame, 1);
  QVERIFY(w.after([&] { wheel(w.view(), -3); }));
  QCOMPARE(w.look().frame, 4);
  QVERIFY(w.press(Qt::Key_End));
  QCOMPARE(w.view()->overlays().topRight.front(), QStringLiteral("Frame 34 / 34"));
  QTest::keyClick(w.view(), Qt::Key_Down);
  QCOMPARE(w.look().frame, 33);
  w.child<QAction>("undo")->trigger();
  QCOMPARE(w.look().frame, 0);
  w.child<QAction>("redo")->trigger();
  QVERIFY(w.shows());
  QVERIFY(w.press(Qt::Key_Home));
  QCOMPARE(w.look().frame, 0);
}

void TestFrames::theScrollToolGoesThroughFrames() {
  NEED_FILES();
  Frames w({clipFile});
  QVERIFY(w.shows());
  w.view()->setTool(flatTool("scroll"));
  QVERIFY(w.after([&] { tests::drag(w.view(), {50, 50}, {50, 50.0 + w.view()->height() / 2.0}); }));
  QVERIFY2(std::abs(w.look().frame - 17) <= 1, qPrintable(QString::number(w.look().frame)));
  w.child<QAction>("undo")->trigger();
  QCOMPARE(w.look().frame, 0);
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
    // A table of 12 bits and its sigmoid may round apart.
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

// 33 frames a second; frames are dropped rather than time, so that the clock says which one is on screen.
void TestFrames::aClipIsPlayedByTheClock() {
  NEED_FILES();
  Frames w({clipFile});
  QVERIFY(w.shows());
  std::set<int> seen;
  const int steps = w.session().undoStack().count();
  // Before the player's own, so that what is due by it is never a frame behind what is shown.
  QElapsedTimer clock;
  clock.start();
  QTest::keyClick(w.view(), Qt::Key_C);
  QVERIFY(w.view()->isPlaying());
  const auto hasRun = [&] {
    seen.insert(w.view()->frame()->key.index);
    const bool saysRate = w.view()->overlays().topRight.front().endsWith(QStringLiteral(" a second"));
    return clock.elapsed() > 2000 && seen.size() > 20 && saysRate;
  };
  QVERIFY(QTest::qWaitFor(hasRun, longest));
  qInfo("%s", qPrintable(w.view()->overlays().topRight.front()));
  const int due = cineFrame({33, {}, false}, 34, 0, double(clock.elapsed()));
  QTest::keyClick(w.view(), Qt::Key_C);
  QVERIFY(!w.view()->isPlaying());
  // Half a second late at most on a machine that is busy with other tests.
  const int late = (due - w.look().frame + 34) % 34;
  QVERIFY2(late <= 16, qPrintable(QStringLiteral("%1 is due, %2 is shown").arg(due).arg(w.look().frame)));
  QCOMPARE(w.session().undoStack().count(), steps + 1);
  w.child<QAction>("undo")->trigger();
  QCOMPARE(w.look().frame, 0);
}

void TestFrames::playingEndsWithAScroll() {
  NEED_FILES();
  Frames w({"us-palette-cine-10.dcm"});
  QVERIFY(w.shows());
  w.child<QAction>("playFrames")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(w.view()->frame()->key.index >= 3, longest);
  const int shown = w.view()->frame()->key.index;
  wheel(w.view(), 1);
  QVERIFY(!w.view()->isPlaying());
  QCOMPARE(w.look().frame, shown - 1);
}

void TestFrames::aClipThatIsTooSlowIsRed() {
  CinePlayer player({20, {}, false}, 100, 0);
  for (int frame = 0; frame < 16; ++frame) {
    player.tellShown(frame);
    QTest::qWait(100);
  }
  QVERIFY2(player.rate() > 0 && player.rate() < 10.5, qPrintable(QString::number(player.rate())));
  QVERIFY(player.isLate());
  Overlays over;
  over.topRight = {QStringLiteral("Frame 1 / 2"), QStringLiteral("px")};
  over.isLate = true;
  for (const PlacedText& text : placeOverlays(over, QRectF(0, 0, 400, 300), QFont()).texts)
    QCOMPARE(text.late, text.text.startsWith(QStringLiteral("Frame")));
}

void TestFrames::aClipIsDraggedIntoAComparedView() {
  NEED_FILES();
  Frames w({clipFile, "cr-hip-mono2-jpeg12.dcm"});
  QVERIFY(w.shows());
  QTRY_VERIFY_WITH_TIMEOUT(w.item("(hidden)") || w.tree()->topLevelItemCount() >= 2, longest);
  w.child<QAction>("layoutTwo")->trigger();
  QVERIFY(w.shows(firstComparedId));
  QTreeWidgetItem* hip = nullptr;
  for (QTreeWidgetItemIterator it(w.tree()); *it; ++it)
    if ((*it)->toolTip(0).contains(QStringLiteral("cr-hip"))) hip = *it;
  QVERIFY(hip);
  const std::unique_ptr<QMimeData> dragged(
      w.tree()->model()->mimeData({w.tree()->indexAt(w.tree()->visualItemRect(hip).center())}));
  SliceView* second = w.view(firstComparedId + 1);
  QDragEnterEvent enter({50, 50}, Qt::CopyAction, dragged.get(), Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(second, &enter);
  QVERIFY(enter.isAccepted());
  QDropEvent drop(QPointF(50, 50), Qt::CopyAction, dragged.get(), Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(second, &drop);
  QVERIFY(w.shows(firstComparedId + 1));
  QVERIFY(!w.view(firstComparedId + 1)->frame()->colour());
  QVERIFY(w.view(firstComparedId)->frame()->colour());
  w.shot("frames-compared");
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.workspace().view(firstComparedId + 1).series.empty());
}

void TestFrames::aVolumeAndAClipInTurn() {
  NEED_FILES();
  Frames w({"../pet-ct/sts019-ct", clipFile});
  QVERIFY(w.settle());
  w.child<QAction>("layoutPlanes")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(w.item("34 frames") != nullptr, longest);
  for (int turn = 0; turn < 3; ++turn) {
    w.choose("34 frames");
    QVERIFY(w.shows());
    QVERIFY(!w.window.view()->isVisible());
    QVERIFY(w.view()->hasFocus());
    QVERIFY(w.window.windowTitle().contains(QStringLiteral("US")));
    w.choose("47 slices");
    QTRY_VERIFY_WITH_TIMEOUT(!w.view()->showsFrames() && !w.view()->picture().isNull(), longest);
    QVERIFY(w.window.view()->isVisible());
    QVERIFY(w.session().series());
  }
  for (int step = 0; step < 5; ++step) w.child<QAction>("undo")->trigger();
  QVERIFY(w.shows());
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.window.view()->isVisible());
}

void TestFrames::aVolumeIsShownAsFramesAndBack() {
  NEED_FILES();
  Frames w({"ct-two-windows.dcm"});
  QVERIFY(w.settle());
  QAction* asFrames = w.child<QAction>("showAsFrames");
  QVERIFY(asFrames->isEnabled() && !asFrames->isChecked());
  asFrames->trigger();
  QVERIFY(w.shows());
  QVERIFY(asFrames->isChecked());
  QCOMPARE(qGray(w.seen(256, 256)), 246);
  QVERIFY(w.press(Qt::Key_2));
  QCOMPARE(qGray(w.seen(256, 256)), 85);
  QCOMPARE(w.said(256, 256).section(QLatin1Char(' '), 0, 1), QStringLiteral("202 HU"));
  QVERIFY2(!w.view()->overlays().left.isEmpty(), "it lies somewhere in the patient");
  asFrames->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(w.window.view()->isVisible(), longest);
  QVERIFY(!asFrames->isChecked());
  QVERIFY(w.session().series());
}

// It was never in memory as a volume.
void TestFrames::aPictureIsShownAsASliceAndBack() {
  NEED_FILES();
  Frames w({"us-palette-cine-10.dcm", "mg-ermf-overlay-shutter.dcm"});
  QVERIFY(w.shows());
  QTRY_VERIFY_WITH_TIMEOUT(w.item("1 frame") != nullptr, longest);
  w.choose("1 frame");
  QVERIFY(w.shows());
  QAction* asFrames = w.child<QAction>("showAsFrames");
  QVERIFY(asFrames->isChecked());
  asFrames->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(w.session().series() && !asFrames->isChecked(), longest);
  QVERIFY(w.window.view()->isVisible());
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.shows());
  QVERIFY(asFrames->isChecked());
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.shows());
  QVERIFY(w.view()->frame()->colour());
}

void TestFrames::theListTellsFrames() {
  NEED_FILES();
  Frames w({clipFile});
  QVERIFY(w.shows());
  QTreeWidgetItem* clip = w.item("34 frames");
  QVERIFY(clip);
  QVERIFY(clip->toolTip(0).contains(QStringLiteral("cannot be shown in 3D")));
  const auto hasThumbnail = [&] {
    const QImage icon = clip->icon(0).pixmap(44, 44).toImage();
    for (int y = 0; y < icon.height(); ++y)
      for (int x = 0; x < icon.width(); ++x)
        if (qAlpha(icon.pixel(x, y)) && qGray(icon.pixel(x, y)) > 60) return true;
    return false;
  };
  QTRY_VERIFY_WITH_TIMEOUT(hasThumbnail(), longest);
  QVERIFY2(!w.item("Could not be read"), "what is shown is not listed as unread");
}

void TestFrames::layoutsSayWhyNothingComes() {
  NEED_FILES();
  Frames w({clipFile});
  QVERIFY(w.shows());
  w.child<QAction>("layoutPlanes")->trigger();
  QVERIFY(!w.window.view()->isVisible());
  const auto labels = w.window.findChildren<QLabel*>();
  QVERIFY(std::ranges::any_of(labels, [](QLabel* label) {
    return label->isVisible() && label->text().startsWith(QStringLiteral("Shown as frames alone"));
  }));
  QVERIFY(!w.child<QAction>("showAsFrames")->isEnabled());
}

void TestFrames::namesAreHidden() {
  NEED_FILES();
  Frames w({"cr-hip-mono2-jpeg12.dcm"});
  QVERIFY(w.shows());
  QVERIFY(w.view()->overlays().topLeft.front().contains(QStringLiteral("CompressedSamples")));
  QVERIFY(w.window.windowTitle().contains(QStringLiteral("CompressedSamples")));
  w.child<QAction>("hideNames")->trigger();
  QVERIFY(!w.view()->overlays().topLeft.join(QString()).contains(QStringLiteral("Compressed")));
  QVERIFY(!w.window.windowTitle().contains(QStringLiteral("Compressed")));
  w.child<QAction>("hideNames")->trigger();
}

void TestFrames::aFileThatWentIsASentence() {
  NEED_FILES();
  const QTemporaryDir folder;
  const QString copy = folder.filePath(QStringLiteral("clip.dcm"));
  QVERIFY(QFile::copy(dataFile("us-palette-cine-10.dcm"), copy));
  Frames w({});
  w.window.open({dataFile("sc-rgb-41.dcm"), copy});
  QVERIFY(w.shows());
  QTRY_VERIFY_WITH_TIMEOUT(w.item("10 frames") != nullptr, longest);
  QVERIFY(QFile::remove(copy));
  w.choose("10 frames");
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->failure().isEmpty(), longest);
  QVERIFY(w.view()->failure().contains(QStringLiteral("clip.dcm")));
  w.choose("1 frame");
  QVERIFY(w.shows());
  QVERIFY(w.view()->failure().isEmpty());
}

VOLUMEN_TEST(TestFrames);
#include "tst_frames.moc"
