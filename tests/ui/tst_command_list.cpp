// Guards the searchable list of commands. All are listed with menus and keys, found by words, and done by
// Enter or a click, without a mouse. Unavailable commands are grey and do nothing.
#include <QLineEdit>
#include <QMenu>
#include <QPointer>
#include <QTemporaryDir>
#include <QTreeWidget>
#include <memory>

#include "tests/ui/clean_settings.h"
#include "tests/ui/hanging_window.h"
#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"
#include "ui/widgets/command_list.h"
#include "ui/workspace/camera_moves.h"

using namespace volumen;
using namespace volumen::tests;

struct CommandWindow : MeasureWindow {
  CommandWindow() {
    view()->setFocus();
    open();
  }
  void open() { QTest::keyClick(window.focusWidget(), Qt::Key_P, Qt::ControlModifier | Qt::ShiftModifier); }
  CommandList* list() { return window.findChild<CommandList*>(); }
  QLineEdit* search() { return child<QLineEdit>("commandSearch"); }
  QTreeWidget* rows() { return child<QTreeWidget>("commandRows"); }
  QTreeWidgetItem* row(int n) { return rows()->topLevelItem(n); }
  // Returns text, path and keys of a row; empty if there is no such row.
  QStringList texts(int n) {
    const QTreeWidgetItem* item = row(n);
    return item ? QStringList{item->text(0), item->text(1), item->text(2)} : QStringList();
  }
  QTreeWidgetItem* rowOf(const char* text) {
    return rows()->findItems(QString::fromUtf8(text), Qt::MatchExactly).value(0);
  }
  void type(const char* text) {
    search()->clear();
    QTest::keyClicks(search(), QString::fromUtf8(text));
  }
  QString current() { return rows()->currentItem() ? rows()->currentItem()->text(0) : QString(); }
};

class TestCommandList : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void itHoldsAllCommands();
  void enterDoesTheFirst();
  void arrowsGoThroughWhatCanBeDone();
  void whatCannotBeDoneIsGrey();
  void aClickDoesIt();
  void escapeClosesNothingElse();
  void itClosesWhenTheKeysGoElsewhere();
  void whatWasUsedLastComesFirst();
  void keysThatAreNoCommandsAreFound();
  void lettersAreTypedNotDone();
  void itActsOnTheViewThatHadTheKeys();
  void aWindowIsFoundByItsName();
  void aPresetIsFoundByItsName();
  void aSeriesIsFoundByItsName();
  void aProtocolIsFoundByItsName();
  void whatWasOpenedIsFoundThoughItsMenuIsFilledAgain();
  void wordsAreFoundAnywhere_data();
  void wordsAreFoundAnywhere();
  void otherWordsFindIt_data();
  void otherWordsFindIt();

 private:
  std::unique_ptr<CommandWindow> shared_;  // of rows that only search
};

void TestCommandList::itHoldsAllCommands() {
  CommandWindow w;
  QVERIFY(w.list()->isVisible());
  QCOMPARE(w.window.focusWidget(), w.search());
  for (const QAction* action : w.window.actions()) {
    if (action->objectName().isEmpty() || action->menu()) continue;
    QString text = action->text().section(QLatin1Char('\t'), 0, 0);
    text.remove(QLatin1Char('&'));
    const auto found = w.rows()->findItems(text, Qt::MatchExactly);
    QVERIFY2(!found.isEmpty(), qPrintable(text));
    for (const QKeySequence& key : action->shortcuts())
      QVERIFY2(std::ranges::any_of(found,
                                   [&](const QTreeWidgetItem* item) {
                                     return item->text(2).contains(key.toString(QKeySequence::NativeText));
                                   }),
               qPrintable(text));
  }
  QCOMPARE(w.rowOf("Length")->text(2), QStringLiteral("D"));
  QCOMPARE(w.rowOf("Length")->text(1), QStringLiteral("Tools > Measure"));
  QCOMPARE(w.rowOf("Lights")->text(1), QStringLiteral("View > Panels"));
  QCOMPARE(w.rowOf("One view")->text(2), QStringLiteral("Alt+1"));
  QCOMPARE(w.rowOf("Lock here")->text(1), QStringLiteral("View > Link"));
}

