// Guards that the picture of a view can be dragged out of the window by the arrow in the view, as a file and
// as an image, and that a drop inside the window does nothing. Real mouse events.
#include <QDrag>
#include <QDragEnterEvent>
#include <QDragLeaveEvent>
#include <QMimeData>
#include <QScopeGuard>
#include <QTimer>
#include <QTreeWidget>

#include "tests/ui/final_picture.h"
#include "tests/ui/two_series.h"
#include "tests/unit/suite.h"
#include "results/text/text.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// A window that shows a series in planes and in 3D.
struct DragWindow : Journey {
  explicit DragWindow(const LoadedSeriesPtr& series = ballSeries()) {
    window.session().show(series);
    child<QAction>("layoutPlanes")->trigger();
    QCoreApplication::processEvents();
  }
  Session& session() { return window.session(); }
  View* view(ViewId id) { return window.views()->viewOf(id); }
  // Waits until slices and 3D are at rest. Returns whether they are.
  bool hasPictures() {
    const auto* slice = window.views()->viewAs<FlatView>(axialViewId);
    return QTest::qWaitFor([&] { return !slice->picture().isNull() && inScene.isThere(); }, longest);
  }

  FinalPicture inScene{window};
};

// What a drag carries.
struct Carried {
  std::shared_ptr<QMimeData> data;  // null if no drag begins

  QString path() const { return data->urls().value(0).toLocalFile(); }
  QImage file() const { return QImage(path()).convertToFormat(QImage::Format_RGB32); }
  QImage image() const {
    return QImage::fromData(data->data(QStringLiteral("image/png"))).convertToFormat(QImage::Format_RGB32);
  }
};

QWidget* handleOf(View* view) { return view->findChild<QWidget*>(QStringLiteral("dragHandle")); }

void moveHeld(QWidget* on, QPointF to) {
  QMouseEvent move(QEvent::MouseMove, to, on->mapToGlobal(to), Qt::NoButton, Qt::LeftButton, {});
  QCoreApplication::sendEvent(on, &move);
}

// Drags by the arrow of a view. Some platforms end a drag at once; the others wait until it is cancelled.
Carried draggedOut(View* view, QPointF by = {30, 40}) {
  hover(view, view->rect().center());
  QWidget* handle = handleOf(view);
  if (!handle->isVisible()) return {};
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);  // the drag before
  Carried carried;
  const auto look = [&] {
    const auto* drag = view->findChild<QDrag*>();
    if (!drag || carried.data) return;
    const QMimeData* data = drag->mimeData();
    carried.data = std::make_shared<QMimeData>();
    for (const QString& format : data->formats()) carried.data->setData(format, data->data(format));
  };
  QTimer held;
  QObject::connect(&held, &QTimer::timeout, view, [&] {
    look();
    QDrag::cancel();
  });
  held.start(0);
  const QPointF middle = handle->rect().center();
  QTest::mousePress(handle, Qt::LeftButton, {}, middle.toPoint());
  moveHeld(handle, middle + by / 2);
  moveHeld(handle, middle + by);
  look();
  QTest::mouseRelease(handle, Qt::LeftButton, {}, (middle + by).toPoint());
  return carried;
}

// Returns whether a drag that enters a widget is accepted by it or by a widget around it.
bool takes(QWidget* widget, const QMimeData& data) {
  QDragEnterEvent enter({20, 20}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(widget, &enter);
  QDragLeaveEvent leave;
  QCoreApplication::sendEvent(widget, &leave);
  return enter.isAccepted();
}

}  // namespace

class TestDraggedPictures : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { openAlone(); }
  void itIsTheViewAsFileAndImage_data();
  void itIsTheViewAsFileAndImage();
  void theViewIsNotChanged();
  void theArrowIsSeenUnderThePointerAlone();
  void anEmptyViewHasNone();
  void aShortMoveIsNoDrag();
  void hiddenNamesStayHidden_data();
  void hiddenNamesStayHidden();
  void noNamesLeaveWithoutIdentity();
  void eachFileStaysUntilTheEnd();
  void aDropInsideDoesNothing();
  void aPictureThatIsBeingDrawnIsNotDragged();
  void whatCannotBeWrittenIsTold();
};

void TestDraggedPictures::itIsTheViewAsFileAndImage_data() {
  QTest::addColumn<ViewId>("id");
  QTest::newRow("slice") << axialViewId;
  QTest::newRow("3D") << sceneViewId;
}

