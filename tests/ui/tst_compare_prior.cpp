// Guards priors in the window. The same series of an earlier date opens beside, in one undo step, and what is
// missing is loaded while the user scrolls. A study that is only listed is opened for it. Real events.
#include <QDir>
#include <QFile>
#include <QLabel>
#include <algorithm>
#include <functional>

#include "io/index/index.h"
#include "tests/ui/gestures.h"
#include "tests/ui/hanging_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

using Edit = std::function<void(DicomSeriesTags&)>;

// Studies of these dates, a folder each, all in one index.
struct ListedDays {
  QTemporaryDir folder;
  const QStringList days;
  const Edit edit;
  const QString home = folder.filePath(QStringLiteral("home"));

  explicit ListedDays(const QStringList& all, const Edit& with = {}) : days(all), edit(with) {}
  QString pathOf(const QString& day) const { return folder.filePath(QStringLiteral("data/") + day); }
  bool writeDays() const {
    QDir(folder.path()).mkdir(QStringLiteral("data"));
    return std::ranges::all_of(days, [&](const QString& day) {
      return TwoDays::writeDay(pathOf(day), day.toLatin1().constData(), edit);
    });
  }
  bool write() const { return writeDays() && import(); }
  bool import() const {
    Result<Index> index = Index::open(home.toStdString());
    return index && index->import({folder.filePath(QStringLiteral("data")).toStdString()});
  }
  // Returns when studies were opened, from the index, joined.
  std::string opened() const {
    std::string all;
    const Result<Index> index = Index::open(home.toStdString());
    if (!index) return "failed";
    const auto studies = index->studies();
    if (!studies) return "failed";
    for (const IndexedStudy& study : *studies) all += study.openedAt;
    return all;
  }
  Services services() const {
    Services real = realServices();
    real.indexFolder = home.toStdString();
    return real;
  }
};

// A window with some of the listed studies open.
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
  void aListThatCannotBeReadIsTold();
  void thatThereIsNoneEndsOnceThereIsOne();
  void aListedStudyIsOpenedForIt();
  void aLaterOneThatIsListedIsTold();
  void filesThatAreGoneAreTold();
  void anOlderOneStandsForWhatIsGone();
  void filesOfOthersAreNotCompared();
  void whatIsNotAlikeIsNotListed();
  void failuresOfOthersDoNotMatter();
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
  const Loader& loader = w.window.document().loader;
  std::vector<SeriesKey> began;
  connect(&loader, &Loader::loadingChanged, this, [&] {
    if (loader.loading()) began.push_back(keyOf(*loader.loading()));
  });
  w.session().change(QStringLiteral("Compare"), four);
  int turned = 0;
  const auto haveCome = [&] {
    wheel(w.window.views()->viewAs<FlatView>(firstCell), turned++ % 2 ? 1 : -1);
    return std::ranges::all_of(wanted,
                               [&](const SeriesKey& key) { return w.session().seriesNamed(key) != nullptr; });
  };
  QVERIFY(QTest::qWaitFor(haveCome, longest));
  QVERIFY2(turned > 1, "the wheel was turned while they came");
  QCOMPARE(began.size(), std::size_t(3));
  const std::size_t order[] = {1, 0, 2};  // the view in focus first
  for (int n = 0; n < 3; ++n) QVERIFY(began[std::size_t(n)] == wanted[order[n]]);
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

void TestComparePrior::aListThatCannotBeReadIsTold() {
  const ListedDays all({QStringLiteral("20260301")});
  QVERIFY(all.writeDays());
  QFile file(all.home);  // blocks the folder of the index
  QVERIFY(file.open(QIODevice::WriteOnly));
  ListedWindow w(all, {QStringLiteral("20260301")});
  QVERIFY(w.isOpen());
  const Workspace before = w.workspace();
  w.comparePrior();
  QTRY_VERIFY2_WITH_TIMEOUT(w.complaint().startsWith(QStringLiteral("A list of studies could not be read")),
                            qPrintable(w.complaint()), longest);
  QVERIFY(w.workspace() == before);
  QCOMPARE(w.window.document().open.volumes().size(), std::size_t(1));
}

// The message disappears once an earlier study was imported and is shown.
void TestComparePrior::thatThereIsNoneEndsOnceThereIsOne() {
  const ListedDays days({QStringLiteral("20260301"), QStringLiteral("20240215")});
  QVERIFY(days.writeDays());
  ListedWindow w(days, {QStringLiteral("20260301")});
  QVERIFY(w.isOpen());
  auto* banner = w.child<Banner>("banner");
  w.comparePrior();
  QTRY_VERIFY_WITH_TIMEOUT(banner->isVisible() && w.complaint().contains(QStringLiteral("No earlier study")),
                           longest);
  QVERIFY(days.import());
  QVERIFY(banner->isVisible());
  w.comparePrior();
  QVERIFY(w.shows(1, "20240215"));
  QVERIFY2(banner->isHidden(), "there is one");
}

