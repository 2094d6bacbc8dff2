// Guards archives in the window with a real archive (dcmqrscp), by real events: choosing one, searching,
// opening, dragging, and priors that only an archive has. The user's list is that of the tests.
#include <QMimeData>

#include "io/archive/fetched_studies.h"
#include "tests/ui/archives_window.h"
#include "tests/ui/gestures.h"
#include "tests/ui/hanging_window.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/suite.h"
#include "ui/workspace/dragged_series.h"

using namespace volumen;
using namespace volumen::tests;

class TestArchivesInWindow : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void init() { openAlone(); }
  void aStudyOfAnArchiveIsOpened();
  void anArchiveThatDoesNotAnswerCanBeAskedAgain();
  void aFetchedStudyIsKept();
  void aBrokenListIsTold();
  void thePriorIsFetchedFromAnArchive();
  void aDragKeepsItsSource_data();
  void aDragKeepsItsSource();
};

void TestArchivesInWindow::initTestCase() {
  if (!QrPeer::isInstalled()) QSKIP("dcmqrscp is not installed (package dcmtk)");
}

void TestArchivesInWindow::aStudyOfAnArchiveIsOpened() {
  const Studies studies;
  QVERIFY(studies.write());
  QrPeer peer;
  peer.add(dicomFilesBelow(studies.data));
  QVERIFY(peer.start());
  const ListedArchives list(peer.port());
  QVERIFY(list.isWritten);
  ArchivesWindow w(studies);
  QVERIFY(w.choose("main"));
  QTRY_COMPARE_WITH_TIMEOUT(
      w.notice(), QStringLiteral("There are no studies of today. Type words to search the archive."),
      longest);
  QTest::keyClicks(w.search(), QStringLiteral("jane"));  // asked after a pause
  QVERIFY(w.has("Head", 4));
  w.click(w.row("Head", 4));
  QTRY_COMPARE_WITH_TIMEOUT(w.strip()->count(), 2, longest);
  QVERIFY(w.openHead());
  w.child<QAction>("showBrowser")->trigger();
  QTest::keyClicks(w.search(), QStringLiteral("jane"));
  QTest::keyClick(w.search(), Qt::Key_Return);
  QVERIFY(w.has("Doe, Jane (here)"));
  w.shot("archive-in-browser");
  QCOMPARE(w.row("Doe, Jane (here)").siblingAtColumn(4).data().toString(), QStringLiteral("Head"));
  w.search()->clear();
  QTest::keyClick(w.box(), Qt::Key_Up);
  QVERIFY(w.shows({QStringLiteral("Doe, Jane")}));
  QVERIFY(w.has("Head", 4));
}

void TestArchivesInWindow::anArchiveThatDoesNotAnswerCanBeAskedAgain() {
  const Studies studies;
  QVERIFY(studies.write());
  QrPeer peer;
  peer.add(dicomFilesBelow(studies.data));
  const ListedArchives list(peer.port());  // which is not started yet
  ArchivesWindow w(studies);
  QVERIFY(w.choose("main"));
  QTRY_VERIFY2_WITH_TIMEOUT(w.notice().contains(QStringLiteral("cannot be reached")), qPrintable(w.notice()),
                            longest);
  QVERIFY(w.search()->isEnabled() && w.patients().isEmpty());
  QVERIFY(peer.start());
  QTest::keyClicks(w.search(), QStringLiteral("abdomen"));
  QTest::keyClick(w.search(), Qt::Key_Return);
  QVERIFY(w.shows({QString::fromUtf8("Müller, Jörg")}));
  QTRY_VERIFY_WITH_TIMEOUT(w.notice().isEmpty(), longest);
}

void TestArchivesInWindow::aFetchedStudyIsKept() {
  const char* const entry = "Keep on this computer";
  const Studies studies;
  QVERIFY(studies.write());
  QVERIFY(importIntoIndex(studies.home.toStdString(), {studies.data.toStdString() + "/mueller"}));
  QrPeer peer;
  peer.add(dicomFilesBelow(studies.data));
  QVERIFY(peer.start());
  const ListedArchives list(peer.port());
  const auto isKept = [&] { return isFetchedKept(studies.home.toStdString(), "1.2.3.1"); };
  {
    ArchivesWindow w(studies);
    QVERIFY(w.open("main", "Head", "Bone"));
    w.child<QAction>("showBrowser")->trigger();
    QVERIFY(w.choose("This computer") && w.has("Head", 4) && w.has("Abdomen", 4));
    QMenu* imported = w.menuOf(w.row("Abdomen", 4));
    QVERIFY(imported && !w.entryOf(imported, entry));
    imported->close();
    QMenu* fetched = w.menuOf(w.row("Head", 4));
    QVERIFY(fetched && w.entryOf(fetched, entry) && !w.entryOf(fetched, entry)->isChecked());
    w.chooseEntry(fetched, w.entryOf(fetched, entry));
    QTRY_VERIFY_WITH_TIMEOUT(isKept() == true, longest);
  }
  ArchivesWindow w(studies);
  QVERIFY(w.has("Head", 4));
  const auto hover = [&] { return w.row("Head", 4).data(Qt::ToolTipRole).toString(); };
  QVERIFY2(hover().contains(QStringLiteral("Kept on this computer")), qPrintable(hover()));
  QMenu* kept = w.menuOf(w.row("Head", 4));
  QVERIFY(kept && w.entryOf(kept, entry) && w.entryOf(kept, entry)->isChecked());
  w.chooseEntry(kept, w.entryOf(kept, entry));
  QTRY_VERIFY_WITH_TIMEOUT(isKept() == false, longest);
  QVERIFY(!hover().contains(QStringLiteral("Kept on this computer")));
}

