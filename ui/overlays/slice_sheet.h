#pragma once

#include <QImage>
#include <QStringList>

namespace volumen {

/// Pictures of one size in rows and columns on black, from the top left on, each with its caption in its
/// corner, under lines that hold for all of them. Works on any thread, once there is a QGuiApplication.
class SliceSheet {
 public:
  SliceSheet(int rows, int columns, QSize picture, const QStringList& head);

  /// The next one, with the letters of its left side at that edge; beyond the last place nothing is added.
  void add(const QImage& picture, const QString& caption, const QString& left = {});
  const QImage& image() const { return image_; }
  /// Where picture `n` (from 0) lies, pixels.
  QRect placeOf(int n) const;

 private:
  void write(const QString& text, QPoint at, int room);
  int headHeight(qsizetype lines) const;

  int rows_, columns_, next_ = 0;
  QSize picture_;
  int textPixels_;
  int top_;  // of the first row
  QImage image_;
};

}  // namespace volumen
