// Guards the dialog of archives, by real events: archives of both protocols are tested and saved, and the
// study list follows at once. Studies of archives that are renamed, changed or removed stay what they are.
#include <QElapsedTimer>
#include <QSpinBox>
#include <QTcpServer>

#include "tests/ui/archives_window.h"
#include "tests/unit/archive/orthanc_peer.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestEditedArchives : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void init() { openAlone(); }
  void archivesAreEdited();
  void aWebArchiveIsAdded();
  void closingWaitsForNoTest();
  void aRemovedArchiveKeepsItsStudies();
  void aRenamedArchiveIsAnotherSource();
  void aChangedArchiveIsAskedAgain();

 private:
  const Studies studies_;
};

void TestEditedArchives::initTestCase() {
  if (!QrPeer::isInstalled()) QSKIP("dcmqrscp is not installed (package dcmtk)");
  QVERIFY(studies_.write());
}

// What the dialog does not show stays in the file.
void TestEditedArchives::archivesAreEdited() {
  QrPeer peer;
  QVERIFY(peer.start());
  Archive other = ListedArchives::archiveAt(104);
  other.name = "other", other.tls = TlsSettings{std::string(64, 'a'), "", "", ""};
  Archives listed{{other}};
  listed.listen = listed.archives[0].listen = Listening{};
  const ListedArchives list(listed);
  const Studies empty;
  ArchivesWindow w(empty);
  w.edit();
  QVERIFY(w.isEditing());
  w.type("archive_host", QStringLiteral("10.0.0.7"));
  w.press("addArchive");
  w.type("archive_name", QStringLiteral("main"));
  w.press("saveArchives");
  QVERIFY2(w.isEditing() && w.told().contains(QStringLiteral("Host or address must")), qPrintable(w.told()));
  w.type("archive_host", QStringLiteral("127.0.0.1"));
  w.type("archive_calledAe", QStringLiteral("ARCH"));
  w.child<QSpinBox>("archivePort")->selectAll();
  QTest::keyClicks(w.child<QSpinBox>("archivePort"), QString::number(peer.port()));
  w.press("testArchive");
  QTRY_COMPARE_WITH_TIMEOUT(w.told(), QStringLiteral("The archive \"main\" answers."), longest);
  QVERIFY(w.save());
  listed.archives[0].host = "10.0.0.7";
  listed.archives.push_back(ListedArchives::archiveAt(peer.port()));
  listed.archives[1].listen = listed.listen;
  const Result<Archives> saved = readArchives(userArchivesFile());
  QVERIFY(saved && *saved == listed);
  QVERIFY2(w.child<QWidget>("studyBrowser")->isVisible(), "archives are listed where nothing else is");
}

// Values of the other protocol are kept while the dialog is open, and not saved.
void TestEditedArchives::aWebArchiveIsAdded() {
  if (!OrthancPeer::isInstalled()) QSKIP("Orthanc is not installed (packages orthanc, orthanc-dicomweb)");
  OrthancPeer peer;
  QVERIFY(peer.start());
  peer.add(dicomFilesBelow(studies_.data));
  const ListedArchives list(Archives{});
  const Studies empty;
  ArchivesWindow w(empty);
  w.edit();
  w.press("addArchive");
  w.type("archive_name", QStringLiteral("web"));
  w.type("archive_host", QStringLiteral("10.0.0.7"));
  auto* protocol = w.child<QComboBox>("archiveKind");
  QTest::keyClick(protocol, Qt::Key_Down);
  QCOMPARE(protocol->currentText(), QStringLiteral("DICOMweb"));
  QVERIFY(!w.child<QLineEdit>("archive_host")->isVisible() && w.child<QLineEdit>("archive_url")->isVisible());
  w.type("archive_url", peer.url() + QLatin1Char('/'));
  w.type("archive_user", QStringLiteral("alice"));
  w.press("testArchive");
  QCOMPARE(w.told(), QStringLiteral("User and \"Password command\" belong together."));
  w.type("archive_passwordCommand", QStringLiteral("echo wrong"));
  w.press("testArchive");
  QTRY_VERIFY2_WITH_TIMEOUT(w.told().endsWith(QStringLiteral("does not accept user and password (401).")),
                            qPrintable(w.told()), longest);
  w.type("archive_passwordCommand", QStringLiteral("echo secret"));
  w.press("testArchive");
  QTRY_COMPARE_WITH_TIMEOUT(w.told(), QStringLiteral("The archive \"web\" answers."), longest);
  QTest::keyClick(protocol, Qt::Key_Up);
  QCOMPARE(w.child<QLineEdit>("archive_host")->text(), QStringLiteral("10.0.0.7"));
  QTest::keyClick(protocol, Qt::Key_Down);
  QVERIFY(w.save());
  Archive web;
  web.name = "web", web.kind = ArchiveKind::dicomweb, web.url = peer.url().toStdString();
  web.user = "alice", web.passwordCommand = "echo secret";
  const Result<Archives> saved = readArchives(userArchivesFile());
  QVERIFY(saved && *saved == Archives{{web}});
  QVERIFY(w.open("web", "Knee", "Sagittal"));
}

