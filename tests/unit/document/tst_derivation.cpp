// Guards that derived values follow what is wanted: by need, once each, the latest alone, within memory.
// Failures are values with a sentence.
#include <QSignalSpy>
#include <atomic>
#include <map>
#include <new>

#include "tests/unit/suite.h"
#include "ui/document/derivation.h"

using namespace volumen;

namespace {

struct Key {
  int of = 0, version = 0;
  bool operator==(const Key&) const = default;
};

using Texts = Derivation<Key, std::string>;

// Values are "of.version". Keys in `refused` fail, and those in `large` need more memory than there is.
struct Toy {
  std::vector<Key> wanted;
  std::vector<Key> refused, large;
  bool isPaused = false, isHiddenKept = false, areVersionsFinished = false;
  int quick = -1;  // of keys computed at once
  int tryAgainMs = 0;
  std::atomic<bool> isHeld = false;  // the work waits until it is cancelled or released
  std::atomic<int> begun = 0;
  std::size_t mostBytes = 100;
  Session session;
  std::shared_ptr<SeriesPool> pool = session.sharedPool();
  Jobs jobs;
  std::vector<std::string> order;
  Texts texts{rule(), session, &jobs};
  QSignalSpy failed{&texts, &Texts::failed}, cancelled{&texts, &Texts::cancelled};

  Texts::Rule rule() {
    return {.wanted = [this] { return wanted; },
            .work = [this](const Key& key, std::size_t room) { return workOf(key, room); },
            .name = [](const Key&) { return JobName(QStringLiteral("Writing")); },
            .bytes = [](const std::string& text) { return text.size(); },
            .areVersions = [](const Key& a, const Key& b) { return a.of == b.of; },
            .finishesVersions = areVersionsFinished,
            .isQuick = [this](const Key& key) { return key.of == quick; },
            .isKept = [this](const Key&) { return isHiddenKept; },
            .isPaused = [this] { return isPaused; },
            .isTriedAgain = [](const Texts::Entry&, const Workspace& before,
                               const Workspace& after) { return before.links != after.links; },
            .tryAgainMs = tryAgainMs,
            .lacksMemory = "There is not enough memory.",
            .wasCancelled = "It was cancelled.",
            .mostBytes = mostBytes};
  }

  Texts::Work workOf(const Key& key, std::size_t room) {
    const std::string text = std::to_string(key.of) + '.' + std::to_string(key.version);
    order.push_back(text);
    const bool isRefused = std::ranges::count(refused, key) > 0, isLarge = std::ranges::count(large, key) > 0;
    return [=, this](const Job& job) -> Result<Texts::ValuePtr> {
      ++begun;
      while (isHeld && !job.cancelled()) QThread::msleep(1);
      if (isLarge) throw std::bad_alloc();
      if (isRefused) return Error{text + " cannot be written."};
      if (text.size() > room) return Error{text + " has no room."};
      return std::make_shared<const std::string>(text);
    };
  }

  void want(std::vector<Key> keys) {
    wanted = std::move(keys);
    texts.update();
  }
  bool idle() {
    return QTest::qWaitFor([this] { return !texts.isBusy(); }, 20000);
  }
  /// Returns the value of a key, or why there is none, or "nothing".
  std::string at(const Key& key) const {
    const Texts::Entry* entry = texts.find(key);
    return !entry ? "nothing" : entry->value ? *entry->value : entry->whyNot;
  }
  bool waitsForWork(int count) {
    return QTest::qWaitFor([=, this] { return begun == count; }, 20000);
  }
};

}  // namespace

class TestDerivation : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theMostNeededComeFirstAndOnce();
  void theLatestAloneIsComputed();
  void aVersionIsFinishedWhileItIsDragged();
  void quickOnesAreThereAtOnce();
  void theVersionBeforeStaysUntilTheNextIsReady();
  void nothingBeginsOrEndsDuringAPause();
  void whatIsNotWantedIsDroppedUnlessKept();
  void aFailureIsToldOnceAndHolds();
  void aFailureIsTriedAgainLater();
  void changesOfTheDocumentAreFollowed();
  void lackOfMemoryIsASentence_data();
  void lackOfMemoryIsASentence();
  void aCancelHoldsForAllThatIsMissing();
  void unneededValuesMakeRoom();
  void whatIsHeldIsCounted();
  void inputsAreReleased_data();
  void inputsAreReleased();
};

