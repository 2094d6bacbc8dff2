#include <algorithm>

#include "ui/controller/registrar.h"
#include "ui/controller/time_points_ahead.h"
#include "ui/main_window.h"
#include "ui/widgets/banner.h"
#include "ui/workspace/links.h"

namespace volumen {

namespace {

// Whether a series of this frame of reference is open.
bool holdsFrame(const Workspace& workspace, const std::string& frame) {
  return std::ranges::any_of(workspace.series,
                             [&](const auto& s) { return frameOfReference(*s.second.series) == frame; });
}

}  // namespace

void MainWindow::connectLinks() {
  new TimePointsAhead(session_, loader_, this);
  registrar_ = new Registrar(jobs_, this);
  connect(registrar_, &Registrar::failed, this, [this](const QString& sentence) { banner_->tell(sentence); });
  connect(registrar_, &Registrar::found, this,
          [this](const std::string& from, const std::string& to, const Rigid& toFromFrom) {
            session_.endGesture();
            session_.change(tr("Register"), withRegistration(session_.workspace(), from, to, toFromFrom));
          });
  connect(&session_, &Session::workspaceChanged, registrar_,
          [this](const Workspace&, const Workspace& after) {
            const auto pair = registrar_->pair();
            if (pair && !(holdsFrame(after, pair->first) && holdsFrame(after, pair->second)))
              registrar_->cancel();
          });
}

// The view in focus and the first one beside it that lies elsewhere.
void MainWindow::registerViews() {
  const std::vector<ViewId> others = viewsOfOtherFrames(session_.workspace());
  if (others.empty()) return;
  const ShownSeriesPtr fixed = session_.seriesOf(session_.workspace().focus);
  const ShownSeriesPtr moving = session_.seriesOf(others.front());
  if (!fixed || !moving) return banner_->tell(tr("A series is still being loaded: try again."));
  registrar_->start({frameOfReference(fixed->series), fixed->volume},
                    {frameOfReference(moving->series), moving->volume});
}

}  // namespace volumen
