// Guards hanging protocols in the window. Opened mammograms face each other, keys and the menu go through
// matching protocols, and the screen is saved as a protocol. Each is one undo step. Real events.
#include <QInputDialog>

#include "tests/ui/hanging_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestHanging : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void mammogramsFaceEachOther_data();
  void mammogramsFaceEachOther();
  void whatIsOpenedNextIsHung_data();
  void whatIsOpenedNextIsHung();
  void aVolumeIsHungOnceItIsShown();
  void aFrameThatCannotBeReadStopsNoOther();
  void aClickMeanwhileMakesNoSecondStep();
  void framesFaceEachOtherInViewsOfAnotherSize();
  void aMaximisedViewIsLeft_data();
  void aMaximisedViewIsLeft();
  void keysGoThroughWhatFits();
  void anotherStudyBeginsWithItsFirst();
  void theMenuHangsAndSaves();
  void withoutAStudyThereIsASentence();
};

void TestHanging::mammogramsFaceEachOther_data() {
  QTest::addColumn<bool>("areSeries");
  QTest::addColumn<bool>("areOfOneSize");
  QTest::newRow("one series of two sizes") << false << false;
  QTest::newRow("one series, one stack") << false << true;
  QTest::newRow("four series") << true << false;
}

void TestHanging::mammogramsFaceEachOther() {
  QFETCH(bool, areSeries);
  QFETCH(bool, areOfOneSize);
  const Mammograms data;
  QVERIFY(data.write(areSeries ? BreastSeries::ofEach : BreastSeries::ofAll, areOfOneSize));
  HangingWindow w({data.folder.path()});
  QTRY_COMPARE_WITH_TIMEOUT(w.workspace().layout, Layout::four, longest);
  const char* cells[] = {"R CC", "L CC", "R MLO", "L MLO"};
  for (int n = 0; n < 4; ++n) QCOMPARE(w.told(n), QLatin1String(cells[n]));
  QVERIFY(w.facesEachOther(4));
  for (int n = 0; n < 4; ++n) {
    QVERIFY2(w.wallOff(n) < 0.5, cells[n]);
    QCOMPARE(flatLookOf(w.workspace().view(firstCell + n)).turn, (n == 1 ? PictureTurn{2} : PictureTurn{}));
    QVERIFY2(w.frameView(n)->overlays().topRight.contains(QLatin1String(cells[n])) ||
                 w.frameView(n)->overlays().topLeft.contains(QLatin1String(cells[n])),
             "the corner says side and view of the frame");
  }
  w.shot("mammograms");
  QCOMPARE(w.session().undoStack().count(), 1);
  const Workspace hung = w.workspace();
  w.child<QAction>("undo")->trigger();
  QCOMPARE(w.workspace().layout, Layout::one);
  w.child<QAction>("redo")->trigger();
  QVERIFY(w.workspace() == hung);
}

void TestHanging::whatIsOpenedNextIsHung_data() {
  QTest::addColumn<int>("patient");
  QTest::addColumn<bool>("isClosed");
  QTest::newRow("another patient over a chosen grid") << 78 << false;
  QTest::newRow("the same study after it was closed") << 77 << true;
}

void TestHanging::whatIsOpenedNextIsHung() {
  QFETCH(int, patient);
  QFETCH(bool, isClosed);
  Mammograms first, next;
  next.patient = patient;
  QVERIFY(first.write() && next.write());
  HangingWindow w({first.folder.path()});
  QVERIFY(w.isHungInFour());
  if (isClosed) {
    w.session().closeAll(w.window.document().open.everything());
    QVERIFY(!w.in(0));
  } else {
    w.child<QAction>("layoutTwo")->trigger();
  }
  w.window.open({isClosed ? first.folder.path() : next.folder.path()});
  const auto isHung = [&] {
    for (int n = 0; n < 4; ++n)
      if (!w.in(n) || w.in(n)->patientId != std::to_string(patient)) return false;
    return w.workspace().layout == Layout::four;
  };
  QVERIFY(QTest::qWaitFor(isHung, longest));
  QVERIFY(w.facesEachOther(4));
}