void TestDerivation::theMostNeededComeFirstAndOnce() {
  Toy toy;
  toy.want({{3, 0}, {1, 0}, {2, 0}});
  QVERIFY(toy.idle());
  toy.texts.update();
  toy.want({{2, 0}, {1, 0}, {3, 0}});
  QVERIFY(toy.idle());
  QCOMPARE(toy.order, (std::vector<std::string>{"3.0", "1.0", "2.0"}));
  QCOMPARE(toy.at({1, 0}), std::string("1.0"));
}

void TestDerivation::theLatestAloneIsComputed() {
  Toy toy;
  toy.isHeld = true;
  toy.want({{1, 0}});
  QVERIFY(toy.waitsForWork(1));
  toy.want({{1, 1}});
  toy.want({{1, 2}});
  toy.isHeld = false;
  QVERIFY(toy.idle());
  QCOMPARE(toy.at({1, 2}), std::string("1.2"));
  QCOMPARE(toy.at({1, 0}) + toy.at({1, 1}), std::string("nothingnothing"));
}

// The second of four is skipped, as the first ends only after the last is wanted.
void TestDerivation::aVersionIsFinishedWhileItIsDragged() {
  Toy toy;
  toy.areVersionsFinished = true;
  Texts texts(toy.rule(), toy.session, &toy.jobs);
  const auto want = [&](int version) {
    toy.wanted = {{1, version}};
    texts.update();
  };
  const auto is = [&](int version) { return texts.find({1, version}) != nullptr; };
  toy.isHeld = true;
  want(0);
  QVERIFY(toy.waitsForWork(1));
  want(1);
  want(2);
  toy.isHeld = false;
  QTRY_VERIFY_WITH_TIMEOUT(is(2), 20000);
  QCOMPARE(toy.order, (std::vector<std::string>{"1.0", "1.2"}));
  // A newer value that is there at once is not replaced by an older one.
  toy.isHeld = true;
  want(3);
  QVERIFY(toy.waitsForWork(3));
  toy.isHeld = false;
  toy.quick = 1;
  want(4);
  QVERIFY(!texts.isBusy());
  QTest::qWait(50);
  QVERIFY(is(4) && !is(3));
}

void TestDerivation::quickOnesAreThereAtOnce() {
  Toy toy;
  toy.quick = 2;
  const QSignalSpy changed(&toy.texts, &Texts::changed);
  toy.want({{1, 0}, {2, 0}});
  QCOMPARE(toy.at({2, 0}), std::string("2.0"));
  QVERIFY(toy.texts.isBusy());
  QCOMPARE(changed.size(), 1);
  toy.want({{1, 0}, {2, 1}});
  QCOMPARE(toy.at({2, 1}) + toy.at({2, 0}), std::string("2.1nothing"));
  QVERIFY(toy.idle());
  QCOMPARE(toy.at({1, 0}), std::string("1.0"));
}

void TestDerivation::theVersionBeforeStaysUntilTheNextIsReady() {
  Toy toy;
  toy.want({{1, 0}});
  QVERIFY(toy.idle());
  toy.isHeld = true;
  toy.want({{1, 1}});
  QVERIFY(toy.waitsForWork(2));
  QCOMPARE(toy.at({1, 0}), std::string("1.0"));
  toy.isHeld = false;
  QVERIFY(toy.idle());
  QCOMPARE(toy.at({1, 0}), std::string("nothing"));
  QCOMPARE(toy.at({1, 1}), std::string("1.1"));
  // Undone at once, nothing is computed.
  toy.isHeld = true;
  toy.want({{1, 2}});
  toy.want({{1, 1}});
  QVERIFY(!toy.texts.isBusy());
  QCOMPARE(toy.at({1, 1}), std::string("1.1"));
}

