#include "ui/workspace/hanging_protocol.h"

#include <algorithm>
#include <charconv>
#include <tuple>

#include "io/study/frame_series.h"
#include "results/text/value_text.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/link_text.h"
#include "ui/workspace/links.h"
#include "ui/workspace/time_points.h"
#include "ui/workspace/view_window.h"

namespace volumen {

namespace {

int numberOf(const Series& series) {
  int number = 1 << 30;
  const std::string& text = series.seriesNumber;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

// Localizers and single slices of a tomogram come last.
bool isOfStack(const Series& series) {
  return !isOneOf(series.modality, "CT|MR|PT") || isUsefulVolume(series);
}

bool comesBefore(const SeriesPicture& one, const SeriesPicture& other, SeriesOrder order) {
  const Series *a = one.series, *b = other.series;
  if (isOfStack(*a) != isOfStack(*b)) return isOfStack(*a);
  const auto byNumber = [](const Series& s) { return std::tuple(numberOf(s), s.id); };
  switch (order) {
    case SeriesOrder::time:
      if (a->time != b->time) return a->time < b->time;
      break;
    case SeriesOrder::description:
      if (a->description != b->description) return a->description < b->description;
      break;
    case SeriesOrder::slices:
      if (a->acquired.size.z != b->acquired.size.z) return a->acquired.size.z > b->acquired.size.z;
      break;
    case SeriesOrder::number:
      break;
  }
  return byNumber(*a) < byNumber(*b);
}

// Splits names at "|".
std::vector<std::string> namesIn(const std::string& text) {
  std::vector<std::string> names(1);
  for (const char c : text)
    if (c == '|')
      names.emplace_back();
    else
      names.back() += c;
  std::erase(names, std::string());
  return names;
}

std::vector<SeriesPicture> picturesNamed(const HangingProtocol& protocol, const PatientStudies& studies,
                                         const std::string& name);

const ProtocolSeries* entryNamed(const HangingProtocol& protocol, const std::string& name) {
  const auto found = std::ranges::find(protocol.series, name, &ProtocolSeries::name);
  return found == protocol.series.end() ? nullptr : &*found;
}

// Returns the series of earlier studies most similar to those of another entry.
std::vector<SeriesPicture> likeOthers(const HangingProtocol& protocol, const PatientStudies& studies,
                                      const ProtocolSeries& entry) {
  const ProtocolSeries* model = entryNamed(protocol, entry.like);
  if (!model || !model->like.empty()) return {};
  std::vector<SeriesPicture> found;
  for (const SeriesPicture& picture : picturesNamed(protocol, studies, entry.like)) {
    int before = 0;  // earlier studies with a similar series
    for (const auto& prior : studies.priors)
      if (const SeriesPicture like = mostLike(picture, prior); like && ++before == entry.prior)
        found.push_back(like);
  }
  return found;
}

std::vector<SeriesPicture> picturesNamed(const HangingProtocol& protocol, const PatientStudies& studies,
                                         const std::string& name) {
  const ProtocolSeries* entry = entryNamed(protocol, name);
  if (!entry) return {};
  return entry->like.empty() ? picturesFor(*entry, studies) : likeOthers(protocol, studies, *entry);
}

SeriesPicture pictureFor(const HangingProtocol& protocol, const PatientStudies& studies,
                         const std::string& names, int which) {
  for (const std::string& name : namesIn(names)) {
    const std::vector<SeriesPicture> found = picturesNamed(protocol, studies, name);
    if (int(found.size()) >= which) return found[std::size_t(which - 1)];
  }
  return {};
}

// Counts the facts that a condition states.
int factsOf(const ProtocolCondition& when) {
  const SeriesRule& rule = when.rule;
  const ProtocolCondition any;
  int said = when.prior + (when.least != any.least || when.most != any.most);
  for (const std::string* text : {&rule.modality, &rule.laterality, &rule.viewPosition, &rule.bodyPart,
                                  &rule.description, &rule.notDescription})
    said += !text->empty();
  return said + rule.plane.has_value() + rule.weighting.has_value() + rule.kernel.has_value() +
         rule.contrast.has_value();
}

bool holds(const ProtocolCondition& when, const PatientStudies& studies) {
  const auto count = std::ranges::count_if(
      picturesOf(studies.current), [&](const SeriesPicture& picture) { return matches(when.rule, picture); });
  return count >= when.least && count <= when.most &&
         (!when.prior || !priorsOf(studies, when.rule.modality).empty());
}

// Returns the 3D look of a series in any view, or null.
const SceneLook* knownLook(const Workspace& workspace, const SeriesKey& key) {
  for (const ViewState& view : workspace.views)
    if (const auto look = view.scenes.find(key); look != view.scenes.end()) return &look->second;
  return nullptr;
}

ViewKind kindOf(CellPicture picture, const Series& series) {
  switch (picture) {
    case CellPicture::axial:
      return ViewKind::axial;
    case CellPicture::coronal:
      return ViewKind::coronal;
    case CellPicture::sagittal:
      return ViewKind::sagittal;
    case CellPicture::scene:
      return ViewKind::volume;
    default:
      return acquiredKind(series.acquired);
  }
}

void makeEmpty(ViewState& view, const std::string& wanted) {
  view.series = {};
  view.kind = ViewKind::axial;
  view.wanted = wanted;
}

std::string wantedText(const std::string& names) {
  std::string text;
  for (const std::string& name : namesIn(names)) text += (text.empty() ? "" : " / ") + name;
  return text;
}

Workspace withCell(Workspace workspace, ViewId id, const ProtocolCell& cell, const SeriesPicture& picture,
                   const Series* over, bool windowAlone) {
  const Series& series = *picture.series;
  const SeriesKey key = keyOf(series);
  makeEmpty(workspace.editView(id), {});
  const bool asFrames = picture.frame >= 0 || opensAsPictures(series) ||
                        (cell.picture == CellPicture::frames && frameCount(series) > 0);
  workspace = asFrames ? withFrames(std::move(workspace), id, series)
                       : withSeries(std::move(workspace), id, series, {});
  if (!asFrames) {
    const SceneLook* known = knownLook(workspace, key);
    const bool isScene = cell.picture == CellPicture::scene && known;
    const CellPicture shown =
        isScene || cell.picture != CellPicture::scene ? cell.picture : CellPicture::asAcquired;
    const SceneLook look = known ? *known : SceneLook{};
    workspace = withKind(std::move(workspace), id, kindOf(shown, series), look);
    if (isScene) return workspace;
  }
  if (over && !whyNotOverlaid(workspace, series, *over).isEmpty()) over = nullptr;
  if (over) workspace = withOverlay(std::move(workspace), id, over);
  ViewState& view = workspace.editView(id);
  FlatLook& look = view.flats.editOrAdd(key);
  const FlatLook before = look;
  look = {};
  look.frame = picture.frame >= 0 ? picture.frame : before.frame;
  look.overlay = over ? keyOf(*over) : SeriesKey{};
  look.slabMm = asFrames ? 0 : cell.slabMm;
  look.slabMode = cell.slabMode;
  look.inverted = cell.inverted;
  if (windowAlone) workspace = withWindowAlone(std::move(workspace), id, true);
  if (cell.window) setWindow(workspace, id, storedWindow(*cell.window, series));
  return workspace;
}

// Returns whether another cell shows this cell's series with another window.
bool hasWindowAlone(const HangingProtocol& protocol, const std::vector<SeriesPicture>& found,
                    std::size_t cell) {
  if (!protocol.cells[cell].window) return false;
  for (std::size_t n = 0; n < found.size(); ++n)
    if (found[n] && keyOf(*found[n].series) == keyOf(*found[cell].series) &&
        protocol.cells[n].picture != CellPicture::scene && protocol.cells[n].window &&
        protocol.cells[n].window != protocol.cells[cell].window)
      return true;
  return false;
}

std::vector<const Series*> allOf(const PatientStudies& studies) {
  std::vector<const Series*> all = studies.current;
  for (const auto& prior : studies.priors) all.insert(all.end(), prior.begin(), prior.end());
  return all;
}

}  // namespace

bool matches(const SeriesRule& rule, const SeriesPicture& picture) {
  const Series& series = *picture.series;
  const ProjectionView projection = projectionOf(series, picture.frame);
  const auto is = [](const std::string& allowed, const std::string& text) {
    return allowed.empty() || isOneOf(text, allowed);
  };
  const auto has = [](const std::string& words, const std::string& text) {
    return words.empty() || hasWord(text, words);
  };
  return is(rule.modality, series.modality) && is(rule.laterality, projection.laterality) &&
         is(rule.viewPosition, projection.viewPosition) &&
         has(rule.bodyPart, series.bodyPart + ' ' + series.studyDescription) &&
         has(rule.description, series.description) &&
         (rule.notDescription.empty() || !hasWord(series.description, rule.notDescription)) &&
         (!rule.plane || rule.plane == acquiredPlaneOf(series)) &&
         (!rule.weighting || rule.weighting == weightingOf(series)) &&
         (!rule.kernel || rule.kernel == kernelOf(series)) &&
         (!rule.contrast || *rule.contrast == contrastOf(series).value_or(false));
}

std::vector<SeriesPicture> picturesFor(const ProtocolSeries& entry, const PatientStudies& studies) {
  const std::vector<std::vector<const Series*>> priors = priorsOf(studies, entry.rule.modality);
  if (entry.prior > int(priors.size())) return {};
  std::vector<SeriesPicture> found =
      picturesOf(entry.prior == 0 ? studies.current : priors[std::size_t(entry.prior - 1)]);
  std::erase_if(found, [&](const SeriesPicture& picture) { return !matches(entry.rule, picture); });
  std::ranges::stable_sort(
      found, [&](const SeriesPicture& a, const SeriesPicture& b) { return comesBefore(a, b, entry.order); });
  return found;
}

std::vector<SeriesPicture> picturesOfCells(const HangingProtocol& protocol, const PatientStudies& studies) {
  std::vector<SeriesPicture> all;
  for (const ProtocolCell& cell : protocol.cells)
    all.push_back(pictureFor(protocol, studies, cell.series, cell.which));
  return all;
}

std::vector<std::size_t> fitting(const std::vector<HangingProtocol>& protocols,
                                 const PatientStudies& studies) {
  std::vector<std::tuple<int, int, std::size_t>> found;
  for (std::size_t n = 0; n < protocols.size(); ++n) {
    if (!holds(protocols[n].when, studies)) continue;
    const std::vector<SeriesPicture> cells = picturesOfCells(protocols[n], studies);
    const auto filled = int(cells.size()) - int(std::ranges::count(cells, SeriesPicture()));
    if (filled >= protocols[n].leastFilled) found.emplace_back(-factsOf(protocols[n].when), -filled, n);
  }
  std::ranges::sort(found);
  std::vector<std::size_t> numbers;
  for (const auto& [facts, filled, n] : found) numbers.push_back(n);
  return numbers;
}

Workspace hung(Workspace workspace, const HangingProtocol& protocol, const PatientStudies& studies) {
  workspace = withScrollLinked(std::move(workspace), protocol.links.scroll);
  workspace.links = protocol.links;
  workspace.layout = protocol.layout;
  workspace.focus = firstComparedId;
  const std::vector<SeriesPicture> found = picturesOfCells(protocol, studies);
  const std::vector<ViewId> views = viewsInMain(workspace);
  std::optional<ViewId> first;
  for (std::size_t n = 0; n < views.size(); ++n) {
    const SeriesPicture picture = n < found.size() ? found[n] : SeriesPicture();
    if (!picture) {
      makeEmpty(workspace.editView(views[n]),
                n < found.size() ? wantedText(protocol.cells[n].series) : std::string());
      continue;
    }
    const ProtocolCell& cell = protocol.cells[n];
    const Series* over = cell.over.empty() ? nullptr : pictureFor(protocol, studies, cell.over, 1).series;
    workspace =
        withCell(std::move(workspace), views[n], cell, picture, over, hasWindowAlone(protocol, found, n));
    workspace = withTimePointsOf(std::move(workspace), *picture.series, allOf(studies));
    if (!first) first = views[n];
  }
  workspace.focus = first.value_or(firstComparedId);
  return workspace;
}

}  // namespace volumen
