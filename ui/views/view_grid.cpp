#include "ui/views/view_grid.h"

#include <QApplication>
#include <QKeyEvent>
#include <QPainter>
#include <algorithm>
#include <optional>
#include <utility>

#include "ui/views/drag_handle.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

constexpr int viewGap = 2;  // logical pixels between views

// Returns the rectangles of the views of a layout.
std::vector<QRect> placesOf(Layout layout, std::size_t count, QSize area) {
  const auto part = [](int whole, int n, int of) { return QPair(whole * n / of, whole * (n + 1) / of); };
  const auto cell = [&](int column, int columns, int row, int rows, QRect in) {
    const auto [left, right] = part(in.width() + viewGap, column, columns);
    const auto [top, bottom] = part(in.height() + viewGap, row, rows);
    return QRect(in.x() + left, in.y() + top, right - left - viewGap, bottom - top - viewGap);
  };
  const QRect whole(QPoint(0, 0), area);
  if (count == 1) return {whole};
  if (layout == Layout::besidePlanes) {
    std::vector<QRect> places{cell(0, 3, 0, 1, whole).united(cell(1, 3, 0, 1, whole))};
    const QRect beside = cell(2, 3, 0, 1, whole);
    for (int row = 0; row < 3; ++row) places.push_back(cell(0, 1, row, 3, beside));
    return places;
  }
  const bool isGrid = comparesSeries(layout);
  const int rows = isGrid ? layout.rows : 2, columns = isGrid ? layout.columns : 2;
  std::vector<QRect> places;
  for (int n = 0; n < int(count); ++n) places.push_back(cell(n % columns, columns, n / columns, rows, whole));
  return places;
}

}  // namespace

ViewGrid::ViewGrid(const ViewParts& parts, QWidget* parent)
    : QWidget(parent),
      session_(parts.session),
      parts_(parts),
      tool_(&toolNamed("window")),
      toolBefore_(tool_),
      second_(std::make_unique<WindowBeside>([this](bool next) { return goToNext(true, next); })) {
  setObjectName(QStringLiteral("viewGrid"));
  setMinimumSize(200, 200);
  volumeView(sceneViewId);
  const auto families = [](const Workspace& w) {
    std::vector<std::pair<ViewId, ViewFamily>> all;
    for (const ViewId id : viewsOnScreen(w)) all.emplace_back(id, rowOf(w.view(id).kind).family);
    return all;
  };
  const auto isFocusInSecond = [](const Workspace& w) { return isInSecond(w.focus); };
  whenChanged(session_, this, qOverload<>(&ViewGrid::arrange), families, &Workspace::layout,
              &Workspace::second, &Workspace::focus);
  whenChanged(
      session_, this,
      [this] {
        if (isOtherActive()) takeKeys();
      },
      isFocusInSecond);
  connect(second_.get(), &WindowBeside::resized, this, qOverload<>(&ViewGrid::arrange));
  arrange();
}

VolumeView* ViewGrid::volumeView(ViewId id) {
  return static_cast<VolumeView*>(viewOf(id, ViewFamily::scene));
}

View* ViewGrid::viewOf(ViewId id, ViewFamily family) {
  View*& view = views_[{id, family}];
  if (view) return view;
  view = makeView(family, parts_, id, isInSecond(id) ? static_cast<QWidget*>(second_.get()) : this);
  connectView(view);
  if (auto* flat = qobject_cast<FlatView*>(view)) connectFlat(flat, family);
  if (auto* volume = qobject_cast<VolumeView*>(view)) {
    volume->setTool(*sceneTool_);
    volume->setFlatTool(*tool_);
    connect(volume, &VolumeView::toolWanted, this, &ViewGrid::setTool);
    connect(volume, &VolumeView::toolDone, this, &ViewGrid::restoreTool);
    volume->setErrorShown(errorShown_);
    Q_EMIT volumeViewMade(volume);
  }
  return view;
}

void ViewGrid::connectFlat(FlatView* flat, ViewFamily family) {
  flat->setTool(*tool_);
  flat->setHighlights(highlights_);
  flat->setFinder([this](ViewId id) { return viewAs<FlatView>(id); });
  connect(flat, &FlatView::toolWanted, this, &ViewGrid::setTool);
  connect(flat, &FlatView::toolDone, this, &ViewGrid::restoreTool);
  connect(flat, &FlatView::drewInAll, this,
          [this] { each<FlatView>([](FlatView& view) { view.update(); }); });
  // The position of a frame is known once it is read.
  if (family == ViewFamily::frames)
    connect(flat, &FlatView::settled, this, [this, flat, last = std::optional<SlicePlane>()]() mutable {
      const std::vector<FlatView::StackPlane> planes = flat->stackPlanesIn(session_.workspace(), false);
      const auto now = planes.empty() ? std::nullopt : std::optional(planes.front().plane);
      if (std::exchange(last, now) == now || !session_.preferences().referenceLines) return;
      each<FlatView>([&](FlatView& view) {
        if (&view != flat) view.update();
      });
    });
}

