// Guards priors in the window: the same series of an earlier day stands beside, in one step, and all that is
// missing comes while one scrolls; a study that is only listed is opened for it. Real events.
#include <QDir>
#include <QLabel>

#include "io/index/index.h"
#include "tests/ui/gestures.h"
#include "tests/ui/hanging_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Studies of these days, a folder each, all of them in an index.
struct ListedDays {
  QTemporaryDir folder;
  const QStringList days;
  const QString home = folder.filePath(QStringLiteral("home"));

  explicit ListedDays(const QStringList& all) : days(all) {}
  QString pathOf(const QString& day) const { return folder.filePath(QStringLiteral("data/") + day); }
  bool write() const {
    QDir(folder.path()).mkdir(QStringLiteral("data"));
    for (const QString& day : days)
      if (!TwoDays::writeDay(pathOf(day), day.toLatin1().constData())) return false;
    Result<Index> index = Index::open(home.toStdString());
    return index && index->import({folder.filePath(QStringLiteral("data")).toStdString()});
  }
  Services services() const {
    Services real = realServices();
    real.indexFolder = home.toStdString();
    return real;
  }
};

// With some of them open.
struct ListedWindow : HangingWindow {
  ListedWindow(const ListedDays& all, const QStringList& opened)
      : HangingWindow(paths(all, opened), all.services()) {
    count = opened.size();
  }
  static QStringList paths(const ListedDays& all, const QStringList& opened) {
    QStringList found;
    for (const QString& day : opened) found << all.pathOf(day);
    return found;
  }
  bool isOpen() {
    return QTest::qWaitFor(
        [&] {
          return qsizetype(window.document().open.volumes().size()) == count && session().series() &&
                 !window.document().loader.isBusy();
        },
        longest);
  }
  bool shows(int cell, const char* day) {
    return QTest::qWaitFor(
        [&] {
          const LoadedSeriesPtr shown = session().seriesOf(firstCell + cell);
          return shown && shown->series.studyDate == day;
        },
        longest);
  }
  void comparePrior() { QTest::keyClick(&window, Qt::Key_7, Qt::AltModifier); }

  qsizetype count = 0;
};

}  // namespace

class TestComparePrior : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void allThatIsMissingComesWhileOneScrolls();
  void thePriorStandsBeside();
  void withoutAPriorThereIsASentence();
  void aListedStudyIsOpenedForIt();
  void aLaterOneThatIsListedIsTold();
  void filesThatAreGoneAreTold_data();
  void filesThatAreGoneAreTold();
  void anOlderOneStandsForWhatIsGone();
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
  QTRY_VERIFY_WITH_TIMEOUT(w.complaint().startsWith(QStringLiteral("No earlier study")), longest);
  QVERIFY(w.workspace() == before);
}

// The latest, in one step; it stands among what is open.
void TestComparePrior::aListedStudyIsOpenedForIt() {
  const ListedDays all({QStringLiteral("20260301"), QStringLiteral("20240215"), QStringLiteral("20220215")});
  QVERIFY(all.write());
  ListedWindow w(all, {QStringLiteral("20260301")});
  QVERIFY(w.isOpen());
  const Workspace before = w.workspace();
  const int steps = w.session().undoStack().count();
  w.comparePrior();
  QVERIFY(w.shows(1, "20240215") && w.shows(0, "20260301"));
  QCOMPARE(w.workspace().layout, Layout::two);
  QCOMPARE(w.workspace().focus, firstCell);
  QCOMPARE(w.session().undoStack().count(), steps + 1);
  QCOMPARE(w.window.document().open.volumes().size(), std::size_t(2));
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.workspace().views == before.views && w.workspace().layout == before.layout);
}

// What is open is shown at once, and not exchanged by itself.
void TestComparePrior::aLaterOneThatIsListedIsTold() {
  const ListedDays all({QStringLiteral("20260301"), QStringLiteral("20250215"), QStringLiteral("20220215")});
  QVERIFY(all.write());
  ListedWindow w(all, {QStringLiteral("20260301"), QStringLiteral("20220215")});
  QVERIFY(w.isOpen());
  for (const Series* series : w.window.document().open.volumes())
    if (series->studyDate == "20260301") w.window.document().opener.show(*series);
  QTRY_VERIFY_WITH_TIMEOUT(w.session().series() && w.session().series()->series.studyDate == "20260301",
                           longest);
  w.comparePrior();
  QVERIFY(w.in(1) && w.in(1)->studyDate == "20220215");
  QTRY_VERIFY_WITH_TIMEOUT(w.child<QLabel>("toldText")->text().contains(QStringLiteral("2025-02-15")),
                           longest);
  QCOMPARE(w.window.document().open.volumes().size(), std::size_t(2));
  w.comparePrior();
  QVERIFY(w.shows(1, "20250215") && w.shows(0, "20260301"));
}

void TestComparePrior::filesThatAreGoneAreTold_data() {
  QTest::addColumn<bool>("withFolder");
  QTest::newRow("with their folder") << true;
  QTest::newRow("from their folder") << false;
}

void TestComparePrior::filesThatAreGoneAreTold() {
  QFETCH(bool, withFolder);
  const ListedDays all({QStringLiteral("20260301"), QStringLiteral("20240215")});
  QVERIFY(all.write());
  QDir gone(all.pathOf(QStringLiteral("20240215")));
  const QStringList files = gone.entryList(QDir::Files);
  QVERIFY(!files.isEmpty());
  for (const QString& file : files) QVERIFY(gone.remove(file));
  if (withFolder) QVERIFY(gone.removeRecursively());
  ListedWindow w(all, {QStringLiteral("20260301")});
  QVERIFY(w.isOpen());
  const SharedList<ViewState> before = w.workspace().views;
  w.comparePrior();
  QTRY_VERIFY_WITH_TIMEOUT(w.complaint().startsWith(QStringLiteral("The files of an earlier study")),
                           longest);
  QVERIFY(w.workspace().views == before);
}

// And it is told that there is a later one.
void TestComparePrior::anOlderOneStandsForWhatIsGone() {
  const ListedDays all({QStringLiteral("20260301"), QStringLiteral("20240215"), QStringLiteral("20220215")});
  QVERIFY(all.write());
  QVERIFY(QDir(all.pathOf(QStringLiteral("20240215"))).removeRecursively());
  ListedWindow w(all, {QStringLiteral("20260301")});
  QVERIFY(w.isOpen());
  w.comparePrior();
  QVERIFY(w.shows(1, "20220215") && w.shows(0, "20260301"));
  QVERIFY(w.complaint().startsWith(QStringLiteral("The files of an earlier study")));
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
