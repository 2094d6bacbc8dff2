// Guards issue 51 "Names and paths are no rich text". Names of patients, series, regions and folders are
// shown literally, and no name makes the program open a file.
#include <dcmtk/dcmdata/dcpath.h>
#include <dcmtk/dcmdata/dctk.h>
#include <fcntl.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <QAbstractItemView>
#include <QDockWidget>
#include <QHelpEvent>
#include <QLabel>
#include <QTemporaryDir>
#include <QTextDocumentFragment>
#include <QToolTip>
#include <QTreeWidget>

#include "tests/ui/derived_2d.h"
#include "tests/unit/suite.h"
#include "ui/workspace/measurements.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Counts how often any program opens a file.
class Watch {
 public:
  explicit Watch(const QString& path) : inotify_(inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
    inotify_add_watch(inotify_, path.toLocal8Bit().constData(), IN_OPEN);
  }
  ~Watch() { close(inotify_); }
  int opened() {
    alignas(inotify_event) char events[4096];
    for (ssize_t got; (got = read(inotify_, events, sizeof events)) > 0;)
      count_ += int(got / ssize_t(sizeof(inotify_event)));
    return count_;
  }

 private:
  int inotify_;
  int count_ = 0;
};

// A picture that the program has no reason to open, and a name that refers to it.
struct Trap {
  QTemporaryDir folder{QDir::tempPath() + QStringLiteral("/t-XXXXXX")};
  QString path = folder.filePath(QStringLiteral("x.png"));
  QString name = QStringLiteral("<img src='%1'>").arg(path);
  std::optional<Watch> watch;

  Trap() {
    QImage picture(8, 8, QImage::Format_RGB32);
    picture.fill(Qt::red);
    picture.save(path);
    watch.emplace(path);
  }
};

// Writes a copy of a file with these texts at these places (DCMTK's paths).
bool writeNamed(const char* from, const QString& to, const QList<std::pair<const char*, QString>>& texts) {
  DcmFileFormat file;
  if (file.loadFile(dataPath(from).c_str()).bad()) return false;
  for (const auto& [where, text] : texts) {
    DcmPathProcessor path;
    if (path.findOrCreatePath(file.getDataset(), where, true).bad()) return false;
    OFList<DcmPath*> found;
    if (path.getResults(found) != 1) return false;
    auto* element = static_cast<DcmElement*>(found.front()->back()->m_obj);
    if (element->putString(text.toUtf8().constData()).bad()) return false;
  }
  return file.saveFile(to.toLocal8Bit().constData()).good();
}

struct Hovered {
  int tips = 0, literal = 0;  // tool tips, and those that show the name literally
};

void pointAt(QWidget* widget, QPoint at, const QString& name, Hovered& hovered) {
  QToolTip::hideText();
  QHelpEvent help(QEvent::ToolTip, at, widget->mapToGlobal(at));
  QCoreApplication::sendEvent(widget, &help);
  if (QToolTip::text().isEmpty()) return;
  ++hovered.tips;
  hovered.literal += Qt::mightBeRichText(QToolTip::text())
                         ? QTextDocumentFragment::fromHtml(QToolTip::text()).toPlainText().contains(name)
                         : QToolTip::text().contains(name);
}

void pointAtItems(QAbstractItemView* view, const QModelIndex& parent, const QString& name, Hovered& hovered) {
  for (int row = 0; row < view->model()->rowCount(parent); ++row)
    for (int column = 0; column < view->model()->columnCount(parent); ++column) {
      const QModelIndex index = view->model()->index(row, column, parent);
      view->scrollTo(index);
      pointAt(view->viewport(), view->visualRect(index).center(), name, hovered);
      if (column == 0) pointAtItems(view, index, name, hovered);
    }
}

// Points at every widget and every item.
Hovered pointAtAll(QWidget* window, const QString& name) {
  Hovered hovered;
  for (QWidget* widget : window->findChildren<QWidget*>()) {
    if (!widget->isVisible()) continue;
    pointAt(widget, widget->rect().center(), name, hovered);
    if (auto* view = qobject_cast<QAbstractItemView*>(widget)) pointAtItems(view, {}, name, hovered);
  }
  QToolTip::hideText();
  return hovered;
}

}  // namespace

class TestPlainTexts : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theTrapSnaps();
  void noNameOpensAFile();
  void aRealHoverShowsTheNameAsItIs();
};

// Verifies the trap itself. Otherwise the rows below could not fail.
void TestPlainTexts::theTrapSnaps() {
  Trap trap;
  QCOMPARE(trap.watch->opened(), 0);
  QWidget window;
  window.setToolTip(trap.name);
  window.show();
  Hovered hovered;
  pointAt(&window, {5, 5}, trap.name, hovered);
  QToolTip::hideText();
  QVERIFY2(trap.watch->opened() > 0, "Qt shows it as a picture");
}

