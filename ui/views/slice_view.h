#pragma once

#include "ui/views/flat_view.h"

namespace volumen {

/// Shows a plane through the volume of a series. The wheel moves it along its normal, Alt+wheel changes the
/// slab thickness, and lines move and rotate the other planes.
class SliceView : public FlatView {
  Q_OBJECT
 public:
  SliceView(const ViewParts& parts, ViewId id, QWidget* parent);

  LoadedSeriesPtr shown() const override;
  Overlays overlays() const override;
  std::vector<WindowChoice> windows() const override;
  std::optional<Window> windowShown() const override;

 protected:
  SliceRequest requestOf(const SlicePlane& plane) const override;
  void seriesExchanged(bool another) override;
  Warnings warnings() const override;
  QString hoverText(QPointF position) const override;

 private:
  class Slices;
};

}  // namespace volumen
