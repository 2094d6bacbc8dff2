// Guards hanging protocols and priors in the window: mammograms face each other as they are opened, keys and
// the menu go through what fits, what is on screen is kept as a protocol, and the same series of an earlier
// day stands beside; each one step. Real events.
#include <QFile>
#include <QInputDialog>
#include <QMenu>

#include "io/files/preset_files.h"
#include "tests/ui/gestures.h"
#include "tests/ui/hung_studies.h"
#include "tests/ui/journey.h"
#include "tests/unit/suite.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "ui/workspace/hanging_protocol.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr ViewId firstCell = firstComparedId;

struct HangingWindow : Journey {
  using Journey::Journey;

  Session& session() { return window.session(); }
  const Workspace& workspace() { return session().workspace(); }
  const Series* in(int cell) { return seriesIn(workspace(), firstCell + cell); }
  FrameView* frameView(int cell) { return window.views()->viewAs<FrameView>(firstCell + cell); }
  ProjectionView projection(int cell) {
    const SeriesPicture picture = pictureIn(workspace(), firstCell + cell);
    return picture ? projectionOf(*picture.series, picture.frame) : ProjectionView();
  }
  QString told(int cell) {
    const ProjectionView view = projection(cell);
    return in(cell) ? QString::fromStdString(view.laterality + " " + view.viewPosition) : QString();
  }
  // Once the frames of all cells are there, as large as each other and at the edges.
  bool facesEachOther(int cells) {
    return QTest::qWaitFor(
        [&] {
          for (int n = 0; n < cells; ++n) {
            const FrameView* view = frameView(n);
            if (!view || !view->isVisible() || !view->frame() || !view->plane()) return false;
            if (view->frame()->key.series != view->state().series) return false;
            if (view->frame()->key.index != flatLookOf(view->state()).frame) return false;
            if (std::abs(view->plane()->mmPerPixel / frameView(0)->plane()->mmPerPixel - 1) > 1e-6)
              return false;
            if (wallOff(n) >= 0.5) return false;
          }
          return true;
        },
        longest);
  }
  // How far the outer edge of the column at the chest wall is from the inner edge of its cell, pixels.
  double wallOff(int cell) {
    const FrameView* view = frameView(cell);
    const VoxelGeometry& geometry = view->frame()->geometry();
    const bool rowsLeadToIt = view->frame()->rowSide == "P";
    const double i = rowsLeadToIt ? geometry.size.x - 0.5 : -0.5;
    const double middle = (geometry.size.y - 1) / 2.0;
    const double x = view->plane()->pixelFromPatient(geometry.patientFromVoxel({i, middle, 0})).x;
    return std::abs(x - (projection(cell).laterality == "R" ? view->plane()->size.x : 0));
  }
  QStringList offered() {
    auto* menu = child<QMenu>("protocolMenu");
    menu->popup({10, 10});
    QStringList names;
    for (const QAction* action : menu->actions())
      if (action->isCheckable()) names << action->text();
    menu->close();
    return names;
  }
  QString complaint() { return child<Banner>("banner")->sentence(); }
};

// With both open, and the later one on screen.
struct TwoDaysWindow : HangingWindow {
  explicit TwoDaysWindow(const TwoDays& days) : HangingWindow(QStringList{days.now, days.before}) {}
  bool isOpen() {
    return QTest::qWaitFor([&] { return window.document().open.volumes().size() == 2 && session().series(); },
                           longest);
  }
  bool showsInCell(int cell, const char* day) {
    return QTest::qWaitFor(
        [&] {
          const LoadedSeriesPtr shown = session().seriesOf(firstCell + cell);
          return shown && shown->series.studyDate == day;
        },
        longest);
  }
};

}  // namespace

class TestHanging : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void mammogramsFaceEachOther_data();
  void mammogramsFaceEachOther();
  void whatIsOpenedNextIsHung_data();
  void whatIsOpenedNextIsHung();
  void aGridThatWasChosenStays();
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
  void allThatIsMissingComesWhileOneScrolls();
  void thePriorStandsBeside();
  void withoutAPriorThereIsASentence();
  void theSecondViewFillsByItself();
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
    QCOMPARE(flatLookOf(w.workspace().view(firstCell + n)).turn.mirrored, n == 1);
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
  QTest::addColumn<bool>("isGridChosen");
  QTest::addColumn<bool>("isClosed");
  QTest::newRow("another patient over the hung grid") << 78 << false << false;
  QTest::newRow("another patient over a chosen grid") << 78 << true << false;
  QTest::newRow("the same study after it was closed") << 77 << false << true;
}

