// Guards opening from the study browser, by real events: what is opened, where, and that patients stay apart.
#include <QHeaderView>
#include <QMimeData>
#include <QUndoStack>

#include "results/text/text.h"
#include "tests/ui/browser_window.h"
#include "tests/ui/gestures.h"
#include "tests/unit/suite.h"
#include "ui/views/flat_view.h"
#include "ui/views/view_grid.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

const QString mueller = QStringLiteral("Müller, Jörg"), yamada = QStringLiteral("Yamada, Tarou  山田 太郎");

}  // namespace

class TestBrowserOpening : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void init();
  void aStudyIsOpened_data();
  void aStudyIsOpened();
  void aSearchEndsWithWhatItFound();
  void aSeriesIsDraggedIntoAView_data();
  void aSeriesIsDraggedIntoAView();
  void anotherPatientTakesThePlace();
  void patientsBesideEachOtherAreNamed();
  void whatWasOpenedLastStandsFirst();

 private:
  std::unique_ptr<Studies> studies_;
};

void TestBrowserOpening::initTestCase() { openAlone(); }

void TestBrowserOpening::init() {
  studies_ = std::make_unique<Studies>();
  QVERIFY(studies_->import());
}

void TestBrowserOpening::aStudyIsOpened_data() {
  QTest::addColumn<QString>("how");
  QTest::addColumn<QByteArray>("shown");
  QTest::newRow("double-click on a study: the largest series")
      << QStringLiteral("study") << QByteArray("Bone");
  QTest::newRow("double-click on a series in the tree")
      << QStringLiteral("series") << QByteArray("Soft tissue");
  QTest::newRow("double-click on a thumbnail") << QStringLiteral("thumbnail") << QByteArray("Soft tissue");
  QTest::newRow("Enter in the list") << QStringLiteral("enter") << QByteArray("Bone");
  QTest::newRow("Enter in the search field") << QStringLiteral("search") << QByteArray("Venous");
  QTest::newRow("double-click on a patient with one study")
      << QStringLiteral("patient") << QByteArray("Venous");
  QTest::newRow("double-click on a patient of several studies: the latest")
      << QStringLiteral("patients") << QByteArray("Bone");
  QTest::newRow("the same where the oldest stands first") << QStringLiteral("oldest") << QByteArray("Bone");
}

void TestBrowserOpening::aStudyIsOpened() {
  QFETCH(QString, how);
  QFETCH(QByteArray, shown);
  BrowserWindow w(*studies_);
  QVERIFY(w.has("Head", 4));
  w.click(w.row("Head", 4));
  QTRY_COMPARE_WITH_TIMEOUT(w.strip()->count(), 2, longest);
  if (how == QStringLiteral("study")) w.doubleClick(w.row("Head", 4));
  if (how == QStringLiteral("patient")) w.doubleClick(w.row("Müller"));
  if (how == QStringLiteral("patients")) w.doubleClick(w.row("Doe"));
  if (how == QStringLiteral("oldest")) {
    QHeaderView* header = w.tree()->header();
    while (header->sortIndicatorSection() != 2 || header->sortIndicatorOrder() != Qt::AscendingOrder)
      QTest::mouseClick(header->viewport(), Qt::LeftButton, {},
                        {header->sectionViewportPosition(2) + 10, header->height() / 2});
    QVERIFY(w.shows({yamada, mueller, QStringLiteral("Doe, Jane")}));
    const QModelIndex patient = w.row("Doe");
    QCOMPARE(patient.model()->index(0, 4, patient).data().toString(), QStringLiteral("Follow-up"));
    w.click(w.row("Müller"));
    w.click(patient);
    QTRY_COMPARE_WITH_TIMEOUT(w.strip()->count(), 2, longest);
    w.doubleClick(patient);
  }
  if (how == QStringLiteral("enter")) QTest::keyClick(w.tree(), Qt::Key_Return);
  if (how == QStringLiteral("series")) {
    w.tree()->setExpanded(w.row("Head", 4), true);
    QVERIFY(w.has("Soft tissue", 4));
    w.doubleClick(w.row("Soft tissue", 4));
  }
  if (how == QStringLiteral("thumbnail")) {
    QListWidgetItem* item = w.strip()->findItems(QStringLiteral("Soft"), Qt::MatchContains).value(0);
    const QPoint at = w.strip()->visualItemRect(item).center();
    QTest::mouseClick(w.strip()->viewport(), Qt::LeftButton, {}, at);
    QTest::mouseDClick(w.strip()->viewport(), Qt::LeftButton, {}, at);
  }
  if (how == QStringLiteral("search")) {
    QTest::keyClicks(w.search(), QStringLiteral("abdomen"));
    QVERIFY(w.shows({mueller}));
    QTest::keyClick(w.search(), Qt::Key_Return);
  }
  QVERIFY(w.isShown(shown.constData()));
  QVERIFY(!w.child<QWidget>("studyBrowser")->isVisible());
  QVERIFY(w.window.views()->isVisible());
}