void TestCommandList::wordsAreFoundAnywhere_data() {
  shared_ = std::make_unique<CommandWindow>();
  QTest::addColumn<QString>("typed");
  QTest::addColumn<QString>("found");
  QTest::newRow("a word") << QStringLiteral("anterior") << QStringLiteral("Anterior view");
  QTest::newRow("parts of words") << QStringLiteral("ror bott") << QStringLiteral("Mirror top to bottom");
  QTest::newRow("in any order") << QStringLiteral("view anterior") << QStringLiteral("Anterior view");
  QTest::newRow("capitals") << QStringLiteral("ANTERIOR") << QStringLiteral("Anterior view");
  QTest::newRow("accents") << QString::fromUtf8("\u00e0nt\u00e9rior") << QStringLiteral("Anterior view");
  QTest::newRow("a menu") << QStringLiteral("layout two") << QStringLiteral("Two series");
  QTest::newRow("nothing") << QStringLiteral("anterior banana") << QString();
}

void TestCommandList::wordsAreFoundAnywhere() {
  QFETCH(QString, typed);
  QFETCH(QString, found);
  CommandWindow& w = *shared_;
  w.search()->setText(typed);
  QCOMPARE(w.row(0) ? w.row(0)->text(0) : QString(), found);
  w.search()->clear();
  QVERIFY(w.rows()->topLevelItemCount() > 50);
}

void TestCommandList::enterDoesTheFirst() {
  CommandWindow w;
  w.type("ant vie");
  QTest::keyClick(w.search(), Qt::Key_Return);
  QVERIFY(!w.list()->isVisible());
  QCOMPARE(viewName(w.window.view()->camera()), std::string("anterior"));
  QCOMPARE(w.window.focusWidget(), static_cast<QWidget*>(w.view()));
}

void TestCommandList::arrowsGoThroughWhatCanBeDone() {
  CommandWindow w;
  w.type("series layout");
  QCOMPARE(w.current(), QStringLiteral("Two series"));
  QTest::keyClick(w.search(), Qt::Key_Down);
  QCOMPARE(w.current(), QStringLiteral("Four series"));
  QTest::keyClick(w.search(), Qt::Key_Up);
  QTest::keyClick(w.search(), Qt::Key_Up);
  QCOMPARE(w.current(), QStringLiteral("Two series"));
  QTest::keyClick(w.search(), Qt::Key_Down);
  QTest::keyClick(w.search(), Qt::Key_Return);
  QCOMPARE(w.session().workspace().layout, Layout::four);
  w.open();
  w.type("view");
  for (int n = 0; n < 100; ++n) {
    QVERIFY(w.rows()->currentItem()->flags() & Qt::ItemIsEnabled);
    QTest::keyClick(w.search(), Qt::Key_Down);
  }
}

void TestCommandList::whatCannotBeDoneIsGrey() {
  CommandWindow w;
  w.type("each image its own");
  QVERIFY(w.row(0) && !(w.row(0)->flags() & Qt::ItemIsEnabled));
  const Workspace before = w.session().workspace();
  QTest::keyClick(w.search(), Qt::Key_Return);
  QTest::mouseClick(w.rows()->viewport(), Qt::LeftButton, {}, w.rows()->visualItemRect(w.row(0)).center());
  QVERIFY(w.list()->isVisible());
  QVERIFY(w.session().workspace() == before);
}

void TestCommandList::aClickDoesIt() {
  CommandWindow w;
  w.type("posterior");
  QTest::mouseClick(w.rows()->viewport(), Qt::LeftButton, {}, w.rows()->visualItemRect(w.row(0)).center());
  QVERIFY(!w.list()->isVisible());
  QCOMPARE(viewName(w.window.view()->camera()), std::string("posterior"));
}

