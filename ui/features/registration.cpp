#include <QMenu>
#include <QToolButton>
#include <algorithm>

#include "ui/controller/registration_jobs.h"
#include "ui/features/feature.h"
#include "ui/panels/link_menu.h"
#include "ui/workspace/links.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

// Returns whether a series in this frame of reference is open.
bool holdsFrame(const Workspace& workspace, const std::string& frame) {
  return std::ranges::any_of(workspace.series,
                             [&](const auto& s) { return frameOfReference(*s.second.series) == frame; });
}

// Links views and registers frames of reference to each other.
class Registration : public Feature {
 public:
  explicit Registration(Workbench& bench);

 private:
  void registerViews();

  RegistrationJobs registrar_;
};

Registration::Registration(Workbench& bench) : Feature(bench), registrar_(bench.document.jobs, this) {
  QMenu* menu = makeLinkMenu(
      session_, [this] { registerViews(); }, &bench_.window);
  bench_.menus.addMenu(menu, {{"viewMenu", 60, 70}});
  for (QAction* action : menu->actions())
    if (!action->isSeparator()) bench_.addAction(action, {});
  QToolButton* button = bench_.addMenuButton("linkButton", 30);
  button->setDefaultAction(menu->menuAction());
  button->setPopupMode(QToolButton::InstantPopup);  // the action had set a menu that opens by its arrow only
  connect(&registrar_, &RegistrationJobs::failed, this,
          [this](const QString& sentence) { warnUntilDone(sentence); });
  connect(&registrar_, &RegistrationJobs::found, this,
          [this](const std::string& from, const std::string& to, const Rigid& toFromFrom) {
            session_.endGesture();
            session_.change(tr("Register"), withRegistration(session_.workspace(), from, to, toFromFrom));
          });
  const auto cancelIfClosed = [this] {
    const Workspace& workspace = session_.workspace();
    const auto pair = registrar_.pair();
    if (pair && !(holdsFrame(workspace, pair->first) && holdsFrame(workspace, pair->second)))
      registrar_.cancel();
  };
  whenChanged(session_, this, cancelIfClosed, &Workspace::series);
}

// Registers the view in focus with the first one in another frame of reference.
void Registration::registerViews() {
  const std::vector<ViewId> others = viewsOfOtherFrames(session_.workspace());
  if (others.empty()) return;
  const LoadedSeriesPtr fixed = session_.seriesOf(session_.workspace().focus);
  const LoadedSeriesPtr moving = session_.seriesOf(others.front());
  if (!fixed || !moving) return warn(tr("A series is still being loaded: try again."));
  registrar_.start({frameOfReference(fixed->series), fixed->volume},
                   {frameOfReference(moving->series), moving->volume});
}

}  // namespace

std::unique_ptr<Feature> makeRegistration(Workbench& bench) { return std::make_unique<Registration>(bench); }

}  // namespace volumen
