// Guards how the window looks at any size. The picture has the space, nothing overlaps or is cut off, panels
// fold to their titles, and layouts of earlier versions do no harm.
#include <QAbstractButton>
#include <QColorDialog>
#include <QDockWidget>
#include <QLabel>
#include <QScrollArea>
#include <QScrollBar>
#include <QSettings>
#include <QTabBar>

#include "io/study/frame_series.h"
#include "tests/fixtures/fixtures.h"
#include "tests/ui/clean_settings.h"
#include "tests/ui/journey.h"
#include "tests/ui/test_series.h"
#include "tests/ui/window_flaws.h"
#include "tests/unit/suite.h"
#include "ui/views/flat_view.h"
#include "ui/views/view_grid.h"

using namespace volumen;
using volumen::tests::flaws;
using volumen::tests::longest;

namespace {

// A window of this size that shows a ball.
struct Sized : MainWindow {
  explicit Sized(QSize size, int textPercent = 100, Theme theme = Theme::dark) : MainWindow(realServices()) {
    session().prefer([&](Preferences& p) {
      p.textPercent = textPercent;
      p.theme = theme;
    });
    resize(size);
    show();
    session().show(tests::ballSeries());
    QCoreApplication::processEvents();
  }
  QDockWidget* dock(const char* name) {
    return findChild<QDockWidget*>(QLatin1String(name) + QStringLiteral("Dock"));
  }
  // Returns whether a panel's tab is selected.
  bool onTop(const char* name) {
    for (const QTabBar* bar : findChildren<QTabBar*>())
      if (bar->currentIndex() >= 0 && bar->tabText(bar->currentIndex()) == dock(name)->windowTitle())
        return true;
    return false;
  }
  QAbstractButton* fold(const char* name) {
    return findChild<QAbstractButton*>(QLatin1String(name) + QStringLiteral("DockFold"));
  }
};

}  // namespace

class TestLooks : public tests::CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void thePictureHasTheRoom_data();
  void thePictureHasTheRoom();
  void nothingOverlapsOrIsCutOff_data();
  void nothingOverlapsOrIsCutOff();
  void panelsAreWholeInAUsualWindow_data();
  void panelsAreWholeInAUsualWindow();
  void theOpenPageOfSegmentsIsSeen_data();
  void theOpenPageOfSegmentsIsSeen();
  void panelsFoldToTheirTitles();
  void hiddenPanelsAreOpenedFromTheView();
  void layoutsOfEarlierVersionsDoNoHarm();
  void theLayoutIsKept();
  void dialogsAreBritish();
  void realStudiesAreShown_data();
  void realStudiesAreShown();
  void layoutsHaveRoom_data();
  void layoutsHaveRoom();
};

void TestLooks::thePictureHasTheRoom_data() {
  QTest::addColumn<QSize>("size");
  QTest::addColumn<int>("width");
  QTest::newRow("1024 x 700") << QSize(1024, 700) << 540;
  QTest::newRow("1440 x 900") << QSize(1440, 900) << 800;
  QTest::newRow("2560 x 1440") << QSize(2560, 1440) << 1850;
}

void TestLooks::thePictureHasTheRoom() {
  QFETCH(QSize, size);
  QFETCH(int, width);
  Sized window(size);
  QCOMPARE(window.size(), size);
  QVERIFY2(window.view()->width() >= width, qPrintable(QString::number(window.view()->width())));
  const auto area = [](const QWidget* widget) { return widget->width() * widget->height(); };
  for (const char* name : {"studies", "transfer", "lights"})
    QVERIFY2(area(window.view()) > 2 * area(window.dock(name)), name);
}

void TestLooks::nothingOverlapsOrIsCutOff_data() {
  QTest::addColumn<QSize>("size");
  QTest::addColumn<int>("textPercent");
  QTest::addColumn<bool>("light");
  for (const QSize size : {QSize(1024, 700), QSize(1440, 900), QSize(2560, 1440)})
    for (int percent : {100, 140})
      for (bool light : {false, true})
        QTest::addRow("%d x %d, text %d %%, %s", size.width(), size.height(), percent,
                      light ? "light" : "dark")
            << size << percent << light;
}