void TestCommandList::escapeClosesNothingElse() {
  CommandWindow w;
  QTest::keyClick(w.search(), Qt::Key_Escape);
  QVERIFY(!w.list()->isVisible());
  QCOMPARE(w.window.focusWidget(), static_cast<QWidget*>(w.view()));
  QTest::keyClick(w.view(), Qt::Key_F10);
  QVERIFY(w.child<QAction>("maximise")->isChecked());
  w.open();
  QVERIFY(w.list()->isVisible());
  QTest::keyClick(w.search(), Qt::Key_Escape);
  QVERIFY(!w.list()->isVisible());
  QVERIFY2(w.child<QAction>("maximise")->isChecked(), "that is the next Esc");
}

void TestCommandList::itClosesWhenTheKeysGoElsewhere() {
  CommandWindow w;
  QTest::mouseClick(w.view(coronalViewId), Qt::LeftButton, {}, {30, 30});
  w.view(coronalViewId)->setFocus();
  QVERIFY(!w.list()->isVisible());
  QCOMPARE(w.window.focusWidget(), static_cast<QWidget*>(w.view(coronalViewId)));
}

void TestCommandList::whatWasUsedLastComesFirst() {
  CommandWindow w;
  QTest::keyClick(w.search(), Qt::Key_Escape);
  QTest::keyClick(w.view(), Qt::Key_O);
  w.child<QAction>("layoutBesidePlanes")->trigger();
  w.view()->setFocus();
  w.open();
  QCOMPARE(w.texts(0).value(0), QStringLiteral("Large 3D beside planes"));
  QCOMPARE(w.texts(1).value(0), QStringLiteral("A pixel of the picture a pixel of the screen"));
  w.type("anterior");
  QTest::keyClick(w.search(), Qt::Key_Return);
  w.open();
  QCOMPARE(w.texts(0),
           (QStringList{QStringLiteral("Anterior view"), QStringLiteral("3D"), QStringLiteral("A")}));
  QCOMPARE(w.current(), QStringLiteral("Anterior view"));
}

void TestCommandList::keysThatAreNoCommandsAreFound() {
  CommandWindow w;
  w.type("choose a window");
  QCOMPARE(w.texts(0).value(2), QStringLiteral("0 to 9 in a slice"));
  QVERIFY(!(w.row(0)->flags() & Qt::ItemIsEnabled));
}

void TestCommandList::lettersAreTypedNotDone() {
  CommandWindow w;
  const Workspace before = w.session().workspace();
  w.type("aplrsifwt1370?h");
  QCOMPARE(w.search()->text(), QStringLiteral("aplrsifwt1370?h"));
  QVERIFY(w.session().workspace() == before);
  QVERIFY(w.session().preferences().crosshairLines);
}

void TestCommandList::itActsOnTheViewThatHadTheKeys() {
  CommandWindow w;
  w.type("mirror left");
  QTest::keyClick(w.search(), Qt::Key_Return);
  QVERIFY(flatLookOf(w.view()->state()).turn.mirrored);
  QVERIFY(!flatLookOf(w.view(coronalViewId)->state()).turn.mirrored);
}

void TestCommandList::aWindowIsFoundByItsName() {
  CommandWindow w;
  w.type("lung window");
  QCOMPARE(w.texts(0).mid(0, 2),
           (QStringList{QStringLiteral("Lung (1500 / -600)"), QStringLiteral("View > Window presets")}));
  QVERIFY2(!w.rowOf("Click a slice or a frame first."), "what only says why is no command");
  QTest::keyClick(w.search(), Qt::Key_Return);
  QCOMPARE(w.session().workspace().series.at(w.view()->state().series).window,
           std::optional(Window{-600, 1500}));
  w.session().setFocus(sceneViewId);
  w.window.view()->setFocus();
  w.open();
  w.type("lung window");
  QVERIFY2(!w.row(0), "3D has none");
}

void TestCommandList::aPresetIsFoundByItsName() {
  CommandWindow w;
  w.type("presets ct-lung");
  QCOMPARE(w.texts(0).mid(0, 2), (QStringList{QStringLiteral("CT-Lung"), QStringLiteral("3D presets")}));
  QTest::keyClick(w.search(), Qt::Key_Return);
  QTRY_COMPARE_WITH_TIMEOUT(w.session().undoStack().undoText(), QStringLiteral("Preset CT-Lung"), longest);
}

