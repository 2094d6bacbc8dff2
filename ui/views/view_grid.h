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

/// The views of the workspace, as its layouts place them, those of the second window there; made when they
/// are first shown.
class ViewGrid : public QWidget {
  Q_OBJECT
 public:
  ViewGrid(Session& session, DrawService& drawService, SliceService& slices, FrameService& frames,
           MeasureJobs& measurer, DerivedObjects& derived, QWidget* parent = nullptr);

  /// The 3D view of this id; where the workspace shows something else in it, it is hidden.
  VolumeView* volumeView(ViewId id);
  /// The view of this id that is shown.
  View* viewOf(ViewId id) { return viewOf(id, familyOf(id)); }
  /// The same where it is one of class V; null: it is another, or was not on screen yet.
  template <class V>
  V* viewAs(ViewId id) const {
    const auto view = views_.find({id, familyOf(id)});
    return view == views_.end() ? nullptr : qobject_cast<V*>(view->second);
  }
  /// The view in focus, or the one that takes all of the place in its window.
  View* viewShown() const { return viewShownIn(isInSecond(session_.workspace().focus)); }
  /// The one of the second window, where that is open, or of the main one that keys are for while it is
  /// active.
  View* viewShownIn(bool second) const {
    return second && secondKeys_ ? secondKeys_ : static_cast<View*>(focusProxy());
  }
  /// The second window, whether it is shown or not.
  WindowBeside& secondWindow() const { return *second_; }
  /// Whether the view in focus has the keys, or a control on it.
  bool hasKeys() const;
  /// Gives them to it, in whichever window it stands.
  void takeKeys();
  /// What is seen of all views of the window in focus (View::capture), as they lie beside each other.
  QImage capture() const;
  /// The views in the window of the view in focus that are on screen.
  std::vector<View*> viewsSeen() const;
  /// What flat views show that is no part of the workspace.
  struct Shown {
    bool clip = false;                     ///< the clip box where it is the whole volume, too
    std::optional<VolumeRange> segment{};  ///< tinted
  };
  const Shown& shown() const { return shown_; }
  /// A hidden view of this id over another session, whose numbers `measurer` has, with what the views here
  /// share, or shared as `shown` was taken; null of 3D.
  std::unique_ptr<FlatView> unseenView(Session& session, FrameService& frames, MeasureJobs& measurer,
                                       ViewId id, const Shown& shown) const;
  /// What is not as it seems in any of them, each sentence once.
  QStringList warningsShown() const;
  /// Shows this view alone in its window, or all of the window's layout again.
  void setAlone(ViewId view, bool alone);
  /// Whether one view is shown alone in the window in which this one stands.
  bool isAlone(ViewId view) const;
  /// Has the 3D views on screen drawn again, as the draw service does by now.
  void requestPictures();
  /// What the left button does in 3D views.
  void setSceneTool(const Tool& tool);
  void setErrorShown(bool shown);
  /// What the left button does in flat views, and in 3D where it draws there, too.
  void setTool(const Tool& tool);
  const Tool& tool() const { return *tool_; }
  /// Whether flat views show the clip box of the 3D scene where it is the whole volume, too.
  void setClipShown(bool shown);
  /// Tints a segment in slices of its volume; null: none.
  void showSegment(const std::optional<VolumeRange>& segment);
  /// Shows in 3D only these values; none: what the scenes show.
  void showOnly(const std::optional<VolumeRange>& range);
  /// Shows in flat views what would be segments of a series under those that are; none: nothing more.
  void showPreview(const std::optional<SegmentMap>& segments);
  /// A series that views wait for will not come.
  void giveUpWaiting(const SeriesKey& series);
  /// The one before the last that measures.
  void restoreTool() { setTool(*toolBefore_); }

 Q_SIGNALS:
  void maximiseRequested();
  void hovered(const QString& text);
  void dropped(const QMimeData& data);
  void menuRequested(volumen::View* view, QPoint global);
  void toolChanged();
  /// The connected part of a place is to be taken.
  void partClicked(const volumen::PartClick& click);
  void strokePainted(const volumen::SegmentStroke& stroke);
  void ballDrawn(const volumen::DrawnBall& ball);
  void segmentCut(const volumen::SegmentCut& cut);
  /// Views were placed, shown or hidden.
  void arranged();
  /// A 3D view was made: it wants to be drawn.
  void volumeViewMade(volumen::VolumeView* view);

 protected:
  void resizeEvent(QResizeEvent*) override;
  /// Keys for a view of the window in which the view in focus does not stand go to that.
  bool eventFilter(QObject* view, QEvent* event) override;
  /// Tab and Shift+Tab go from the view that has the keys to the next one on screen, which comes into focus;
  /// F6 leaves the views (ui/features/focus_keys). In the window without the focus they bring it there. From
  /// a control on a view, and where there is one view alone, they go on as everywhere else.
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
  /// Calls it with all views of class V that were made.
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
  Shown shown_;
  std::optional<SegmentMap> preview_;
  std::set<ViewId> alone_;  // one a window
  View* secondKeys_ = nullptr;
  std::unique_ptr<WindowBeside> second_;  // and the views in it
};

}  // namespace volumen
