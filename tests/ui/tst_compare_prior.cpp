// Guards priors in the window: the same series of an earlier day stands beside, in one step, and all that is
// missing comes while one scrolls. Real events.
#include "tests/ui/gestures.h"
#include "tests/ui/hanging_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestComparePrior : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void allThatIsMissingComesWhileOneScrolls();
  void thePriorStandsBeside();
  void withoutAPriorThereIsASentence();
  void theSecondViewFillsByItself();
};

void TestComparePrior::allThatIsMissingComesWhileOneScrolls() {
  const QTemporaryDir folder;
  QStringList paths;
  for (const char* day : {"20260301", "20250301", "20240301", "20230301"}) {
    paths << folder.filePath(QLatin1String(day));
    QVERIFY(TwoDays::writeDay(paths.back(), day));
  }
  HangingWindow w(paths);
  const auto volumes = [&] { return w.window.document().open.volumes(); };
  QTRY_VERIFY_WITH_TIMEOUT(volumes().size() == 4 && w.session().series(), longest);
  QTRY_VERIFY_WITH_TIMEOUT(!w.window.document().loader.isBusy(), longest);
  const SeriesKey shown = keyOf(w.session().series()->series);
  Workspace four = withLayout(w.workspace(), Layout::four);
  four = withSeries(std::move(four), firstCell, w.session().series()->series, {});
  std::vector<SeriesKey> wanted;
  for (const Series* series : volumes()) {
    if (keyOf(*series) == shown) continue;
    wanted.push_back(keyOf(*series));
    four = withSeries(std::move(four), firstCell + int(wanted.size()), *series, {});
  }
  four.focus = firstCell + 2;
  QSignalSpy began(&w.window.document().loader, &Loader::loadBegan);
  QSignalSpy givenUp(&w.window.document().loader, &Loader::loadGivenUp);
  w.session().change(QStringLiteral("Compare"), four);
  int turned = 0;
  const auto haveCome = [&] {
    wheel(w.window.views()->viewAs<FlatView>(firstCell), turned++ % 2 ? 1 : -1);
    return std::ranges::all_of(wanted,
                               [&](const SeriesKey& key) { return w.session().seriesNamed(key) != nullptr; });
  };
  QVERIFY(QTest::qWaitFor(haveCome, longest));
  QVERIFY2(turned > 1, "the wheel was turned while they came");
  QCOMPARE(givenUp.count(), 0);
  QCOMPARE(began.count(), 3);
  const std::size_t order[] = {1, 0, 2};  // the view in focus first
  for (int n = 0; n < 3; ++n) QVERIFY(keyOf(began[n][0].value<Series>()) == wanted[order[n]]);
}

void TestComparePrior::thePriorStandsBeside() {
  const TwoDays days;
  QVERIFY(days.write());
  TwoDaysWindow w(days);
  QVERIFY(w.isOpen());
  const Workspace before = w.workspace();
  const int steps = w.session().undoStack().count();
  QTest::keyClick(&w.window, Qt::Key_7, Qt::AltModifier);
  QCOMPARE(w.workspace().layout, Layout::two);
  QVERIFY(w.showsInCell(0, "20260301") && w.showsInCell(1, "20240215"));
  QCOMPARE(w.workspace().focus, firstCell);
  const auto dateOf = [&](int cell) {
    return w.window.views()->viewAs<FlatView>(firstCell + cell)->overlays().date;
  };
  QCOMPARE(dateOf(0), QStringLiteral("2026-03-01"));
  QCOMPARE(dateOf(1), QStringLiteral("2024-02-15"));
  w.shot("prior");
  QCOMPARE(w.session().undoStack().count(), steps + 1);
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.workspace().views == before.views && w.workspace().layout == before.layout);
}

void TestComparePrior::withoutAPriorThereIsASentence() {
  const TwoDays days;
  QVERIFY(days.write());
  HangingWindow w(QStringList{days.before});
  QTRY_VERIFY_WITH_TIMEOUT(w.session().series() != nullptr, longest);
  const Workspace before = w.workspace();
  w.child<QAction>("comparePrior")->trigger();
  QVERIFY(w.complaint().startsWith(QStringLiteral("No earlier study")));
  QVERIFY(w.workspace() == before);
}

void TestComparePrior::theSecondViewFillsByItself() {
  const TwoDays days;
  QVERIFY(days.write());
  TwoDaysWindow w(days);
  QVERIFY(w.isOpen());
  const int steps = w.session().undoStack().count();
  w.child<QAction>("layoutTwo")->trigger();
  QVERIFY(w.showsInCell(0, "20260301") && w.showsInCell(1, "20240215"));
  QCOMPARE(w.session().undoStack().count(), steps + 1);
}

VOLUMEN_TEST(TestComparePrior);
#include "tst_compare_prior.moc"