void TestDraggedPictures::itIsTheViewAsFileAndImage() {
  QFETCH(ViewId, id);
  DragWindow w;
  QVERIFY(w.hasPictures());
  w.session().setFocus(coronalViewId);
  const Carried carried = draggedOut(w.view(id));
  QVERIFY(carried.data);
  const QImage seen = w.view(id)->capture();
  QCOMPARE(carried.data->urls().size(), 1);
  QCOMPARE(carried.file(), seen);
  QCOMPARE(carried.image(), seen);
  QVERIFY(QFileInfo(carried.path()).fileName().endsWith(QStringLiteral(".png")));
  QCOMPARE(QImage(carried.path()).text(QStringLiteral("Comment")), QStringLiteral("Not for clinical use"));
}

// No tool sees the mouse, and the focus stays.
void TestDraggedPictures::theViewIsNotChanged() {
  DragWindow w;
  QVERIFY(w.hasPictures());
  w.session().setFocus(coronalViewId);
  const Workspace before = w.session().workspace();
  const int steps = w.session().undoStack().count();
  for (const ViewId id : {axialViewId, sceneViewId}) {
    QVERIFY(draggedOut(w.view(id)).data);
    QTest::mouseDClick(handleOf(w.view(id)), Qt::LeftButton);
  }
  QVERIFY(w.session().workspace() == before);
  QCOMPARE(w.session().undoStack().count(), steps);
}

void TestDraggedPictures::theArrowIsSeenUnderThePointerAlone() {
  DragWindow w;
  QVERIFY(w.hasPictures());
  for (const ViewId id : {axialViewId, sceneViewId}) {
    View* view = w.view(id);
    QWidget* handle = handleOf(view);
    const QImage seen = view->capture();
    QVERIFY(!handle->isVisible());
    moveHeld(view, view->rect().center());
    QVERIFY2(!handle->isVisible(), "while a button is held");
    hover(view, view->rect().center());
    QVERIFY(handle->isVisible() && view->rect().contains(handle->geometry()));
    QVERIFY(!handle->accessibleName().isEmpty() && !handle->toolTip().isEmpty());
    QVERIFY2(view->capture() == seen, "it is not in the picture");
    QEvent leave(QEvent::Leave);
    QCoreApplication::sendEvent(view, &leave);
    QVERIFY(!handle->isVisible());
  }
}

void TestDraggedPictures::anEmptyViewHasNone() {
  Journey w;
  w.window.session().show(ballSeries());
  w.child<QAction>("layoutTwo")->trigger();
  QCoreApplication::processEvents();
  w.window.session().change(QStringLiteral("test"), [](Workspace& now) { now.editView(right).series = {}; });
  View* empty = w.window.views()->viewOf(right);
  QVERIFY(empty->isVisible() && empty->state().series.empty());
  QVERIFY(!draggedOut(empty).data);
  QVERIFY(!handleOf(empty)->isVisible());
}

void TestDraggedPictures::aShortMoveIsNoDrag() {
  DragWindow w;
  QVERIFY(w.hasPictures());
  QVERIFY(!draggedOut(w.view(axialViewId), {2, 1}).data);
  QVERIFY(draggedOut(w.view(axialViewId)).data);
}

void TestDraggedPictures::hiddenNamesStayHidden_data() { itIsTheViewAsFileAndImage_data(); }

// What is exported without the identity is dragged without names, too.
void TestDraggedPictures::noNamesLeaveWithoutIdentity() {
  auto series = std::make_shared<LoadedSeries>(*ballSeries());
  series->series.format = "NIfTI";
  series->series.path = "/home/doe/Doe-Jane.nii.gz";
  DragWindow w(series);
  QVERIFY(w.hasPictures());
  const auto leaveIdentity = [&](bool out) {
    w.session().prefer([out](Preferences& p) { p.exportsWithoutIdentity = out; });
  };
  leaveIdentity(true);
  const auto back = qScopeGuard([&] { leaveIdentity(false); });
  const Carried dragged = draggedOut(w.view(axialViewId));
  QVERIFY(dragged.data && !dragged.path().contains(QStringLiteral("Doe")));
  QVERIFY(dragged.file() != w.view(axialViewId)->capture());
  const HidingNames hiding(true);
  QCOMPARE(dragged.file(), w.view(axialViewId)->capture());
}

