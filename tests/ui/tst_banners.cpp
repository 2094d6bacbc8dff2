// Guards banners over the views: they disappear with their subject and move no picture. Real events.
#include <QLabel>

#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

class TestBanners : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theyMoveNoPicture();
  void theyEndWithWhatTheySpeakOf_data();
  void theyEndWithWhatTheySpeakOf();
  void eachEndsAlone();
};

void TestBanners::theyMoveNoPicture() {
  MeasureWindow w;
  QCoreApplication::processEvents();
  const QSize size = w.view()->size();
  const QPoint place = w.view()->mapTo(&w.window, QPoint());
  auto* banner = w.child<Banner>("banner");
  banner->tell(QStringLiteral("A sentence."), {QStringLiteral("a"), QStringLiteral("b")});
  QCoreApplication::processEvents();
  QVERIFY(banner->isVisible() && banner->height() > 10);
  QCOMPARE(w.view()->size(), size);
  QCOMPARE(w.view()->mapTo(&w.window, QPoint()), place);
  const QRect views(w.window.views()->mapTo(&w.window, QPoint()), w.window.views()->size()),
      over(banner->mapTo(&w.window, QPoint()), banner->size());
  QVERIFY2(over.bottom() == views.bottom() && over.width() == views.width(), "at their lower edge");
  w.window.resize(w.window.width() - 150, w.window.height() - 80);
  QCoreApplication::processEvents();
  QCOMPARE(banner->mapTo(&w.window, QPoint(0, banner->height())).y(),
           w.window.views()->mapTo(&w.window, QPoint(0, w.window.views()->height())).y());
  QCOMPARE(banner->width(), w.window.views()->width());
}

void TestBanners::theyEndWithWhatTheySpeakOf_data() {
  QTest::addColumn<bool>("bySeries");
  QTest::newRow("another view is in focus") << false;
  QTest::newRow("another series is open") << true;
}

void TestBanners::theyEndWithWhatTheySpeakOf() {
  QFETCH(bool, bySeries);
  MeasureWindow w;
  auto* banner = w.child<Banner>("banner");
  w.session().setFocus(sceneViewId);
  w.child<QAction>("trueSize")->trigger();
  QVERIFY2(banner->isVisible() && banner->sentence().contains(QStringLiteral("Click a slice")),
           qPrintable(banner->sentence()));
  w.session().select(0);
  QVERIFY(banner->isVisible());
  if (bySeries)
    w.session().show(ballSeries());
  else
    QTest::mouseClick(w.view(), Qt::LeftButton, {}, {40, 40});
  QVERIFY(banner->isHidden());
}

void TestBanners::eachEndsAlone() {
  QWidget window;
  auto* over = new QWidget(&window);
  Banner banner(over);
  const int owner = 0;
  banner.tell({QStringLiteral("one"), {QStringLiteral("detail")}, &owner});
  banner.add(QStringLiteral("two"));
  banner.takeBackOfFocus();
  QCOMPARE(banner.sentence(), QStringLiteral("one\ntwo"));
  banner.takeBack(&owner);
  QCOMPARE(banner.sentence(), QStringLiteral("two"));
  QVERIFY(!banner.isHidden());
  banner.takeBack(nullptr);
  QVERIFY(banner.isHidden());
}

VOLUMEN_TEST(TestBanners);
#include "tst_banners.moc"
