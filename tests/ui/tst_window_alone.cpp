// Guards that a view may have a window alone. One series is shown side by side in two windows, and everything
// that sets a window sets that of the view. Real events.
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QMenu>

#include "results/pictures/overlays.h"
#include "tests/ui/frames_window.h"
#include "tests/ui/hanging_window.h"
#include "tests/ui/two_series.h"
#include "tests/unit/suite.h"
#include "ui/views/colour_bar.h"
#include "ui/workspace/key_image_list.h"
#include "ui/workspace/session_json.h"
#include "ui/workspace/view_window.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr Window ofLung{-600, 1500}, ofBall{500, 1000};

// One series in both views, the left one with a window alone.
struct AloneWindow : TwoSeries {
  explicit AloneWindow(const LoadedSeriesPtr& a = ballIn("A")) : AloneWindow(a, a) {}
  AloneWindow(const LoadedSeriesPtr& a, const LoadedSeriesPtr& b) : TwoSeries(a, b) { press("windowAlone"); }

  std::optional<ChosenWindow> alone(ViewId id) { return flatLookOf(workspace().view(id)).windowAlone; }
  std::optional<Window> ofSeries(ViewId id) {
    return workspace().series.at(workspace().view(id).series).window;
  }
  // Returns the grey of the air beside the ball on screen.
  int air(ViewId id) {
    const SlicePlane now = plane(id);
    const glm::dvec2 p = now.pixelFromPatient(now.centre + 13.0 * now.right);
    return qGray(view(id)->picture().pixel(int(p.x), int(p.y)));
  }
};

// Returns LINEAR of DICOM (PS3.3 C.11.2.1.2.1), /255.
double linearGrey(double value, Window window) {
  return 255 * std::clamp((value - (window.centre - 0.5)) / (window.width - 1) + 0.5, 0.0, 1.0);
}

}  // namespace

class TestWindowAlone : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void oneSeriesIsSeenByTwoWindows();
  void allThatSetsAWindowSetsThatOfTheView_data();
  void allThatSetsAWindowSetsThatOfTheView();
  void aColourBarSetsThatOfTheView();
  void withoutItTheViewHasThatOfTheSeries();
  void picturesHaveIt();
  void linksLeaveItAlone();
  void itIsKeptInTheSession();
  void keyImagesAreOfTheWindowTheyWereMarkedBy();
  void aProtocolShowsLungAndSoftTissue();
  void framesHaveOneToo();
  void coloursHaveNone();
};

// The bound is one grey level, for rounding.
void TestWindowAlone::oneSeriesIsSeenByTwoWindows() {
  AloneWindow w;
  QVERIFY(w.child<QAction>("windowAlone")->isChecked());
  QTest::keyClick(w.view(left), Qt::Key_6);
  QVERIFY(w.alone(left) && w.alone(left)->window == ofLung);
  QVERIFY(!w.ofSeries(left));
  QTRY_VERIFY_WITH_TIMEOUT(std::abs(w.air(left) - linearGrey(0, ofLung)) <= 1, longest);
  QTRY_VERIFY_WITH_TIMEOUT(std::abs(w.air(right) - linearGrey(0, ofBall)) <= 1, longest);
  QCOMPARE(w.view(left)->overlays().bottomRight, QStringLiteral("Lung  W 1500 L -600 (this view)"));
  QCOMPARE(w.view(right)->overlays().bottomRight, QStringLiteral("W 1000 L 500"));
  const auto larger = w.view(left)->requestFor({64, 64});
  QVERIFY2(larger && larger->layers[0].grey.window == ofLung, "a picture of another size has it, too");
  QTest::mouseClick(w.view(right), Qt::LeftButton, {}, {100, 100});
  QVERIFY(!w.child<QAction>("windowAlone")->isChecked());
  w.shot("window-alone");
}

