#include "ui/views/view_grid.h"

#include <algorithm>

namespace volumen {

namespace {

constexpr int viewGap = 2;  // logical pixels between views

// Where the views of a layout lie in an area.
std::vector<QRect> placesOf(Layout layout, std::size_t count, QSize area) {
  const auto part = [](int whole, int n, int of) { return QPair(whole * n / of, whole * (n + 1) / of); };
  const auto cell = [&](int column, int columns, int row, int rows, QRect in) {
    const auto [left, right] = part(in.width() + viewGap, column, columns);
    const auto [top, bottom] = part(in.height() + viewGap, row, rows);
    return QRect(in.x() + left, in.y() + top, right - left - viewGap, bottom - top - viewGap);
  };
  const QRect whole(QPoint(0, 0), area);
  if (count == 1) return {whole};
  if (count == 2) return {cell(0, 2, 0, 1, whole), cell(1, 2, 0, 1, whole)};
  if (layout == Layout::besidePlanes) {
    std::vector<QRect> places{cell(0, 3, 0, 1, whole).united(cell(1, 3, 0, 1, whole))};
    const QRect beside = cell(2, 3, 0, 1, whole);
    for (int row = 0; row < 3; ++row) places.push_back(cell(0, 1, row, 3, beside));
    return places;
  }
  std::vector<QRect> places;
  for (int n = 0; n < int(count); ++n) places.push_back(cell(n % 2, 2, n / 2, 2, whole));
  return places;
}

}  // namespace

ViewGrid::ViewGrid(Session& session, DrawService& drawService, SliceService& slices, FrameService& frames,
                   Measurer& measurer, References& references, QWidget* parent)
    : QWidget(parent),
      session_(session),
      drawService_(drawService),
      slices_(slices),
      frames_(frames),
      measurer_(measurer),
      references_(references),
      tool_(&toolNamed("window")),
      toolBefore_(tool_) {
  setObjectName(QStringLiteral("viewGrid"));
  setMinimumSize(200, 200);
  volumeView(sceneViewId);
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            const auto kinds = [](const Workspace& w) {
              std::vector<std::pair<ViewId, bool>> are3d;
              for (const ViewId id : viewsOnScreen(w))
                are3d.emplace_back(id, w.view(id).kind == ViewKind::volume);
              return are3d;
            };
            if (kinds(before) != kinds(after) || before.layout != after.layout || before.focus != after.focus)
              arrange();
          });
  arrange();
}

SliceView* ViewGrid::sliceView(ViewId id) const {
  const auto view = flats_.find(id);
  const bool isFlat = session_.workspace().view(id).kind != ViewKind::volume;
  return view == flats_.end() || !isFlat ? nullptr : view->second;
}

VolumeView* ViewGrid::volumeView(ViewId id) {
  VolumeView*& view = volumes_[id];
  if (view) return view;
  view = new VolumeView(session_, drawService_, id, this);
  view->hide();
  view->setTool(*sceneTool_);
  view->setErrorShown(errorShown_);
  connect(view, &VolumeView::menuRequested, this,
          [this, view = view](QPoint global) { Q_EMIT menuRequested(view, global); });
  add(view);
  Q_EMIT volumeViewMade(view);
  return view;
}

View* ViewGrid::viewOf(ViewId id) {
  if (session_.workspace().view(id).kind == ViewKind::volume) return volumeView(id);
  SliceView*& view = flats_[id];
  if (view) return view;
  view = new SliceView(session_, slices_, frames_, measurer_, references_, id, this);
  view->setTool(*tool_);
  view->setClipShown(clipShown_);
  view->showSegment(segment_);
  connect(view, &SliceView::toolWanted, this, &ViewGrid::setTool);
  connect(view, &SliceView::toolDone, this, &ViewGrid::restoreTool);
  connect(view, &SliceView::menuRequested, this,
          [this, view = view](QPoint global) { Q_EMIT menuRequested(view, global); });
  add(view);
  return view;
}

void ViewGrid::requestPictures() {
  for (const ViewId id : viewsOnScreen(session_.workspace()))
    if (session_.workspace().view(id).kind == ViewKind::volume) volumeView(id)->requestPicture();
}

void ViewGrid::setSceneTool(const Tool& tool) {
  sceneTool_ = &tool;
  for (const auto& [id, view] : volumes_) view->setTool(tool);
}

void ViewGrid::setErrorShown(bool shown) {
  errorShown_ = shown;
  for (const auto& [id, view] : volumes_) view->setErrorShown(shown);
}

void ViewGrid::setTool(const Tool& tool) {
  tool_ = &tool;
  if (!tool.measuring) toolBefore_ = tool_;
  for (const auto& [id, view] : flats_) view->setTool(tool);
  Q_EMIT toolChanged();
}

void ViewGrid::setClipShown(bool shown) {
  clipShown_ = shown;
  for (const auto& [id, view] : flats_) view->setClipShown(shown);
}

void ViewGrid::showSegment(const std::optional<VolumeRange>& segment) {
  segment_ = segment;
  for (const auto& [id, view] : flats_) view->showSegment(segment);
}

void ViewGrid::giveUpWaiting(const SeriesKey& series) {
  for (const auto& [id, view] : volumes_) view->giveUpWaiting(series);
  for (const auto& [id, view] : flats_) view->giveUpWaiting(series);
}

void ViewGrid::add(View* view) {
  connect(view, &View::maximiseRequested, this, &ViewGrid::maximiseRequested);
  connect(view, &View::hovered, this, &ViewGrid::hovered);
  connect(view, &View::dropped, this, &ViewGrid::dropped);
}

void ViewGrid::setAlone(bool alone) {
  alone_ = alone ? std::optional(session_.workspace().focus) : std::nullopt;
  arrange();
}

void ViewGrid::arrange() {
  std::vector<ViewId> ids = viewsOnScreen(session_.workspace());
  if (alone_ && std::ranges::find(ids, *alone_) != ids.end()) ids = {*alone_};
  const std::vector<QRect> places = placesOf(session_.workspace().layout, ids.size(), size());
  const auto hideOthers = [&](const auto& views, bool are3d) {
    for (const auto& [id, view] : views) {
      const bool is3d = session_.workspace().view(id).kind == ViewKind::volume;
      if (std::ranges::find(ids, id) == ids.end() || is3d != are3d) view->hide();
    }
  };
  hideOthers(volumes_, true);
  hideOthers(flats_, false);
  for (std::size_t n = 0; n < ids.size(); ++n) {
    View* view = viewOf(ids[n]);
    view->setGeometry(places[n]);
    view->show();
  }
  // Keys are for what is on screen.
  const ViewId focus = session_.workspace().focus;
  View* const keys = viewOf(std::ranges::find(ids, focus) == ids.end() ? ids.front() : focus);
  setFocusProxy(keys);
  if (const QWidget* now = window()->focusWidget(); now && isAncestorOf(now) && now != keys) keys->setFocus();
}

void ViewGrid::resizeEvent(QResizeEvent*) { arrange(); }

}  // namespace volumen
