#pragma once

#include <QWidget>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "ui/views/frame_view.h"
#include "ui/views/slice_view.h"
#include "ui/views/volume_view.h"
#include "ui/views/window_beside.h"

namespace volumen {

/// Arranges the views of the workspace by its layouts, including those of the second window. Views are made
/// when they are first shown.
class ViewGrid : public QWidget {
  Q_OBJECT
 public:
  explicit ViewGrid(const ViewParts& parts, QWidget* parent = nullptr);

  /// Returns the 3D view of this id. It is hidden if the workspace shows something else there.
  VolumeView* volumeView(ViewId id);
  /// Returns the view of this id that is shown.
  View* viewOf(ViewId id) { return viewOf(id, familyOf(id)); }
  /// Returns the view if it is of class V; null if it is another, or was not on screen yet.
  template <class V>
  V* viewAs(ViewId id) const {
    const auto view = views_.find({id, familyOf(id)});
    return view == views_.end() ? nullptr : qobject_cast<V*>(view->second);
  }
  /// Returns the view in focus, or the one that fills its window.
  View* viewShown() const { return viewShownIn(isInSecond(session_.workspace().focus)); }
  /// Returns the view that has the keys in the main window or, if `second` and that is open, in the second
  /// window.
  View* viewShownIn(bool second) const {
    return second && secondKeys_ ? secondKeys_ : static_cast<View*>(focusProxy());
  }
  /// Returns the second window, which may be hidden.
  WindowBeside& secondWindow() const { return *second_; }
  /// Returns whether the view in focus, or a control on it, has the keys.
  bool hasKeys() const;
  /// Gives the keys to the view in focus, in either window.
  void takeKeys();
  /// Returns the captures of all views in the window in focus, arranged as on screen (View::capture).
  QImage capture() const;
  /// Returns the views on screen in the window that has the view in focus.
  std::vector<View*> viewsSeen() const;
  /// Returns the clip box and the segment that all flat views mark.
  const Highlights& highlights() const { return highlights_; }
  /// Makes a hidden view of this id over another session, with results from `measurer`. It shares what the
  /// views here share, except for `highlights`. Returns null for 3D.
  std::unique_ptr<FlatView> unseenView(Session& session, FrameService& frames, MeasuredNumbers& measurer,
                                       ViewId id, const Highlights& highlights) const;
  /// Returns the warnings about all pictures, each sentence once.
  QStringList warningsShown() const;
  /// Shows this view alone in its window, or the window's layout again.
  void setAlone(ViewId view, bool alone);
  /// Returns whether one view is shown alone in the window of this view.
  bool isAlone(ViewId view) const;
  /// Requests new pictures for the 3D views on screen with the current settings of the draw service.
  void requestPictures();
  /// Sets the tool of the left button in 3D views.
  void setSceneTool(const Tool& tool);
  void setErrorShown(bool shown);
  /// Sets the tool of the left button in flat views; tools that draw also apply in 3D.
  void setTool(const Tool& tool);
  const Tool& tool() const { return *tool_; }
  /// Sets whether flat views show the clip box of the 3D scene even if it is the whole volume.
  void setClipShown(bool shown);
  /// Tints a segment in slices of its volume; null for none.
  void showSegment(const std::optional<VolumeRange>& segment);
  /// Restricts 3D to the values of `range`; nothing shows the scenes unchanged.
  void showOnly(const std::optional<VolumeRange>& range);
  /// Stops views from waiting for a series that will not be loaded.
  void giveUpWaiting(const SeriesKey& series);
  /// Selects the tool used before the last drawing tool.
  void restoreTool() { setTool(*toolBefore_); }

 Q_SIGNALS:
  void maximiseRequested();
  void hovered(const QString& text);
  void dropped(const QMimeData& data);
  /// The picture of this view is being dragged out of it.
  void pictureDragged(volumen::View* view);
  void menuRequested(volumen::View* view, QPoint global);
  void toolChanged();
  /// setAlone() has changed what isAlone() returns.
  void aloneChanged();
  /// Views were placed, shown or hidden.
  void arranged();
  /// A 3D view was made and needs a picture.
  void volumeViewMade(volumen::VolumeView* view);

 protected:
  void resizeEvent(QResizeEvent*) override;
  /// Forwards keys to the view in focus if it is in the other window.
  bool eventFilter(QObject* view, QEvent* event) override;
  /// Tab and Shift+Tab move keys and focus to the next view on screen. F6 leaves the views
  /// (ui/features/focus_keys). In the window without the focus they bring the focus there. From a control on
  /// a view, or with a single view, they act as usual.
  bool focusNextPrevChild(bool next) override;

 private:
  View* viewOf(ViewId id, ViewFamily family);
  void connectView(View* view);
  void connectFlat(FlatView* flat, ViewFamily family);
  std::vector<ViewId> idsShown(bool second) const;
  bool goToNext(bool second, bool next);
  void arrange();
  void arrange(QWidget& area, const std::vector<ViewId>& ids, Layout layout);
  bool isOtherActive() const;
  ViewId idForKeys(bool second, const std::vector<ViewId>& ids) const;
  ViewFamily familyOf(ViewId id) const { return rowOf(session_.workspace().view(id).kind).family; }
  /// Calls `call` with all existing views of class V.
  template <class V, class Call>
  void each(const Call& call) const {
    for (const auto& [place, view] : views_)
      if (V* found = qobject_cast<V*>(view)) call(*found);
  }

  Session& session_;
  const ViewParts parts_;
  const Tool* sceneTool_ = &toolNamed("rotate");
  bool errorShown_ = false;
  const Tool *tool_, *toolBefore_;
  std::map<std::pair<ViewId, ViewFamily>, View*> views_;
  Highlights highlights_;
  std::set<ViewId> alone_;  // at most one per window
  View* secondKeys_ = nullptr;
  std::unique_ptr<WindowBeside> second_;  // with its views
};

}  // namespace volumen