// The volume is not in memory when its study is opened.
void TestHanging::aVolumeIsHungOnceItIsShown() {
  HangingProtocol mine = twoOfAny();
  mine.automatic = true, mine.when.rule.modality = "CT";
  mine.cells[1].picture = CellPicture::coronal;
  QVERIFY(writePresetFile(mine.name, protocolToJson(mine), protocolFolder()));
  const TwoDays days;
  QVERIFY(days.write());
  HangingWindow w(QStringList{days.now});
  removeOwnProtocols();
  QTRY_COMPARE_WITH_TIMEOUT(w.workspace().layout, Layout::two, longest);
  QVERIFY(w.in(0) && w.in(1));
  QCOMPARE(w.workspace().view(firstCell + 1).kind, ViewKind::coronal);
}

void TestHanging::aFrameThatCannotBeReadStopsNoOther() {
  const Mammograms data;
  QVERIFY(data.write(BreastSeries::ofEach));
  // In a grid that the reader chose, only one picture is read. The R CC is removed before it is.
  HangingWindow w;
  QVERIFY(w.opensIntoAChosenGrid(data.folder.path()));
  QVERIFY(w.told(0) != QStringLiteral("R CC"));
  QVERIFY(QFile::remove(data.folder.filePath(QStringLiteral("1"))));
  w.child<QAction>("nextProtocol")->trigger();
  QCOMPARE(w.workspace().layout, Layout::four);
  QCOMPARE(w.told(0), QStringLiteral("R CC"));
  QTRY_COMPARE_WITH_TIMEOUT(flatLookOf(w.workspace().view(firstCell + 1)).turn, PictureTurn{2}, longest);
  for (int n = 1; n < 4; ++n) {
    const auto isAtTheEdge = [&] { return w.frameView(n)->frame() && w.wallOff(n) < 0.5; };
    QVERIFY(QTest::qWaitFor(isAtTheEdge, longest));
  }
}

void TestHanging::aClickMeanwhileMakesNoSecondStep() {
  MammogramsWindow w;
  QVERIFY(w.isOpen());
  const int steps = w.session().undoStack().count();
  w.child<QAction>("nextProtocol")->trigger();
  w.session().setFocus(firstCell + 1);
  w.session().endGesture();
  QVERIFY(w.facesEachOther(2));
  QTRY_COMPARE(flatLookOf(w.workspace().view(firstCell + 1)).turn, PictureTurn{2});
  QCOMPARE(w.session().undoStack().count(), steps + 1);
  w.child<QAction>("undo")->trigger();
  QCOMPARE(w.workspace().layout, Layout::four);
}

void TestHanging::framesFaceEachOtherInViewsOfAnotherSize() {
  MammogramsWindow w;
  QVERIFY(w.isOpen());
  const int steps = w.session().undoStack().count();
  // The view moved by hand stays as it is.
  w.session().change(QStringLiteral("Pan"), [&](Workspace& workspace) {
    ViewState& moved = workspace.editView(firstCell + 3);
    moved.flats.edit(moved.series).panMm.x += 1;
  });
  const FlatLook byHand = flatLookOf(w.workspace().view(firstCell + 3));
  const glm::ivec2 before = w.frameView(0)->plane()->size;
  w.window.resize(1300, 640);
  const auto areAtTheEdge = [&] {
    return w.frameView(0)->width() > 0 && w.wallOff(0) < 0.5 && w.wallOff(1) < 0.5 && w.wallOff(2) < 0.5;
  };
  QTRY_VERIFY_WITH_TIMEOUT(w.frameView(0)->plane()->size != before, longest);
  QVERIFY(QTest::qWaitFor(areAtTheEdge, longest));
  QVERIFY(flatLookOf(w.workspace().view(firstCell + 3)) == byHand);
  QCOMPARE(w.session().undoStack().count(), steps + 1);
}

void TestHanging::aMaximisedViewIsLeft_data() {
  QTest::addColumn<QByteArray>("action");
  QTest::newRow("by a protocol") << QByteArrayLiteral("nextProtocol");
  QTest::newRow("by a comparison") << QByteArrayLiteral("comparePrior");
}

