#pragma once

#include <QImage>
#include <QLabel>
#include <QMimeData>
#include <QTimer>
#include <QWidget>
#include <functional>
#include <vector>

#include "ui/overlays/overlays.h"
#include "ui/tools/tool.h"
#include "ui/workspace/session.h"

namespace volumen {

class DropMark;

/// One view of the workspace: shows what its ViewState says, at device pixels, and is in focus once it is
/// pressed.
class View : public QWidget {
  Q_OBJECT
 public:
  View(Session& session, ViewId id, QWidget* parent = nullptr);

  ViewId id() const { return id_; }
  Session& session() const { return session_; }
  const ViewState& state() const { return session_.workspace().view(id_); }
  /// Null: none, or it is not in memory yet.
  LoadedSeriesPtr series() const { return session_.seriesOf(id_); }
  /// How many device pixels the picture should have.
  QSize pixels() const;
  /// Whether its volume is being read or cut. The last picture of the series, or of another step of it, stays
  /// until then, with a mark where that takes longer than a moment.
  bool isWaiting() const;
  /// Whether its picture is of what the workspace says: else what is written over it is of another one.
  virtual bool hasItsPicture() const { return !isWaiting(); }
  /// What is seen of it now, at its pixels(), but for what is there to be used: bars, the frame of the focus.
  virtual QImage capture() const;
  /// What is not as it seems in it, whole sentences.
  virtual QStringList warningsShown() const { return {}; }
  /// What is being read of this series will not come.
  void giveUpWaiting(const SeriesKey& series);

 Q_SIGNALS:
  void pixelsChanged();
  void maximiseRequested();
  /// A right click, the Menu key or Shift+F10: a menu is to be opened here.
  void menuRequested(QPoint global);
  /// A series was dropped.
  void dropped(const QMimeData& data);
  /// The connected part of a place is to be taken.
  void partClicked(const volumen::PartClick& click);
  /// A part of a stroke is to be painted.
  void strokePainted(const volumen::SegmentStroke& stroke);
  /// A ball is being drawn, was drawn, or is none any more.
  void ballDrawn(const volumen::DrawnBall& ball);
  /// The current segment is to be cut.
  void segmentCut(const volumen::SegmentCut& cut);
  /// What is under the cursor, empty where nothing is.
  void hovered(const QString& text);

 protected:
  /// The series that is shown was exchanged, or what is known of it. `another`: it is not the one of before,
  /// nor another step of it.
  virtual void seriesExchanged(bool another) = 0;
  /// Something of the workspace changed.
  virtual void workspaceChanged(const Workspace& before) = 0;

  /// All that capture() holds, but for badges(), in logical pixels.
  virtual void paintShown(QPainter& painter) const = 0;
  /// The same in so many pixels, as wide as the view, where `paint` takes the place of paintShown().
  QImage captureBy(QSize pixels, const std::function<void(QPainter&)>& paint) const;
  /// The same over what an image as large as that shows, which is not copied where nobody else has it.
  void captureOver(QImage& image, const std::function<void(QPainter&)>& paint) const;
  /// Widgets of its own that say something of the picture.
  virtual std::vector<QWidget*> badges() const { return {loading_}; }
  /// What is to be said of a place of the view, logical pixels; empty: nothing.
  virtual QString textAt(QPointF position) const = 0;
  /// Whether there is something that a menu could be about.
  virtual bool hasMenu() const { return false; }
  /// The cursor is here: hovered() tells what is under it, now and whenever that changes beneath it.
  void pointAt(QPointF position);
  /// Where it is; none: not over the view.
  std::optional<QPointF> pointedAt() const { return pointedAt_; }
  /// What is under the cursor may be something else now.
  void tellPointed();

  /// What is written over the last picture while isWaiting(): whose, and which step is awaited.
  Overlays waitingOverlays() const;
  /// A thin frame where this is the view in focus of several; in a view to compare that shows nothing what
  /// may be dropped there.
  void paintFocus(QPainter& painter) const;
  /// The date of its study, where views on screen show several; else empty.
  QString dateBeside() const;

  bool event(QEvent*) override;
  void paintEvent(QPaintEvent*) override;
  void dragEnterEvent(QDragEnterEvent*) override;
  void dragLeaveEvent(QDragLeaveEvent*) override;
  void dropEvent(QDropEvent*) override;
  void mousePressEvent(QMouseEvent*) override;
  void mouseDoubleClickEvent(QMouseEvent*) override;
  void keyPressEvent(QKeyEvent*) override;
  void focusInEvent(QFocusEvent*) override;
  void leaveEvent(QEvent*) override;
  void hideEvent(QHideEvent*) override;
  void resizeEvent(QResizeEvent*) override;

  Session& session_;

 private:
  void paintInvitation(QPainter& painter) const;
  bool followSeries();
  void showWaiting();
  void followPixels();
  void showDropMark(bool on);

  const ViewId id_;
  LoadedSeriesPtr seen_;
  std::shared_ptr<const Series> shownLast_;
  SeriesKey givenUp_;                 // will not come
  std::optional<QPointF> pointedAt_;  // while the cursor is over the view
  QLabel* loading_;
  DropMark* dropMark_;  // while a series is dragged over the view
  QTimer loadingSoon_;
};

}  // namespace volumen
