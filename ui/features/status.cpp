#include "results/text/series_text.h"
#include "ui/features/feature.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/status_line.h"

namespace volumen {

namespace {

// Shows the position under the pointer and warnings about the series in focus in the status line.
class StatusTexts : public Feature {
 public:
  explicit StatusTexts(Workbench& bench);

 private:
  void showWarnings();
};

StatusTexts::StatusTexts(Workbench& bench) : Feature(bench) {
  connect(&grid_, &ViewGrid::hovered, &bench_.status, &StatusLine::showHover);
  connect(&session_, &Session::workspaceChanged, this, &StatusTexts::showWarnings);
}

// For frames and series being read, the warnings come from the headers.
void StatusTexts::showWarnings() {
  const Workspace& workspace = session_.workspace();
  const Series* series = seriesIn(workspace, workspace.focus);
  const LoadedSeriesPtr read =
      showsFrames(workspace, workspace.focus) ? nullptr : session_.seriesOf(workspace.focus);
  bench_.status.showWarnings(read     ? warningSentences(read->warnings)
                             : series ? warningSentences(series->warnings)
                                      : QStringList());
}

}  // namespace

std::unique_ptr<Feature> makeStatus(Workbench& bench) { return std::make_unique<StatusTexts>(bench); }

}  // namespace volumen
