// Guards sending to archives (Orthanc, dcmqrscp), by real events: what leaves is what was chosen, and how it
// ended is one sentence.
#include <QMenu>

#include "io/archive/search_archive.h"
#include "tests/ui/archives_window.h"
#include "tests/unit/archive/orthanc_peer.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// A window with studies in its index, which sends to archives.
struct SendingWindow : ArchivesWindow {
  using ArchivesWindow::ArchivesWindow;

  QComboBox* field(const char* name) { return child<QComboBox>(name); }
  // Chooses the archive and, from the top, what to send. Sends it.
  void send(const char* archive, int choice) {
    for (int n = 0; n < choice; ++n) QTest::keyClick(field("exportChoice"), Qt::Key_Down);
    const int n = field("exportTarget")->findText(QLatin1String(archive));
    while (field("exportTarget")->currentIndex() < n) QTest::keyClick(field("exportTarget"), Qt::Key_Down);
    press("exportButton");
  }
  QString status() { return child<QLabel>("toldText")->text(); }
  // Waits for the sentence about a series or study that was sent whole.
  bool hasSent(std::size_t images, const char* archive) {
    const QString sentence =
        QStringLiteral("Sent %1 of %1 images to %2.").arg(images).arg(QLatin1String(archive));
    return QTest::qWaitFor([&] { return status() == sentence; }, longest);
  }
  bool warns(const char* beginning) {
    return QTest::qWaitFor([&] { return banner()->sentence().startsWith(QLatin1String(beginning)); },
                           longest);
  }
  // Chooses an entry of the menu of a row.
  void chooseInMenu(const QModelIndex& row, const QString& entry) {
    const QPoint at = tree()->visualRect(row).center();
    QContextMenuEvent event(QContextMenuEvent::Mouse, at, tree()->viewport()->mapToGlobal(at));
    QCoreApplication::sendEvent(tree()->viewport(), &event);
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    QVERIFY(menu);
    for (QAction* action : menu->actions())
      if (action->text() == entry)
        return QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(action).center());
    QTest::keyClick(menu, Qt::Key_Escape);
    QFAIL("there is no such entry");
  }
};

// Returns the number of series that an archive has of a study; -1 if it does not answer.
int seriesInArchive(const Archive& archive, const char* studyUid) {
  const auto series = seriesOfArchiveStudy(archive, studyUid, {});
  return series ? int(series->size()) : -1;
}

const QString sendEntry = QStringLiteral("Send to archive...");

}  // namespace

class TestSending : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void init() { openAlone(); }
  void theSeriesInTheViewIsSent_data();
  void theSeriesInTheViewIsSent();
  void whatIsListedIsSent_data();
  void whatIsListedIsSent();
  void whatCannotBeSentIsTold_data();
  void whatCannotBeSentIsTold();
  void aLostFileIsNamed();
  void sendingIsCancelled();
};

void TestSending::initTestCase() {
  if (!QrPeer::isInstalled()) QSKIP("dcmqrscp is not installed (package dcmtk)");
}

void TestSending::theSeriesInTheViewIsSent_data() {
  QTest::addColumn<bool>("isWeb");
  QTest::newRow("DIMSE") << false;
  QTest::newRow("DICOMweb") << true;
}

// Then its study. The archive is proposed again.
void TestSending::theSeriesInTheViewIsSent() {
  QFETCH(bool, isWeb);
  if (!OrthancPeer::isInstalled()) QSKIP("Orthanc is not installed (packages orthanc, orthanc-dicomweb)");
  OrthancPeer peer;
  QVERIFY(peer.start());
  Archive archive;
  archive.name = "second";
  archive.host = "127.0.0.1", archive.port = peer.port(), archive.calledAe = "ORTHANC";
  if (isWeb) {
    archive.kind = ArchiveKind::dicomweb;
    archive.url = peer.url().toStdString(), archive.user = "alice", archive.passwordCommand = "echo secret";
  }
  const ListedArchives list(Archives{{ListedArchives::archiveAt(1), archive}});
  const Studies studies;
  QVERIFY(studies.import());
  SendingWindow w(studies);
  QVERIFY(w.openHead());
  const auto count = [&](const char* folder) {
    return std::size_t(dicomFilesBelow(studies.data + QLatin1String(folder)).size());
  };
  w.child<QAction>("sendToArchive")->trigger();
  w.send("second", 0);
  QVERIFY2(w.hasSent(count("/doe/bone"), "second"), qPrintable(w.status() + w.banner()->sentence()));
  QCOMPARE(seriesInArchive(archive, "1.2.3.1"), 1);
  QTRY_VERIFY(!w.child<QDialog>("exportDialog"));
  w.child<QAction>("sendToArchive")->trigger();
  QCOMPARE(w.field("exportTarget")->currentText(), QStringLiteral("second"));
  w.send("second", 1);
  QVERIFY(w.hasSent(count("/doe/bone") + count("/doe/soft"), "second"));
  QCOMPARE(seriesInArchive(archive, "1.2.3.1"), 2);
  QCOMPARE(seriesInArchive(archive, "1.2.3.2"), 0);
}

void TestSending::whatIsListedIsSent_data() {
  QTest::addColumn<QByteArray>("source");
  QTest::newRow("in the list of this computer") << QByteArray("This computer");
  QTest::newRow("in the list of all places") << QByteArray("All");
}

