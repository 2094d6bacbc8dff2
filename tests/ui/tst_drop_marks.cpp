// Guards that a view says what a drop does only while a series is dragged over it, and accepts nothing but
// series. Real drag events.
#include <QDragEnterEvent>
#include <QDragLeaveEvent>
#include <QMimeData>
#include <QUrl>

#include "tests/ui/two_series.h"
#include "tests/unit/suite.h"
#include "ui/widgets/drop_mark.h"
#include "ui/workspace/dragged_series.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

std::unique_ptr<QMimeData> draggedData() {
  auto data = std::make_unique<QMimeData>();
  data->setData(draggedSeriesType, "0 nowhere");
  return data;
}

bool enter(View* view, const QMimeData& what) {
  QDragEnterEvent event({30, 30}, Qt::CopyAction, &what, Qt::LeftButton, Qt::NoModifier);
  event.ignore();
  QCoreApplication::sendEvent(view, &event);
  return event.isAccepted();
}

DropMark* markOf(View* view) { return view->findChild<DropMark*>(); }

}  // namespace

class TestDropMarks : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aViewIsLitWhileASeriesIsOverIt();
  void itSaysWhichViewsChange();
  void droppingEndsIt();
  void nothingElseIsTaken_data();
  void nothingElseIsTaken();
};

void TestDropMarks::aViewIsLitWhileASeriesIsOverIt() {
  TwoSeries w(ballIn("A"), ballIn("B"));
  const auto data = draggedData();
  QVERIFY(markOf(w.view(right)) && !markOf(w.view(right))->isVisible());
  QVERIFY(enter(w.view(right), *data));
  QVERIFY(markOf(w.view(right))->isVisible() && !markOf(w.view(left))->isVisible());
  QCOMPARE(markOf(w.view(right))->size(), w.view(right)->size());
  QCOMPARE(markOf(w.view(right))->text(), QStringLiteral("Show here"));
  QVERIFY2(w.workspace().focus == left, "nothing is done yet");
  QDragLeaveEvent leave;
  QCoreApplication::sendEvent(w.view(right), &leave);
  QVERIFY(!markOf(w.view(right))->isVisible());
}

void TestDropMarks::itSaysWhichViewsChange() {
  Journey w;
  w.window.session().show(ballSeries());
  const auto data = draggedData();
  QVERIFY(enter(w.window.view(), *data));
  QCOMPARE(markOf(w.window.view())->text(), QStringLiteral("Show here"));
  w.child<QAction>("layoutPlanes")->trigger();
  View* axial = w.window.views()->viewOf(axialViewId);
  QVERIFY(enter(axial, *data));
  QCOMPARE(markOf(axial)->text(), QStringLiteral("Show in these views"));
}

void TestDropMarks::droppingEndsIt() {
  TwoSeries w(ballIn("A"), ballIn("B"));
  const auto data = draggedData();
  const Workspace before = w.workspace();
  QVERIFY(drop(*data, w.view(right)));
  QVERIFY(!markOf(w.view(right))->isVisible());
  QCOMPARE(w.workspace().focus, right);
  QVERIFY2(w.workspace().views == before.views, "a series that is not in the list is none");
}

void TestDropMarks::nothingElseIsTaken_data() {
  QTest::addColumn<bool>("isFile");
  QTest::newRow("text") << false;
  QTest::newRow("a file: it is the window's") << true;
}

void TestDropMarks::nothingElseIsTaken() {
  QFETCH(bool, isFile);
  TwoSeries w(ballIn("A"), ballIn("B"));
  QMimeData data;
  if (isFile)
    data.setUrls({QUrl::fromLocalFile(QStringLiteral("/nowhere"))});
  else
    data.setText(QStringLiteral("text"));
  QCOMPARE(enter(w.view(left), data), isFile);
  QVERIFY(!markOf(w.view(left))->isVisible());
}

VOLUMEN_TEST(TestDropMarks);
#include "tst_drop_marks.moc"