// The latest prior opens in one undo step and joins the open series.
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
  QCOMPARE(all.opened(), std::string());  // its opening is not recorded
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.workspace().views == before.views && w.workspace().layout == before.layout);
}

// The open prior is shown at once and not replaced automatically by a later one.
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

// Their folder is still there.
void TestComparePrior::filesThatAreGoneAreTold() {
  const ListedDays all({QStringLiteral("20260301"), QStringLiteral("20240215")});
  QVERIFY(all.write());
  QDir gone(all.pathOf(QStringLiteral("20240215")));
  const QStringList files = gone.entryList(QDir::Files);
  QVERIFY(!files.isEmpty());
  for (const QString& file : files) QVERIFY(gone.remove(file));
  ListedWindow w(all, {QStringLiteral("20260301")});
  QVERIFY(w.isOpen());
  const SharedList<ViewState> before = w.workspace().views;
  w.comparePrior();
  QTRY_VERIFY_WITH_TIMEOUT(w.complaint().startsWith(QStringLiteral("The files of an earlier study")),
                           longest);
  QVERIFY(w.workspace().views == before);
}

// A message says that there is a later one.
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

// The files of another patient are where those of the earlier study were, with the same names.
void TestComparePrior::filesOfOthersAreNotCompared() {
  const ListedDays all({QStringLiteral("20260301"), QStringLiteral("20240215")});
  QVERIFY(all.write());
  QDir folder(all.pathOf(QStringLiteral("20240215")));
  const QStringList names = folder.entryList(QDir::Files);
  QVERIFY(folder.removeRecursively());
  const Edit another = [](DicomSeriesTags& tags) { tags.patientName = "Roe^Jane"; };
  QVERIFY(TwoDays::writeDay(folder.path(), "20240215", another));
  QCOMPARE(QDir(folder.path()).entryList(QDir::Files), names);
  ListedWindow w(all, {QStringLiteral("20260301")});
  QVERIFY(w.isOpen());
  const SharedList<ViewState> before = w.workspace().views;
  w.comparePrior();
  QTRY_VERIFY_WITH_TIMEOUT(w.complaint().startsWith(QStringLiteral("The files of an earlier study")),
                           longest);
  QVERIFY(w.workspace().views == before);
  QCOMPARE(w.window.document().open.volumes().size(), std::size_t(1));
}

// Five studies of knees beside a head: three are examined.
void TestComparePrior::whatIsNotAlikeIsNotListed() {
  const ListedDays all(
      {QStringLiteral("20260301"), QStringLiteral("20250215"), QStringLiteral("20240215"),
       QStringLiteral("20230215"), QStringLiteral("20220215"), QStringLiteral("20210215")},
      [](DicomSeriesTags& tags) { tags.bodyPart = tags.studyDate == "20260301" ? "HEAD" : "KNEE"; });
  QVERIFY(all.write());
  ListedWindow w(all, {QStringLiteral("20260301")});
  QVERIFY(w.isOpen());
  const Workspace before = w.workspace();
  QSignalSpy opened(&w.window.document().loader, &Loader::filesOpened);
  w.comparePrior();
  QTRY_VERIFY_WITH_TIMEOUT(w.complaint().startsWith(QStringLiteral("The 3 earlier studies")), longest);
  QCOMPARE(opened.count(), 3);
  QVERIFY(w.workspace() == before);
  QCOMPARE(w.window.document().open.all().size(), std::size_t(1));
  QCOMPARE(all.opened(), std::string());
}

// Failures of other studies do not matter once the study was requested.
void TestComparePrior::failuresOfOthersDoNotMatter() {
  const ListedDays all({QStringLiteral("20260301"), QStringLiteral("20240215")});
  QVERIFY(all.write());
  ListedWindow w(all, {QStringLiteral("20260301")});
  QVERIFY(w.isOpen());
  StudySource* source = &w.window.document().sources.current();
  connect(source, &StudySource::patientListed, source,
          [source] { Q_EMIT source->failed(QStringLiteral("A disk is full.")); });
  w.comparePrior();
  QVERIFY(w.shows(1, "20240215") && w.shows(0, "20260301"));
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
