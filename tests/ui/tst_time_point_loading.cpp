// Guards loading of time points. The next ones are loaded ahead if there is memory. The picture stays until
// the next is there, and disappears if that does not come.
#include <QLabel>
#include <QTemporaryDir>

#include "tests/ui/perfusion_window.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"
#include "ui/workspace/time_points.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Returns the grey in the middle, inside the volume.
int middleOf(FlatView* view) {
  const QImage seen = view->grab().toImage();
  return qGray(seen.pixel(seen.width() / 2 + 9, seen.height() / 2 + 9));
}

// A window whose second time point was removed from memory. Nothing is loaded any more.
struct StepAwaited : Perfusion {
  using Perfusion::Perfusion;
  LoadedSeriesPtr second;

  bool wait() {
    const auto next = [&] {
      return session().seriesNamed(
          keyOf(*timePointsOf(workspace(), workspace().view(axialViewId).series)[1]));
    };
    if (!opened() || !QTest::qWaitFor([&] { return next() && middleOf(view()) > 100; }, longest))
      return false;
    second = next();
    if (!QTest::qWaitFor([&] { return !window.document().loader.isBusy(); }, longest)) return false;
    QCoreApplication::processEvents();  // the loader looks once more
    QObject::disconnect(&session(), &Session::needsChanged, nullptr, nullptr);
    session().pool().forget(keyOf(second->series));
    key(Qt::Key_Right);
    return !session().seriesOf(axialViewId);
  }
  QLabel* mark() { return view()->findChild<QLabel*>(QStringLiteral("loadingMark")); }
};

}  // namespace

class TestTimePointLoading : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { path_ = fourVolumes(folder_); }
  void theNextOneIsLoadedAhead();
  void memoryWithoutRoomLoadsNothingAhead();
  void bothNeighboursAreLoadedAhead();
  void theLastPictureStaysUntilTheNextIsThere();
  void whatDoesNotComeLeavesNoOldPicture();
  void aFileThatIsGoneIsGivenUp();

 private:
  QTemporaryDir folder_;
  QString path_;
};

void TestTimePointLoading::theNextOneIsLoadedAhead() {
  Perfusion w(path_);
  QVERIFY(w.opened());
  const auto held = [&](int n) {
    const auto all = timePointsOf(w.workspace(), w.workspace().view(axialViewId).series);
    return all.size() == Perfusion::steps && w.session().seriesNamed(keyOf(*all[std::size_t(n)])) != nullptr;
  };
  QTRY_VERIFY_WITH_TIMEOUT(held(1), longest);
  QVERIFY2(w.shows(100), "it is not shown for that");
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  w.key(Qt::Key_Right);
  QVERIFY2(!w.view()->picture().isNull(), "no flash of black between two steps");
  QCOMPARE(w.session().seriesOf(axialViewId)->volume->value(8, 8, 8), 200.f);
  QTRY_VERIFY_WITH_TIMEOUT(held(2), longest);
}

void TestTimePointLoading::memoryWithoutRoomLoadsNothingAhead() {
  SeriesPool pool(100);
  const auto volume = [] {
    VolumeParts parts;
    parts.geometry.size = {40, 1, 1};
    parts.values = std::vector<std::uint8_t>(40);
    std::vector<std::string> warnings;
    auto series = std::make_shared<LoadedSeries>();
    series->volume = *Volume::make(std::move(parts), warnings);
    return series;
  };
  pool.put({{"a", "1"}, {}}, volume());
  pool.put({{"a", "2"}, {}}, volume());
  pool.setOnScreen({{{"a", "1"}, {}}});
  QVERIFY(pool.hasRoomFor(60));
  QVERIFY(!pool.hasRoomFor(61));
  pool.count(this, 10);
  QVERIFY2(pool.hasRoomFor(50) && !pool.hasRoomFor(51), "what is held elsewhere counts");
}

void TestTimePointLoading::bothNeighboursAreLoadedAhead() {
  Perfusion w(path_);
  QVERIFY(w.opened());
  const auto isHeld = [&](int n) {
    const auto all = timePointsOf(w.workspace(), w.workspace().view(axialViewId).series);
    return w.session().seriesNamed(keyOf(*all[std::size_t(n)])) != nullptr;
  };
  QTRY_VERIFY_WITH_TIMEOUT(isHeld(1), longest);
  QVERIFY(!isHeld(2));
  // Goes from the first to the last, past two that were never requested.
  w.slider()->setValue(3);
  QVERIFY(w.shows(400));
  QTRY_VERIFY_WITH_TIMEOUT(isHeld(2), longest);
}

void TestTimePointLoading::theLastPictureStaysUntilTheNextIsThere() {
  StepAwaited w(path_);
  QVERIFY(w.wait());
  QVERIFY2(middleOf(w.view()) > 100, "no flash of black");
  QVERIFY2(!w.mark()->isVisible(), "not at once");
  QTRY_VERIFY_WITH_TIMEOUT(w.mark()->isVisible(), longest);
  QVERIFY(middleOf(w.view()) > 100);
  w.shot("time-points-loading");
  w.session().keep(w.second);
  QVERIFY(w.shows(200));
  QVERIFY(!w.mark()->isVisible());
}

// If a time point does not come, the old picture is not left under its name.
void TestTimePointLoading::whatDoesNotComeLeavesNoOldPicture() {
  StepAwaited w(path_);
  QVERIFY(w.wait());
  w.window.views()->giveUpWaiting(keyOf(w.second->series));
  QVERIFY(middleOf(w.view()) < 10);
  w.session().keep(w.second);
  QVERIFY(w.shows(200));
  QTRY_VERIFY_WITH_TIMEOUT(middleOf(w.view()) > 100, longest);
}

void TestTimePointLoading::aFileThatIsGoneIsGivenUp() {
  const QTemporaryDir folder;
  const QString path = fourVolumes(folder);
  Perfusion w(path);
  QVERIFY(w.opened());
  QTRY_VERIFY_WITH_TIMEOUT(middleOf(w.view()) > 100, longest);
  QTRY_VERIFY_WITH_TIMEOUT(w.window.jobs().rows().empty(), longest);
  QVERIFY(QFile::remove(path));
  w.slider()->setValue(3);
  QTRY_VERIFY_WITH_TIMEOUT(w.child<Banner>("banner")->isVisible(), longest);
  QVERIFY(middleOf(w.view()) < 10);
  QVERIFY(!w.view()->findChild<QLabel*>(QStringLiteral("loadingMark"))->isVisible());
}

VOLUMEN_TEST(TestTimePointLoading);
#include "tst_time_point_loading.moc"
