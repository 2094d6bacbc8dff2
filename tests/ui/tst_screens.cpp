// Guards issue 51: a window is restored on the screens that exist, and a screen of 16 bits per pixel shows
// what others show.
#include <QScreen>
#include <QSettings>

#include "tests/ui/journey.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/views/canvas.h"
#include "ui/widgets/on_screen.h"

using namespace volumen;
using namespace volumen::tests;

class TestScreens : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aWindowLiesOnAScreen_data();
  void aWindowLiesOnAScreen();
  void aWindowComesBackOnTheScreen();
  void theThirdDimensionIsSeen();
};

void TestScreens::aWindowLiesOnAScreen_data() {
  QTest::addColumn<QRect>("window");
  QTest::addColumn<QList<QRect>>("screens");
  QTest::addColumn<QRect>("expected");
  const QRect laptop(0, 0, 1366, 768), beside(1366, 0, 1920, 1080), below(0, 28, 1366, 740);
  QTest::newRow("it fits") << QRect(10, 20, 800, 600) << QList{laptop} << QRect(10, 20, 800, 600);
  QTest::newRow("larger than the screen") << QRect(200, 100, 1440, 900) << QList{laptop} << laptop;
  QTest::newRow("wider alone") << QRect(200, 100, 1440, 500) << QList{laptop} << QRect(0, 100, 1366, 500);
  QTest::newRow("of a screen that is gone")
      << QRect(2000, 300, 800, 600) << QList{laptop} << QRect(566, 168, 800, 600);
  QTest::newRow("on the second one") << QRect(2000, 300, 800, 600) << QList{laptop, beside}
                                     << QRect(2000, 300, 800, 600);
  QTest::newRow("between both, mostly on the second")
      << QRect(1300, 300, 800, 600) << QList{laptop, beside} << QRect(1366, 300, 800, 600);
  QTest::newRow("left above") << QRect(-500, -400, 800, 600) << QList{laptop} << QRect(0, 0, 800, 600);
  QTest::newRow("under the title bar") << QRect(0, 0, 800, 600) << QList{below} << QRect(0, 28, 800, 600);
  QTest::newRow("no screen") << QRect(5, 5, 8, 6) << QList<QRect>{} << QRect(5, 5, 8, 6);
}

void TestScreens::aWindowLiesOnAScreen() {
  QFETCH(QRect, window);
  QFETCH(QList<QRect>, screens);
  QFETCH(QRect, expected);
  QCOMPARE(onScreen(window, screens), expected);
}

void TestScreens::aWindowComesBackOnTheScreen() {
  const QRect screen = QApplication::primaryScreen()->availableGeometry();
  {
    MainWindow window(realServices());
    window.setGeometry(QRect(screen.bottomRight() - QPoint(40, 40), screen.size() + QSize(200, 200)));
    window.show();
    window.close();
  }
  MainWindow window(realServices());
  const QSize least = window.minimumSizeHint();
  QVERIFY(screen.contains(window.geometry().topLeft()));
  QVERIFY(window.width() <= std::max(screen.width(), least.width()));
  QVERIFY(window.height() <= std::max(screen.height(), least.height()));
  QSettings().remove(QStringLiteral("window"));
}

// Reads the screen itself, if the platform allows it.
void TestScreens::theThirdDimensionIsSeen() {
  Journey w;
  w.window.session().show(ballSeries());
  QVERIFY(w.settle());
  if (QApplication::platformName() != QLatin1String("xcb"))
    QSKIP("only an X server tells what is on its screen");
  QScreen* screen = w.window.screen();
  qInfo("%d bits a pixel, %s", screen->depth(), qPrintable(canvasKind(w.window.view()->canvas())));
  const auto middle = [&] {
    const QPoint at = w.window.view()->mapToGlobal(w.window.view()->rect().center());
    return qGray(screen->grabWindow(0, at.x(), at.y(), 1, 1).toImage().pixel(0, 0));
  };
  const QImage& picture = w.window.view()->picture();
  QVERIFY(qGray(picture.pixel(picture.rect().center())) > 60);
  QTRY_VERIFY2(middle() > 60, "the screen is black where the ball is");
}

VOLUMEN_TEST(TestScreens);
#include "tst_screens.moc"
