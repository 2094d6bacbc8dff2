// Guards the source "All" with a real archive (dcmqrscp), by real events: studies of all places are listed
// with their places, and what is opened, dragged and sent comes from its own.
#include <QMimeData>

#include "tests/ui/archives_window.h"
#include "tests/ui/gestures.h"
#include "tests/ui/held_archive.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/suite.h"
#include "ui/data/study_list.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Doe is on this computer and in the archive "main", which has Yamada, too. The archive "down" does not
// answer.
struct Places {
  Places() {
    Result<Index> index = studies.write() ? Index::open(studies.home.toStdString()) : Error{"no files"};
    const QString doe = studies.data + QStringLiteral("/doe");
    peer.add(dicomFilesBelow(doe) + dicomFilesBelow(studies.data + QStringLiteral("/yamada")));
    isReady = index && index->import({doe.toStdString()}) && peer.start();
  }
  static Archive down() {
    Archive down = ListedArchives::archiveAt(freePort());
    down.name = "down";
    return down;
  }
  Archives archives() const { return {{down(), ListedArchives::archiveAt(peer.port())}}; }

  Studies studies;
  QrPeer peer;
  bool isReady = false;
};

struct AllWindow : ArchivesWindow {
  using ArchivesWindow::ArchivesWindow;

  static constexpr int place = int(StudyColumn::place), description = int(StudyColumn::description);

  // Searches all places for a study. Returns its row that is found in `source`, once it is listed.
  QModelIndex find(const char* words, const char* study, const char* source) {
    if (!child<QWidget>("studyBrowser")->isVisible()) child<QAction>("showBrowser")->trigger();
    if (!choose("All")) return {};
    searchFor(words);
    QModelIndex found;
    const auto isThere = [&] { return (found = rowIn(study, source)).isValid(); };
    return QTest::qWaitFor(isThere, longest) ? found : QModelIndex();
  }
  QModelIndex rowIn(const char* study, const char* source) {
    for (const QModelIndex& row : rowsOf(study))
      if (row.siblingAtColumn(place).data() == QLatin1String(source)) return row.siblingAtColumn(0);
    return {};
  }
  QModelIndexList rowsOf(const char* study) {
    const QAbstractItemModel* model = tree()->model();
    return model->match(model->index(0, description), Qt::DisplayRole, QLatin1String(study), -1,
                        Qt::MatchExactly | Qt::MatchRecursive);
  }
};

}  // namespace

class TestAllSources : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void init() { openAlone(); }
  void allPlacesAreListed();
  void aSlowArchiveHoldsUpNobody();
  void whatIsOpenedComesFromItsPlace();
  void aDragComesFromItsPlace_data();
  void aDragComesFromItsPlace();
};

void TestAllSources::initTestCase() {
  if (!QrPeer::isInstalled()) QSKIP("dcmqrscp is not installed (package dcmtk)");
}

// What does not answer is named.
void TestAllSources::allPlacesAreListed() {
  const Places places;
  QVERIFY(places.isReady);
  const ListedArchives list(places.archives());
  AllWindow w(places.studies);
  QVERIFY(w.find("doe", "Head", "main").isValid());
  QTRY_VERIFY2_WITH_TIMEOUT(w.notice().startsWith(QStringLiteral("The archive \"down\" (127.0.0.1:")),
                            qPrintable(w.notice()), longest);
  for (const char* study : {"Head", "Follow-up"}) {
    QCOMPARE(w.rowsOf(study).size(), qsizetype(2));
    QCOMPARE(w.rowIn(study, "main").data().toString(), QStringLiteral("Doe, Jane (here)"));
    QCOMPARE(w.rowIn(study, "This computer").data().toString(), QStringLiteral("Doe, Jane"));
  }
  QCOMPARE(w.patients(AllWindow::place), QStringList(QStringLiteral("This computer, main")));
  QVERIFY(!w.tree()->isColumnHidden(AllWindow::place));
  w.shot("all-sources-in-browser");
  QVERIFY(w.choose("This computer"));
  QVERIFY(w.tree()->isColumnHidden(AllWindow::place));
}

void TestAllSources::aSlowArchiveHoldsUpNobody() {
  const Places places;
  QVERIFY(places.isReady);
  HeldArchive held;
  Archives archives = places.archives();
  archives.archives = {held.archive(), archives.archives[1]};
  const ListedArchives list(archives);
  AllWindow w(places.studies);
  QVERIFY(w.choose("All"));
  QTRY_COMPARE_WITH_TIMEOUT(w.patients().size(), qsizetype(401), longest);
  QTRY_COMPARE_WITH_TIMEOUT(w.notice(),
                            QStringLiteral("Archives list the studies of today. Type words to search them. "
                                           "Searching held: 400 studies so far."),
                            longest);
  held.sendRest();
  QTRY_COMPARE_WITH_TIMEOUT(w.patients().size(), qsizetype(601), longest);
  QTRY_COMPARE_WITH_TIMEOUT(
      w.notice(), QStringLiteral("Archives list the studies of today. Type words to search them."), longest);
}

void TestAllSources::whatIsOpenedComesFromItsPlace() {
  const Places places;
  QVERIFY(places.isReady);
  const ListedArchives list(places.archives());
  AllWindow w(places.studies);
  w.doubleClick(w.find("knee", "Knee", "main"));
  QVERIFY(w.isShown("Sagittal"));
  QCOMPARE(w.openPlaces(), QStringList(QStringLiteral("archive:main:1")));
  w.doubleClick(w.find("doe", "Head", "This computer"));
  QVERIFY(w.isShown("Bone"));
  QCOMPARE(w.openPlaces().size(), qsizetype(2));
  QCOMPARE(w.openPlaces().filter(QStringLiteral("index:")).size(), qsizetype(1));
}

void TestAllSources::aDragComesFromItsPlace_data() {
  QTest::addColumn<bool>("isRemoved");
  QTest::newRow("that is offered") << false;
  QTest::newRow("that was removed meanwhile") << true;
}

void TestAllSources::aDragComesFromItsPlace() {
  QFETCH(bool, isRemoved);
  const Places places;
  QVERIFY(places.isReady);
  const ListedArchives list(places.archives());
  AllWindow w(places.studies);
  QVERIFY(w.openHead());
  w.child<QAction>("layoutTwo")->trigger();
  const QModelIndex knee = w.find("knee", "Knee", "main");
  QVERIFY(knee.isValid());
  const std::unique_ptr<QMimeData> data(w.tree()->model()->mimeData({knee}));
  if (isRemoved) {
    const ListedArchives others(Archives{{Places::down()}});
    QVERIFY(w.window.document().sources.offerArchives());
  }
  QVERIFY(tests::drop(*data, w.window.views()->viewOf(firstComparedId + 1)));
  if (!isRemoved) QVERIFY(w.isShown("Sagittal", firstComparedId + 1));
  QCOMPARE(w.banner()->isVisible() ? w.banner()->sentence() : QString(),
           isRemoved ? QStringLiteral("The archive of this study is no longer in the list.") : QString());
  QCOMPARE(w.openPlaces().size(), isRemoved ? 1 : 2);
}

VOLUMEN_TEST(TestAllSources);
#include "tst_all_sources.moc"
