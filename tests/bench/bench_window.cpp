// Prints times in the window for the goals of design.md 2: the interaction frame and the full picture of a
// chest CT in a window of 1440 x 900. Asserts only that a drag gives drafts and ends in a full picture.
#include <algorithm>

#include "tests/fixtures/fixtures.h"
#include "tests/ui/journey.h"
#include "tests/unit/suite.h"
#include "viewer/evaluation/statistics.h"

using namespace volumen;
using volumen::tests::Journey;

class BenchWindow : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aDragAcrossTheChest();
};

void BenchWindow::aDragAcrossTheChest() {
  const std::string path = tests::dataPath("ct-chest-lidc0314-138");
  NEED_DATA(path);
  Journey w;
  w.window.resize(1440, 900);
  std::vector<double> draftsMs, fullMs, factors;
  QObject::connect(&w.window.drawService(), &DrawService::screenPictureReady, &w.window,
                   [&](const ScreenPicture& picture) {
                     const double ms = picture.ms - picture.stats.gradientsMs;
                     (picture.draft() ? draftsMs : fullMs).push_back(ms);
                     if (picture.draft()) factors.push_back(picture.factor);
                   });
  w.window.open({QString::fromStdString(path)});
  QVERIFY(w.settle());
  // The first drag finds the pace of drafts, so the second one shows what users see.
  VolumeView* view = w.window.view();
  for (int drag = 0; drag < 2; ++drag) {
    draftsMs.clear(), fullMs.clear(), factors.clear();
    const QPoint from(view->width() / 3, view->height() / 2);
    w.after([&] {
      QTest::mousePress(view, Qt::LeftButton, {}, from);
      for (int n = 1; n <= 12; ++n) {
        QTest::mouseMove(view, from + QPoint(12 * n, 2 * n));
        QTest::qWait(30);
      }
      QTest::mouseRelease(view, Qt::LeftButton, {}, from + QPoint(144, 24));
    });
  }
  QVERIFY(!draftsMs.empty());
  QVERIFY(!fullMs.empty());
  const QSize size = view->pixels();
  qInfo(
      "chest CT, %d x %d pixels, %d drafts: median %.0f ms, largest %.0f ms, one ray for %g x %g pixels; "
      "full picture %.0f ms",
      size.width(), size.height(), int(draftsMs.size()), median(draftsMs),
      *std::max_element(draftsMs.begin(), draftsMs.end()), factors.back(), factors.back(), fullMs.back());
}

VOLUMEN_TEST(BenchWindow);
#include "bench_window.moc"
