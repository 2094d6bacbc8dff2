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

ViewGrid::ViewGrid(Session& session, SliceService& slices, FrameService& frames, Measurer& measurer,
                   References& references, QWidget* parent)
    : QWidget(parent),
      session_(session),
      slices_(slices),
      frames_(frames),
      measurer_(measurer),
      references_(references),
      scene_(new VolumeView(session)),
      tool_(&flatTool("window")),
      toolBefore_(tool_) {
  setObjectName(QStringLiteral("viewGrid"));
  scene_->setParent(this);
  add(sceneViewId, scene_);
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            if (viewsOnScreen(before) != viewsOnScreen(after) || before.layout != after.layout ||
                before.focus != after.focus)
              arrange();
          });
  arrange();
}

SliceView* ViewGrid::sliceView(ViewId id) const {
  const auto view = views_.find(id);
  return view == views_.end() ? nullptr : qobject_cast<SliceView*>(view->second);
}

View* ViewGrid::viewOf(ViewId id) {
  if (!views_.contains(id)) {
    auto* made = new SliceView(session_, slices_, frames_, measurer_, references_, id, this);
    made->setTool(*tool_);
    made->setClipShown(clipShown_);
    made->showSegment(segment_);
    connect(made, &SliceView::toolWanted, this, &ViewGrid::setTool);
    connect(made, &SliceView::toolDone, this, &ViewGrid::restoreTool);
    add(id, made);
  }
  return views_.at(id);
}

void ViewGrid::setTool(const FlatTool& tool) {
  tool_ = &tool;
  if (!tool.measuring) toolBefore_ = tool_;
  for (const auto& [id, view] : views_)
    if (auto* slice = qobject_cast<SliceView*>(view)) slice->setTool(tool);
  Q_EMIT toolChanged();
}

void ViewGrid::setClipShown(bool shown) {
  clipShown_ = shown;
  for (const auto& [id, view] : views_)
    if (auto* slice = qobject_cast<SliceView*>(view)) slice->setClipShown(shown);
}

void ViewGrid::showSegment(const std::shared_ptr<const RangeSegment>& segment) {
  segment_ = segment;
  for (const auto& [id, view] : views_)
    if (auto* slice = qobject_cast<SliceView*>(view)) slice->showSegment(segment);
}

void ViewGrid::add(ViewId id, View* view) {
  views_[id] = view;
  connect(view, &View::maximiseRequested, this, &ViewGrid::maximiseRequested);
  connect(view, &View::hovered, this, &ViewGrid::hovered);
  connect(view, &View::dropped, this, &ViewGrid::dropped);
  if (auto* flat = qobject_cast<SliceView*>(view))
    connect(flat, &SliceView::menuRequested, this,
            [this, flat](QPoint global) { Q_EMIT menuRequested(flat, global); });
}

void ViewGrid::setAlone(bool alone) {
  alone_ = alone ? std::optional(session_.workspace().focus) : std::nullopt;
  arrange();
}

void ViewGrid::arrange() {
  std::vector<ViewId> ids = viewsOnScreen(session_.workspace());
  if (alone_ && std::ranges::find(ids, *alone_) != ids.end()) ids = {*alone_};
  const std::vector<QRect> places = placesOf(session_.workspace().layout, ids.size(), size());
  for (const auto& [id, view] : views_)
    if (std::ranges::find(ids, id) == ids.end()) view->hide();
  for (std::size_t n = 0; n < ids.size(); ++n) {
    View* view = viewOf(ids[n]);
    view->setGeometry(places[n]);
    view->show();
  }
  // Keys are for what is on screen.
  const ViewId focus = session_.workspace().focus;
  setFocusProxy(viewOf(std::ranges::find(ids, focus) == ids.end() ? ids.front() : focus));
}

void ViewGrid::resizeEvent(QResizeEvent*) { arrange(); }

}  // namespace volumen