void ViewGrid::requestPictures() {
  for (const ViewId id : viewsOnScreen(session_.workspace()))
    if (familyOf(id) == ViewFamily::scene) volumeView(id)->requestPicture();
}

void ViewGrid::setSceneTool(const Tool& tool) {
  sceneTool_ = &tool;
  if (tool_->draws() && tool_->inScene) restoreTool();
  each<VolumeView>([&](VolumeView& view) { view.setTool(tool); });
}

void ViewGrid::setErrorShown(bool shown) {
  errorShown_ = shown;
  each<VolumeView>([&](VolumeView& view) { view.setErrorShown(shown); });
}

void ViewGrid::setTool(const Tool& tool) {
  tool_ = &tool;
  if (!tool.draws()) toolBefore_ = tool_;
  each<FlatView>([&](FlatView& view) { view.setTool(tool); });
  each<VolumeView>([&](VolumeView& view) { view.setFlatTool(tool); });
  Q_EMIT toolChanged();
}

void ViewGrid::setClipShown(bool shown) {
  highlights_.clip = shown;
  each<FlatView>([&](FlatView& view) { view.setHighlights(highlights_); });
}

void ViewGrid::showSegment(const std::optional<VolumeRange>& segment) {
  highlights_.segment = segment;
  each<FlatView>([&](FlatView& view) { view.setHighlights(highlights_); });
}

void ViewGrid::showOnly(const std::optional<VolumeRange>& range) {
  each<VolumeView>([&](VolumeView& view) { view.showOnly(range); });
}

void ViewGrid::giveUpWaiting(const SeriesKey& series) {
  each<View>([&](View& view) { view.giveUpWaiting(series); });
}

void ViewGrid::connectView(View* view) {
  connect(view, &View::maximiseRequested, this, &ViewGrid::maximiseRequested);
  connect(view, &View::hovered, this, &ViewGrid::hovered);
  connect(view, &View::dropped, this, &ViewGrid::dropped);
  connect(view, &View::menuRequested, this,
          [this, view](QPoint global) { Q_EMIT menuRequested(view, global); });
  connect(new DragHandle(*view), &DragHandle::dragged, this, [this, view] { Q_EMIT pictureDragged(view); });
  view->installEventFilter(this);
}

// Keys go to the view in focus, whichever window is active. Tab moves the focus to the active window.
bool ViewGrid::eventFilter(QObject* view, QEvent* event) {
  const QEvent::Type type = event->type();
  if (type != QEvent::ShortcutOverride && type != QEvent::KeyPress && type != QEvent::KeyRelease)
    return QWidget::eventFilter(view, event);
  const int key = static_cast<QKeyEvent*>(event)->key();
  View* shown = viewShown();
  const QWidget* itsWindow = shown->window();
  if (static_cast<QWidget*>(view)->window() == itsWindow || !shown->isVisible() || itsWindow->isMinimized() ||
      key == Qt::Key_Tab || key == Qt::Key_Backtab)
    return QWidget::eventFilter(view, event);
  // A window below a dialog takes no keys.
  if (const QWidget* modal = QApplication::activeModalWidget();
      modal && modal->parentWidget() && modal->parentWidget()->window() == itsWindow)
    return true;
  QWidget* field = shown->window()->focusWidget();
  return QCoreApplication::sendEvent(shown->isAncestorOf(field) ? field : shown, event);
}

// Returns whether the active window is not the one with the view in focus.
bool ViewGrid::isOtherActive() const {
  return (isInSecond(viewShown()->id()) ? window() : second_.get())->isActiveWindow();
}

bool ViewGrid::hasKeys() const {
  const View* view = viewShown();
  return view->parentWidget()->isAncestorOf(view->window()->focusWidget()) && !isOtherActive();
}

void ViewGrid::takeKeys() {
  View* view = viewShown();
  if (isOtherActive()) {
    // A widget that is hidden while it has the keys passes them to the next one.
    View* left = viewShownIn(!isInSecond(view->id()));
    if (left->isVisible()) left->setFocus();
    view->window()->activateWindow();
  }
  view->setFocus();
}

std::vector<View*> ViewGrid::viewsSeen() const {
  std::vector<View*> seen;
  const QWidget* area = viewShown()->parentWidget();
  for (const auto& [place, view] : views_)
    if (view->isVisible() && view->parentWidget() == area) seen.push_back(view);
  return seen;
}

QImage ViewGrid::capture() const {
  const QWidget* area = viewShown()->parentWidget();
  const double ratio = area->devicePixelRatioF();
  QImage image((QSizeF(area->size()) * ratio).toSize(), QImage::Format_RGB32);
  image.fill(palette().color(QPalette::Window));
  QPainter painter(&image);
  for (const View* view : viewsSeen()) {
    QImage seen = view->capture();
    seen.setDevicePixelRatio(1);
    painter.drawImage((QPointF(view->pos()) * ratio).toPoint(), seen);
  }
  painter.end();
  image.setDevicePixelRatio(ratio);
  return image;
}