void TestDerivation::nothingBeginsOrEndsDuringAPause() {
  Toy toy;
  toy.isPaused = true;
  toy.want({{1, 0}});
  QVERIFY(!toy.texts.isBusy() && toy.order.empty());
  toy.isPaused = false;
  toy.want({{1, 0}});
  QVERIFY(toy.idle());
  toy.isPaused = true;
  toy.want({});
  QCOMPARE(toy.at({1, 0}), std::string("1.0"));
}

void TestDerivation::whatIsNotWantedIsDroppedUnlessKept() {
  Toy toy;
  toy.want({{1, 0}});
  QVERIFY(toy.idle());
  toy.isHiddenKept = true;
  toy.want({});
  QCOMPARE(toy.at({1, 0}), std::string("1.0"));
  const QSignalSpy changed(&toy.texts, &Texts::changed);
  toy.isHiddenKept = false;
  toy.want({});
  QCOMPARE(toy.at({1, 0}), std::string("nothing"));
  QCOMPARE(changed.size(), 1);
}

void TestDerivation::aFailureIsToldOnceAndHolds() {
  Toy toy;
  toy.refused = {{1, 0}, {1, 1}};
  toy.want({{1, 0}, {2, 0}});
  QVERIFY(toy.idle());
  QCOMPARE(toy.at({1, 0}), std::string("1.0 cannot be written."));
  QVERIFY2(toy.at({2, 0}) == "2.0", "the next is computed all the same");
  toy.texts.update();
  QVERIFY(toy.idle());
  toy.want({{1, 1}, {2, 0}});
  QVERIFY(toy.idle());
  QCOMPARE(toy.at({1, 1}), std::string("1.1 cannot be written."));
  QCOMPARE(toy.failed.size(), 1);
  QCOMPARE(toy.order.size(), std::size_t(3));
  toy.refused.clear();
  toy.texts.tryAgain([](const Key& key) { return key.of == 1; });
  toy.texts.update();
  QVERIFY(toy.idle());
  QCOMPARE(toy.at({1, 1}), std::string("1.1"));
  toy.refused = {{1, 2}};
  toy.want({{1, 2}});
  QVERIFY(toy.idle());
  QCOMPARE(toy.failed.size(), 2);
}

// As a file that cannot be read for a moment. It is told once.
void TestDerivation::aFailureIsTriedAgainLater() {
  Toy toy;
  toy.tryAgainMs = 20;
  Texts texts(toy.rule(), toy.session, &toy.jobs);
  const QSignalSpy failed(&texts, &Texts::failed);
  toy.refused = toy.wanted = {{1, 0}};
  texts.update();
  QTRY_VERIFY_WITH_TIMEOUT(toy.order.size() == 3, 20000);
  toy.refused.clear();
  QTRY_VERIFY_WITH_TIMEOUT(texts.find({1, 0})->value, 20000);
  QCOMPARE(failed.size(), 1);
}

void TestDerivation::changesOfTheDocumentAreFollowed() {
  Toy toy;
  toy.refused = toy.wanted = {{1, 0}};
  toy.session.prefer([](Preferences& p) { p.hideNames = !p.hideNames; });
  QVERIFY(toy.idle());
  QCOMPARE(toy.at({1, 0}), std::string("1.0 cannot be written."));
  toy.refused.clear();
  toy.session.change({}, [](Workspace& w) { w.measurementsShown = !w.measurementsShown; });
  QVERIFY(toy.idle());
  QCOMPARE(toy.at({1, 0}), std::string("1.0 cannot be written."));
  toy.session.change({}, [](Workspace& w) { w.links.scroll = !w.links.scroll; });
  QVERIFY(toy.idle());
  QCOMPARE(toy.at({1, 0}), std::string("1.0"));
}

void TestDerivation::lackOfMemoryIsASentence_data() {
  QTest::addColumn<bool>("isQuick");
  QTest::newRow("on the lane") << false;
  QTest::newRow("at once") << true;
}

void TestDerivation::lackOfMemoryIsASentence() {
  QFETCH(bool, isQuick);
  Toy toy;
  toy.quick = isQuick ? 1 : -1;
  toy.large = {{1, 0}};
  toy.want({{1, 0}});
  QVERIFY(toy.idle());
  QCOMPARE(toy.at({1, 0}), std::string("There is not enough memory."));
  QCOMPARE(toy.failed.size(), isQuick ? 0 : 1);
}

