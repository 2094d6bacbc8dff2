#include "ui/overlays/picture_pages.h"

#include <QDate>
#include <QPagedPaintDevice>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "results/pictures/picture_font.h"
#include "results/text/text.h"
#include "ui/workspace/corner_text.h"

namespace volumen {

namespace {

// mm
constexpr double cellGap = 4, headText = 3.6, captionText = 2.8, lineSpacing = 1.35, headGap = 3;

double headHeight(const PicturePage& page) {
  return double(std::max<qsizetype>(2, page.head.size())) * headText * lineSpacing + headGap;
}

constexpr double captionHeight = 2 * captionText * lineSpacing + 1,
                 footHeight = captionText * lineSpacing + 1;

// The room between header and foot.
QRectF middleOf(const PicturePage& page, QSizeF paperMm) {
  const double top = headHeight(page);
  return {0, top, paperMm.width(), paperMm.height() - top - footHeight};
}

QRectF cellOf(const PicturePage& page, int n, const PageLook& look, QSizeF paperMm) {
  const QSize grid = pageGrid(look.perPage, paperMm);
  const QRectF room = middleOf(page, paperMm);
  const double width = (room.width() - (grid.width() - 1) * cellGap) / grid.width();
  const double height = (room.height() - (grid.height() - 1) * cellGap) / grid.height();
  return {n % grid.width() * (width + cellGap), room.top() + n / grid.width() * (height + cellGap), width,
          height};
}

QSizeF roomIn(const QRectF& cell) { return {cell.width(), cell.height() - captionHeight}; }

std::optional<QSizeF> trueSize(const PagePicture& picture) {
  if (!picture.mmPerPixel) return {};
  return QSizeF(picture.image.size()) * *picture.mmPerPixel;
}

bool fits(QSizeF size, QSizeF room) {
  constexpr double rounding = 1e-6;
  return size.width() <= room.width() + rounding && size.height() <= room.height() + rounding;
}

class PagePainter {
 public:
  PagePainter(QPainter& painter, double dotsPerMm) : painter_(painter), dotsPerMm_(dotsPerMm) {
    painter_.setRenderHints(QPainter::SmoothPixmapTransform | QPainter::LosslessImageRendering);
    painter_.setPen(Qt::black);
  }

  void image(const QImage& image, const QRectF& mm) { painter_.drawImage(dots(mm), image); }

  void tables(const std::vector<PageTable>& tables, const QRectF& room) {
    paintTables(painter_, tables, room.top(), room.size());
    painter_.setPen(Qt::black);
  }

  // Elides text that is too long.
  void line(const QString& text, QPointF mm, double widthMm, double heightMm, Qt::Alignment alignment) {
    QFont font = pictureFont();
    font.setPixelSize(std::max(1, int(std::lround(heightMm * dotsPerMm_))));
    painter_.setFont(font);
    const QString fitting =
        QFontMetricsF(font, painter_.device()).elidedText(text, Qt::ElideRight, widthMm * dotsPerMm_);
    const QRectF place = dots({mm, QSizeF(widthMm, heightMm * lineSpacing)});
    painter_.drawText(place, int(alignment | Qt::AlignTop | Qt::TextSingleLine), fitting);
  }

 private:
  QRectF dots(const QRectF& mm) const { return {mm.topLeft() * dotsPerMm_, mm.size() * dotsPerMm_}; }

