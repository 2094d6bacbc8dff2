// Guards that there is something to look at while a series is being loaded: its middle slice, which scrolls,
// gone once the views show the series or the load was given up.
#include <QSemaphore>

#include "tests/ui/frames_window.h"
#include "tests/ui/two_series.h"
#include "ui/views/first_image.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// A window whose loads end when they are let go.
struct SlowLoads {
  QSemaphore gate;
  Journey w;

  explicit SlowLoads(const char* path) : w({}, services()) {
    openAlone(false);
    w.window.open({QString::fromStdString(dataPath(path))});
  }
  ~SlowLoads() { gate.release(100); }
  Services services() {
    Services services = realServices();
    services.makeScene = [this, real = services.makeScene](const std::string& preset, const Volume& volume) {
      gate.acquire();
      return real(preset, volume);
    };
    return services;
  }
  FirstImage* image() { return w.child<FirstImage>("firstImage"); }
  bool appears() {
    return QTest::qWaitFor([this] { return image()->isVisible(); }, longest);
  }
  Session& session() { return w.window.session(); }
  Loader& loader() { return w.window.document().loader; }
  // Lets it be loaded, and waits until it is seen; its key.
  SeriesKey loaded() {
    gate.release(1);
    const auto isSeen = [&] { return flat() && !flat()->picture().isNull() && image()->isHidden(); };
    return QTest::qWaitFor(isSeen, longest) ? flat()->state().series : SeriesKey{};
  }
  FlatView* flat() { return qobject_cast<FlatView*>(w.window.views()->viewShown()); }
};

constexpr const char* chest = "ct-chest-lidc0314-138";

}  // namespace

class TestFirstImages : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cleanup() { openAlone(); }
  void theMiddleSliceIsThereBeforeTheVolume();
  void theWheelScrollsIt();
  void itGoesOnceTheViewsShowTheSeries();
  void itGoesWithTheLoad_data();
  void itGoesWithTheLoad();
  void itLiesOverTheViewThatWaits();
  void whatAnOverlayIsLaidOverStays();
  void whatIsShownAgainEndsTheLoad();
  void whatIsLoadedAtOnceHasNone();
};

void TestFirstImages::theMiddleSliceIsThereBeforeTheVolume() {
  NEED_DATA(dataPath(chest));
  SlowLoads s(chest);
  QVERIFY(s.appears());
  QVERIFY(!s.w.window.session().series());
  QCOMPARE(s.image()->index(), 69);
  QCOMPARE(s.w.window.session().undoStack().count(), 0);
  // The CT is 512 wide: its middle is body, its corner air.
  const QImage& picture = s.image()->picture();
  QCOMPARE(picture.size(), s.image()->size() * s.image()->devicePixelRatioF());
  QVERIFY(qGray(picture.pixel(picture.width() / 2, picture.height() / 2)) > 0);
  s.w.shot("first-image");
}

void TestFirstImages::theWheelScrollsIt() {
  NEED_DATA(dataPath(chest));
  SlowLoads s(chest);
  QVERIFY(s.appears());
  const QImage middle = s.image()->picture();
  wheel(s.image(), -3);
  QTRY_VERIFY_WITH_TIMEOUT(s.image()->index() == 72 && s.image()->picture() != middle, longest);
  wheel(s.image(), 1000);
  QTRY_COMPARE_WITH_TIMEOUT(s.image()->index(), 0, longest);
}

void TestFirstImages::itGoesOnceTheViewsShowTheSeries() {
  NEED_DATA(dataPath(chest));
  SlowLoads s(chest);
  QVERIFY(s.appears());
  s.gate.release(10);
  QTRY_VERIFY_WITH_TIMEOUT(s.image()->isHidden(), longest);
  QVERIFY(s.flat() && !s.flat()->picture().isNull());
}

void TestFirstImages::itGoesWithTheLoad_data() {
  QTest::addColumn<bool>("another");
  QTest::newRow("it is cancelled") << false;
  QTest::newRow("another series is opened") << true;
}

void TestFirstImages::itGoesWithTheLoad() {
  QFETCH(bool, another);
  NEED_DATA(dataPath(chest));
  SlowLoads s(chest);
  QVERIFY(s.appears());
  if (another) {
    s.w.window.open({QStringLiteral("phantom:sphere:32")});
    s.gate.release(10);
  } else {
    s.w.window.document().loader.cancel();
  }
  QTRY_VERIFY_WITH_TIMEOUT(s.image()->isHidden(), longest);
  QVERIFY(s.image()->picture().isNull());
}

// Not over the one in focus, which shows something else; and it goes where the one that waits does.
void TestFirstImages::itLiesOverTheViewThatWaits() {
  NEED_DATA(dataPath(chest));
  SlowLoads s(chest);
  const SeriesKey key = s.loaded();
  QVERIFY(!key.empty());
  s.w.child<QAction>("layoutTwo")->trigger();
  s.session().show(ballIn("A"), tests::right);
  s.session().setFocus(tests::right);
  QCOMPARE(s.session().workspace().view(tests::left).series, key);
  s.session().close({key});
  s.session().undoStack().undo();
  QVERIFY(s.appears());
  const auto placeOf = [&](const QWidget* widget) {
    return QRect(widget->mapTo(&s.w.window, QPoint(0, 0)), widget->size());
  };
  QCOMPARE(placeOf(s.image()), placeOf(s.w.window.views()->viewOf(tests::left)));
  s.w.child<QAction>("maximise")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(s.image()->isHidden(), longest);
  QVERIFY(s.loader().isLoading());
}

void TestFirstImages::whatAnOverlayIsLaidOverStays() {
  NEED_DATA(dataPath(chest));
  SlowLoads s(chest);
  const SeriesKey key = s.loaded();
  QVERIFY(!key.empty());
  const Series over = *s.session().workspace().series.at(key).series;
  s.session().show(ballIn("A"));
  s.session().pool().forget(key);
  QVERIFY(!s.loader().isLoading());
  s.session().change(QStringLiteral("test"),
                     withOverlay(s.session().workspace(), s.session().workspace().focus, &over));
  QVERIFY(s.loader().isLoading());
  QVERIFY(!QTest::qWaitFor([&] { return s.image()->isVisible(); }, 2000));
  QVERIFY(s.loader().isLoading());
}

void TestFirstImages::whatIsShownAgainEndsTheLoad() {
  NEED_DATA(dataPath(chest));
  SlowLoads s(chest);
  QVERIFY(s.appears());
  const LoadedSeriesPtr ball = ballIn("A");
  s.session().show(ball);
  QVERIFY(s.loader().isLoading());
  s.w.window.document().opener.show(ball->series);
  QVERIFY(!s.loader().isLoading());
  QTRY_VERIFY_WITH_TIMEOUT(s.image()->isHidden(), longest);
}

// Frames as acquired need no volume, and samples have no slices as acquired.
void TestFirstImages::whatIsLoadedAtOnceHasNone() {
  NEED_FILES();
  Frames w({clipFile});
  QVERIFY(w.shows());
  QVERIFY(w.child<FirstImage>("firstImage")->isHidden());
}

VOLUMEN_TEST(TestFirstImages);
#include "tst_first_images.moc"