// A series that is a file is named after it.
void TestDraggedPictures::hiddenNamesStayHidden() {
  QFETCH(ViewId, id);
  auto series = std::make_shared<LoadedSeries>(*ballSeries());
  series->series.format = "NIfTI";
  series->series.path = "/home/doe/Doe-Jane.nii.gz";
  DragWindow w(series);
  QVERIFY(w.hasPictures());
  const Carried named = draggedOut(w.view(id));
  w.child<QAction>("hideNames")->trigger();
  const auto back = qScopeGuard([&] { w.child<QAction>("hideNames")->trigger(); });
  QVERIFY(w.hasPictures());
  const Carried hidden = draggedOut(w.view(id));
  QVERIFY(named.data && hidden.data);
  QVERIFY(named.path().contains(QStringLiteral("Doe")) && !hidden.path().contains(QStringLiteral("Doe")));
  QVERIFY(hidden.file() != named.file());
  QCOMPARE(hidden.file(), w.view(id)->capture());
  QCOMPARE(hidden.image(), hidden.file());
}

// Other programs read files after the drop.
void TestDraggedPictures::eachFileStaysUntilTheEnd() {
  QString folder;
  {
    DragWindow w;
    QVERIFY(w.hasPictures());
    const Carried first = draggedOut(w.view(axialViewId));
    QVERIFY(first.data);
    const QImage seen = first.file();
    w.window.views()->viewAs<FlatView>(axialViewId)->scroll(8);
    QTRY_VERIFY_WITH_TIMEOUT(w.view(axialViewId)->hasItsPicture(), longest);
    const Carried second = draggedOut(w.view(axialViewId));
    QVERIFY(second.data && first.path() != second.path());
    QCOMPARE(first.file(), seen);
    QVERIFY(second.file() != seen);
    folder = QFileInfo(first.path()).path();
    const auto others = QFile::ReadGroup | QFile::WriteGroup | QFile::ReadOther | QFile::WriteOther;
    QVERIFY(!(QFileInfo(folder).permissions() & others));
  }
  QVERIFY(!QFileInfo::exists(folder));
}

void TestDraggedPictures::aDropInsideDoesNothing() {
  DragWindow w;
  QVERIFY(w.hasPictures());
  const Carried carried = draggedOut(w.view(axialViewId));
  QVERIFY(carried.data);
  QMimeData otherFile;
  otherFile.setUrls(carried.data->urls());
  auto* segments = w.child<QTreeWidget>("segmentList");
  QVERIFY2(takes(&w.window, otherFile) && takes(segments, otherFile), "other files are taken");
  const QList<QWidget*> targets{&w.window,
                                w.view(axialViewId),
                                w.view(coronalViewId),
                                w.view(sceneViewId),
                                w.child<QTreeWidget>("studyTree")->viewport(),
                                w.child<QLineEdit>("studySearch"),
                                segments};
  for (QWidget* target : targets) {
    QVERIFY(target);
    QVERIFY2(!takes(target, *carried.data), qPrintable(target->objectName()));
  }
}

void TestDraggedPictures::aPictureThatIsBeingDrawnIsNotDragged() {
  DragWindow w;
  QVERIFY(w.hasPictures());
  w.session().setFocus(sceneViewId);
  w.child<QAction>("viewRight")->trigger();
  QVERIFY(!w.view(sceneViewId)->hasItsPicture());
  QVERIFY(!draggedOut(w.view(sceneViewId)).data);
  auto* banner = w.child<Banner>("banner");
  QCOMPARE(banner->sentence(),
           QStringLiteral("The picture is still being drawn: drag it again in a moment."));
  QTRY_VERIFY_WITH_TIMEOUT(w.view(sceneViewId)->hasItsPicture(), longest);
  QVERIFY(draggedOut(w.view(sceneViewId)).data);
  QVERIFY2(!banner->isVisible(), "it went well");
}

void TestDraggedPictures::whatCannotBeWrittenIsTold() {
  DragWindow w;
  QVERIFY(w.hasPictures());
  const QByteArray before = qgetenv("TMPDIR");
  const auto back = qScopeGuard([&] { before.isNull() ? qunsetenv("TMPDIR") : qputenv("TMPDIR", before); });
  qputenv("TMPDIR", "/proc");
  QVERIFY(!draggedOut(w.view(axialViewId)).data);
  QCOMPARE(w.child<Banner>("banner")->sentence(),
           QStringLiteral("Cannot write into /proc: free some space there."));
}

VOLUMEN_TEST(TestDraggedPictures);
#include "tst_dragged_pictures.moc"
