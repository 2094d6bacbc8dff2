// Guards design.md 8: the list of series, its thumbnails and its context menu. Real events.
#include <QApplication>
#include <QContextMenuEvent>
#include <QDesktopServices>
#include <QLineEdit>
#include <QMenu>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QTreeWidget>

#include "io/export/dicom_series.h"
#include "io/thumbnail.h"
#include "results/text/text.h"
#include "tests/ui/journey.h"
#include "tests/unit/suite.h"
#include "ui/controller/thumbnails.h"
#include "ui/panels/attributes_dialog.h"
#include "viewer/phantoms/phantoms.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// A folder with a DICOM series of 14 slices, and a window that shows it.
struct Listed {
  QTemporaryDir dir;
  QString folder = dir.filePath(QStringLiteral("head"));
  Journey w;
  QTreeWidget* tree = w.child<QTreeWidget>("studyTree");

  bool open() {
    const VolumePtr head = *makePhantom("ct-head:40");
    DicomSeriesTags tags;
    tags.patientName = "Doe^Jane";
    if (!writeDicomSeries(*head, tags, folder.toStdString())) return false;
    w.window.open({folder, QStringLiteral("phantom:sphere:32")});
    return w.settle() && QTest::qWaitFor([&] { return item("Phantoms") != nullptr; }, longest);
  }
  QTreeWidgetItem* item(const char* text) const {
    return tree->findItems(QLatin1String(text), Qt::MatchContains | Qt::MatchRecursive).value(0);
  }
  QTreeWidgetItem* series() const { return item("slices, axial"); }

  // Opens the context menu with the right mouse button and chooses by the keyboard.
  void choose(QTreeWidgetItem* of, const char* entry) {
    const QPoint at = tree->visualItemRect(of).center();
    QTest::mouseClick(tree->viewport(), Qt::RightButton, {}, at);
    QContextMenuEvent event(QContextMenuEvent::Mouse, at, tree->viewport()->mapToGlobal(at));
    QCoreApplication::sendEvent(tree->viewport(), &event);
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    QVERIFY(menu && menu->objectName() == QStringLiteral("studyMenu"));
    for (QAction* action : menu->actions()) {
      if (action->text() != QLatin1String(entry)) continue;
      QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(action).center());
      return;
    }
    QFAIL(entry);
  }
};

bool isGrey(const QTreeWidgetItem* item) {
  const QImage icon = item->icon(0).pixmap(44, 44).toImage();
  int bright = 0;
  for (int y = 0; y < icon.height(); ++y)
    for (int x = 0; x < icon.width(); ++x) bright += qAlpha(icon.pixel(x, y)) && qGray(icon.pixel(x, y)) > 60;
  return bright > 50;
}

}  // namespace

class TestStudiesList : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aSeriesSaysItsSlicesAndPlaneAndHasAThumbnail();
  void theThumbnailIsTheRightWayUp_data();
  void theThumbnailIsTheRightWayUp();
  void whatIsRemovedIsGone();
  void everythingIsClosed();
  void theFolderIsShown();
  void attributesAreReadAndSearched();
  void attributesHideNames();
};

void TestStudiesList::aSeriesSaysItsSlicesAndPlaneAndHasAThumbnail() {
  Listed l;
  QVERIFY(l.open());
  QTreeWidgetItem* series = l.series();
  QVERIFY(series);
  const int slices = l.w.window.session().series()->volume->size().z;
  QCOMPARE(series->text(0).section(QLatin1Char('\n'), 1), QStringLiteral("%1 slices, axial").arg(slices));
  QVERIFY(series->toolTip(0).contains(l.folder));
  QTRY_VERIFY_WITH_TIMEOUT(isGrey(series), longest);
  // The sphere was not shown yet.
  QTRY_VERIFY_WITH_TIMEOUT(isGrey(l.item("sphere:32")), longest);
  l.w.shot("series-list");
}

void TestStudiesList::theThumbnailIsTheRightWayUp_data() {
  QTest::addColumn<bool>("turned");
  QTest::newRow("rows from the right, columns from the front") << false;
  QTest::newRow("rows from the left, columns from behind") << true;
}

