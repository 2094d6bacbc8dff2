// Tasks of tasks.md: MR, PET/CT and studies of before.
#include <QSlider>
#include <QToolButton>

#include "tests/fixtures/fixtures.h"
#include "tests/ui/frames_window.h"
#include "tests/ui/hand.h"
#include "tests/ui/measure_window.h"
#include "tests/ui/two_series.h"
#include "ui/workspace/flat_plane.h"

namespace volumen::tests {

namespace {

int twoSeries() {
  MeasureWindow w;
  Hand hand(w.window);
  const LoadedSeriesPtr second = ballSeries();
  w.session().show(second, firstComparedId + 1);
  w.session().setFocus(axialViewId);
  hand.key(Qt::Key_4, Qt::AltModifier);
  DONE(w.session().workspace().layout == withLayout(w.session().workspace(), Layout::two).layout);
  for (const ViewId id : {left, right}) DONE(!w.session().workspace().view(id).series.empty());
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
  auto* button = w.child<QToolButton>("linkButton");
  hand.click(button);
  QMenu* menu = button->menu();
  for (QAction* action : menu->actions())
    if (action->objectName() == QLatin1String("lockHere")) hand.choose(menu, action);
  const double apart = w.z(left) - w.z(right);
  wheel(w.view(left), -3);
  DONE(w.z(left) - w.z(right) == apart);
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

// The PET of a study over its CT.
struct PetCt : Journey {
  Hand hand{window};
  PetCt()
      : Journey({QString::fromStdString(dataPath("pet-ct/sts019-ct")),
                 QString::fromStdString(dataPath("pet-ct/sts019-pet"))}) {}
  const Workspace& workspace() { return window.session().workspace(); }
};

}  // namespace

std::vector<Task> comparingTasks() {
  return {{15, twoSeries}, {16, linkedScrolling}, {17, lockedStudies}, {20, automaticWindow}};
}

}  // namespace volumen::tests
