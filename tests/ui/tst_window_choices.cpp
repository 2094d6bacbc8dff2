// Guards that windows are chosen by name in the context menu, in the View menu and in the tool bar, with
// their digits. The name of a tissue's window stands in the corner while it applies.
#include <QMenu>
#include <QToolButton>

#include "tests/fixtures/small_volumes.h"
#include "tests/ui/frames_window.h"
#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

QAction* entry(const QMenu* menu, const char* text) {
  for (QAction* action : menu->actions())
    if (action->text().startsWith(QLatin1String(text))) return action;
  return nullptr;
}

QString chosenIn(const QMenu* menu) {
  QStringList chosen;
  for (const QAction* action : menu->actions())
    if (action->isChecked()) chosen << action->text();
  return chosen.join(QLatin1Char('|'));
}

}  // namespace

class TestWindowChoices : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aRightClickChoosesOne();
  void theMenuSaysWhichIsChosen();
  void ofTheSameWindowsOneHasTheMark();
  void theNameStandsWhileItHolds();
  void whatHasNoTissuesHasNone();
  void withoutASliceItSaysSo();
  void digitsDoNotMoveWithTheFile();
};

void TestWindowChoices::aRightClickChoosesOne() {
  MeasureWindow w;
  QTest::mouseClick(w.view(), Qt::RightButton, {}, {90, 90});
  auto* menu = w.child<QMenu>("flatMenu");
  QVERIFY(menu && menu->isVisible());
  QCOMPARE(menu->actions().front()->text(), QStringLiteral("Automatic\t0"));
  QAction* lung = entry(menu, "Lung");
  QVERIFY(lung);
  const int digit = lung->text().section(QLatin1Char('\t'), 1).toInt();
  QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(lung).center());
  const auto window = [&] { return w.session().workspace().series.at(w.view()->state().series).window; };
  QCOMPARE(window(), std::optional(Window{-600, 1500}));
  w.undo();
  QVERIFY(!window());
  QTest::keyClick(w.view(), Qt::Key(Qt::Key_0 + digit));
  QCOMPARE(window(), std::optional(Window{-600, 1500}));
}

void TestWindowChoices::theMenuSaysWhichIsChosen() {
  MeasureWindow w;
  auto* menu = w.child<QMenu>("windowMenu");
  QCOMPARE(w.child<QToolButton>("windowButton")->menu(), menu);
  Q_EMIT menu->aboutToShow();
  QVERIFY(chosenIn(menu).startsWith(QStringLiteral("Automatic")));
  entry(menu, "Brain")->trigger();
  Q_EMIT menu->aboutToShow();
  QVERIFY(chosenIn(menu).startsWith(QStringLiteral("Brain (80 / 40)")));
  entry(menu, "Invert")->trigger();
  QVERIFY(flatLookOf(w.view()->state()).inverted);
}

// A radiograph has the window of its file, which is the automatic one.
void TestWindowChoices::ofTheSameWindowsOneHasTheMark() {
  NEED_FILES();
  Frames w({"cr-hip-mono2-jpeg12.dcm"});
  QVERIFY(w.shows());
  const std::vector<FlatView::WindowChoice> windows = w.view()->windows();
  QVERIFY(std::ranges::count_if(windows, &FlatView::WindowChoice::isChosen) > 1);
  auto* menu = w.child<QMenu>("windowMenu");
  Q_EMIT menu->aboutToShow();
  QCOMPARE(chosenIn(menu), QStringLiteral("Automatic\t0"));
  QVERIFY(w.after([&] { drag(w.view(), {100, 100}, {140, 130}); }));
  Q_EMIT menu->aboutToShow();
  QCOMPARE(chosenIn(menu), QString());
}

void TestWindowChoices::theNameStandsWhileItHolds() {
  MeasureWindow w;
  QCOMPARE(w.view()->overlays().bottomRight, QStringLiteral("Abdomen  W 400 L 40"));
  Q_EMIT w.child<QMenu>("windowMenu")->aboutToShow();
  entry(w.child<QMenu>("windowMenu"), "Lung")->trigger();
  QCOMPARE(w.view()->overlays().bottomRight, QStringLiteral("Lung  W 1500 L -600"));
  drag(w.view(), {90, 90}, {110, 90});
  QVERIFY(w.view()->overlays().bottomRight.startsWith(QStringLiteral("W ")));
  QTest::keyClick(w.view(), Qt::Key_8);
  QVERIFY2(w.view()->overlays().bottomRight == QStringLiteral("W 1800 L 700"), "Bone MIP names no tissue");
}

void TestWindowChoices::whatHasNoTissuesHasNone() {
  auto series = std::make_shared<LoadedSeries>(*ballSeries());
  series->series.modality = "MR";
  series->series.unit.clear();
  MeasureWindow w(series);
  Q_EMIT w.child<QMenu>("windowMenu")->aboutToShow();
  QVERIFY(entry(w.child<QMenu>("windowMenu"), "Automatic"));
  QVERIFY(!entry(w.child<QMenu>("windowMenu"), "Lung"));
}

void TestWindowChoices::withoutASliceItSaysSo() {
  Journey w;
  Q_EMIT w.child<QMenu>("windowMenu")->aboutToShow();
  const QList<QAction*> all = w.child<QMenu>("windowMenu")->actions();
  QVERIFY(!all.front()->isEnabled() && !all.front()->text().isEmpty());
  QCOMPARE(all.last()->text(), QStringLiteral("Edit windows..."));
  QVERIFY(all.last()->isEnabled());
}

void TestWindowChoices::digitsDoNotMoveWithTheFile() {
  auto series = std::make_shared<LoadedSeries>(*ballSeries());
  VolumeParts parts{series->volume->geometry(), series->volume->stored(), 1, 0, {}};
  parts.attributes.windows = {{35, 350}, {-450, 2000}};
  series->volume = volumeFrom(std::move(parts));
  MeasureWindow w(series);
  const auto after = [&](Qt::Key key, Qt::KeyboardModifiers keys = {}) {
    QTest::keyClick(w.view(), key, keys);
    return w.session().workspace().series.at(w.view()->state().series).window;
  };
  QCOMPARE(after(Qt::Key_6), std::optional(Window{-600, 1500}));
  QCOMPARE(after(Qt::Key_5), std::optional(Window{400, 2000}));
  QCOMPARE(after(Qt::Key_9), std::optional(Window{35, 40}));
  QCOMPARE(after(Qt::Key_2, Qt::ControlModifier), std::optional(Window{-450, 2000}));
  QCOMPARE(after(Qt::Key_1, Qt::ControlModifier), std::optional(Window{35, 350}));
  QVERIFY2(after(Qt::Key_3, Qt::ControlModifier) == Window({35, 350}), "the file has two");
  QVERIFY(!after(Qt::Key_0));
  Q_EMIT w.child<QMenu>("windowMenu")->aboutToShow();
  QVERIFY(entry(w.child<QMenu>("windowMenu"), "From file, 2")->text().endsWith(QStringLiteral("\tCtrl+2")));
  QVERIFY(entry(w.child<QMenu>("windowMenu"), "Lung")->text().endsWith(QStringLiteral("\t6")));
}

VOLUMEN_TEST(TestWindowChoices);
#include "tst_window_choices.moc"