// A server that takes no more connections is as silent as a host that is off: a test of it takes 5 s.
void TestEditedArchives::closingWaitsForNoTest() {
  QTcpServer full;
  full.setListenBacklogSize(1);
  QVERIFY(full.listen(QHostAddress::LocalHost));
  full.pauseAccepting();
  QTcpSocket waiting[4];
  for (QTcpSocket& socket : waiting) socket.connectToHost(QHostAddress::LocalHost, full.serverPort());
  QTest::qWait(100);
  const ListedArchives list(full.serverPort());
  const Studies empty;
  ArchivesWindow w(empty);
  w.edit();
  w.press("testArchive");
  QTest::qWait(300);
  QCOMPARE(w.told(), QStringLiteral("Testing..."));
  QElapsedTimer since;
  since.start();
  w.press("cancelArchives");
  QTRY_VERIFY_WITH_TIMEOUT(!w.child<QDialog>("archivesDialog"), longest);
  QVERIFY2(since.elapsed() < 3000, qPrintable(QStringLiteral("%1 ms").arg(since.elapsed())));
}

// An archive that comes back lists its studies under the same numbers.
void TestEditedArchives::aRemovedArchiveKeepsItsStudies() {
  QrPeer peer;
  peer.add(dicomFilesBelow(studies_.data));
  QVERIFY(peer.start());
  const ListedArchives list(peer.port());
  const Studies home;
  ArchivesWindow w(home);
  QVERIFY(w.open("main", "Knee", "Sagittal"));
  const QStringList places = w.openPlaces();
  w.edit();
  w.press("removeArchive");
  QVERIFY(w.save());
  QVERIFY(w.box()->isHidden());
  w.child<QAction>("showBrowser")->trigger();
  QVERIFY2(w.has("Yamada"), "it was fetched into the index, which is listed now");
  QVERIFY(w.isShown("Sagittal"));
  QCOMPARE(w.openPlaces(), places);
  const ListedArchives again(peer.port());
  QVERIFY(w.window.document().sources.offerArchives());
  QVERIFY(w.open("main", "Abdomen", "Venous"));
  QVERIFY(w.open("main", "Knee", "Sagittal"));
  QCOMPARE(w.openPlaces().size(), qsizetype(2));
  QVERIFY(w.openPlaces().contains(places[0]));
}

// Another archive takes the name of the first one. Their studies have different numbers.
void TestEditedArchives::aRenamedArchiveIsAnotherSource() {
  QrPeer first, second;
  first.add(dicomFilesBelow(studies_.data + QStringLiteral("/mueller")));
  second.add(dicomFilesBelow(studies_.data + QStringLiteral("/yamada")));
  QVERIFY(first.start() && second.start());
  const ListedArchives list(first.port());
  const Studies home;
  ArchivesWindow w(home);
  QVERIFY(w.open("main", "Abdomen", "Venous"));
  w.edit();
  w.type("archive_name", QStringLiteral("old"));
  w.press("addArchive");
  w.type("archive_name", QStringLiteral("main"));
  w.type("archive_host", QStringLiteral("127.0.0.1"));
  w.type("archive_calledAe", QStringLiteral("ARCH"));
  w.child<QSpinBox>("archivePort")->selectAll();
  QTest::keyClicks(w.child<QSpinBox>("archivePort"), QString::number(second.port()));
  QVERIFY(w.save());
  QCOMPARE(w.box()->count(), 4);
  QVERIFY(w.open("main", "Knee", "Sagittal"));
  QVERIFY(w.open("old", "Abdomen", "Venous"));
  QCOMPARE(w.openPlaces(), QStringList({QStringLiteral("archive:main:1"), QStringLiteral("archive:main:2"),
                                        QStringLiteral("archive:old:1")}));
}

// The list follows by itself. Its source stays, and so do the others.
void TestEditedArchives::aChangedArchiveIsAskedAgain() {
  QrPeer first, second;
  first.add(dicomFilesBelow(studies_.data + QStringLiteral("/mueller")));
  second.add(dicomFilesBelow(studies_.data + QStringLiteral("/yamada")));
  QVERIFY(first.start() && second.start());
  Archive other = ListedArchives::archiveAt(first.port());
  other.name = "other";
  const ListedArchives list(Archives{{ListedArchives::archiveAt(first.port()), other}});
  const Studies home;
  ArchivesWindow w(home);
  w.child<QAction>("showBrowser")->trigger();
  QVERIFY(w.choose("main"));
  w.searchFor("*e*");
  QVERIFY(w.has("Abdomen", 4));
  const std::vector<StudySource*> before = w.window.document().sources.offered();
  w.edit();
  w.child<QSpinBox>("archivePort")->selectAll();
  QTest::keyClicks(w.child<QSpinBox>("archivePort"), QString::number(second.port()));
  QVERIFY(w.save());
  QVERIFY(w.has("Knee", 4));
  QCOMPARE(w.box()->currentText(), QStringLiteral("main"));
  QVERIFY(w.window.document().sources.offered() == before);
}

VOLUMEN_TEST(TestEditedArchives);
#include "tst_edited_archives.moc"