void TestWindowAlone::allThatSetsAWindowSetsThatOfTheView_data() {
  using Act = std::function<void(AloneWindow&)>;
  QTest::addColumn<Act>("act");
  const auto row = [](const char* name, const Act& act) { QTest::newRow(name) << act; };
  row("a drag", [](AloneWindow& w) { drag(w.view(left), {100, 100}, {140, 130}); });
  row("a digit", [](AloneWindow& w) { QTest::keyClick(w.view(left), Qt::Key_5); });
  row("the box of a region", [](AloneWindow& w) {
    w.press("regionWindowTool");
    const QPointF middle = QRectF(w.view(left)->rect()).center();
    drag(w.view(left), middle - QPointF(60, 60), middle + QPointF(60, 60));
  });
  row("a name of the menu", [](AloneWindow& w) {
    auto* menu = w.child<QMenu>("windowMenu");
    Q_EMIT menu->aboutToShow();
    menu->actions().at(3)->trigger();
  });
  row("a field of the panel", [](AloneWindow& w) {
    auto* field = w.child<QDoubleSpinBox>("flatWidth");
    QTRY_COMPARE_WITH_TIMEOUT(field->value(), 1000.0, longest);
    field->setFocus();
    field->selectAll();
    QTest::keyClicks(field, QStringLiteral("300"));
    QTest::keyClick(field, Qt::Key_Return);
    QVERIFY(w.alone(left)->window == Window({500, 300}));
  });
  row("a name of the panel", [](AloneWindow& w) {
    auto* box = w.child<QComboBox>("flatWindowChoice");
    const auto lung = [&] { return box->findText(QStringLiteral("Lung"), Qt::MatchStartsWith); };
    QTRY_VERIFY_WITH_TIMEOUT(lung() > 0, longest);
    Q_EMIT box->activated(lung());
    QVERIFY(w.alone(left)->window == ofLung);
  });
  row("numbers typed in the corner", [](AloneWindow& w) {
    const Overlays over = w.view(left)->overlays();
    const QRectF besideTheBar = QRectF(w.view(left)->rect()).adjusted(0, 0, -6, 0);
    for (const PlacedText& text : placeOverlays(over, besideTheBar, w.view(left)->font()).texts)
      if (text.text == over.bottomRight)
        QTest::mouseClick(w.view(left), Qt::LeftButton, {}, text.rect.center().toPoint());
    auto *width = w.child<QLineEdit>("flatWindowWidth"), *centre = w.child<QLineEdit>("flatWindowCentre");
    QVERIFY(width && centre);
    QTest::keyClicks(width, QStringLiteral("800"));
    QTest::keyClick(width, Qt::Key_Tab);
    QTest::keyClicks(centre, QStringLiteral("300"));
    QTest::keyClick(centre, Qt::Key_Return);
    QVERIFY(w.alone(left)->window == Window({300, 800}));
  });
}

void TestWindowAlone::allThatSetsAWindowSetsThatOfTheView() {
  QFETCH(std::function<void(AloneWindow&)>, act);
  AloneWindow w;
  const Workspace before = w.workspace();
  const int steps = w.session().undoStack().index();
  act(w);
  QVERIFY(w.alone(left) && w.alone(left)->window);
  QVERIFY(!w.ofSeries(left) && !w.alone(right));
  QVERIFY(w.view(right)->windowShown() == ofBall);
  QCOMPARE(w.session().undoStack().index(), steps + 1);
  w.press("undo");
  QVERIFY(w.workspace() == before);
}

// The window starts at 0 to 1000, and is dragged, then typed. Colours are those of the series in both views.
void TestWindowAlone::aColourBarSetsThatOfTheView() {
  AloneWindow w;
  w.session().change(QStringLiteral("test"), [&](Workspace& all) {
    all.series.edit(w.view(left)->state().series).colours = ColourMap::hotIron;
  });
  w.session().endGesture();
  const QRectF bar = colourBarRect(w.view(left)->rect());
  const QPointF top = QPointF(bar.center().x(), bar.top() + 1).toPoint();
  drag(w.view(left), top, top - QPointF(0, 20));
  QVERIFY(w.alone(left)->window);
  const double wide = 1000 * (1 + 20 / bar.height());
  QVERIFY(std::abs(w.alone(left)->window->width - wide) < 1e-6);
  QVERIFY(std::abs(w.alone(left)->window->centre - wide / 2) < 1e-6);
  QTest::mouseDClick(w.view(left), Qt::LeftButton, {}, bar.center().toPoint());
  auto *low = w.child<QLineEdit>("barLow"), *high = w.child<QLineEdit>("barHigh");
  QVERIFY(low && high);
  QTest::keyClicks(low, QStringLiteral("100"));
  QTest::keyClick(low, Qt::Key_Tab);
  QTest::keyClicks(high, QStringLiteral("900"));
  QTest::keyClick(high, Qt::Key_Return);
  QVERIFY(w.alone(left)->window == Window({500, 800}));
  QVERIFY(!w.ofSeries(left) && !w.alone(right) && w.view(right)->windowShown() == ofBall);
}

