#pragma once

#include <QImage>
#include <QStringList>

namespace volumen {

/// Images of one size in rows and columns on black, each with a caption in its corner, below common header
/// lines. Works on any thread if a QGuiApplication exists.
class SliceSheet {
 public:
  SliceSheet(int rows, int columns, QSize picture, const QStringList& head);

  /// Adds the next image, with the letters of its left side at that edge and a scale bar unless `mmPerPixel`
  /// is 0; ignored if the sheet is full.
  void add(const QImage& picture, const QString& caption, const QString& left = {}, double mmPerPixel = 0);
  const QImage& image() const { return image_; }
  /// Returns the rectangle of image `n` (from 0) in pixels.
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