  QPainter& painter_;
  double dotsPerMm_;
};

// Returns "volumen 0.1.0, 2026-03-14".
QString madeByText() {
  return QStringLiteral("volumen " VOLUMEN_VERSION ", %1").arg(QDate::currentDate().toString(Qt::ISODate));
}

QSizeF paperOf(const QPagedPaintDevice& device) {
  return device.pageLayout().paintRect(QPageLayout::Millimeter).size();
}

void paintPicturePage(PagePainter& painter, const PicturePage& page, const QString& number,
                      const PageLook& look, QSizeF paperMm) {
  const double numberWidth = std::min(50.0, paperMm.width() / 3);
  const double left = paperMm.width() - numberWidth, line = headText * lineSpacing;
  for (qsizetype n = 0; n < page.head.size(); ++n)
    painter.line(page.head[n], {0, double(n) * line}, left - headGap, headText, Qt::AlignLeft);
  painter.line(number, {left, 0}, numberWidth, headText, Qt::AlignRight);
  const double foot = paperMm.height() - captionText * lineSpacing, half = paperMm.width() / 2;
  painter.line(tr("Not for clinical use"), {0, foot}, half, captionText, Qt::AlignLeft);
  painter.line(madeByText(), {half, foot}, half, captionText, Qt::AlignRight);
  painter.tables(page.tables, middleOf(page, paperMm));
  for (int n = 0; n < int(page.pictures.size()); ++n) {
    const PagePicture& picture = page.pictures[std::size_t(n)];
    painter.image(picture.image, pagePlace(page, n, look, paperMm));
    const QRectF cell = cellOf(page, n, look, paperMm);
    const QPointF under(cell.left(), cell.bottom() - captionHeight + 1);
    painter.line(picture.caption, under, cell.width(), captionText, Qt::AlignHCenter);
    painter.line(scaleText(page, n, look, paperMm), under + QPointF(0, captionText * lineSpacing),
                 cell.width(), captionText, Qt::AlignHCenter);
  }
}

}  // namespace

QStringList pageHead(const Series& series) {
  QStringList patient{patientText(series), sexAgeText(series)};
  patient.removeAll(QString());
  return {patient.join(QStringLiteral(", ")), studyText(series)};
}

QSizeF roomOfPage(const QStringList& head, QSizeF paperMm) {
  return roomIn(cellOf({head, {}}, 0, {1, true}, paperMm));
}

QSize pageGrid(int perPage, QSizeF paperMm) {
  const int shorter = int(std::floor(std::sqrt(double(perPage)))), longer = (perPage + shorter - 1) / shorter;
  return paperMm.width() > paperMm.height() ? QSize(longer, shorter) : QSize(shorter, longer);
}

bool isInTrueSize(const PicturePage& page, int n, const PageLook& look, QSizeF paperMm) {
  const auto size = trueSize(page.pictures[std::size_t(n)]);
  return look.inTrueSize && size && fits(*size, roomIn(cellOf(page, n, look, paperMm)));
}

QRectF pagePlace(const PicturePage& page, int n, const PageLook& look, QSizeF paperMm) {
  const PagePicture& picture = page.pictures[std::size_t(n)];
  const QRectF cell = cellOf(page, n, look, paperMm);
  const QSizeF room = roomIn(cell);
  const QSizeF size = isInTrueSize(page, n, look, paperMm)
                          ? *trueSize(picture)
                          : QSizeF(picture.image.size()).scaled(room, Qt::KeepAspectRatio);
  return {QPointF(cell.left() + (room.width() - size.width()) / 2,
                  cell.top() + (room.height() - size.height()) / 2),
          size};
}

QString scaleText(const PicturePage& page, int n, const PageLook& look, QSizeF paperMm) {
  const PagePicture& picture = page.pictures[std::size_t(n)];
  if (!look.inTrueSize) return {};
  if (!picture.mmPerPixel) return tr("Not true size: not calibrated");
  if (!isInTrueSize(page, n, look, paperMm)) return tr("Not true size: too large for its place");
  return picture.lengthsWord.isEmpty() ? tr("True size") : tr("True size (%1)").arg(picture.lengthsWord);
}

std::vector<std::vector<PageTable>> tablesOnPages(const std::vector<PageTable>& tables,
                                                  const QStringList& head, QPagedPaintDevice& device) {
  return dividedTables(tables, middleOf({head, {}}, paperOf(device)).size(), device);
}

Status paintPages(QPagedPaintDevice& device, const PageSource& pages, const PageLook& look) {
  const Error cannot{tr("The printer or its file cannot be written to.").toStdString()};
  const QSizeF paperMm = paperOf(device);
  QPainter painter;
  if (!painter.begin(&device)) return cannot;
  PagePainter pagePainter(painter, device.logicalDpiX() / 25.4);
  for (std::size_t n = 0; n < pages.count; ++n) {
    if (n > 0 && !device.newPage()) return cannot;
    const QString number = tr("Page %1 of %2").arg(n + 1).arg(pages.count);
    paintPicturePage(pagePainter, pages.page(n), number, look, paperMm);
  }
  return painter.end() ? Status() : Status(cannot);
}

}  // namespace volumen
