// Tasks of tasks.md: MR, PET/CT and prior studies.
#include <QSlider>
#include <QToolButton>
#include <QTreeWidget>

#include "tests/fixtures/fixtures.h"
#include "tests/ui/frames_window.h"
#include "tests/ui/hand.h"
#include "tests/ui/hung_studies.h"
#include "tests/ui/measure_window.h"
#include "tests/ui/two_series.h"
#include "ui/views/reference_lines.h"
#include "ui/workspace/flat_plane.h"

namespace volumen::tests {

namespace {

// The same series of two dates, opened from its files.
struct TwoOpen {
  TwoDays days;
  std::unique_ptr<Journey> w;

  bool open() {
    if (!days.write()) return false;
    w = std::make_unique<Journey>(QStringList{days.now, days.before});
    return QTest::qWaitFor(
        [&] { return w->window.document().open.volumes().size() == 2 && w->window.session().series(); },
        longest);
  }
  std::string dayIn(ViewId id) const {
    const Series* series = seriesIn(w->window.session().workspace(), id);
    return series ? series->studyDate : std::string();
  }
};

int twoSeries() {
  TwoOpen t;
  DONE(t.open());
  Hand hand(t.w->window);
  hand.key(Qt::Key_4, Qt::AltModifier);
  DONE(t.dayIn(left) == "20260301" && t.dayIn(right) == "20240215");
  SOON(t.w->window.session().seriesOf(right));
  return hand.steps();
}

int linkedScrolling() {
  TwoSeries w(ballIn("A"), ballIn("A", 2));
  Hand hand(w.window);
  wheel(w.view(left), -3);
  DONE(w.z(left) == w.z(right));
  return hand.steps();
}

int lockedStudies() {
  TwoSeries w(ballIn("A"), ballIn("B"));
  Hand hand(w.window);
  hand.menuOf(w.child<QToolButton>("linkButton"), "lockHere");
  const double apart = w.z(left) - w.z(right);
  wheel(w.view(left), -3);
  DONE(std::abs(w.z(left) - w.z(right) - apart) < 1e-9);
  return hand.steps();
}

int automaticWindow() {
  MeasureWindow w;
  w.view()->setFocus();
  drag(w.view(), {50, 50}, {90, 50});
  Hand hand(w.window);
  hand.key(Qt::Key_0);
  DONE(!w.session().workspace().series.begin()->second.window);
  return hand.steps();
}

int referenceLines() {
  TwoSeries w(ballIn("A"), ballIn("A"));
  Hand hand(w.window);
  w.session().showAs(right, ViewKind::coronal);
  DONE(w.session().preferences().referenceLines && !w.view(left)->referenceLines().empty());
  return hand.steps();
}

// A PET and the CT of its study, fused by a click on the PET.
struct PetCt : Journey {
  Hand hand{window};

  PetCt() : Journey({QString::fromStdString(dataPath("pet-ct/sts019-ct"))}) {
    openAlone(false);
    window.document().loader.open(QString::fromStdString(dataPath("pet-ct/sts019-pet")));  // not shown yet
  }
  ~PetCt() { openAlone(); }
  const Workspace& workspace() { return window.session().workspace(); }
  FlatView* view() { return window.views()->viewAs<FlatView>(axialViewId); }
  FlatLook look() { return flatLookOf(workspace().view(axialViewId)); }
  bool isFused() {
    const auto isOpen = [&] {
      return window.session().series() && window.document().open.volumes().size() == 2;
    };
    if (!QTest::qWaitFor(isOpen, longest)) return false;
    auto* tree = child<QTreeWidget>("studyTree");
    for (QTreeWidgetItemIterator it(tree); *it; ++it)
      if ((*it)->text(0).startsWith(QStringLiteral("PT IBSI")) && (*it)->childCount() == 0) {
        hand.click(tree->viewport(), tree->visualItemRect(*it).center());
        break;
      }
    return QTest::qWaitFor([&] { return view() && !look().overlay.empty() && view()->shown(); }, longest);
  }
};

int fuse() {
  PetCt w;
  DONE(w.isFused());
  return w.hand.steps();
}

int fusionOpacity() {
  PetCt w;
  DONE(w.isFused());
  Hand hand(w.window);
  w.window.session().setFocus(axialViewId);
  QCoreApplication::processEvents();
  auto* slider = w.child<QWidget>("overlayOpacityRow")->findChild<QSlider*>();
  DONE(slider && slider->isVisible());
  const double before = w.look().overlayOpacity;
  hand.drag(slider, {slider->width() / 2.0, slider->height() / 2.0},
            {slider->width() - 4.0, slider->height() / 2.0});
  DONE(w.look().overlayOpacity > before);
  return hand.steps();
}

int suvMax() {
  MeasureWindow w(petIn("A"));
  w.view()->setFocus();
  Hand hand(w.window);
  hand.key(Qt::Key_E);
  const QPointF middle(w.view()->rect().center());
  hand.drag(w.view(), middle - QPointF(20, 20), middle + QPointF(20, 20));
  SOON(w.all().size() == 1 &&
       w.drawn(w.last().id).text.join(QLatin1Char('\n')).contains(QStringLiteral("SUVmax")));
  return hand.steps();
}

int rotatingProjection() {
  PetCt w;
  DONE(w.isFused());
  VolumeView* scene = w.window.view();
  SOON(!scene->picture().isNull());
  DONE(w.window.session().scene().mode == Mode::mip);
  const Camera before = scene->camera();
  w.hand.drag(scene, {100, 100}, {140, 100});
  DONE(!(scene->camera() == before));
  return w.hand.steps();
}

int prior() {
  TwoOpen t;
  DONE(t.open());
  Hand hand(t.w->window);
  hand.key(Qt::Key_7, Qt::AltModifier);
  DONE(t.dayIn(left) == "20260301" && t.dayIn(right) == "20240215");
  return hand.steps();
}

}  // namespace

std::vector<Task> comparingTasks() {
  return {{15, twoSeries},      {16, linkedScrolling}, {17, lockedStudies},
          {18, referenceLines}, {20, automaticWindow}, {21, fuse},
          {22, fusionOpacity},  {23, suvMax},          {24, rotatingProjection},
          {33, prior}};
}

}  // namespace volumen::tests