void TestLooks::nothingOverlapsOrIsCutOff() {
  QFETCH(QSize, size);
  QFETCH(int, textPercent);
  QFETCH(bool, light);
  Sized window(size, textPercent, light ? Theme::light : Theme::dark);
  QCOMPARE(window.size(), size);
  for (const char* tab : {"clip", "segment", "snapshot", "camera", "accuracy", "effects", "lights"}) {
    window.dock(tab)->show();
    window.dock(tab)->raise();
    QTest::qWait(20);
    QTRY_VERIFY2(window.onTop(tab), tab);
    // A label that has just changed its text is laid out a moment later.
    QStringList found;
    QTRY_VERIFY2((found = flaws(window)).isEmpty(),
                 qPrintable(QLatin1String(tab) + QStringLiteral(": ") + found.join(QLatin1Char('\n'))));
  }
}

void TestLooks::panelsAreWholeInAUsualWindow_data() {
  QTest::addColumn<QString>("name");
  for (const char* name : {"transfer", "lights", "clip", "segment", "snapshot"})
    QTest::newRow(name) << QString::fromLatin1(name);
}

void TestLooks::panelsAreWholeInAUsualWindow() {
  QFETCH(QString, name);
  Sized window({1440, 900});
  QDockWidget* dock = window.findChild<QDockWidget*>(name + QStringLiteral("Dock"));
  dock->raise();
  QTest::qWait(20);
  auto* area = dock->findChild<QScrollArea*>();
  QVERIFY(area->isVisible());
  QCOMPARE(area->verticalScrollBar()->maximum(), 0);
}

void TestLooks::theOpenPageOfSegmentsIsSeen_data() {
  QTest::addColumn<Theme>("theme");
  QTest::newRow("dark") << Theme::dark;
  QTest::newRow("light") << Theme::light;
}

namespace {

// Counts pixels in a button's two highest and two lowest rows that differ from its corner.
int framePixels(QWidget* button) {
  const QImage image = button->grab().toImage();
  int framed = 0;
  for (int x = 0; x < image.width(); ++x)
    for (const int y : {0, 1, image.height() - 2, image.height() - 1})
      framed += image.pixel(x, y) != image.pixel(0, 0);
  return framed;
}

}  // namespace

// The button of the open page has a frame, as in the tool bar. Those of the other pages have none.
void TestLooks::theOpenPageOfSegmentsIsSeen() {
  QFETCH(Theme, theme);
  Sized window(QSize(1600, 1000), 100, theme);
  window.dock("segment")->raise();
  QCoreApplication::processEvents();
  const std::vector<const char*> pages{"segmentFromCurve", "segmentPaint", "segmentGrowing", "segmentChange"};
  const auto button = [&](const char* page) {
    return window.findChild<QAbstractButton*>(QLatin1String(page));
  };
  for (const char* open : pages) {
    QTest::mouseClick(button(open), Qt::LeftButton);
    for (const char* page : pages) {
      QCOMPARE(button(page)->isChecked(), page == open);
      QVERIFY2((framePixels(button(page)) > button(page)->width()) == (page == open), page);
    }
  }
}

