// Guards that the Segments panel is usable on a laptop screen in the initial window layout. The list of
// segments and the whole open page are visible together, without scrolling.
#include <QComboBox>
#include <QDockWidget>
#include <QTreeWidget>

#include "tests/ui/clean_settings.h"
#include "tests/ui/journey.h"
#include "tests/ui/window_flaws.h"
#include "tests/unit/suite.h"
#include "ui/panels/segments_panel.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// A head CT with segments and the Segments panel in front. The window has its final size before docks divide
// the space.
struct LaptopWindow : MainWindow {
  explicit LaptopWindow(QSize size = {1366, 768}, int textPercent = 100) : MainWindow(realServices()) {
    session().prefer([&](Preferences& p) { p.textPercent = textPercent; });
    resize(size);
    show();
    QSignalSpy settled(this, &MainWindow::settled);
    open({QStringLiteral("phantom:ct-head:64")});
    QVERIFY(settled.wait(longest));
    child<QDockWidget>("segmentDock")->raise();
    for (int n = 0; n < 6; ++n) QTest::mouseClick(child<QToolButton>("segmentAdd"), Qt::LeftButton);
    QTRY_VERIFY_WITH_TIMEOUT(jobs().rows().empty(), longest);
  }
  template <class Child>
  Child* child(const char* name) {
    return findChild<Child*>(QLatin1String(name));
  }
  // Returns the number of completely visible rows.
  int rowsSeen() {
    auto* list = child<QTreeWidget>("segmentList");
    const QRect seen = list->viewport()->visibleRegion().boundingRect();
    int rows = 0;
    for (int n = 0; n < list->topLevelItemCount(); ++n)
      rows += seen.contains(list->visualItemRect(list->topLevelItem(n))) ? 1 : 0;
    return rows;
  }
  // Returns the parts of the open page that are cut off or scrolled away.
  QStringList unseen() {
    QStringList found;
    const QWidget* page = findChild<SegmentsPanel*>()->findChild<QStackedWidget*>()->currentWidget();
    for (const QWidget* part : page->findChildren<QWidget*>())
      if (part->isVisible() && !part->isWindow() && !part->rect().isEmpty() &&
          part->visibleRegion().boundingRect() != part->rect())
        found << nameOf(part);
    return found;
  }
};

}  // namespace

class TestSegmentPanelRoom : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void listAndPageAreSeenTogether_data();
  void listAndPageAreSeenTogether();
  void soAreTheFieldsOfAnyStep();
  void theCurveStaysInAWindowMadeSmaller();
  void noPageOverlapsWithLargeText();
};

void TestSegmentPanelRoom::listAndPageAreSeenTogether_data() {
  QTest::addColumn<QString>("page");
  for (const char* page : {"segmentFromCurve", "segmentPaint", "segmentGrowing", "segmentChange"})
    QTest::newRow(page) << QString::fromLatin1(page);
}

void TestSegmentPanelRoom::listAndPageAreSeenTogether() {
  QFETCH(QString, page);
  LaptopWindow w;
  QCOMPARE(w.size(), QSize(1366, 768));
  QTest::mouseClick(w.findChild<QToolButton*>(page), Qt::LeftButton);
  QStringList unseen;
  QTRY_VERIFY2((unseen = w.unseen()).isEmpty(), qPrintable(unseen.join(QLatin1Char('\n'))));
  if (const QString folder = qEnvironmentVariable("VOLUMEN_SHOTS"); !folder.isEmpty())
    w.grab().save(QDir(folder).filePath(QStringLiteral("laptop-") + page + QStringLiteral(".png")));
  QVERIFY2(w.rowsSeen() >= 4, qPrintable(QString::number(w.rowsSeen())));
  QCOMPARE(flaws(w), QStringList());
}

void TestSegmentPanelRoom::soAreTheFieldsOfAnyStep() {
  LaptopWindow w;
  QTest::mouseClick(w.child<QToolButton>("segmentChange"), Qt::LeftButton);
  auto* kinds = w.child<QComboBox>("segmentStepKind");
  QVERIFY(kinds->count() > 10);
  for (int n = 0; n < kinds->count(); ++n) {
    if (kinds->itemText(n).isEmpty()) continue;  // a separator
    kinds->setCurrentIndex(n);
    // Fields and the scroll bar are laid out a moment later.
    QStringList unseen;
    QTRY_VERIFY2((unseen = w.unseen()).isEmpty(),
                 qPrintable(kinds->itemText(n) + QStringLiteral(": ") + unseen.join(u'\n')));
    QVERIFY2(w.rowsSeen() >= 4, qPrintable(kinds->itemText(n)));
    QCOMPARE(flaws(w), QStringList());
  }
}

void TestSegmentPanelRoom::theCurveStaysInAWindowMadeSmaller() {
  LaptopWindow w({1440, 900});
  w.resize(1366, 768);
  const auto* curve = w.child<QWidget>("curveEditor");
  const auto heightSeen = [&] { return curve->visibleRegion().boundingRect().height(); };
  QTRY_VERIFY2(heightSeen() >= 140, qPrintable(QString::number(heightSeen())));
}

void TestSegmentPanelRoom::noPageOverlapsWithLargeText() {
  const QSize small(1024, 700);
  LaptopWindow w(small, 140);
  for (const char* page : {"segmentFromCurve", "segmentPaint", "segmentGrowing", "segmentChange"}) {
    w.child<QToolButton>(page)->click();
    QStringList found;
    QTRY_VERIFY2((found = flaws(w)).isEmpty(),
                 qPrintable(QLatin1String(page) + QStringLiteral(": ") + found.join(QLatin1Char('\n'))));
    QCOMPARE(w.size(), small);
  }
}

VOLUMEN_TEST(TestSegmentPanelRoom);
#include "tst_segment_panel_room.moc"