void TestDerivation::aCancelHoldsForAllThatIsMissing() {
  Toy toy;
  toy.isHeld = true;
  toy.want({{1, 0}, {2, 0}});
  QVERIFY(toy.waitsForWork(1));
  toy.jobs.cancel(toy.jobs.rows().front().id);
  toy.isHeld = false;
  QVERIFY(!toy.texts.isBusy());
  toy.texts.update();
  QVERIFY(!toy.texts.isBusy());
  QCOMPARE(toy.at({1, 0}) + toy.at({2, 0}), std::string("It was cancelled.It was cancelled."));
  QCOMPARE(toy.cancelled.size(), 1);
  QCOMPARE(toy.failed.size(), 0);
  toy.texts.tryAgain([](const Key&) { return true; });
  toy.texts.update();
  QVERIFY(toy.idle());
  QCOMPARE(toy.at({1, 0}) + toy.at({2, 0}), std::string("1.02.0"));
}

// Each value has three bytes.
void TestDerivation::unneededValuesMakeRoom() {
  Toy toy;
  toy.mostBytes = 5;
  Texts texts(toy.rule(), toy.session, &toy.jobs);
  const QSignalSpy failed(&texts, &Texts::failed);
  const auto isIdle = [&] { return QTest::qWaitFor([&] { return !texts.isBusy(); }, 20000); };
  toy.isHiddenKept = true;
  toy.wanted = {{1, 0}};
  texts.update();
  QVERIFY(isIdle());
  toy.wanted = {{2, 0}};
  texts.update();
  QVERIFY(isIdle());
  QVERIFY(!texts.find({1, 0}) && texts.find({2, 0})->value);
  QCOMPARE(failed.size(), 0);
  toy.wanted = {{2, 0}, {1, 0}};
  texts.update();
  QVERIFY(isIdle());
  QVERIFY2(texts.find({2, 0})->value, "what is needed stays");
  QCOMPARE(texts.find({1, 0})->whyNot, std::string("1.0 has no room."));
  QCOMPARE(failed.size(), 1);
}

void TestDerivation::whatIsHeldIsCounted() {
  Toy toy;
  const std::size_t before = toy.pool->counted();
  toy.want({{1, 0}, {2, 0}});
  QVERIFY(toy.idle());
  QCOMPARE(toy.pool->counted(), before + 6);
  toy.want({{2, 0}});
  QCOMPARE(toy.pool->counted(), before + 3);
  {
    Texts more(toy.rule(), toy.session, &toy.jobs);
    more.update();
    QVERIFY(QTest::qWaitFor([&] { return !more.isBusy(); }, 20000));
    QCOMPARE(toy.pool->counted(), before + 6);
  }
  QCOMPARE(toy.pool->counted(), before + 3);
}

void TestDerivation::inputsAreReleased_data() {
  QTest::addColumn<bool>("isDone");
  QTest::newRow("of a value no longer wanted") << true;
  QTest::newRow("of a computation no longer wanted") << false;
}

// Keys may hold label maps and volumes.
void TestDerivation::inputsAreReleased() {
  QFETCH(bool, isDone);
  using Input = std::shared_ptr<int>;
  std::vector<Input> wanted{std::make_shared<int>(7)};
  const std::weak_ptr<int> input = wanted.front();
  const auto copy = [](const Input& key, std::size_t) {
    return
        [key](const Job&) -> Result<std::shared_ptr<const int>> { return std::make_shared<const int>(*key); };
  };
  const Session session;
  Derivation<Input, int> copies({.wanted = [&] { return wanted; },
                                 .work = copy,
                                 .name = [](const Input&) { return JobName(); },
                                 .bytes = [](int) { return std::size_t(4); },
                                 .lacksMemory = {}},
                                session, nullptr);
  copies.update();
  if (isDone) QVERIFY(QTest::qWaitFor([&] { return !copies.isBusy(); }, 20000));
  wanted.clear();
  copies.update();
  QVERIFY(QTest::qWaitFor([&] { return input.expired(); }, 20000));
}

VOLUMEN_TEST(TestDerivation);
#include "tst_derivation.moc"