// The next time the browser is shown, it lists all studies.
void TestBrowserOpening::aSearchEndsWithWhatItFound() {
  BrowserWindow w(*studies_);
  QVERIFY(w.has("Head", 4));
  QTest::keyClicks(w.search(), QStringLiteral("abdomen"));
  QVERIFY(w.shows({mueller}));
  QTest::keyClick(w.search(), Qt::Key_Return);
  QVERIFY(w.isShown("Venous"));
  QTRY_VERIFY(!w.child<QWidget>("studyBrowser")->isVisible());
  w.child<QAction>("showBrowser")->trigger();
  QVERIFY(w.search()->text().isEmpty());
  QVERIFY(w.shows({QStringLiteral("Doe, Jane"), mueller, yamada}));
}

void TestBrowserOpening::aSeriesIsDraggedIntoAView_data() {
  QTest::addColumn<bool>("fromTree");
  QTest::newRow("from the tree") << true;
  QTest::newRow("from the thumbnails") << false;
}

void TestBrowserOpening::aSeriesIsDraggedIntoAView() {
  QFETCH(bool, fromTree);
  BrowserWindow w(*studies_);
  QVERIFY(w.openHead());
  w.child<QAction>("layoutTwo")->trigger();
  w.child<QAction>("showBrowser")->trigger();
  QVERIFY(w.tree()->isVisible() && w.window.views()->isVisible());
  w.click(w.row("Head", 4));
  QTRY_COMPARE_WITH_TIMEOUT(w.strip()->count(), 2, longest);
  w.tree()->setExpanded(w.row("Head", 4), true);
  QVERIFY(w.has("Soft tissue", 4));
  QListWidgetItem* item = w.strip()->findItems(QStringLiteral("Soft"), Qt::MatchContains).value(0);
  const QModelIndex dragged =
      fromTree ? w.row("Soft tissue", 4) : w.strip()->model()->index(w.strip()->row(item), 0);
  const QAbstractItemModel* model = dragged.model();
  QVERIFY(model->flags(dragged) & Qt::ItemIsDragEnabled);
  const std::unique_ptr<QMimeData> data(model->mimeData({dragged}));
  QVERIFY(data);
  View* right = w.window.views()->viewOf(firstComparedId + 1);
  QVERIFY(tests::drop(*data, right));
  QVERIFY(w.isShown("Soft tissue", firstComparedId + 1));
  QVERIFY(w.isShown("Bone", firstComparedId));
  QVERIFY2(w.tree()->isVisible(), "the list stays for the next one");
  w.shot("browser-above");
}

void TestBrowserOpening::anotherPatientTakesThePlace() {
  BrowserWindow w(*studies_);
  QVERIFY(w.openHead());
  w.child<QAction>("layoutTwo")->trigger();
  w.child<QAction>("showBrowser")->trigger();
  w.doubleClick(w.row("Müller"));
  QVERIFY(w.isShown("Venous"));
  for (ViewId id = 0; id < viewCount; ++id) {
    const Series* series = seriesIn(w.window.session().workspace(), id);
    QVERIFY(!series || series->patientId == "B222");
  }
  QVERIFY(!w.child<QWidget>("patientsBar")->isVisible());
  // Nothing is lost. The series stays in the list of open studies, and one undo step restores or repeats
  // everything.
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.isShown("Bone", firstComparedId));
  w.child<QAction>("redo")->trigger();
  QVERIFY(w.isShown("Venous"));
}

void TestBrowserOpening::patientsBesideEachOtherAreNamed() {
  BrowserWindow w(*studies_);
  QVERIFY(w.openHead());
  w.child<QAction>("showBrowser")->trigger();
  w.click(w.row("Müller"));
  QTest::keyClick(w.tree(), Qt::Key_Return, Qt::ControlModifier);
  QVERIFY(w.isShown("Venous", firstComparedId + 1));
  QVERIFY(w.isShown("Bone", firstComparedId));
  auto* bar = w.child<QLabel>("patientsBar");
  QTRY_VERIFY(bar->isVisible());
  QCOMPARE(bar->text(),
           QStringLiteral("The views show different patients: Doe, Jane (A111) and Müller, Jörg (B222)."));
  w.shot("browser-patients");
  w.child<QAction>("hideNames")->trigger();
  QCOMPARE(bar->text(), QStringLiteral("The views show 2 different patients."));
  w.child<QAction>("hideNames")->trigger();
  w.child<QAction>("layoutOne")->trigger();
  QVERIFY2(!bar->isVisible(), "what is not on screen is not mixed");
}

void TestBrowserOpening::whatWasOpenedLastStandsFirst() {
  BrowserWindow w(*studies_);
  QVERIFY(w.has("Head", 4));
  w.doubleClick(w.row("Knee", 4));
  QVERIFY(w.isShown("Sagittal"));
  w.child<QAction>("showBrowser")->trigger();
  QVERIFY(w.has("Opened last"));
  const QModelIndex group = w.row("Opened last");
  QCOMPARE(group.row(), 0);
  QCOMPARE(w.tree()->model()->rowCount(group), 1);
  QCOMPARE(w.tree()->model()->index(0, 0, group).data().toString(), yamada);
  QVERIFY(w.tree()->isExpanded(group));
  // A search covers all studies.
  QTest::keyClicks(w.search(), QStringLiteral("knee"));
  QTRY_COMPARE_WITH_TIMEOUT(w.tree()->model()->rowCount(), 1, longest);
  QCOMPARE(w.patients(), QStringList{yamada});
}

VOLUMEN_TEST(TestBrowserOpening);
#include "tst_browser_opening.moc"
