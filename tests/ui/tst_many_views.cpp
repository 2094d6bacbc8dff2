// Guards design.md 11: many views, one scheduler; every request is answered exactly once.
#include <random>
#include <set>

#include "tests/ui/slow_renderer.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestManyViews : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyViewGetsItsPictures_data();
  void everyViewGetsItsPictures();
  void hiddenViewsAreNotDrawn();
  void anInterruptedPictureIsDrawnAfterAll();
  void hidingAViewLeavesTheOthersAlone();
  void viewsThatFollowTheHandAreDrawn();
  void levelsAreOfTheirViews();
  void everyRequestIsAnsweredOnce_data();
  void everyRequestIsAnsweredOnce();
};

void TestManyViews::everyViewGetsItsPictures_data() {
  QTest::addColumn<int>("views");
  QTest::newRow("two views") << 2;
  QTest::newRow("four views") << 4;
}

void TestManyViews::everyViewGetsItsPictures() {
  QFETCH(int, views);
  const ViewId hand = views - 1;
  SlowRenderer renderer;
  Watched w(renderer.make());
  w.service.setGestureView(hand);
  // Another picture keeps the thread busy until all views have sent requests.
  renderer.msPerRow = 2;
  w.service.requestPicture(w.volume, greyScene(0), ofSize(8, 5000));
  QTRY_COMPARE(renderer.begun.load(), 1);
  QElapsedTimer clock;
  clock.start();
  std::vector<int> numbers;
  for (ViewId view = 0; view < views; ++view) {
    w.service.show(view, w.volume);
    numbers.push_back(w.service.request(view, greyScene((view + 1) / 8.0), {64, 48}));
  }
  renderer.msPerRow = 0;
  for (const int number : numbers) QTRY_COMPARE(w.answerTo(number), Answer::drawn);
  // On a machine that stalls for that long, another view may go first (longestWait).
  if (clock.elapsed() < 200) QCOMPARE(w.pictures[0].view, hand);
  std::set<ViewId> drafted;
  for (int n = 0; n < views; ++n) {
    QVERIFY2(w.pictures[std::size_t(n)].draft(), "drafts of all come before pictures at rest");
    drafted.insert(w.pictures[std::size_t(n)].view);
  }
  QCOMPARE(drafted.size(), std::size_t(views));
  const auto rest =
      std::find_if(w.pictures.begin(), w.pictures.end(), [](const auto& p) { return p.atRest; });
  QCOMPARE(rest->view, hand);
  for (const ScreenPicture& picture : w.pictures) {
    QCOMPARE(picture.number, numbers[std::size_t(picture.view)]);
    QCOMPARE(picture.volume, w.volume);
    QCOMPARE(qRed(picture.image.pixel(32, 24)), qRound(255 * (picture.view + 1) / 8.0));
  }
}

void TestManyViews::hiddenViewsAreNotDrawn() {
  SlowRenderer renderer;
  renderer.msPerRow = 2;
  Watched w(renderer.make());
  w.service.show(1, w.volume);
  const int first = w.service.request(0, greyScene(0.2), {64, 400});
  QTRY_COMPARE(renderer.begun.load(), 1);
  const int second = w.service.request(1, greyScene(0.4), {64, 40});
  w.service.show(1, nullptr);
  w.service.show(0, nullptr);
  const int third = w.service.request(0, greyScene(0.6), {64, 40});
  for (const int number : {first, second, third}) QTRY_COMPARE(w.answerTo(number), Answer::cancelled);
  QTRY_COMPARE(renderer.cancelled.load(), 1);
  // If one view is drawn again, the others are not.
  w.service.show(1, w.volume);
  const int fourth = w.service.request(1, greyScene(0.8), {64, 20});
  QTRY_COMPARE(w.answerTo(fourth), Answer::drawn);
  for (const ScreenPicture& picture : w.pictures) QCOMPARE(picture.number, fourth);
  QCOMPARE(renderer.cancelled.load(), 1);
  QCOMPARE(w.answers.size(), std::size_t(4));
}

void TestManyViews::anInterruptedPictureIsDrawnAfterAll() {
  SlowRenderer renderer;
  renderer.msPerRow = 2;
  Watched w(renderer.make());
  w.service.show(1, w.volume);
  const int first = w.service.request(0, greyScene(0.2), {64, 200});
  QTRY_COMPARE(renderer.begun.load(), 2);
  const int second = w.service.request(1, greyScene(0.8), {64, 20});
  QTRY_COMPARE(renderer.cancelled.load(), 1);
  QTRY_COMPARE(w.answerTo(first), Answer::drawn);
  QTRY_COMPARE(w.answerTo(second), Answer::drawn);
  QVERIFY2(w.pictures[1].view == 1 && w.pictures[1].draft(), "it gave way to the other's draft");
}

