#include "ui/overlays/slice_sheet.h"

#include <QFontMetrics>
#include <QPainter>
#include <algorithm>

#include "results/pictures/overlays.h"
#include "results/pictures/picture_font.h"
#include "results/pictures/readable_text.h"

namespace volumen {

namespace {

constexpr int sheetGap = 4;  // pixels, between and around images

QFont sheetFont(int pixels) {
  QFont font = pictureFont();
  font.setPixelSize(pixels);
  return font;
}

}  // namespace

SliceSheet::SliceSheet(int rows, int columns, QSize picture, const QStringList& head)
    : rows_(rows),
      columns_(columns),
      picture_(picture),
      textPixels_(std::clamp(picture.height() / 16, 10, 24)),
      top_(sheetGap + headHeight(head.size())),
      image_(columns * (picture.width() + sheetGap) + sheetGap, top_ + rows * (picture.height() + sheetGap),
             QImage::Format_RGB32) {
  image_.fill(Qt::black);
  for (qsizetype n = 0; n < head.size(); ++n)
    write(head[n], {sheetGap, sheetGap + headHeight(n)}, image_.width() - 2 * sheetGap);
}

int SliceSheet::headHeight(qsizetype lines) const {
  return int(lines) * (QFontMetrics(sheetFont(textPixels_)).height() + 1);
}

QRect SliceSheet::placeOf(int n) const {
  const int row = n / columns_, column = n % columns_;
  return {{sheetGap + column * (picture_.width() + sheetGap), top_ + row * (picture_.height() + sheetGap)},
          picture_};
}

void SliceSheet::add(const QImage& picture, const QString& caption, const QString& left, double mmPerPixel) {
  if (next_ >= rows_ * columns_) return;
  const QRect place = placeOf(next_++);
  {
    QPainter painter(&image_);
    painter.drawImage(place, picture);
  }
  const int height = QFontMetrics(sheetFont(textPixels_)).height();
  write(caption, {place.left() + sheetGap, place.bottom() - height - sheetGap}, place.width() - 2 * sheetGap);
  write(left, {place.left() + sheetGap, place.center().y() + 2 * sheetGap}, place.width() / 2);
  if (!(mmPerPixel > 0)) return;
  Overlays scale;
  scale.mmPerPixel = mmPerPixel;
  scale.taken.emplace_back(place.left(), place.bottom() - height - sheetGap,
                           QFontMetrics(sheetFont(textPixels_)).horizontalAdvance(caption) + sheetGap,
                           height);
  QPainter painter(&image_);
  painter.setFont(sheetFont(textPixels_));
  paintOverlays(painter, scale, place);
}

void SliceSheet::write(const QString& text, QPoint at, int room) {
  QPainter painter(&image_);
  painter.setFont(sheetFont(textPixels_));
  const QString fitting = QFontMetrics(painter.font()).elidedText(text, Qt::ElideRight, room);
  paintReadable(painter, at, fitting, QColor(0xf2, 0xf4, 0xf6));
}

}  // namespace volumen
