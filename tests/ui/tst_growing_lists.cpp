// Guards lists that grow while an archive answers, by real events: rows come before the end of the search,
// sorted as asked, and what the user looks at stays where it is.
#include <QHeaderView>
#include <algorithm>

#include "tests/ui/archives_window.h"
#include "tests/ui/held_archive.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// A window that lists 400 studies of 600, by name.
struct GrowingWindow : ArchivesWindow {
  explicit GrowingWindow(const Studies& studies) : ArchivesWindow(studies) {
    if (!choose("held")) return;
    QHeaderView* header = tree()->header();
    QTest::mouseClick(header->viewport(), Qt::LeftButton, {},
                      {header->sectionViewportPosition(0) + 10, header->height() / 2});
    const auto isShown = [&] { return patients().size() == 400 && tree()->viewport()->height() > 100; };
    isReady = QTest::qWaitFor(isShown, longest);
  }
  bool isSorted() {
    const QStringList names = patients();
    return std::is_sorted(names.begin(), names.end());
  }
  QString current() { return tree()->currentIndex().data().toString(); }
  int yOf(const char* patient) { return tree()->visualRect(row(patient)).y(); }

  bool isReady = false;
};

}  // namespace

class TestGrowingLists : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { openAlone(); }
  void rowsComeBeforeTheEnd();
  void whatWasFoundStays_data();
  void whatWasFoundStays();

 private:
  const Studies studies_;
};

// 200 rows come above the one that was clicked.
void TestGrowingLists::rowsComeBeforeTheEnd() {
  HeldArchive archive;
  const ListedArchives list(Archives{{archive.archive()}});
  GrowingWindow w(studies_);
  QVERIFY(w.isReady && w.isSorted());
  QCOMPARE(w.notice(), QStringLiteral("Searching held: 400 studies so far."));
  w.click(w.row("P0450"));
  w.shot("growing-list-in-browser");
  const int y = w.yOf("P0450");
  archive.sendRest();
  QTRY_COMPARE_WITH_TIMEOUT(w.patients().size(), qsizetype(600), longest);
  QVERIFY(w.isSorted());
  QCOMPARE(w.current(), QStringLiteral("P0450"));
  QCOMPARE(w.tree()->selectionModel()->selectedRows(), QModelIndexList{w.row("P0450")});
  QCOMPARE(w.yOf("P0450"), y);
  QTRY_COMPARE_WITH_TIMEOUT(w.notice(), QStringLiteral("Studies of today. Type words to search the archive."),
                            longest);
}

void TestGrowingLists::whatWasFoundStays_data() {
  QTest::addColumn<bool>("isCancelled");
  QTest::newRow("after the line broke") << false;
  QTest::newRow("after the search was cancelled") << true;
}

// Another order asks nobody, and the sentence stays.
void TestGrowingLists::whatWasFoundStays() {
  QFETCH(bool, isCancelled);
  HeldArchive archive;
  const ListedArchives list(Archives{{archive.archive()}});
  GrowingWindow w(studies_);
  QVERIFY(w.isReady);
  if (isCancelled) {
    const std::vector<JobRow> rows = w.window.jobs().rows();
    QCOMPARE(rows.size(), std::size_t(1));
    QVERIFY2(rows[0].text.contains(QStringLiteral("400 studies")), qPrintable(rows[0].text));
    w.window.jobs().cancel(rows[0].id);
  } else {
    archive.hangUp();
  }
  const QString beginning =
      QStringLiteral("These are not all studies. The ") +
      (isCancelled ? QStringLiteral("search of held was cancelled.") : QStringLiteral("archive \"held\" "));
  QTRY_VERIFY2_WITH_TIMEOUT(w.notice().startsWith(beginning), qPrintable(w.notice()), longest);
  QCOMPARE(w.patients().size(), qsizetype(400));
  w.tree()->header()->setSortIndicator(0, Qt::DescendingOrder);
  QTRY_COMPARE_WITH_TIMEOUT(w.patients().front(), QStringLiteral("P0599"), longest);
  QVERIFY2(w.notice().startsWith(beginning), qPrintable(w.notice()));
}

VOLUMEN_TEST(TestGrowingLists);
#include "tst_growing_lists.moc"