void TestManyViews::hidingAViewLeavesTheOthersAlone() {
  SlowRenderer renderer;
  renderer.msPerRow = 2;
  Watched w(renderer.make());
  w.service.show(1, w.volume);
  const int number = w.service.request(0, greyScene(0.2), {64, 200});
  QTRY_COMPARE(renderer.begun.load(), 2);
  w.service.show(1, nullptr);
  w.service.show(1, smallVolume());
  QTRY_COMPARE(w.answerTo(number), Answer::drawn);
  QCOMPARE(renderer.cancelled.load(), 0);
}

// A draft takes at least 10 ms and the view of the gesture requests one each 10 ms, so that one is always
// waiting.
void TestManyViews::viewsThatFollowTheHandAreDrawn() {
  SlowRenderer renderer;
  renderer.msPerRow = 1;
  Watched w(renderer.make());
  w.service.show(1, w.volume);
  w.service.setGestureView(0);
  for (int n = 0; n < 150; ++n) {
    w.service.request(0, greyScene(n / 150.0), {64, 80});
    w.service.request(1, greyScene(n / 150.0), {64, 80});
    QTest::qWait(10);
  }
  const auto followed =
      std::count_if(w.pictures.begin(), w.pictures.end(), [](const ScreenPicture& p) { return p.view == 1; });
  QVERIFY2(followed >= 3, qPrintable(QString::number(followed)));
}

void TestManyViews::levelsAreOfTheirViews() {
  SlowRenderer renderer;
  Watched w(renderer.make());
  w.service.show(1, w.volume);
  w.service.setLevel(1, {Quality::exact, 2});
  QVERIFY(w.service.level(0) == PictureLevel());
  for (const ViewId view : {0, 1}) w.service.request(view, greyScene(0.5), {64, 64});
  for (const ViewId view : {0, 1})
    QTRY_VERIFY(std::any_of(w.pictures.begin(), w.pictures.end(),
                            [&](const ScreenPicture& p) { return p.view == view && p.atRest; }));
  for (const ScreenPicture& picture : w.pictures) {
    if (picture.draft()) continue;
    QCOMPARE(picture.quality, picture.view == 1 ? Quality::exact : Quality::standard);
    QCOMPARE(picture.factor, picture.view == 1 ? 2.0 : 1.0);
  }
}

namespace {

constexpr int views = 4;
constexpr double fails = 0.9;  // scenes with a brighter light cannot be drawn

MakeDraw failing(SlowRenderer& renderer) {
  return [make = renderer.make()](const VoxelsPtr& voxels) -> Draw {
    const Draw draw = make(voxels);
    return {draw.plan, [draw](const Planned& planned, const CancelToken& cancel) -> Result<Drawn> {
              if (planned.plan.scene.lights[0].intensity > fails) return Error{"It cannot be drawn."};
              return draw.picture(planned, cancel);
            }};
  };
}

// Uses a service at random and checks all its messages.
class RandomUse {
 public:
  explicit RandomUse(unsigned seed) : random_(seed) {
    renderer_.microsecondsPerPixel = pick(3);
    service_ = std::make_unique<DrawService>(failing(renderer_));
    QObject::connect(service_.get(), &DrawService::screenPictureReady, service_.get(),
                     [this](const ScreenPicture& picture) { take(picture); });
    QObject::connect(service_.get(), &DrawService::answered, service_.get(),
                     [this](ViewId view, int number, Answer answer) { take(view, number, answer); });
    QObject::connect(service_.get(), &DrawService::pictureReady, service_.get(),
                     [this](int number) { ++saved_[number]; });
  }

  void act() {
    const ViewId view = pick(views);
    switch (pick(12)) {
      case 0:
        return show(view, nullptr);
      case 1:
      case 2:
        return show(view, volumes_[std::size_t(pick(3))]);
      case 3:
        return service_->setGestureView(view);
      case 4:
        return service_->setLevel(view, {pick(2) ? Quality::exact : Quality::draft, 1 + pick(4)});
      case 5:
        saved_[service_->requestPicture(volumes_[std::size_t(pick(3))], greyScene(0.5), ofSize(8, 8))] = 0;
        return;
      case 6:
        return QTest::qWait(pick(40));
      case 7:
        return QTest::qWait(pick(5));
      default:
        return request(view);
    }
  }

