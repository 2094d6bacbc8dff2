// Guards archives in the window with a real archive (dcmqrscp), by real events: choosing one, searching,
// opening, and priors that only an archive has. The user's list is that of the tests.
#include <QComboBox>
#include <QDialog>
#include <QDirIterator>
#include <QFile>
#include <QSpinBox>

#include "io/archive/archives.h"
#include "io/files/output_file.h"
#include "io/files/private_folder.h"
#include "tests/ui/browser_window.h"
#include "tests/ui/hanging_window.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// The user's list of archives, until the end of a test.
struct ListedArchives {
  explicit ListedArchives(const std::string& json) {
    isWritten = makePrivateFolder(configFolder()) && writeWholeFile(userArchivesFile(), json);
  }
  explicit ListedArchives(int port) : ListedArchives(archivesToJson({{archiveAt(port)}})) {}
  ~ListedArchives() { QFile::remove(QString::fromStdString(userArchivesFile())); }
  static Archive archiveAt(int port) {
    Archive archive;
    archive.name = "main", archive.host = "127.0.0.1", archive.port = port, archive.calledAe = "ARCH";
    return archive;
  }

  bool isWritten = false;
};

QStringList dicomFilesBelow(const QString& folder) {
  QStringList files;
  for (QDirIterator all(folder, QDir::Files, QDirIterator::Subdirectories); all.hasNext();)
    files << all.next();
  return files;
}

// The dialog of archives, opened from the preferences.
struct EditedArchives : BrowserWindow {
  explicit EditedArchives(const Studies& studies) : BrowserWindow(studies) {
    QTest::keyClick(&window, Qt::Key_Comma, Qt::ControlModifier);
    click("editArchives");
  }
  void click(const char* button) { QTest::mouseClick(child<QPushButton>(button), Qt::LeftButton); }
  void type(const char* field, const QString& text) {
    child<QLineEdit>(field)->selectAll();
    QTest::keyClicks(child<QLineEdit>(field), text);
  }
  QString told() { return child<QLabel>("archiveTold")->text(); }
  bool isOpen() {
    const auto* dialog = child<QDialog>("archivesDialog");
    return dialog && dialog->isVisible();
  }
};

// Chooses the archive by a key.
bool chooseArchive(BrowserWindow& w) {
  auto* box = w.child<QComboBox>("browserSource");
  if (!QTest::qWaitFor([&] { return box->isVisible(); }, longest)) return false;
  box->setFocus();
  QTest::keyClick(box, Qt::Key_Down);
  return box->currentText() == QStringLiteral("main");
}

}  // namespace

class TestArchivesInWindow : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void init() { openAlone(); }
  void aStudyOfAnArchiveIsOpened();
  void anArchiveThatDoesNotAnswerCanBeAskedAgain();
  void aBrokenListIsTold();
  void thePriorIsFetchedFromAnArchive();
  void archivesAreEdited();
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
  BrowserWindow w(studies);
  QVERIFY(chooseArchive(w));
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
  QTest::keyClick(w.child<QComboBox>("browserSource"), Qt::Key_Up);
  QVERIFY(w.shows({QStringLiteral("Doe, Jane")}));
  QVERIFY(w.has("Head", 4));
}

void TestArchivesInWindow::anArchiveThatDoesNotAnswerCanBeAskedAgain() {
  const Studies studies;
  QVERIFY(studies.write());
  QrPeer peer;
  peer.add(dicomFilesBelow(studies.data));
  const ListedArchives list(peer.port());  // which is not started yet
  BrowserWindow w(studies);
  QVERIFY(chooseArchive(w));
  QTRY_VERIFY2_WITH_TIMEOUT(w.notice().contains(QStringLiteral("cannot be reached")), qPrintable(w.notice()),
                            longest);
  QVERIFY(w.search()->isEnabled() && w.patients().isEmpty());
  QVERIFY(peer.start());
  QTest::keyClicks(w.search(), QStringLiteral("abdomen"));
  QTest::keyClick(w.search(), Qt::Key_Return);
  QVERIFY(w.shows({QString::fromUtf8("Müller, Jörg")}));
  QVERIFY(w.notice().isEmpty());
}

void TestArchivesInWindow::aBrokenListIsTold() {
  const ListedArchives list("{\"archives\": 7}");
  const Studies studies;
  BrowserWindow w(studies);
  QTRY_VERIFY_WITH_TIMEOUT(w.banner()->sentence().contains(QStringLiteral("archives.json")), longest);
  QCOMPARE(w.child<QComboBox>("browserSource")->count(), 1);
  EditedArchives edited(studies);
  QVERIFY(edited.told().contains(QStringLiteral("archives.json")));
  QVERIFY2(!edited.child<QPushButton>("saveArchives")->isEnabled(), "it would replace the file");
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

// What the dialog does not show stays in the file.
void TestArchivesInWindow::archivesAreEdited() {
  QrPeer peer;
  QVERIFY(peer.start());
  Archive other = ListedArchives::archiveAt(104);
  other.name = "other", other.tls = TlsSettings{std::string(64, 'a'), "", "", ""};
  const ListedArchives list(archivesToJson({{other}}));
  const Studies studies;
  EditedArchives w(studies);
  QVERIFY(w.isOpen());
  w.type("archive_host", QStringLiteral("10.0.0.7"));
  w.click("addArchive");
  w.type("archive_name", QStringLiteral("main"));
  w.click("saveArchives");
  QVERIFY2(w.isOpen() && w.told().contains(QStringLiteral("Host or address must")), qPrintable(w.told()));
  w.type("archive_host", QStringLiteral("127.0.0.1"));
  w.type("archive_calledAe", QStringLiteral("ARCH"));
  w.child<QSpinBox>("archivePort")->selectAll();
  QTest::keyClicks(w.child<QSpinBox>("archivePort"), QString::number(peer.port()));
  w.click("testArchive");
  QTRY_COMPARE_WITH_TIMEOUT(w.told(), QStringLiteral("The archive \"main\" answers."), longest);
  w.shot("archives-edited");
  w.click("saveArchives");
  QVERIFY(!w.isOpen());
  other.host = "10.0.0.7";
  const Result<Archives> saved = readArchives(userArchivesFile());
  QVERIFY(saved && *saved == (Archives{{other, ListedArchives::archiveAt(peer.port())}}));
}

VOLUMEN_TEST(TestArchivesInWindow);
#include "tst_archives_in_window.moc"