void TestWindowAlone::withoutItTheViewHasThatOfTheSeries() {
  AloneWindow w;
  QTest::keyClick(w.view(left), Qt::Key_6);
  QTest::keyClick(w.view(right), Qt::Key_5);
  QVERIFY2(w.ofSeries(right) == Window({400, 2000}), "that of the view at the right is the series'");
  QVERIFY(w.view(left)->windowShown() == ofLung);
  QTest::mouseClick(w.view(left), Qt::RightButton, {}, {100, 100});
  const Workspace before = w.workspace();
  auto* menu = w.child<QMenu>("flatMenu");
  QVERIFY(menu && menu->isVisible());
  QAction* entry = w.child<QAction>("windowAlone");
  QVERIFY(menu->actions().contains(entry) && entry->isChecked());
  menu->close();
  entry->trigger();
  QVERIFY(!w.alone(left) && !entry->isChecked());
  QVERIFY(w.view(left)->windowShown() == Window({400, 2000}));
  w.press("undo");
  QVERIFY(w.workspace() == before && entry->isChecked());
}

// Compares a view's copied picture beside the ball. The bound is one grey level, for rounding.
void TestWindowAlone::picturesHaveIt() {
  AloneWindow w;
  QTest::keyClick(w.view(left), Qt::Key_6);
  QTRY_VERIFY_WITH_TIMEOUT(std::abs(w.air(left) - linearGrey(0, ofLung)) <= 1, longest);
  QTRY_VERIFY_WITH_TIMEOUT(std::abs(w.air(right) - linearGrey(0, ofBall)) <= 1, longest);
  const auto captured = [&](ViewId id) {
    const SlicePlane plane = w.plane(id);
    const glm::dvec2 p = plane.pixelFromPatient(plane.centre + 9.0 * (plane.right + plane.down));
    return qGray(w.view(id)->capture().pixel(int(p.x), int(p.y)));
  };
  QVERIFY(std::abs(captured(left) - linearGrey(0, ofLung)) <= 1);
  QVERIFY(std::abs(captured(right) - linearGrey(0, ofBall)) <= 1);
}

void TestWindowAlone::linksLeaveItAlone() {
  AloneWindow w(ballIn("A"), ballIn("B"));
  w.press("linkWindow");
  QTest::keyClick(w.view(right), Qt::Key_5);
  QVERIFY(w.ofSeries(right) == Window({400, 2000}));
  QVERIFY(w.view(left)->windowShown() == ofBall);
  QTest::keyClick(w.view(left), Qt::Key_6);
  QVERIFY(w.view(left)->windowShown() == ofLung);
  QVERIFY(w.view(right)->windowShown() == Window({400, 2000}));
}

void TestWindowAlone::itIsKeptInTheSession() {
  AloneWindow w;
  QTest::keyClick(w.view(left), Qt::Key_6);
  const Workspace& now = w.workspace();
  const Result<std::string> text = sessionToJson(now, "");
  QVERIFY2(text, text ? "" : text.message().c_str());
  const auto back = sessionFromJson(*text, [&](const SavedSeries& saved) {
    return now.series.at({saved.series.path, saved.series.id}).series;
  });
  QVERIFY2(back, back ? "" : back.message().c_str());
  QVERIFY2(text->find("windowAlone") == text->rfind("windowAlone"), "of the one view alone");
  const auto kept = flatLookOf(back->workspace.view(left)).windowAlone;
  QVERIFY(kept && kept->window == ofLung);
  QVERIFY(!flatLookOf(back->workspace.view(right)).windowAlone);
}

// The left image has the view's own window, the right one the series window at that time.
void TestWindowAlone::keyImagesAreOfTheWindowTheyWereMarkedBy() {
  auto ball = std::make_shared<LoadedSeries>(*ballIn("A"));
  for (int n = 0; n < 32; ++n) {
    ball->series.sopInstanceUids.push_back("1.2.3." + std::to_string(n));
    ball->series.frames.push_back(0);
  }
  AloneWindow w(ball);
  QTest::keyClick(w.view(left), Qt::Key_6);
  w.press("keyImage");
  QTest::mouseClick(w.view(right), Qt::LeftButton, {}, {100, 100});
  w.scroll(right, 3);
  w.press("keyImage");
  const auto listed = [&] { return listKeyImages(w.workspace(), {}, {}).at(0).pictures; };
  QCOMPARE(w.workspace().keyImages.size(), std::size_t(2));
  QCOMPARE(listed().size(), std::size_t(2));
  QTest::keyClick(w.view(right), Qt::Key_5);
  const auto windowOf = [&](std::size_t n) {
    const PictureStop stop = viewOfKeyImage(w.workspace(), listed().at(n), ball);
    return seriesStateIn(stop.workspace, stop.view).window;
  };
  QVERIFY(windowOf(0) == ofLung);
  QVERIFY(windowOf(1) == Window({400, 2000}));
  const Result<std::string> text = sessionToJson(w.workspace(), "");
  QVERIFY2(text, text ? "" : text.message().c_str());
  const auto back = sessionFromJson(*text, [&](const SavedSeries& saved) {
    return w.workspace().series.at({saved.series.path, saved.series.id}).series;
  });
  QVERIFY2(back, back ? "" : back.message().c_str());
  QVERIFY(back->workspace.keyImages == w.workspace().keyImages);
  // It is the same key image in another window.
  w.session().setFocus(left);
  QTest::keyClick(w.view(left), Qt::Key_5);
  w.press("keyImage");
  QCOMPARE(listed().size(), std::size_t(1));
}

