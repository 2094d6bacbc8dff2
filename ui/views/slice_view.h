#pragma once

#include "ui/views/colour_bar.h"
#include "ui/views/flat_view.h"

namespace volumen {

/// Shows a plane through the volume of a series. The wheel moves it along its normal, Alt+wheel changes the
/// slab thickness, and lines move and rotate the other planes.
class SliceView : public FlatView {
  Q_OBJECT
 public:
  SliceView(const ViewParts& parts, ViewId id, QWidget* parent);

  /// Tints a segment in the slices; null for none.
  void showSegment(const std::optional<VolumeRange>& segment);
  /// Sets whether the clip box of the 3D scene is shown even if it is the whole volume.
  void setClipShown(bool shown);
  void scroll(int steps) override;
  void goTo(int place) override;
  LoadedSeriesPtr shown() const override;
  Overlays overlays() const override;
  std::vector<WindowChoice> windows() const override;
  void chooseWindow(int number) override;
  PictureSeen pictureSeen() const override;
  std::vector<StackPlane> stackPlanesIn(const Workspace& workspace, bool ends) const override;
  StackPlace place() const override;

 protected:
  SliceRequest requestOf(const SlicePlane& plane) const override;
  bool keepsPictureOf(const SeriesKey& before) const override;
  void seriesExchanged(bool another) override;
  Numbers numbers() const override;
  QString numberLine() const override;
  std::optional<int> placeOf(int number) const override;
  QString goToNumber(int number) override;
  std::vector<int> keyImagePlaces() const override;
  std::vector<std::pair<int, int>> heldPlaces() const override { return {{0, place().count - 1}}; }
  Window greyWindow() const override;
  void makeThicker(int steps) override;
  Workspace unturned(Workspace workspace) const override;
  Warnings warnings() const override;
  QString hoverText(QPointF position) const override;
  std::vector<const Measurement*> measurements() const override;
  std::unique_ptr<Drag> pressLine(const SlicePress& press) const override;
  bool isOnLine(const SlicePress& press) const override;
  void paintLines(QPainter& painter) const override;
  void paintColours(QPainter& painter) const override;
  void paintHandles(QPainter& painter) const override;
  void mouseDoubleClickEvent(QMouseEvent*) override;

 private:
  class Stack;

  bool hasCrosshairTool() const;
  void moveTo(int place);
  bool isAlongSlices() const;
  glm::dvec3 pointOn(int slice) const;
  std::optional<ColourBar> colourBar() const;
  void typeBar(const ColourBar& bar);

  bool clipShown_ = false;
  std::optional<VolumeRange> segment_;  // the segment that is highlighted
};

}  // namespace volumen