void TestLooks::panelsFoldToTheirTitles() {
  Sized window({1440, 900});
  const int before = window.dock("lights")->height(), curve = window.dock("transfer")->height();
  QTest::mouseClick(window.fold("transfer"), Qt::LeftButton);
  QTRY_VERIFY(window.dock("lights")->height() > before + 100);
  QVERIFY(window.dock("transfer")->height() < 40);
  QVERIFY(!window.findChild<QWidget*>(QStringLiteral("transferPanel"))->isVisible());
  // A click on the title unfolds the panel, too.
  QTest::mouseClick(window.dock("transfer")->titleBarWidget(), Qt::LeftButton, {}, QPoint(80, 8));
  QTRY_VERIFY(std::abs(window.dock("transfer")->height() - curve) < curve / 10);
  // Tabs fold together, because one that stayed open would keep the space.
  QTest::mouseClick(window.fold("lights"), Qt::LeftButton);
  QTRY_VERIFY(window.dock("lights")->height() < 40);
  QTRY_VERIFY(window.dock("transfer")->height() > curve + 100);
  QTest::mouseClick(window.fold("lights"), Qt::LeftButton);
  QTRY_VERIFY(std::abs(window.dock("lights")->height() - before) < before / 10);
}

void TestLooks::hiddenPanelsAreOpenedFromTheView() {
  Sized window({1440, 900});
  for (const char* name : {"effects", "accuracy", "camera"}) {
    QVERIFY(!window.dock(name)->isVisible());
    window.dock(name)->toggleViewAction()->trigger();
    QTRY_VERIFY2(window.onTop(name), name);
  }
  window.findChild<QAction*>(QStringLiteral("resetLayout"))->trigger();
  QTRY_VERIFY(!window.dock("effects")->isVisible());
  QTRY_VERIFY(window.onTop("lights"));
}

void TestLooks::layoutsOfEarlierVersionsDoNoHarm() {
  // Restores a window state saved with other panels and without a layout version.
  QMainWindow earlier;
  for (const char* name : {"studies", "transfer", "lights", "material", "effects"}) {
    auto* dock = new QDockWidget;
    dock->setObjectName(QLatin1String(name) + QStringLiteral("Dock"));
    earlier.addDockWidget(Qt::LeftDockWidgetArea, dock);
    if (name == std::string("lights")) dock->hide();
  }
  QSettings().setValue(QStringLiteral("window/layout"), earlier.saveState());
  Sized window({1440, 900});
  QVERIFY(!window.dock("effects")->isVisible());
  QTRY_VERIFY(window.onTop("lights"));
  QVERIFY(window.view()->width() > 800);
  QCOMPARE(window.dockWidgetArea(window.dock("transfer")), Qt::RightDockWidgetArea);
}

void TestLooks::theLayoutIsKept() {
  int width = 0;
  {
    Sized window({1440, 900});
    window.dock("studies")->close();
    QTest::mouseClick(window.fold("transfer"), Qt::LeftButton);
    QTest::qWait(20);
    width = window.view()->width();
    window.close();
  }
  Sized window({1440, 900});
  QVERIFY(!window.dock("studies")->isVisible());
  QVERIFY(!window.findChild<QWidget*>(QStringLiteral("transferPanel"))->isVisible());
  QCOMPARE(window.view()->width(), width);
}

void TestLooks::dialogsAreBritish() {
  QColorDialog dialog;
  dialog.setOption(QColorDialog::DontUseNativeDialog);
  QStringList texts{dialog.windowTitle()};
  for (const QAbstractButton* button : dialog.findChildren<QAbstractButton*>()) texts << button->text();
  for (const QLabel* label : dialog.findChildren<QLabel*>()) texts << label->text();
  QVERIFY2(!texts.filter(QStringLiteral("olour")).isEmpty(), qPrintable(texts.join(QLatin1Char('|'))));
  QVERIFY2(texts.filter(QStringLiteral("olor")).isEmpty(), qPrintable(texts.join(QLatin1Char('|'))));
  QCOMPARE(QLocale().toString(1196896), QStringLiteral("1,196,896"));
}

