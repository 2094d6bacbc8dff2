// Guards sending of segments to an archive (dcmqrscp), by real events: those of the window as they are, and
// a file of the list.
#include <QMenu>

#include "io/archive/fetch_archive.h"
#include "io/archive/search_archive.h"
#include "io/export/read_segments.h"
#include "tests/ui/archives_window.h"
#include "tests/ui/segment_window.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr const char* sentStudy = "1.2.3.1";

// Returns the files of the segmentations that an archive has of the study.
QStringList segmentationsIn(const Archive& archive, const QString& folder) {
  const auto series = seriesOfArchiveStudy(archive, sentStudy, {});
  if (!series) return {};
  for (const IndexedSeries& one : *series)
    if (one.modality == "SEG" &&
        !fetchFromArchive(archive, {sentStudy, one.seriesUid, folder.toStdString()}, {}, {}))
      return {};
  return dicomFilesBelow(folder);
}

}  // namespace

class TestSendingSegments : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void init() { openAlone(); }
  void segmentsAreSent();
};

void TestSendingSegments::initTestCase() {
  if (!QrPeer::isInstalled()) QSKIP("dcmqrscp is not installed (package dcmtk)");
}

// The file that arrives has the voxels and the name of the segment. Opened beside its series, it is sent on.
void TestSendingSegments::segmentsAreSent() {
  const QTemporaryDir folder;
  const QString ct = folder.filePath(QStringLiteral("ct"));
  DicomSeriesTags tags;
  tags.patientName = "Doe^Jane", tags.patientId = "A111", tags.studyUid = sentStudy;
  const Result<VolumePtr> head = makePhantom("ct-head:40");
  QVERIFY(head && writeDicomSeries(**head, tags, ct.toStdString()));
  QrPeer peer, other;
  QVERIFY(peer.start() && other.start());
  Archive second = ListedArchives::archiveAt(other.port());
  second.name = "other";
  const ListedArchives list(Archives{{ListedArchives::archiveAt(peer.port()), second}});
  SegmentWindow w(QStringList{ct});
  QVERIFY(w.settle());
  w.child<QDockWidget>("segmentDock")->raise();
  QVERIFY(w.make(-100, 100) && w.count() == 1 && w.voxels(1) > 0);
  const auto send = [&](const char* choice, const char* archive) {
    for (const char* field : {"exportChoice", "exportTarget"}) {
      auto* box = w.child<QComboBox>(field);
      const int n = box->findText(QLatin1String(field == QByteArray("exportChoice") ? choice : archive));
      while (box->currentIndex() < n) QTest::keyClick(box, Qt::Key_Down);
      QCOMPARE(box->currentIndex(), n);
    }
    w.click("exportButton");
    const QString sentence = QStringLiteral("Sent 1 of 1 images to %1.").arg(QLatin1String(archive));
    QTRY_VERIFY_WITH_TIMEOUT(w.child<QLabel>("toldText")->text().startsWith(sentence), longest);
    QTRY_VERIFY(!w.child<QDialog>("exportDialog"));
  };
  w.child<QAction>("sendToArchive")->trigger();
  send("Its segments as they are now", "main");
  const QStringList files =
      segmentationsIn(ListedArchives::archiveAt(peer.port()), folder.filePath(QStringLiteral("back")));
  QCOMPARE(files.size(), qsizetype(1));
  const LoadedSeriesPtr shown = w.session().series();
  const auto read = readSegments(files[0].toStdString(), shown->series, shown->volume->geometry());
  QVERIFY2(read, read ? "" : read.message().c_str());
  QCOMPARE(read->maps.size(), std::size_t(1));
  QCOMPARE(read->maps[0].segments.size(), std::size_t(1));
  QCOMPARE(read->maps[0].segments[0].label, w.segment(0).label);
  QCOMPARE(maskOf(read->maps[0].labels, 1).count(), w.voxels(1));

  w.window.open({files[0]});
  auto* tree = w.child<QTreeWidget>("studyTree");
  QTreeWidgetItem* item = nullptr;
  const auto isListed = [&] {
    item = tree->findItems(QStringLiteral("Segmentation"), Qt::MatchContains | Qt::MatchRecursive).value(0);
    return item != nullptr;
  };
  QVERIFY(QTest::qWaitFor(isListed, longest));
  tree->scrollToItem(item);
  const QPoint at = tree->visualItemRect(item).center();
  QContextMenuEvent event(QContextMenuEvent::Mouse, at, tree->viewport()->mapToGlobal(at));
  QCoreApplication::sendEvent(tree->viewport(), &event);
  auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
  QVERIFY(menu);
  for (QAction* action : menu->actions())
    if (action->text() == QStringLiteral("Send to archive..."))
      QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(action).center());
  QVERIFY(w.child<QComboBox>("exportChoice"));
  send("This object", "other");
  QCOMPARE(segmentationsIn(second, folder.filePath(QStringLiteral("there"))).size(), qsizetype(1));
  w.window.end();
}

VOLUMEN_TEST(TestSendingSegments);
#include "tst_sending_segments.moc"
