// Guards File > Export... by real events where it fails or is cancelled: it says so and leaves nothing.
#include <QScopeGuard>

#include "tests/fixtures/mount_disk.h"
#include "tests/fixtures/program.h"
#include "tests/ui/export_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestFailedFileExports : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void init() { openAlone(); }
  void whatFailsLeavesNothing();
  void aDiskThatTakesNothingIsSaid_data();
  void aDiskThatTakesNothingIsSaid();
  void cancelledTurnLeavesNothing();
  void nothingToExportIsSaid();

 private:
  QTemporaryDir data_;
  QString ct_;
};

void TestFailedFileExports::initTestCase() {
  ct_ = data_.filePath(QStringLiteral("ct"));
  QVERIFY(writeNamedHead(ct_));
}

void TestFailedFileExports::whatFailsLeavesNothing() {
  ExportWindow w(ct_);
  QVERIFY(w.prepare());
  const QTemporaryDir folder;
  const QString there = folder.filePath(QStringLiteral("there"));
  QVERIFY(QDir().mkdir(there));
  QVERIFY(w.ask("Its segments as they are now"));
  w.click("exportButton");
  QVERIFY(QDir(there).removeRecursively());
  QFile inTheWay(there);
  QVERIFY(inTheWay.open(QIODevice::WriteOnly));
  inTheWay.close();
  QVERIFY(w.idle());
  auto* dialog = w.window.findChild<QFileDialog*>(QStringLiteral("exportFolderDialog"));
  QVERIFY(dialog);
  Q_EMIT dialog->fileSelected(there);
  const auto* banner = w.child<QWidget>("banner");
  QVERIFY(banner);
  QTRY_VERIFY_WITH_TIMEOUT(banner->isVisible(), longest);
  QCOMPARE(filesAt(folder.path()), QStringList{there});
  QCOMPARE(contentsOf(there), QByteArray());
  w.window.end();
}

void TestFailedFileExports::aDiskThatTakesNothingIsSaid_data() {
  QTest::addColumn<unsigned long>("flags");
  QTest::addColumn<QByteArray>("options");
  QTest::newRow("read-only") << (unsigned long)(MS_RDONLY) << QByteArray();
  QTest::newRow("no file can be made") << 0ul << QByteArray("nr_inodes=1");
  QTest::newRow("full") << 0ul << QByteArray("size=4k");
}

// Every choice of a view of slices and of the 3D view.
void TestFailedFileExports::aDiskThatTakesNothingIsSaid() {
  QFETCH(unsigned long, flags);
  QFETCH(QByteArray, options);
  ExportWindow w(ct_);
  QVERIFY(w.prepare());
  w.child<QAction>("layoutPlanes")->trigger();
  const QTemporaryDir disk;
  const QByteArray folder = disk.path().toUtf8();
  MOUNT_DISK(folder.constData(), flags, options.constData());
  const auto unmount = qScopeGuard([&] { umount(folder.constData()); });
  if (QFile all(disk.filePath(QStringLiteral("all"))); all.open(QIODevice::WriteOnly))
    all.write(QByteArray(4096, 'x'));
  const auto files = [&] {
    return QDir(disk.path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot);
  };
  const QStringList before = files();
  for (const ViewId view : {axialViewId, sceneViewId}) {
    w.session().setFocus(view);
    QVERIFY(w.idle());
    const QStringList choices = w.choices();
    QVERIFY(choices.size() > 6);
    for (const QString& choice : choices) {
      auto* banner = w.child<QWidget>("banner");
      banner->hide();
      QVERIFY2(w.ask(qPrintable(choice)), qPrintable(choice));
      w.answerWith(disk.path());
      QTRY_VERIFY2_WITH_TIMEOUT(banner->isVisible(), qPrintable(choice), longest);
      QVERIFY(w.idle());
      QVERIFY2(files() == before, qPrintable(choice));
    }
  }
  w.window.end();
}

void TestFailedFileExports::cancelledTurnLeavesNothing() {
  ExportWindow w(ct_);
  QVERIFY(w.prepare());
  w.child<QAction>("layoutPlanes")->trigger();
  w.session().setFocus(sceneViewId);
  const QTemporaryDir folder;
  QVERIFY(w.ask("A full turn in 36 pictures"));
  QVERIFY(!w.child<QCheckBox>("exportHideNames")->isEnabled());
  w.answerWith(folder.path());
  QTRY_VERIFY_WITH_TIMEOUT(!w.window.jobs().rows().empty(), longest);
  w.window.jobs().cancel(w.window.jobs().rows()[0].id);
  QVERIFY(w.idle());
  QVERIFY(filesAt(folder.path()).isEmpty());
  QVERIFY(w.leave("A full turn in 36 pictures", folder.path()));
  QCOMPARE(textIn(folder.filePath(QStringLiteral("turn.dcm")), DCM_NumberOfFrames), std::string("36"));
  w.window.end();
}

void TestFailedFileExports::nothingToExportIsSaid() {
  SegmentWindow w;
  w.child<QAction>("exportFiles")->trigger();
  QVERIFY(!w.child<QDialog>("exportDialog"));
  QVERIFY(w.child<QWidget>("banner")->isVisible());
}

VOLUMEN_TEST(TestFailedFileExports);
#include "tst_failed_file_exports.moc"
