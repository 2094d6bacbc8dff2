#pragma once

#include <QImage>
#include <QTimer>
#include <QWidget>
#include <memory>
#include <optional>

#include "ui/controller/slice_service.h"
#include "ui/workspace/workspace.h"

namespace volumen {

class FrameService;

/// A slice of a series while the rest of it is being loaded, as acquired; the middle one at first, the wheel
/// scrolls. It lies over the views and takes no part in the document.
class FirstImage : public QWidget {
  Q_OBJECT
 public:
  FirstImage(FrameService& frames, SliceService& slices, QWidget* parent);

  /// Shows a slice of the series of a state as its volume will be seen, as far as that is known by then; once
  /// it is read, unless that comes after end().
  void begin(const SeriesState& state);
  void end();
  /// Of what is on screen, from 0.
  int index() const { return frame_ ? frame_->key.index : 0; }
  const QImage& picture() const { return picture_; }

 Q_SIGNALS:
  /// A slice was read, and this is to lie over the views.
  void appears();

 protected:
  void paintEvent(QPaintEvent*) override;
  void resizeEvent(QResizeEvent*) override;
  void wheelEvent(QWheelEvent*) override;

 private:
  void go(int index, int step);
  void takeFrame(int view, const LoadedFramePtr& frame);
  void takePicture(const SlicePicture& picture);
  void askForPicture();
  SeriesState shownState() const;

  FrameService& frames_;
  SliceService& slices_;
  SeriesState state_;
  std::shared_ptr<const Series> series_;  // of it; null: it has ended
  int wanted_ = 0;
  double wheelRest_ = 0;  // notches not yet scrolled
  LoadedFramePtr frame_;
  QImage picture_;
};

}  // namespace volumen