  /// Waits for all answers, or closes at once. Returns an empty text if each answer came once and was right.
  QString end(bool wait) {
    const auto allAnswered = [this] {
      return std::all_of(asked_.begin(), asked_.end(), [](const auto& r) { return r.second.answers == 1; }) &&
             std::all_of(saved_.begin(), saved_.end(), [](const auto& s) { return s.second == 1; });
    };
    if (wait && !QTest::qWaitFor(allAnswered, 20000)) note(QStringLiteral("some answers never come"));
    service_.reset();
    const std::size_t told = told_;
    QCoreApplication::processEvents();
    if (told != told_) note(QStringLiteral("something is told by what is gone"));
    for (const auto& [number, request] : asked_)
      if (request.answers != 1) note(QStringLiteral("%1 answers to %2").arg(request.answers).arg(number));
    return wrong_;
  }
  const std::map<Answer, int>& counts() const { return counts_; }

 private:
  struct Asked {
    ViewId view;
    double grey;
    bool replaced = false;  // another request was made for the view
    bool outdated = false;  // the view was hidden, or shows another volume
    bool onScreen = false;  // its picture at rest is shown
    int answers = 0;
  };

  int pick(int count) { return std::uniform_int_distribution(0, count - 1)(random_); }
  void note(const QString& wrong) { wrong_ += wrong + QStringLiteral("; "); }

  void show(ViewId view, const VolumePtr& volume) {
    if (shown_[view] == volume) return service_->show(view, volume);
    shown_[view] = volume;
    for (auto& [number, request] : asked_) request.outdated |= request.view == view;
    service_->show(view, volume);
  }

  void request(ViewId view) {
    const double grey = pick(6) == 0 ? 0.95 : pick(800) / 1000.0;
    for (auto& [number, request] : asked_) request.replaced |= request.view == view;
    const int number = service_->request(view, greyScene(grey), {16, 12});
    if (asked_.contains(number)) note(QStringLiteral("a number is given twice"));
    asked_[number] = {view, grey, false, !shown_[view]};
  }

  void take(const ScreenPicture& picture) {
    ++told_;
    Asked& request = asked_.at(picture.number);
    if (request.outdated || picture.view != request.view || picture.volume != shown_[picture.view])
      note(QStringLiteral("a picture of what is not shown"));
    if (picture.scene.lights[0].intensity != request.grey)
      note(QStringLiteral("a picture of another request"));
    if (std::exchange(last_[picture.view], picture.number) > picture.number)
      note(QStringLiteral("an older picture after a newer one"));
    request.onScreen |= picture.atRest;
  }

  void take(ViewId view, int number, Answer answer) {
    ++told_;
    ++counts_[answer];
    Asked& request = asked_.at(number);
    ++request.answers;
    const bool right = answer == Answer::drawn      ? request.onScreen
                       : answer == Answer::replaced ? request.replaced
                       : answer == Answer::failed   ? request.grey > fails
                                                    : request.outdated || closing();
    if (!right || view != request.view) note(QStringLiteral("a wrong answer to %1").arg(number));
  }
  bool closing() const { return !service_; }

  std::mt19937 random_;
  SlowRenderer renderer_;
  const VolumePtr volumes_[3] = {smallVolume(1), smallVolume(2), smallVolume(3)};
  std::map<ViewId, VolumePtr> shown_;
  std::map<ViewId, int> last_;
  std::map<int, Asked> asked_;
  std::map<int, int> saved_;  // how often each was ready
  std::map<Answer, int> counts_;
  std::size_t told_ = 0;
  QString wrong_;
  std::unique_ptr<DrawService> service_;
};

}  // namespace

void TestManyViews::everyRequestIsAnsweredOnce_data() {
  QTest::addColumn<bool>("wait");
  QTest::newRow("all are waited for") << true;
  QTest::newRow("closed in the middle") << false;
}

void TestManyViews::everyRequestIsAnsweredOnce() {
  QFETCH(bool, wait);
  std::map<Answer, int> counts;
  for (unsigned seed = 0; seed < 100; ++seed) {
    RandomUse use(seed);
    for (int n = 0; n < 40; ++n) use.act();
    const QString wrong = use.end(wait);
    QVERIFY2(wrong.isEmpty(), qPrintable(QStringLiteral("seed %1: %2").arg(seed).arg(wrong)));
    for (const auto& [answer, count] : use.counts()) counts[answer] += count;
  }
  for (const Answer answer : {Answer::drawn, Answer::replaced, Answer::cancelled, Answer::failed})
    QVERIFY2(counts[answer] >= 20, qPrintable(QStringLiteral("few answers of kind %1").arg(int(answer))));
  qInfo("%d drawn, %d replaced, %d cancelled, %d failed", counts[Answer::drawn], counts[Answer::replaced],
        counts[Answer::cancelled], counts[Answer::failed]);
}

VOLUMEN_TEST(TestManyViews);
#include "tst_many_views.moc"