void TestArchivesInWindow::aBrokenListIsTold() {
  const ListedArchives list("{\"archives\": 7}");
  const Studies studies;
  ArchivesWindow w(studies);
  QTRY_VERIFY_WITH_TIMEOUT(w.banner()->sentence().contains(QStringLiteral("archives.json")), longest);
  QCOMPARE(w.box()->count(), 1);
  w.edit();
  QVERIFY(w.told().contains(QStringLiteral("archives.json")));
  QVERIFY2(!w.child<QPushButton>("saveArchives")->isEnabled(), "it would replace the file");
}

void TestArchivesInWindow::thePriorIsFetchedFromAnArchive() {
  const TwoDays days;
  QVERIFY(days.write());
  QrPeer peer;
  peer.add(dicomFilesBelow(days.before));
  QVERIFY(peer.start());
  const ListedArchives list(peer.port());
  Services services = realServices();
  services.indexFolder = days.folder.filePath(QStringLiteral("home")).toStdString();
  HangingWindow w({days.now}, services);
  QTRY_VERIFY_WITH_TIMEOUT(w.session().series() && !w.window.document().loader.isBusy(), longest);
  QTest::keyClick(&w.window, Qt::Key_7, Qt::AltModifier);
  const auto showsPrior = [&] {
    const LoadedSeriesPtr shown = w.session().seriesOf(firstCell + 1);
    return shown && shown->series.studyDate == "20240215";
  };
  QVERIFY2(QTest::qWaitFor(showsPrior, longest), qPrintable(w.complaint()));
}

void TestArchivesInWindow::aDragKeepsItsSource_data() {
  QTest::addColumn<QString>("meanwhile");
  QTest::addColumn<bool>("isOpened");
  QTest::newRow("another source is listed") << QString() << true;
  QTest::newRow("the archive is removed") << QStringLiteral("removed") << false;
  QTest::newRow("the drag is of another program") << QStringLiteral("other program") << false;
}

// The first study of the archive is the last one of the index.
void TestArchivesInWindow::aDragKeepsItsSource() {
  QFETCH(QString, meanwhile);
  QFETCH(bool, isOpened);
  const Studies studies;
  QVERIFY(studies.import());
  QrPeer peer;
  peer.add(dicomFilesBelow(studies.data + QStringLiteral("/yamada")));
  QVERIFY(peer.start());
  const ListedArchives list(peer.port());
  ArchivesWindow w(studies);
  QVERIFY(w.openHead());
  w.child<QAction>("layoutTwo")->trigger();
  w.child<QAction>("showBrowser")->trigger();
  QVERIFY(w.choose("main"));
  w.searchFor("knee");
  QVERIFY(w.has("Knee", 4));
  const std::unique_ptr<QMimeData> data(w.tree()->model()->mimeData({w.row("Knee", 4)}));
  if (meanwhile == QStringLiteral("removed")) {
    const ListedArchives none(Archives{});
    QVERIFY(w.window.document().sources.offerArchives());
  } else if (!meanwhile.isEmpty()) {
    QByteArray said = data->data(draggedSeriesType);
    data->setData(draggedSeriesType, said.replace(0, 8, "00000000"));
  }
  w.choose("This computer");
  w.search()->clear();
  QVERIFY(w.has("Head", 4));
  QVERIFY(tests::drop(*data, w.window.views()->viewOf(firstComparedId + 1)));
  QCOMPARE(w.banner()->isVisible(), !isOpened);
  QVERIFY(w.isShown("Bone", firstComparedId));
  if (isOpened) QVERIFY(w.isShown("Sagittal", firstComparedId + 1));
  QTest::qWait(isOpened ? 0 : 300);
  QCOMPARE(w.openPlaces().size(), isOpened ? 2 : 1);
}

VOLUMEN_TEST(TestArchivesInWindow);
#include "tst_archives_in_window.moc"
