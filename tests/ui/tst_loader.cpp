// Guards design.md 8 (the UI thread never decodes or waits; progress, cancel) and design.md 7 (a bad path
// costs a sentence).
#include <QSignalSpy>

#include "tests/unit/suite.h"
#include "ui/controller/loader.h"
#include "ui/main_window.h"
#include "ui/widgets/status_line.h"

using namespace volumen;

namespace {

constexpr int longest = 60000;  // ms, for a loaded machine

Series phantom(const char* name) {
  const Result<Study> study = openStudy(std::string("phantom:") + name);
  return study->volumes.at(0);
}

struct Watched {
  Loader loader{realServices().makeScene};
  QSignalSpy loaded{&loader, &Loader::seriesLoaded}, failed{&loader, &Loader::failed};
  bool busy = false;

  Watched() {
    QObject::connect(&loader, &Loader::busyChanged, &loader, [this](bool now) { busy = now; });
  }
  bool finish() {
    return QTest::qWaitFor([this] { return !busy; }, longest);
  }
};

}  // namespace

class TestLoader : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aSeriesComesWithWhatThePanelsNeed();
  void theLaterLoadWins();
  void whatIsCancelledIsNotTold();
  void aBadPathIsASentence();
  void closingWhileLoadingIsClean();
  void theStatusLineShowsWhatLastsAndCancels();
};

void TestLoader::aSeriesComesWithWhatThePanelsNeed() {
  Watched w;
  w.loader.load(phantom("sphere:32"));
  QVERIFY(w.busy);
  QVERIFY(w.finish());
  QCOMPARE(w.loaded.count(), 1);
  const auto series = w.loaded[0][0].value<ShownSeriesPtr>();
  QCOMPARE(series->volume->size().x, 32);
  std::int64_t counted = 0;
  for (const std::int64_t count : series->histogram.counts) counted += count;
  QCOMPARE(counted, std::int64_t(32 * 32 * 32));
  QVERIFY(!series->firstScene.transferFunction.points.empty());
}

void TestLoader::theLaterLoadWins() {
  Watched w;
  w.loader.load(phantom("ct-head:96"));
  w.loader.load(phantom("sphere:32"));
  QVERIFY(w.finish());
  QCOMPARE(w.loaded.count(), 1);
  QCOMPARE(w.loaded[0][0].value<ShownSeriesPtr>()->volume->size().x, 32);
}

void TestLoader::whatIsCancelledIsNotTold() {
  Watched w;
  w.loader.load(phantom("ct-head:64"));
  w.loader.cancel();
  QVERIFY(w.finish());
  QCOMPARE(w.loaded.count(), 0);
  QCOMPARE(w.failed.count(), 0);
}

void TestLoader::aBadPathIsASentence() {
  Watched w;
  w.loader.open(QStringLiteral("/nowhere/at/all"));
  QVERIFY(w.finish());
  QCOMPARE(w.failed.count(), 1);
  QVERIFY(w.failed[0][0].toString().contains(QStringLiteral("/nowhere/at/all")));
}

void TestLoader::closingWhileLoadingIsClean() {
  Watched w;
  w.loader.load(phantom("ct-head:64"));
  w.loader.open(QStringLiteral("phantom:sphere"));
}

void TestLoader::theStatusLineShowsWhatLastsAndCancels() {
  StatusLine line;
  line.show();
  QSignalSpy cancelled(&line, &StatusLine::cancelRequested);
  auto* cancel = line.findChild<QToolButton*>(QStringLiteral("cancelTask"));
  const int height = line.height();
  line.begin(QStringLiteral("opening"));
  QVERIFY2(!cancel->isVisible(), "what takes less than 0.3 s shows no progress");
  QTRY_VERIFY(cancel->isVisible());
  QCOMPARE(line.height(), height);
  line.progress(QStringLiteral("reading"), 3, 10);
  QCOMPARE(line.findChild<QLabel*>(QStringLiteral("taskText"))->text(), QStringLiteral("reading: 3 of 10"));
  QTest::mouseClick(cancel, Qt::LeftButton);
  QCOMPARE(cancelled.count(), 1);
  line.end();
  QVERIFY(!cancel->isVisible());
}

VOLUMEN_TEST(TestLoader);
#include "tst_loader.moc"
