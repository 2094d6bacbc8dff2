#pragma once

#include <QImage>
#include <QLabel>
#include <QMimeData>
#include <QTimer>
#include <QWidget>
#include <functional>
#include <optional>
#include <vector>

#include "results/pictures/overlays.h"
#include "ui/tools/tool.h"
#include "ui/workspace/session.h"

namespace volumen {

class DropMark;

/// One view of the workspace. It shows its ViewState at device pixels and takes the focus when pressed.
class View : public QWidget {
  Q_OBJECT
 public:
  View(Session& session, ViewId id, QWidget* parent = nullptr);

  ViewId id() const { return id_; }
  Session& session() const { return session_; }
  const ViewState& state() const { return session_.workspace().view(id_); }
  /// Returns null if there is no series or it is not in memory yet.
  LoadedSeriesPtr series() const { return session_.seriesOf(id_); }
  /// Returns the size of the picture in device pixels.
  QSize pixels() const;
  /// Returns whether its volume is being read or masked. Until then the last picture of the series, or of
  /// another time point, stays. It is marked after a moment.
  bool isWaiting() const;
  /// Returns whether the picture corresponds to the workspace. Otherwise the texts over it belong to another
  /// picture.
  virtual bool hasItsPicture() const { return !isWaiting(); }
  /// Returns the view as seen, at pixels(), without controls such as bars and the focus frame.
  virtual QImage capture() const;
  /// Returns warnings about the picture, whole sentences.
  virtual QStringList warningsShown() const { return {}; }
  /// Stops waiting for this series because it will not be loaded.
  void giveUpWaiting(const SeriesKey& series);

 Q_SIGNALS:
  void pixelsChanged();
  void maximiseRequested();
  /// A right click, the Menu key or Shift+F10 asks for a menu at this position.
  void menuRequested(QPoint global);
  /// A series was dropped.
  void dropped(const QMimeData& data);
  /// Text about the point under the cursor; empty if there is nothing.
  void hovered(const QString& text);

 protected:
  /// The series shown, or its metadata, was replaced. `another` is false for the same series and for another
  /// time point of it.
  virtual void seriesExchanged(bool another) = 0;
  /// The workspace changed.
  virtual void workspaceChanged(const Workspace& before) = 0;

  /// Paints the content of capture() without badges(), in logical pixels.
  virtual void paintShown(QPainter& painter) const = 0;
  /// Returns a capture of `pixels` with the width of the view, painted by `paint` instead of paintShown().
  QImage captureBy(QSize pixels, const std::function<void(QPainter&)>& paint) const;
  /// Paints a capture onto `image`, which sets the size. The image is not copied if it is not shared.
  void captureOver(QImage& image, const std::function<void(QPainter&)>& paint) const;
  /// Returns its widgets that belong to the picture.
  virtual std::vector<QWidget*> badges() const { return {loading_}; }
  /// Returns the text about a point in logical pixels; empty if there is none.
  virtual QString textAt(QPointF position) const = 0;
  /// Returns whether a menu can be opened.
  virtual bool hasMenu() const { return false; }
  /// Sets the cursor position. hovered() reports what is under it, now and whenever that changes.
  void pointAt(QPointF position);
  /// Returns the cursor position; nothing if it is outside the view.
  std::optional<QPointF> pointedAt() const { return pointedAt_; }
  /// Reports what is under the cursor, because it may have changed.
  void tellPointed();

  /// Returns whether the series or frame of the workspace is being read. After a moment the view says so.
  virtual bool isLoading() const { return isWaiting(); }
  /// Shows or hides the loading mark. To be called where isLoading() may have changed.
  void showWaiting();
  /// Sets how much of the awaited picture is read, for the loading mark; empty if that is not known.
  void setPercentRead(std::optional<int> percent);
  /// Returns the texts over the last picture while isLoading(): its series and the awaited time point.
  Overlays waitingOverlays() const;
  /// Paints a thin frame if several views are on screen and this one has the focus. An empty view for
  /// comparison gets an invitation to drop a series.
  void paintFocus(QPainter& painter) const;
  /// Returns the date of its study if views on screen show several studies; otherwise empty.
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
  void followPixels();
  void showDropMark(bool on);
  void placeLoading();

  const ViewId id_;
  LoadedSeriesPtr seen_;
  std::shared_ptr<const Series> shownLast_;
  SeriesKey givenUp_;                 // series that will not be loaded
  std::optional<QPointF> pointedAt_;  // set while the cursor is over the view
  QLabel* loading_;
  DropMark* dropMark_;  // shown while a series is dragged over the view
  QTimer loadingSoon_;
};

}  // namespace volumen