// A series of the study list, a study without opening it, and nothing that an archive lists.
void TestSending::whatIsListedIsSent() {
  QFETCH(QByteArray, source);
  QrPeer peer;
  QVERIFY(peer.start());
  const ListedArchives list(peer.port());
  const Studies studies;
  QVERIFY(studies.import());
  SendingWindow w(studies);
  QVERIFY(w.choose(source.constData()) && w.has("Head", 4));
  w.tree()->setExpanded(w.row("Head", 4), true);
  QVERIFY(w.has("Soft tissue", 4));
  w.chooseInMenu(w.row("Soft tissue", 4), sendEntry);
  QCOMPARE(w.field("exportChoice")->count(), 2);
  w.send("main", 0);
  const auto count = [&](const char* folder) {
    return std::size_t(dicomFilesBelow(studies.data + QLatin1String(folder)).size());
  };
  QVERIFY(w.hasSent(count("/doe/soft"), "main"));
  QCOMPARE(seriesInArchive(ListedArchives::archiveAt(peer.port()), "1.2.3.1"), 1);
  QTRY_VERIFY(!w.child<QDialog>("exportDialog"));
  w.chooseInMenu(w.row("Müller"), sendEntry);
  QCOMPARE(w.field("exportChoice")->count(), 1);
  w.send("main", 0);
  QVERIFY(w.hasSent(count("/mueller"), "main"));
  QCOMPARE(seriesInArchive(ListedArchives::archiveAt(peer.port()), "1.2.3.3"), 1);
  QVERIFY(w.openPlaces().isEmpty());
  QVERIFY(w.choose("main"));
  w.searchFor("abdomen");
  QVERIFY(w.shows({QString::fromUtf8("Müller, Jörg (here)")}));
  const QPoint at = w.tree()->visualRect(w.row("Müller")).center();
  QContextMenuEvent event(QContextMenuEvent::Mouse, at, w.tree()->viewport()->mapToGlobal(at));
  QCoreApplication::sendEvent(w.tree()->viewport(), &event);
  auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
  QVERIFY(menu);
  for (const QAction* action : menu->actions()) QVERIFY(action->text() != sendEntry);
}

void TestSending::whatCannotBeSentIsTold_data() {
  QTest::addColumn<QString>("opened");
  QTest::addColumn<bool>("isListed");
  QTest::addColumn<QByteArray>("sentence");
  const auto row = [](const char* name, const char* opened, bool isListed, const char* sentence) {
    QTest::newRow(name) << QString::fromLatin1(opened) << isListed << QByteArray(sentence);
  };
  row("nothing is open", "", true, "Open a series first.");
  row("no DICOM file", "phantom:cube:16", true, "Archives take DICOM files only: ");
  row("no archive", "doe/bone", false, "No archive is set up: ");
  row("the archive does not answer", "doe/bone", true, "The archive \"main\" (127.0.0.1:");
}

void TestSending::whatCannotBeSentIsTold() {
  QFETCH(QString, opened);
  QFETCH(bool, isListed);
  QFETCH(QByteArray, sentence);
  const ListedArchives list(isListed ? Archives{{ListedArchives::archiveAt(freePort())}} : Archives());
  const Studies studies;
  QVERIFY(studies.write());
  const bool isFile = opened.contains(QLatin1Char('/'));
  SendingWindow w(studies, opened.isEmpty()
                               ? QStringList()
                               : QStringList(isFile ? studies.data + QLatin1Char('/') + opened : opened));
  if (!opened.isEmpty())
    QTRY_VERIFY_WITH_TIMEOUT(w.window.session().series() && !w.window.document().loader.isBusy(), longest);
  w.child<QAction>("sendToArchive")->trigger();
  if (w.child<QDialog>("exportDialog")) w.send("main", 0);
  QVERIFY2(w.warns(sentence.constData()), qPrintable(w.banner()->sentence()));
}

void TestSending::aLostFileIsNamed() {
  QrPeer peer;
  QVERIFY(peer.start());
  const ListedArchives list(peer.port());
  const Studies studies;
  QVERIFY(studies.import());
  SendingWindow w(studies);
  QVERIFY(w.openHead());
  const QStringList files = dicomFilesBelow(studies.data + QStringLiteral("/doe/bone"));
  QVERIFY(QFile::remove(files[0]));
  w.child<QAction>("sendToArchive")->trigger();
  w.send("main", 0);
  const QString sentence =
      QStringLiteral("Sent %1 of %1 images to main. 1 file holds no image to send.").arg(files.size() - 1);
  QVERIFY2(w.warns(sentence.toLatin1().constData()), qPrintable(w.banner()->sentence()));
  QVERIFY(w.child<QPlainTextEdit>("bannerDetails")->toPlainText().contains(QFileInfo(files[0]).fileName()));
}

// Closing the window while images are being sent is asked about.
void TestSending::sendingIsCancelled() {
  FakePeer silent([](QTcpSocket& socket) { socket.waitForDisconnected(3000); });
  const ListedArchives list(silent.port());
  const Studies studies;
  QVERIFY(studies.import());
  SendingWindow w(studies);
  QVERIFY(w.openHead());
  w.child<QAction>("sendToArchive")->trigger();
  w.send("main", 0);
  QTRY_COMPARE_WITH_TIMEOUT(w.window.jobs().rows().size(), std::size_t(1), longest);
  QVERIFY(w.window.jobs().rows()[0].text.startsWith(QStringLiteral("Sending")));
  QVERIFY(!w.window.close());
  auto* box = w.child<QMessageBox>("closeBox");
  QVERIFY(box && box->text().contains(QStringLiteral("files that are being exported")));
  box->reject();
  w.window.jobs().cancel(w.window.jobs().rows()[0].id);
  QVERIFY(w.window.jobs().rows().empty());
  QVERIFY(w.banner()->sentence().isEmpty() || !w.banner()->isVisible());
}

VOLUMEN_TEST(TestSending);
#include "tst_sending.moc"
