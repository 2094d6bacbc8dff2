#include <algorithm>
#include <set>

#include "ui/data/frame_series.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/hanging_protocol.h"
#include "ui/workspace/value_text.h"

namespace volumen {

namespace {

// Without what would read as several alternatives.
std::string oneOnly(const std::string& text) { return text.substr(0, text.find('|')); }

SeriesRule ruleOf(const SeriesPicture& picture) {
  const Series& series = *picture.series;
  const ProjectionView projection = projectionOf(series, picture.frame);
  SeriesRule rule;
  rule.modality = oneOnly(series.modality);
  rule.laterality = oneOnly(projection.laterality);
  rule.viewPosition = oneOnly(projection.viewPosition);
  if (rule.viewPosition.empty()) rule.description = oneOnly(series.description);
  rule.plane = acquiredPlaneOf(series);
  return rule;
}

CellPicture pictureOf(ViewKind kind, const Series& series) {
  if (showsScene(kind)) return CellPicture::scene;
  if (showsFrames(kind)) return opensAsPictures(series) ? CellPicture::asAcquired : CellPicture::frames;
  if (kind == acquiredKind(series.acquired)) return CellPicture::asAcquired;
  return kind == ViewKind::axial     ? CellPicture::axial
         : kind == ViewKind::coronal ? CellPicture::coronal
                                     : CellPicture::sagittal;
}

// Collects the series that cells name.
class ProtocolMaker {
 public:
  explicit ProtocolMaker(const Workspace& workspace) : workspace_(workspace) {
    for (const ViewId id : viewsOnScreen(workspace))
      if (const Series* series = seriesIn(workspace, id)) days_.insert(series->studyDate);
  }

  std::string nameOf(const SeriesPicture& picture) {
    const Series& series = *picture.series;
    const auto known = std::ranges::find(pictures_, picture);
    if (known != pictures_.end()) return protocol.series[std::size_t(known - pictures_.begin())].name;
    ProtocolSeries entry;
    entry.rule = ruleOf(picture);
    entry.prior = int(std::ranges::count_if(days_, [&](const auto& day) { return day > series.studyDate; }));
    const std::string words = oneOnly(series.description.empty() ? series.modality : series.description);
    entry.name = words.empty() ? "series" : words;
    for (int n = 2; std::ranges::count(protocol.series, entry.name, &ProtocolSeries::name) > 0; ++n)
      entry.name = words + " " + std::to_string(n);
    protocol.when.prior = protocol.when.prior || entry.prior > 0;
    pictures_.push_back(picture);
    protocol.series.push_back(entry);
    return entry.name;
  }

  ProtocolCell cellOf(ViewId id) {
    ProtocolCell cell;
    const SeriesPicture picture = pictureIn(workspace_, id);
    const Series* series = picture.series;
    if (!series) return cell;
    const ViewState& view = workspace_.view(id);
    cell.series = nameOf(picture);
    cell.picture = pictureOf(view.kind, *series);
    if (showsScene(view.kind)) return cell;
    const FlatLook look = flatLookOf(view);
    if (const auto& window = workspace_.series.at(view.series).window)
      cell.window = shownWindow(*window, *series);
    cell.slabMm = std::min(look.slabMm, 1000.0);
    cell.slabMode = look.slabMode;
    cell.inverted = look.inverted;
    if (const auto over = workspace_.series.find(look.overlay); over != workspace_.series.end())
      cell.over = nameOf({over->second.series.get()});
    return cell;
  }

  HangingProtocol protocol;

 private:
  const Workspace& workspace_;
  std::set<std::string> days_;
  std::vector<SeriesPicture> pictures_;  // of protocol.series
};

}  // namespace

HangingProtocol protocolOf(const Workspace& workspace, const std::string& name) {
  ProtocolMaker maker(workspace);
  const std::vector<ViewId> views = viewsOnScreen(workspace);
  for (const ViewId id : views) maker.protocol.cells.push_back(maker.cellOf(id));
  HangingProtocol& protocol = maker.protocol;
  protocol.name = name;
  protocol.links = workspace.links;
  if (comparesSeries(workspace.layout))
    protocol.layout = workspace.layout;
  else
    protocol.layout = views.size() == 1 ? Layout{Layout::Kind::grid, 1, 1} : Layout::four;
  if (const Series* series = seriesIn(workspace, workspace.focus)) {
    protocol.when.rule.modality = oneOnly(series->modality);
    protocol.when.rule.bodyPart = oneOnly(series->bodyPart);
  }
  return protocol;
}

}  // namespace volumen
