#include "ui/controller/next_time_point.h"

#include <algorithm>

#include "ui/controller/loader.h"
#include "ui/workspace/time_points.h"

namespace volumen {

NextTimePoint::NextTimePoint(Session& session, Loader& loader, QObject* parent)
    : QObject(parent), session_(session), loader_(loader) {
  connect(&session_, &Session::workspaceChanged, this, &NextTimePoint::look);
  connect(&loader_, &Loader::loadedAhead, &session_, &Session::keep);
  connect(&loader_, &Loader::busyChanged, this, [this](bool busy) {
    if (!busy) look();
  });
}

void NextTimePoint::look() {
  const Workspace& workspace = session_.workspace();
  const ViewState& view = workspace.view(workspace.focus);
  const ShownSeriesPtr shown = session_.seriesOf(workspace.focus);
  if (loader_.isBusy() || !shown || view.kind == ViewKind::frames || seen_.lock() == shown) return;
  seen_ = shown;
  const std::vector<const Series*> steps = timePointsOf(workspace, view.series);
  const auto at = std::ranges::find(steps, view.series, [](const Series* s) { return keyOf(*s); });
  if (steps.size() < 2 || at == steps.end()) return;
  const Series& next = at + 1 == steps.end() ? *steps.front() : **(at + 1);
  const bool isMissing = workspace.series.at(keyOf(next)).missing.has_value();
  // The steps of a series are of one grid and size.
  if (isMissing || session_.seriesNamed(keyOf(next)) || !session_.pool().hasRoomFor(shown->volume->bytes()))
    return;
  loader_.loadAhead(next);
}

}  // namespace volumen