// The anterior left quarter is bright.
void TestStudiesList::theThumbnailIsTheRightWayUp() {
  QFETCH(bool, turned);
  VolumeParts parts;
  parts.geometry.size = {20, 20, 3};
  if (turned) parts.geometry.patientFromVoxelStep = glm::dmat3{{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  std::vector<std::int16_t> values;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 20; ++i) {
        const glm::dvec3 step = parts.geometry.patientFromVoxelStep * glm::dvec3(i - 9.5, j - 9.5, 0);
        values.push_back(step.x > 0 && step.y < 0 ? 100 : 0);
      }
  parts.values = values;
  std::vector<std::string> warnings;
  const QImage image = thumbnailOf(**Volume::make(parts, warnings), {}, 40);
  QCOMPARE(image.size(), QSize(40, 40));
  QVERIFY(qGray(image.pixel(30, 10)) > 200);
  for (const QPoint dark : {QPoint(10, 10), QPoint(10, 30), QPoint(30, 30)})
    QVERIFY(qGray(image.pixel(dark)) < 50);
}

void TestStudiesList::whatIsRemovedIsGone() {
  Listed l;
  QVERIFY(l.open());
  l.choose(l.item("sphere:32"), "Remove from list");
  QTRY_VERIFY(!l.item("Phantoms"));
  QVERIFY2(l.w.window.session().series(), "what is on screen stays");
  l.choose(l.series(), "Remove from list");
  QTRY_COMPARE(l.tree->topLevelItemCount(), 0);
  QVERIFY(!l.w.window.session().series());
  QVERIFY(l.w.child<QWidget>("startPage")->isVisible());
  QCOMPARE(l.w.window.windowTitle(), QStringLiteral("volumen"));
  // The study can be opened again.
  l.w.settled.clear();
  l.w.window.open({l.folder});
  QVERIFY(l.w.settle());
}

void TestStudiesList::everythingIsClosed() {
  Listed l;
  QVERIFY(l.open());
  l.choose(l.item("sphere:32"), "Close all");
  QTRY_COMPARE(l.tree->topLevelItemCount(), 0);
  QVERIFY(!l.w.window.session().series());
  QVERIFY(l.w.window.session().undoStack().canUndo());
}

// Stands in for the file manager.
class FileManager : public QObject {
  Q_OBJECT
 public:
  QList<QUrl> shown;
 public Q_SLOTS:
  void show(const QUrl& url) { shown << url; }
};

void TestStudiesList::theFolderIsShown() {
  Listed l;
  QVERIFY(l.open());
  FileManager manager;
  QDesktopServices::setUrlHandler(QStringLiteral("file"), &manager, "show");
  l.choose(l.series(), "Show in file manager");
  QTRY_COMPARE(manager.shown, QList<QUrl>{QUrl::fromLocalFile(l.folder)});
  QDesktopServices::unsetUrlHandler(QStringLiteral("file"));
}

void TestStudiesList::attributesAreReadAndSearched() {
  Listed l;
  QVERIFY(l.open());
  l.choose(l.series(), "DICOM attributes...");
  QTRY_VERIFY(l.w.child<QDialog>("attributesDialog"));
  auto* dialog = l.w.child<QDialog>("attributesDialog");
  auto* tree = dialog->findChild<QTreeWidget*>(QStringLiteral("attributesTree"));
  const auto value = [&](const char* name) {
    const auto found = tree->findItems(QLatin1String(name), Qt::MatchExactly, 1);
    return found.isEmpty() ? QString() : found[0]->text(3);
  };
  QTRY_COMPARE_WITH_TIMEOUT(value("Modality"), QStringLiteral("CT"), longest);
  const QString first = value("SOPInstanceUID");
  auto* slice = dialog->findChild<QSpinBox*>(QStringLiteral("attributesSlice"));
  QCOMPARE(slice->maximum(), l.w.window.session().series()->volume->size().z);
  slice->setFocus();
  QTest::keyClick(slice, Qt::Key_Up);
  QTRY_VERIFY_WITH_TIMEOUT(!value("SOPInstanceUID").isEmpty() && value("SOPInstanceUID") != first, longest);

  auto* search = dialog->findChild<QLineEdit*>(QStringLiteral("attributesSearch"));
  QTest::keyClicks(search, QStringLiteral("pixelspac"));
  int left = 0;
  for (int n = 0; n < tree->topLevelItemCount(); ++n) left += !tree->topLevelItem(n)->isHidden();
  QCOMPARE(left, 1);
  const QString folder = qEnvironmentVariable("VOLUMEN_SHOTS");
  search->clear();
  if (!folder.isEmpty()) dialog->grab().save(folder + QStringLiteral("/attributes.png"));
  QTest::keyClick(dialog, Qt::Key_Escape);
  QTRY_VERIFY(!l.w.child<QDialog>("attributesDialog"));
}

void TestStudiesList::attributesHideNames() {
  Listed l;
  QVERIFY(l.open());
  hideNames(true);
  l.choose(l.series(), "DICOM attributes...");
  QTRY_VERIFY(l.w.child<QDialog>("attributesDialog"));
  auto* tree = l.w.child<QTreeWidget>("attributesTree");
  const auto value = [&](const char* name) {
    const auto found = tree->findItems(QLatin1String(name), Qt::MatchExactly, 1);
    return found.isEmpty() ? QString() : found[0]->text(3);
  };
  QTRY_COMPARE_WITH_TIMEOUT(value("Modality"), QStringLiteral("CT"), longest);
  for (const char* name : {"PatientName", "PatientID", "StudyDate", "SOPInstanceUID"})
    QCOMPARE(value(name), QStringLiteral("(hidden)"));
  QVERIFY(!value("PixelSpacing").contains(QStringLiteral("hidden")));
  hideNames(false);
}

VOLUMEN_TEST(TestStudiesList);
#include "tst_studies_list.moc"
