#pragma once

#include <QWidget>
#include <map>
#include <optional>

#include "ui/views/slice_view.h"
#include "ui/views/volume_view.h"

namespace volumen {

/// The views of the workspace, as its layout places them; made when they are first shown.
class ViewGrid : public QWidget {
  Q_OBJECT
 public:
  ViewGrid(Session& session, DrawService& drawService, SliceService& slices, FrameService& frames,
           Measurer& measurer, References& references, QWidget* parent = nullptr);

  /// The 3D view of this id; where the workspace shows something else in it, it is hidden.
  VolumeView* volumeView(ViewId id);
  /// The flat view of this id where that is what is shown; null: it was never shown, or is a 3D one.
  SliceView* sliceView(ViewId id) const;
  /// The view of this id that is shown.
  View* viewOf(ViewId id);
  /// Shows the view in focus alone, or all of the layout again.
  void setAlone(bool alone);
  /// Has the 3D views on screen drawn again, as the draw service does by now.
  void requestPictures();
  /// What the left button does in 3D views.
  void setSceneTool(const Tool& tool);
  void setErrorShown(bool shown);
  /// What the left button does in flat views.
  void setTool(const Tool& tool);
  const Tool& tool() const { return *tool_; }
  /// Whether flat views show the clip box of the 3D scene where it is the whole volume, too.
  void setClipShown(bool shown);
  /// Tints a segment in slices of its volume; null: none.
  void showSegment(const std::optional<VolumeRange>& segment);
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
  /// A 3D view was made: it wants to be drawn.
  void volumeViewMade(volumen::VolumeView* view);

 protected:
  void resizeEvent(QResizeEvent*) override;

 private:
  void add(View* view);
  void arrange();

  Session& session_;
  DrawService& drawService_;
  SliceService& slices_;
  FrameService& frames_;
  Measurer& measurer_;
  References& references_;
  const Tool* sceneTool_ = &toolNamed("rotate");
  bool errorShown_ = false;
  const Tool *tool_, *toolBefore_;
  std::map<ViewId, VolumeView*> volumes_;
  std::map<ViewId, SliceView*> flats_;
  bool clipShown_ = false;
  std::optional<VolumeRange> segment_;
  std::optional<ViewId> alone_;
};

}  // namespace volumen