void TestPlainTexts::noNameOpensAFile() {
  NEED_DATA(dataPath("pet-ct"));
  Trap trap;
  const QString folder = trap.folder.filePath(QStringLiteral("<img src='x.png'>"));
  QVERIFY(QDir().mkpath(folder));
  const QString regions = folder + QStringLiteral("/rt.dcm"), slice = folder + QStringLiteral("/ct.dcm");
  QVERIFY(writeNamed("pet-ct/sts019-rtstruct-ct.dcm", regions,
                     {{"StructureSetROISequence[0].ROIName", trap.name},
                      {"StructureSetLabel", QStringLiteral("<i>label</i>")},
                      {"PatientName", trap.name}}));
  QVERIFY(writeNamed(ct, slice,
                     {{"PatientName", trap.name},
                      {"PatientID", trap.name},
                      {"StudyDescription", trap.name},
                      {"SeriesDescription", trap.name}}));
  const QString before = QDir::currentPath();
  QDir::setCurrent(trap.folder.path());  // where a picture without a folder is searched
  {
    Journey w({folder, folder + QStringLiteral("/none.dcm")});
    w.window.resize(1440, 900);
    auto* tree = w.child<QTreeWidget>("studyTree");
    const auto item = [&](const char* text, QTreeWidget* in) {
      return in->findItems(QLatin1String(text), Qt::MatchContains | Qt::MatchRecursive).value(0);
    };
    QTRY_VERIFY_WITH_TIMEOUT(item("Contours", tree), longest);
    QTRY_VERIFY_WITH_TIMEOUT(!w.window.session().workspace().series.empty(), longest);
    Session& session = w.window.session();
    tree->scrollToItem(item("Contours", tree));
    QTest::mouseClick(tree->viewport(), Qt::LeftButton, {},
                      tree->visualItemRect(item("Contours", tree)).center());
    auto* list = w.child<QTreeWidget>("regionList");
    QTRY_VERIFY_WITH_TIMEOUT(item("<img", list), longest);
    for (const char* name : {"regions", "keyImages", "measurements", "segment", "accuracy", "studies"})
      w.child<QDockWidget>((QByteArray(name) + "Dock").constData())->show();
    Shape length;
    length.kind = ShapeKind::length;
    length.points = {{0, 0, 0}, {10, 0, 0}};
    length.name = trap.name.toStdString();
    const SeriesKey shown = session.workspace().view(axialViewId).series;
    addMeasurement(session, shown, length);
    w.child<QAction>("keyImage")->trigger();
    session.endGesture();
    session.change(trap.name, [](Workspace& workspace) { workspace.measurementsShown = false; });
    QCoreApplication::processEvents();
    for (const char* name : {"regions", "keyImages", "measurements", "segment", "accuracy", "studies"}) {
      w.child<QDockWidget>((QByteArray(name) + "Dock").constData())->raise();
      QCoreApplication::processEvents();
      const Hovered hovered = pointAtAll(&w.window, trap.name);
      QVERIFY2(hovered.tips > 10 && hovered.literal > 0, name);
      QVERIFY2(trap.watch->opened() == 0, name);
    }
    w.shot("plain-texts");
    for (QLabel* label : w.window.findChildren<QLabel*>())
      QVERIFY2(label->inherits("QTipLabel") || label->textFormat() == Qt::PlainText,
               qPrintable(label->text()));
  }
  QDir::setCurrent(before);
}

void TestPlainTexts::aRealHoverShowsTheNameAsItIs() {
  NEED_DATA(dataPath("dicom-pydicom"));
  Trap trap;
  const QString slice = trap.folder.filePath(QStringLiteral("ct.dcm"));
  QVERIFY(writeNamed(ct, slice, {{"PatientName", trap.name}, {"SeriesDescription", trap.name}}));
  Journey w({slice});
  auto* tree = w.child<QTreeWidget>("studyTree");
  const auto firstSeries = [&] {
    QTreeWidgetItem* item = tree->topLevelItem(0);
    while (item && item->childCount() > 0) item = item->child(0);
    return item;
  };
  QTRY_VERIFY_WITH_TIMEOUT(firstSeries(), longest);
  QTreeWidgetItem* series = firstSeries();
  tree->scrollToItem(series);
  QTest::mouseMove(tree->viewport(), tree->visualItemRect(series).center());
  QTest::mouseMove(tree->viewport(), tree->visualItemRect(series).center() + QPoint(1, 0));
  QTRY_VERIFY_WITH_TIMEOUT(!QToolTip::text().isEmpty(), longest);
  QVERIFY(QTextDocumentFragment::fromHtml(QToolTip::text()).toPlainText().contains(trap.name));
  QCOMPARE(trap.watch->opened(), 0);
  QToolTip::hideText();
}

VOLUMEN_TEST(TestPlainTexts);
#include "tst_plain_texts.moc"