void TestLooks::realStudiesAreShown_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<QSize>("size");
  QTest::addColumn<bool>("light");
  // Takes screenshots of every size and theme if $VOLUMEN_SHOTS names a folder, else of the smallest size.
  const bool all = qEnvironmentVariableIsSet("VOLUMEN_SHOTS");
  const auto sizes = all ? QList<QSize>{{1024, 700}, {1440, 900}, {2560, 1440}} : QList<QSize>{{1024, 700}};
  for (const char* path : {"ct-chest-lidc0314-138", "mr-head-ge-mprage-130", "pet-ct/sts019-pet",
                           "dicom-geometry/ct-ge-tilt-varspacing-28", "dicom-2d/us-cine-aspect-regions.dcm"})
    for (const QSize size : sizes)
      for (bool light : all ? QList<bool>{false, true} : QList<bool>{false})
        QTest::addRow("%s, %d, %s", path, size.width(), light ? "light" : "dark")
            << QString::fromLatin1(path) << size << light;
}

void TestLooks::realStudiesAreShown() {
  QFETCH(QString, path);
  QFETCH(QSize, size);
  QFETCH(bool, light);
  const std::string data = tests::dataPath(path.toStdString());
  NEED_DATA(data);
  Sized window(size, 100, light ? Theme::light : Theme::dark);
  QSignalSpy settled(&window, &MainWindow::settled);
  window.open({QString::fromStdString(data)});
  const auto shown = [&] {
    return seriesIn(window.session().workspace(), window.session().workspace().focus);
  };
  QTRY_VERIFY_WITH_TIMEOUT(shown() && shown()->description != "Ball", longest);
  if (opensAsFrames(*shown())) {
    QTRY_VERIFY_WITH_TIMEOUT(!window.views()->viewAs<FlatView>(axialViewId)->picture().isNull(), longest);
  } else {
    QTRY_VERIFY_WITH_TIMEOUT(window.session().series()->series.description != "Ball", longest);
    settled.clear();
    QTRY_VERIFY_WITH_TIMEOUT(settled.count() > 0, longest);
  }
  const QStringList found = flaws(window);
  QVERIFY2(found.isEmpty(), qPrintable(found.join(QLatin1Char('\n'))));
  const QString name =
      path.section(QLatin1Char('/'), -1) + QStringLiteral("-%1-%2.png").arg(size.width()).arg(light ? 1 : 0);
  if (const QString folder = qEnvironmentVariable("VOLUMEN_SHOTS"); !folder.isEmpty())
    QVERIFY(window.grab().save(QDir(folder).filePath(name)));
}

void TestLooks::layoutsHaveRoom_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<QString>("layout");
  for (const char* path : {"ct-chest-lidc0314-138", "mr-head-ge-mprage-130", "pet-ct/sts019-pet"})
    for (const char* layout : {"layoutPlanes", "layoutBesidePlanes"})
      QTest::addRow("%s, %s", path, layout) << QString::fromLatin1(path) << QString::fromLatin1(layout);
}

void TestLooks::layoutsHaveRoom() {
  QFETCH(QString, path);
  QFETCH(QString, layout);
  const std::string data = tests::dataPath(path.toStdString());
  NEED_DATA(data);
  Sized window({1440, 900});
  window.open({QString::fromStdString(data)});
  QTRY_VERIFY_WITH_TIMEOUT(window.session().series()->series.description != "Ball", longest);
  QSignalSpy settled(&window, &MainWindow::settled);
  window.findChild<QAction*>(layout)->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(settled.count() > 0, longest);
  for (const ViewId id : {axialViewId, coronalViewId, sagittalViewId})
    QTRY_VERIFY(!window.views()->viewAs<FlatView>(id)->picture().isNull());
  if (const QString folder = qEnvironmentVariable("VOLUMEN_SHOTS"); !folder.isEmpty())
    QVERIFY(window.grab().save(QDir(folder).filePath(path.section(QLatin1Char('/'), -1) + QLatin1Char('-') +
                                                     layout + QStringLiteral(".png"))));
  const QStringList found = flaws(window);
  QVERIFY2(found.isEmpty(), qPrintable(found.join(QLatin1Char('\n'))));
}

VOLUMEN_TEST(TestLooks);
#include "tst_looks.moc"
