// Guards window.md "Segment": segment files dropped on views and the panel, and segmentations of the list of
// studies, become segments of the series.
#include <QContextMenuEvent>
#include <QMenu>
#include <QTemporaryDir>

#include "io/export/dicom_series.h"
#include "io/export/export_segments.h"
#include "tests/ui/import_window.h"
#include "tests/unit/suite.h"
#include "viewer/phantoms/phantoms.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentDrops : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void filesAreDroppedOnViewsAndPanel_data();
  void filesAreDroppedOnViewsAndPanel();
  void otherFilesOpenWhereTheyAreDropped();
  void anObjectIsEditedAsSegments_data();
  void anObjectIsEditedAsSegments();
};

namespace {

// Chooses an entry of a row's context menu.
void chooseInStudies(Journey& w, const char* rowText, const char* entry) {
  auto* tree = w.child<QTreeWidget>("studyTree");
  const auto row = [&] {
    return tree->findItems(QLatin1String(rowText), Qt::MatchContains | Qt::MatchRecursive).value(0);
  };
  QTRY_VERIFY_WITH_TIMEOUT(row() && w.window.jobs().rows().empty(), longest);
  tree->scrollToItem(row());
  const QPoint at = tree->visualItemRect(row()).center();
  QContextMenuEvent event(QContextMenuEvent::Mouse, at, tree->viewport()->mapToGlobal(at));
  QCoreApplication::sendEvent(tree->viewport(), &event);
  auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
  QVERIFY(menu);
  for (QAction* action : menu->actions())
    if (action->text() == QLatin1String(entry))
      return QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(action).center());
  QFAIL(entry);
}

}  // namespace

void TestSegmentDrops::filesAreDroppedOnViewsAndPanel_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<bool>("onPanel");
  for (const char* name : {"a.seg.nrrd", "a.nii.gz"})
    for (const bool onPanel : {false, true})
      QTest::addRow("%s, %s", name, onPanel ? "panel" : "view") << QString::fromLatin1(name) << onPanel;
  QTest::newRow("labels without a table, panel") << QStringLiteral("b.mha") << true;
}

void TestSegmentDrops::filesAreDroppedOnViewsAndPanel() {
  QFETCH(QString, name);
  QFETCH(bool, onPanel);
  ImportWindow w;
  QVERIFY(w.makeBoth());
  const QString path = w.at(qPrintable(name));
  QVERIFY(w.exportTo(path));
  if (name.startsWith(QLatin1Char('b'))) QVERIFY(QFile::remove(w.at("b.label")));
  const std::int64_t core = w.voxels(2);
  QVERIFY(w.removeAll());
  QMimeData files;
  files.setUrls({QUrl::fromLocalFile(path)});
  const Workspace before = w.workspace();
  const int steps = w.steps();
  QVERIFY(drop(files, onPanel ? static_cast<QWidget*>(w.list()) : w.view()));
  QVERIFY(w.idle());
  QCOMPARE(w.count(), std::size_t(2));
  QCOMPARE(w.voxels(2), core);
  QCOMPARE(w.steps(), steps + 1);
  w.undo();
  QVERIFY(w.workspace() == before);
}

// An image without a table of names may be a picture. Dropped on a view, it opens as one.
void TestSegmentDrops::otherFilesOpenWhereTheyAreDropped() {
  ImportWindow w;
  QVERIFY(w.makeBoth() && w.exportTo(w.at("a.nii.gz")));
  QVERIFY(QFile::remove(w.at("a.label")));
  const SeriesKey before = w.series();
  QMimeData files;
  files.setUrls({QUrl::fromLocalFile(w.at("a.nii.gz"))});
  QVERIFY(drop(files, w.view()));
  QTRY_VERIFY_WITH_TIMEOUT(w.session().series() && w.series() != before, longest);
  QCOMPARE(w.count(), std::size_t(0));
}

void TestSegmentDrops::anObjectIsEditedAsSegments_data() {
  QTest::addColumn<bool>("dropped");
  QTest::newRow("by the menu of the list of studies") << false;
  QTest::newRow("dropped on a view") << true;
}

// A series of files has a DICOM segmentation.
void TestSegmentDrops::anObjectIsEditedAsSegments() {
  QFETCH(bool, dropped);
  const QTemporaryDir folder;
  const QString slices = folder.filePath(QStringLiteral("ct"));
  QVERIFY(writeDicomSeries(**makePhantom("ct-head:40"), {}, slices.toStdString()));
  Journey w({slices});
  QTRY_VERIFY_WITH_TIMEOUT(w.window.session().series(), longest);
  const LoadedSeriesPtr series = w.window.session().series();
  Segmented made{{{.number = 1, .label = "Block", .colour = glm::u8vec3(9, 8, 7)}},
                 LabelMap(series->volume->geometry())};
  LabelEdit edit(made.labels);
  for (int n = 0; n < 1000; ++n) edit.set({10 + n % 10, 10 + n / 10 % 10, 10 + n / 100}, 1);
  made.labels = edit.done();
  const QString path = folder.filePath(QStringLiteral("seg.dcm"));
  QVERIFY(exportSegments(path.toStdString(), {&made, 1}, series->series));
  QMimeData files;
  files.setUrls({QUrl::fromLocalFile(path)});
  if (dropped) {
    QVERIFY(drop(files, w.window.view()));
  } else {
    w.window.open({path});
    chooseInStudies(w, "Segmentation", "Edit as segments");
  }
  const auto map = [&] { return segmentMapOf(w.window.session().workspace(), keyOf(series->series)); };
  QTRY_VERIFY_WITH_TIMEOUT(map(), longest);
  QVERIFY(*map()->labels == made.labels);
  QCOMPARE(map()->segments.front().label, std::string("Block"));
  QVERIFY(map()->segments.front().colour == made.segments.front().colour);
}

VOLUMEN_TEST(TestSegmentDrops);
#include "tst_segment_drops.moc"