void TestCommandList::aSeriesIsFoundByItsName() {
  CommandWindow w;
  QTest::keyClick(w.search(), Qt::Key_Escape);
  const LoadedSeriesPtr first = w.session().series();
  auto other = std::make_shared<LoadedSeries>(*ballSeries(24, 8));
  other->series.description = "Pair & half";
  auto study = std::make_shared<Study>();
  study->volumes = {first->series, other->series};
  w.window.document().open.add(QStringLiteral("/data"), study);
  w.session().show(other, axialViewId);
  w.session().show(first, axialViewId);
  QCOMPARE(w.view()->state().series, keyOf(first->series));
  w.view()->setFocus();
  w.open();
  w.type("show series pair half");
  QVERIFY(w.row(0) && w.row(0)->text(0).contains(QStringLiteral("Pair & half")));
  QTest::keyClick(w.search(), Qt::Key_Return);
  QTRY_COMPARE(seriesIn(w.session().workspace(), w.session().workspace().focus)->description,
               other->series.description);
}

void TestCommandList::aProtocolIsFoundByItsName() {
  MammogramsWindow w;
  QVERIFY(w.isWritten);
  QVERIFY(w.isHungInFour());
  w.frameView(0)->setFocus();
  QTest::keyClick(w.frameView(0), Qt::Key_P, Qt::ControlModifier | Qt::ShiftModifier);
  auto* search = w.child<QLineEdit>("commandSearch");
  QTest::keyClicks(search, QStringLiteral("hanging mammograms, cc"));
  const auto* rows = w.child<QTreeWidget>("commandRows");
  QVERIFY(rows->topLevelItem(0));
  QCOMPARE(rows->topLevelItem(0)->text(0), QStringLiteral("Mammograms, CC"));
  QCOMPARE(rows->topLevelItem(0)->text(1), QStringLiteral("View > Hanging protocols"));
  QTest::keyClick(search, Qt::Key_Return);
  QTRY_COMPARE(w.session().undoStack().undoText(), QStringLiteral("Hang as Mammograms, CC"));
}

// The menu is rebuilt once it is known which files still exist.
void TestCommandList::whatWasOpenedIsFoundThoughItsMenuIsFilledAgain() {
  const QTemporaryDir folder;
  CommandWindow w;
  QTest::keyClick(w.search(), Qt::Key_Escape);
  w.window.document().recent.add(folder.path());
  w.view()->setFocus();
  w.open();
  w.type("open recent");
  QCOMPARE(w.texts(0).mid(0, 2), (QStringList{folder.path(), QStringLiteral("File > Open recent")}));
  QMenu* menu = w.child<QMenu>("recentMenu");
  const QPointer<QAction> before = menu->actions().value(0);
  Q_EMIT w.window.document().recent.changed();
  QVERIFY2(!before, "it was filled again");
  QTest::keyClick(w.search(), Qt::Key_Return);
  QVERIFY(!w.list()->isVisible());
  QTRY_VERIFY2(!w.child<Banner>("banner")->sentence().isEmpty(), "the folder is empty, which was found out");
}

void TestCommandList::otherWordsFindIt_data() {
  QTest::addColumn<QString>("typed");
  QTest::addColumn<QString>("found");
  const auto row = [](const char* typed, const char* found) {
    QTest::newRow(typed) << QString::fromLatin1(typed) << QString::fromLatin1(found);
  };
  row("high", "Quality high");
  row("anonymise", "Hide names");
  row("anonymize", "Hide names");
  row("report", "Report of key images and measurements...");
  row("findings", "Report of key images and measurements...");
  row("video", "Film...");
  row("calibrate", "True size");
  row("print", "Print picture...");
  row("ruler", "Length");
  row("MPR", "Planes and 3D");
  row("screenshot", "Save picture...");
  row("settings", "Preferences...");
}

// Compares the first available command, as Enter does it.
void TestCommandList::otherWordsFindIt() {
  QFETCH(QString, typed);
  QFETCH(QString, found);
  shared_->search()->setText(typed);
  QCOMPARE(shared_->current(), found);
}

VOLUMEN_TEST(TestCommandList);
#include "tst_command_list.moc"