void TestHanging::aMaximisedViewIsLeft() {
  QFETCH(QByteArray, action);
  const TwoDays days;
  QVERIFY(days.write());
  const HangingProtocol mine = twoOfAny();
  QVERIFY(writePresetFile(mine.name, protocolToJson(mine), protocolFolder()));
  TwoDaysWindow w(days);
  removeOwnProtocols();
  QVERIFY(w.isOpen());
  w.child<QAction>("maximise")->trigger();
  QVERIFY(w.child<QAction>("maximise")->isChecked());
  w.child<QAction>(action.constData())->trigger();
  QVERIFY(!w.child<QAction>("maximise")->isChecked());
  for (int cell = 0; cell < 2; ++cell) QTRY_VERIFY(w.window.views()->viewOf(firstCell + cell)->isVisible());
}

void TestHanging::keysGoThroughWhatFits() {
  MammogramsWindow w;
  QVERIFY(w.isOpen());
  const auto press = [&](Qt::Key key, const char* first, int cells) {
    const int steps = w.session().undoStack().count();
    QTest::keyClick(&w.window, key, Qt::AltModifier);
    return w.told(0) == QLatin1String(first) && int(viewsOnScreen(w.workspace()).size()) == cells &&
           w.facesEachOther(cells) && w.session().undoStack().count() == steps + 1;
  };
  QVERIFY(press(Qt::Key_PageDown, "R CC", 2));
  QVERIFY(press(Qt::Key_PageDown, "R MLO", 2));
  QVERIFY2(press(Qt::Key_PageDown, "R CC", 4), "the first one comes after the last");
  QVERIFY(press(Qt::Key_PageUp, "R MLO", 2));
}

void TestHanging::anotherStudyBeginsWithItsFirst() {
  Mammograms first, next;
  next.patient = 78;
  QVERIFY(first.write() && next.write());
  HangingWindow w({first.folder.path()});
  QTRY_COMPARE_WITH_TIMEOUT(w.workspace().layout, Layout::four, longest);
  const Series shownFirst = *w.in(0);
  w.window.open({next.folder.path()});
  QTRY_VERIFY_WITH_TIMEOUT(w.in(3) && w.in(3)->patientId == "78", longest);
  w.child<QAction>("nextProtocol")->trigger();
  QCOMPARE(w.workspace().layout, Layout::two);
  w.session().showFrames(shownFirst, firstCell);
  w.session().setFocus(firstCell);
  w.child<QAction>("nextProtocol")->trigger();
  QCOMPARE(w.workspace().layout, Layout::four);
  QCOMPARE(w.told(0), QStringLiteral("R CC"));
}

void TestHanging::theMenuHangsAndSaves() {
  MammogramsWindow w;
  QVERIFY(w.isOpen());
  const QStringList expected{QStringLiteral("Mammograms"), QStringLiteral("Mammograms, CC"),
                             QStringLiteral("Mammograms, MLO")};
  QCOMPARE(w.offered(), expected);
  w.child<QAction>("protocol2")->trigger();
  QCOMPARE(w.told(1), QStringLiteral("L MLO"));
  QVERIFY(w.facesEachOther(2));
  const auto save = [&](const char* name) {
    w.child<QAction>("saveProtocol")->trigger();
    auto* dialog = w.child<QInputDialog>("protocolNameDialog");
    if (!dialog) return false;
    dialog->setTextValue(QLatin1String(name));
    dialog->accept();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    return true;
  };
  QVERIFY(save("Mammograms"));
  QVERIFY2(w.complaint().contains(QStringLiteral("choose another name")), "it is one of the program's");
  QVERIFY(save("Mine"));
  const auto files = readPresetFiles(protocolFolder());
  QCOMPARE(files.size(), std::size_t(1));
  const Result<HangingProtocol> kept = protocolFromJson(files[0].text);
  QFile::remove(QString::fromStdString(files[0].path));
  QVERIFY(kept && kept->name == "Mine" && kept->layout == Layout::two);
  QVERIFY(w.offered().contains(QStringLiteral("Mine")));
}

void TestHanging::withoutAStudyThereIsASentence() {
  HangingWindow w;
  w.child<QAction>("nextProtocol")->trigger();
  QVERIFY(w.complaint().startsWith(QStringLiteral("No hanging protocol fits")));
  w.child<QAction>("saveProtocol")->trigger();
  QCOMPARE(w.complaint(), QStringLiteral("Open a series first."));
}

VOLUMEN_TEST(TestHanging);
#include "tst_hanging.moc"