std::unique_ptr<FlatView> ViewGrid::unseenView(Session& session, FrameService& frames,
                                               MeasuredNumbers& measurer, ViewId id,
                                               const Highlights& highlights) const {
  const ViewFamily family = rowOf(session.workspace().view(id).kind).family;
  if (family == ViewFamily::scene) return nullptr;
  ViewParts parts{session, parts_.drawn, parts_.drawService, parts_.slices, frames, measurer, parts_.derived};
  std::unique_ptr<FlatView> view(static_cast<FlatView*>(makeView(family, parts, id, nullptr)));
  view->setFinder([this](ViewId other) { return viewAs<FlatView>(other); });
  view->setHighlights(highlights);
  return view;
}

QStringList ViewGrid::warningsShown() const {
  QStringList all;
  for (const View* view : viewsSeen()) all << view->warningsShown();
  all.removeDuplicates();
  return all;
}

void ViewGrid::setAlone(ViewId view, bool alone) {
  const std::set<ViewId> before = alone_;
  std::erase_if(alone_, [view](ViewId id) { return isInSecond(id) == isInSecond(view); });
  if (alone) alone_.insert(view);
  if (alone_ == before) return;
  arrange();
  Q_EMIT aloneChanged();
}

bool ViewGrid::isAlone(ViewId view) const {
  return std::ranges::any_of(alone_, [view](ViewId id) { return isInSecond(id) == isInSecond(view); });
}

std::vector<ViewId> ViewGrid::idsShown(bool second) const {
  const Workspace& workspace = session_.workspace();
  const std::vector<ViewId> ids = second ? viewsInSecond(workspace) : viewsInMain(workspace);
  for (const ViewId alone : alone_)
    if (std::ranges::find(ids, alone) != ids.end()) return {alone};
  return ids;
}

bool ViewGrid::focusNextPrevChild(bool next) {
  return goToNext(false, next) || QWidget::focusNextPrevChild(next);
}

bool ViewGrid::goToNext(bool second, bool next) {
  const View* keys = viewShownIn(second);
  if (keys->window()->focusWidget() != keys) return false;
  if (isInSecond(session_.workspace().focus) != second) {
    session_.setFocus(keys->id());
    return true;
  }
  const std::vector<ViewId> ids = idsShown(second);
  const auto at = std::ranges::find(ids, session_.workspace().focus);
  if (ids.size() < 2 || at == ids.end()) return false;
  const std::size_t step = next ? 1 : ids.size() - 1;
  session_.setFocus(ids[(std::size_t(at - ids.begin()) + step) % ids.size()]);
  return true;
}

void ViewGrid::arrange() {
  const Workspace& workspace = session_.workspace();
  arrange(*this, idsShown(false), workspace.layout);
  if (workspace.second.shown)
    arrange(*second_, idsShown(true), workspace.second.layout);
  else {
    secondKeys_ = nullptr;
    std::erase_if(alone_, isInSecond);
  }
  Q_EMIT arranged();
}

// Returns the view in focus, or the window's last view in focus, if it is on screen.
ViewId ViewGrid::idForKeys(bool second, const std::vector<ViewId>& ids) const {
  const Workspace& workspace = session_.workspace();
  const bool isLeft = second && secondKeys_ && !isInSecond(workspace.focus);
  const ViewId wanted = isLeft ? secondKeys_->id() : second ? workspace.focus : mainFocusOf(workspace);
  return std::ranges::find(ids, wanted) == ids.end() ? ids.front() : wanted;
}

// Arranges the views of one window on their parent.
void ViewGrid::arrange(QWidget& area, const std::vector<ViewId>& ids, Layout layout) {
  const std::vector<QRect> places = placesOf(layout, ids.size(), area.size());
  for (std::size_t n = 0; n < ids.size(); ++n) {
    View* view = viewOf(ids[n]);
    view->setGeometry(places[n]);
    view->show();
  }
  const bool isSecond = &area == second_.get();
  View* const keys = viewOf(idForKeys(isSecond, ids));
  if (isSecond)
    secondKeys_ = keys;
  else
    setFocusProxy(keys);
  const QWidget* now = area.window()->focusWidget();
  const bool hasKeys = now ? area.isAncestorOf(now) : isSecond;
  if (hasKeys && now != keys) keys->setFocus();
  // Hides views last: a hidden view passes its keys to the next widget in the window.
  for (const auto& [place, view] : views_)
    if (view->parentWidget() == &area &&
        (std::ranges::find(ids, place.first) == ids.end() || place.second != familyOf(place.first)))
      view->hide();
  // A view hidden with an open field takes the keys back first.
  if (hasKeys && area.window()->focusWidget() != keys) keys->setFocus();
}

void ViewGrid::resizeEvent(QResizeEvent*) { arrange(); }

}  // namespace volumen