void TestWindowAlone::aProtocolShowsLungAndSoftTissue() {
  const TwoDays days;
  QVERIFY(TwoDays::writeDay(days.now, "20260301"));
  HangingWindow w(QStringList{days.now});
  QTRY_VERIFY_WITH_TIMEOUT(w.session().series() && !w.window.document().loader.isBusy(), longest);
  const Workspace before = w.workspace();
  const int steps = w.session().undoStack().index();
  auto* menu = w.child<QMenu>("protocolMenu");
  menu->popup({10, 10});
  for (QAction* action : menu->actions())
    if (action->text() == QStringLiteral("CT, lung and soft tissue")) action->trigger();
  menu->close();
  const auto said = [&](int cell) {
    const auto* view = w.window.views()->viewAs<FlatView>(firstCell + cell);
    return view && view->shown() ? view->overlays().bottomRight : QString();
  };
  QTRY_COMPARE_WITH_TIMEOUT(said(0), QStringLiteral("Lung  W 1500 L -600 (this view)"), longest);
  QTRY_COMPARE_WITH_TIMEOUT(said(1), QStringLiteral("Abdomen  W 400 L 40 (this view)"), longest);
  QVERIFY(w.in(0) && w.in(1) && keyOf(*w.in(0)) == keyOf(*w.in(1)));
  QCOMPARE(w.session().undoStack().index(), steps + 1);
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.workspace().views == before.views && w.workspace().series == before.series);
}

void TestWindowAlone::framesHaveOneToo() {
  NEED_DATA(dataPath("dicom-2d"));
  Frames w({"cr-hip-mono2-jpeg12.dcm"});
  QVERIFY(w.shows());
  w.child<QAction>("windowAlone")->trigger();
  QVERIFY(w.after([&] { drag(w.view(), {100, 100}, {140, 130}); }));
  const SeriesState& series = w.workspace().series.at(w.view()->state().series);
  QVERIFY(!series.window && w.look().windowAlone && w.look().windowAlone->window);
  QVERIFY(w.view()->windowShown() == w.look().windowAlone->window);
  QVERIFY(w.press(Qt::Key_0));
  QVERIFY2(w.look().windowAlone == ChosenWindow(), "automatic, and still alone");
}

void TestWindowAlone::coloursHaveNone() {
  NEED_DATA(dataPath("dicom-2d"));
  Frames w({"sc-rgb-41.dcm"});
  QVERIFY(w.shows());
  QAction* action = w.child<QAction>("windowAlone");
  QTRY_VERIFY_WITH_TIMEOUT(!action->isEnabled(), longest);
  auto* menu = w.child<QMenu>("windowMenu");
  Q_EMIT menu->aboutToShow();
  QVERIFY(menu->actions().front()->text().startsWith(QStringLiteral("Colours are shown as they are")));
  // A session may give colours a window alone, which is not mentioned.
  w.session().change(QStringLiteral("test"), withWindowAlone(w.workspace(), axialViewId, true));
  QVERIFY(w.look().windowAlone);
  QCOMPARE(w.view()->overlays().bottomRight, QString());
  // Grey frames that replace them have a window.
  w.window.open({dataFile("cr-hip-mono2-jpeg12.dcm")});
  QTRY_VERIFY_WITH_TIMEOUT(w.view()->windowShown() && action->isEnabled(), longest);
  w.child<QAction>("undo")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(!action->isEnabled(), longest);
}

VOLUMEN_TEST(TestWindowAlone);
#include "tst_window_alone.moc"