void TestHanging::whatIsOpenedNextIsHung() {
  QFETCH(int, patient);
  QFETCH(bool, isGridChosen);
  QFETCH(bool, isClosed);
  Mammograms first, next;
  next.patient = patient;
  QVERIFY(first.write() && next.write());
  HangingWindow w({first.folder.path()});
  QTRY_COMPARE_WITH_TIMEOUT(w.workspace().layout, Layout::four, longest);
  QVERIFY(w.facesEachOther(4));
  if (isGridChosen) w.child<QAction>("layoutTwo")->trigger();
  if (isClosed) {
    w.session().closeAll(w.window.document().open.everything());
    QVERIFY(!w.in(0));
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

// One of the same patient that the reader laid out by hand.
void TestHanging::aGridThatWasChosenStays() {
  const Mammograms data;
  QVERIFY(data.write());
  HangingWindow w;
  w.session().change(QStringLiteral("Layout"), withLayout(w.workspace(), Layout::two));
  w.window.open({data.folder.path()});
  QTRY_VERIFY_WITH_TIMEOUT(w.in(0) != nullptr, longest);
  QTest::qWait(100);
  QCOMPARE(w.workspace().layout, Layout::two);
}

// It is not in memory as its study is opened.
void TestHanging::aVolumeIsHungOnceItIsShown() {
  HangingProtocol mine;
  mine.name = "Mine", mine.automatic = true, mine.when.rule.modality = "CT";
  mine.series.resize(1);
  mine.series[0].name = "any";
  mine.cells.resize(2);
  for (ProtocolCell& cell : mine.cells) cell.series = "any";
  mine.cells[1].picture = CellPicture::coronal;
  QVERIFY(writePresetFile(mine.name, protocolToJson(mine), protocolFolder()));
  const TwoDays days;
  QVERIFY(days.write());
  HangingWindow w(QStringList{days.now});
  for (const PresetFile& file : readPresetFiles(protocolFolder()))
    QFile::remove(QString::fromStdString(file.path));
  QTRY_COMPARE_WITH_TIMEOUT(w.workspace().layout, Layout::two, longest);
  QVERIFY(w.in(0) && w.in(1));
  QCOMPARE(w.workspace().view(firstCell + 1).kind, ViewKind::coronal);
}

void TestHanging::aFrameThatCannotBeReadStopsNoOther() {
  const Mammograms data;
  QVERIFY(data.write(BreastSeries::ofEach));
  // Where the reader chose a grid one picture alone is read; the R CC is gone before it is.
  HangingWindow w;
  w.session().change(QStringLiteral("Layout"), withLayout(w.workspace(), Layout::two));
  w.window.open({data.folder.path()});
  QTRY_VERIFY_WITH_TIMEOUT(w.in(0) != nullptr, longest);
  QTest::qWait(100);
  QVERIFY(w.told(0) != QStringLiteral("R CC"));
  QVERIFY(QFile::remove(data.folder.filePath(QStringLiteral("1"))));
  w.child<QAction>("nextProtocol")->trigger();
  QCOMPARE(w.workspace().layout, Layout::four);
  QCOMPARE(w.told(0), QStringLiteral("R CC"));
  QTRY_VERIFY_WITH_TIMEOUT(flatLookOf(w.workspace().view(firstCell + 1)).turn.mirrored, longest);
  for (int n = 1; n < 4; ++n) {
    const auto isAtTheEdge = [&] { return w.frameView(n)->frame() && w.wallOff(n) < 0.5; };
    QVERIFY(QTest::qWaitFor(isAtTheEdge, longest));
  }
}

void TestHanging::aClickMeanwhileMakesNoSecondStep() {
  const Mammograms data;
  QVERIFY(data.write());
  HangingWindow w({data.folder.path()});
  QTRY_COMPARE_WITH_TIMEOUT(w.workspace().layout, Layout::four, longest);
  QVERIFY(w.facesEachOther(4));
  const int steps = w.session().undoStack().count();
  w.child<QAction>("nextProtocol")->trigger();
  w.session().setFocus(firstCell + 1);
  w.session().endGesture();
  QVERIFY(w.facesEachOther(2));
  QTRY_VERIFY(flatLookOf(w.workspace().view(firstCell + 1)).turn.mirrored);
  QCOMPARE(w.session().undoStack().count(), steps + 1);
  w.child<QAction>("undo")->trigger();
  QCOMPARE(w.workspace().layout, Layout::four);
}

void TestHanging::framesFaceEachOtherInViewsOfAnotherSize() {
  const Mammograms data;
  QVERIFY(data.write());
  HangingWindow w({data.folder.path()});
  QTRY_COMPARE_WITH_TIMEOUT(w.workspace().layout, Layout::four, longest);
  QVERIFY(w.facesEachOther(4));
  const int steps = w.session().undoStack().count();
  // One was moved by hand: it stays as it is.
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
  HangingProtocol mine;
  mine.name = "Mine", mine.series.resize(1), mine.cells.resize(2);
  mine.series[0].name = "any";
  for (ProtocolCell& cell : mine.cells) cell.series = "any";
  QVERIFY(writePresetFile(mine.name, protocolToJson(mine), protocolFolder()));
  TwoDaysWindow w(days);
  for (const PresetFile& file : readPresetFiles(protocolFolder()))
    QFile::remove(QString::fromStdString(file.path));
  QVERIFY(w.isOpen());
  w.child<QAction>("maximise")->trigger();
  QVERIFY(w.child<QAction>("maximise")->isChecked());
  w.child<QAction>(action.constData())->trigger();
  QVERIFY(!w.child<QAction>("maximise")->isChecked());
  for (int cell = 0; cell < 2; ++cell) QTRY_VERIFY(w.window.views()->viewOf(firstCell + cell)->isVisible());
}

void TestHanging::keysGoThroughWhatFits() {
  const Mammograms data;
  QVERIFY(data.write());
  HangingWindow w({data.folder.path()});
  QTRY_COMPARE_WITH_TIMEOUT(w.workspace().layout, Layout::four, longest);
  QVERIFY(w.facesEachOther(4));
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
  const Mammograms data;
  QVERIFY(data.write());
  HangingWindow w({data.folder.path()});
  QTRY_COMPARE_WITH_TIMEOUT(w.workspace().layout, Layout::four, longest);
  QVERIFY(w.facesEachOther(4));
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

void TestHanging::allThatIsMissingComesWhileOneScrolls() {
  const QTemporaryDir folder;
  QStringList paths;
  for (const char* day : {"20260301", "20250301", "20240301", "20230301"}) {
    paths << folder.filePath(QLatin1String(day));
    QVERIFY(TwoDays::writeDay(paths.back(), day));
  }
  HangingWindow w(paths);
  const auto volumes = [&] { return w.window.document().open.volumes(); };
  QTRY_VERIFY_WITH_TIMEOUT(volumes().size() == 4 && w.session().series(), longest);
  QTRY_VERIFY_WITH_TIMEOUT(!w.window.document().loader.isBusy(), longest);
  const SeriesKey shown = keyOf(w.session().series()->series);
  Workspace four = withLayout(w.workspace(), Layout::four);
  four = withSeries(std::move(four), firstCell, w.session().series()->series, {});
  std::vector<SeriesKey> wanted;
  for (const Series* series : volumes()) {
    if (keyOf(*series) == shown) continue;
    wanted.push_back(keyOf(*series));
    four = withSeries(std::move(four), firstCell + int(wanted.size()), *series, {});
  }
  four.focus = firstCell + 2;
  QSignalSpy began(&w.window.document().loader, &Loader::loadBegan);
  QSignalSpy givenUp(&w.window.document().loader, &Loader::loadGivenUp);
  w.session().change(QStringLiteral("Compare"), four);
  int turned = 0;
  const auto haveCome = [&] {
    wheel(w.window.views()->viewAs<FlatView>(firstCell), turned++ % 2 ? 1 : -1);
    return std::ranges::all_of(wanted,
                               [&](const SeriesKey& key) { return w.session().seriesNamed(key) != nullptr; });
  };
  QVERIFY(QTest::qWaitFor(haveCome, longest));
  QVERIFY2(turned > 1, "the wheel was turned while they came");
  QCOMPARE(givenUp.count(), 0);
  QCOMPARE(began.count(), 3);
  const std::size_t order[] = {1, 0, 2};  // the view in focus first
  for (int n = 0; n < 3; ++n) QVERIFY(keyOf(began[n][0].value<Series>()) == wanted[order[n]]);
}

void TestHanging::thePriorStandsBeside() {
  const TwoDays days;
  QVERIFY(days.write());
  TwoDaysWindow w(days);
  QVERIFY(w.isOpen());
  const Workspace before = w.workspace();
  const int steps = w.session().undoStack().count();
  QTest::keyClick(&w.window, Qt::Key_7, Qt::AltModifier);
  QCOMPARE(w.workspace().layout, Layout::two);
  QVERIFY(w.showsInCell(0, "20260301") && w.showsInCell(1, "20240215"));
  QCOMPARE(w.workspace().focus, firstCell);
  const auto dateOf = [&](int cell) {
    return w.window.views()->viewAs<FlatView>(firstCell + cell)->overlays().date;
  };
  QCOMPARE(dateOf(0), QStringLiteral("2026-03-01"));
  QCOMPARE(dateOf(1), QStringLiteral("2024-02-15"));
  w.shot("prior");
  QCOMPARE(w.session().undoStack().count(), steps + 1);
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.workspace().views == before.views && w.workspace().layout == before.layout);
}

void TestHanging::withoutAPriorThereIsASentence() {
  const TwoDays days;
  QVERIFY(days.write());
  HangingWindow w(QStringList{days.before});
  QTRY_VERIFY_WITH_TIMEOUT(w.session().series() != nullptr, longest);
  const Workspace before = w.workspace();
  w.child<QAction>("comparePrior")->trigger();
  QVERIFY(w.complaint().startsWith(QStringLiteral("No earlier study")));
  QVERIFY(w.workspace() == before);
}

void TestHanging::theSecondViewFillsByItself() {
  const TwoDays days;
  QVERIFY(days.write());
  TwoDaysWindow w(days);
  QVERIFY(w.isOpen());
  const int steps = w.session().undoStack().count();
  w.child<QAction>("layoutTwo")->trigger();
  QVERIFY(w.showsInCell(0, "20260301") && w.showsInCell(1, "20240215"));
  QCOMPARE(w.session().undoStack().count(), steps + 1);
}

VOLUMEN_TEST(TestHanging);
#include "tst_hanging.moc"
