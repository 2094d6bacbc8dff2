#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "io/study/frame_series.h"
#include "results/series/series_facts.h"
#include "results/text/value_text.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/hanging_protocol.h"
#include "ui/workspace/view_window.h"
#include "viewer/volume/free_name.h"

namespace volumen {

namespace {

// Returns the text up to a "|", which would read as several alternatives.
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

bool isSamePicture(const SeriesPicture& a, const SeriesPicture& b) {
  return a && b && keyOf(*a.series) == keyOf(*b.series) && a.frame == b.frame;
}

// Returns the studies around the latest one on screen of the patient in focus.
PatientStudies studiesShown(const Workspace& workspace, const std::vector<const Series*>& open) {
  const Series* latest = seriesIn(workspace, workspace.focus);
  for (const ViewId id : viewsOnScreen(workspace)) {
    const Series* shown = seriesIn(workspace, id);
    if (!latest) latest = shown;
    if (shown && areOfOnePatient(*shown, *latest) && shown->studyDate > latest->studyDate) latest = shown;
  }
  return latest ? studiesAround(open, *latest) : PatientStudies();
}

bool canBeKept(const Window& window) {
  return std::abs(window.centre) <= mostOfWindow && std::abs(window.width) <= mostOfWindow &&
         std::abs(window.width) >= leastWidthOfWindow;
}

// Collects the series that cells name.
class ProtocolMaker {
 public:
  ProtocolMaker(const Workspace& workspace, const PatientStudies& studies)
      : workspace_(workspace), studies_(studies) {}

  // Returns the name of the entry that finds a picture, and its rank there; no name if it is in none of the
  // studies.
  std::pair<std::string, int> nameOf(const SeriesPicture& picture) {
    const std::optional<int> prior = priorNumberOf(*picture.series);
    if (!prior) return {};
    ProtocolSeries entry;
    entry.rule = ruleOf(picture);
    entry.prior = *prior;
    const std::vector<SeriesPicture> found = picturesFor(entry, studies_);
    const auto at =
        std::ranges::find_if(found, [&](const auto& other) { return isSamePicture(other, picture); });
    const int rank = at == found.end() ? 1 : int(at - found.begin()) + 1;
    for (const ProtocolSeries& known : protocol.series)
      if (known.rule == entry.rule && known.prior == entry.prior) return {known.name, rank};
    const Series& series = *picture.series;
    const std::string words = oneOnly(series.description.empty() ? series.modality : series.description);
    entry.name = freeName(words.empty() ? "series" : words, [&](const std::string& name) {
      return std::ranges::count(protocol.series, name, &ProtocolSeries::name) > 0;
    });
    protocol.when.prior = protocol.when.prior || entry.prior > 0;
    protocol.series.push_back(entry);
    return {entry.name, rank};
  }

  ProtocolCell cellOf(ViewId id) {
    ProtocolCell cell;
    const SeriesPicture picture = pictureIn(workspace_, id);
    const Series* series = picture.series;
    if (!series) return cell;
    const ViewState& view = workspace_.view(id);
    const auto [name, rank] = nameOf(picture);
    if (name.empty()) return cell;
    cell.series = name;
    cell.which = rank;
    cell.picture = pictureOf(view.kind, *series);
    if (showsScene(view.kind)) return cell;
    const FlatLook look = flatLookOf(view);
    if (const auto window = seriesStateIn(workspace_, id).window)
      if (const Window shown = shownWindow(*window, *series); canBeKept(shown)) cell.window = shown;
    cell.slabMm = std::min(look.slabMm, 1000.0);
    cell.slabMode = look.slabMode;
    cell.inverted = look.inverted;
    if (const auto over = workspace_.series.find(look.overlay); over != workspace_.series.end())
      cell.over = nameOf({over->second.series.get()}).first;
    return cell;
  }

  HangingProtocol protocol;

 private:
  // Returns 0 for the current study, else the number of the prior; empty if it is no study of the patient.
  std::optional<int> priorNumberOf(const Series& series) const {
    const auto holds = [&](const std::vector<const Series*>& study) {
      return std::ranges::any_of(study, [&](const Series* s) { return keyOf(*s) == keyOf(series); });
    };
    if (holds(studies_.current)) return 0;
    const std::vector<std::vector<const Series*>> priors = priorsOf(studies_, oneOnly(series.modality));
    const auto found = std::ranges::find_if(priors, holds);
    return found == priors.end() ? std::nullopt : std::optional(int(found - priors.begin()) + 1);
  }

  const Workspace& workspace_;
  const PatientStudies& studies_;
};

// Keeps chest walls and scale where the pictures of the last protocol still stand.
void keepFacing(HangingProtocol& protocol, const HangingProtocol& last, const Workspace& workspace,
                const PatientStudies& studies) {
  if (protocol.layout != last.layout) return;
  const std::vector<SeriesPicture> hung = picturesOfCells(last, studies);
  const std::vector<ViewId> views = viewsInMain(workspace);
  bool allStand = true;
  for (std::size_t n = 0; n < std::min({hung.size(), views.size(), protocol.cells.size()}); ++n) {
    const SeriesPicture shown = pictureIn(workspace, views[n]);
    if (isSamePicture(hung[n], shown))
      protocol.cells[n].chestWall = last.cells[n].chestWall;
    else
      allStand = allStand && !hung[n] && !shown;
  }
  protocol.sameScale = last.sameScale && allStand;
}

}  // namespace

HangingProtocol protocolOf(const Workspace& workspace, const std::string& name,
                           const std::vector<const Series*>& open, const HangingProtocol* last) {
  const PatientStudies studies = studiesShown(workspace, open);
  ProtocolMaker maker(workspace, studies);
  const std::vector<ViewId> views = viewsInMain(workspace);
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
  if (last) keepFacing(protocol, *last, workspace, studies);
  return protocol;
}

}  // namespace volumen
