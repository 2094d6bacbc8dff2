#pragma once

#include <QImage>
#include <QRectF>
#include <QStringList>
#include <functional>
#include <optional>
#include <vector>

#include "viewer/volume/result.h"

class QPagedPaintDevice;
class QPainter;

namespace volumen {

struct Series;

/// A picture on a page, and what is written under it.
struct PagePicture {
  QImage image;
  std::optional<double> mmPerPixel;  ///< none: it is not calibrated
  QString caption;
  QString lengthsWord = {};  ///< what is true of its mm: "at detector"; empty: they are the patient's
};

/// Pictures that stand on one page, and what stands above them: lines at the left.
struct PicturePage {
  QStringList head;
  std::vector<PagePicture> pictures;
};

/// Pages that are there one at a time, each when it is painted.
struct PageSource {
  std::size_t count = 0;
  std::function<PicturePage(std::size_t n)> page;
};

/// How many pictures a page has at most, and whether they are as large as the patient where there is room.
struct PageLook {
  int perPage = 6;
  bool inTrueSize = false;
};

/// Whose pictures a page holds: lines of patient and study.
QStringList pageHead(const Series& series);

/// How much room a picture has that stands alone on a page, mm.
QSizeF roomOfPage(const QStringList& head, QSizeF paperMm);

/// Columns and rows of a page of this size for so many pictures.
QSize pageGrid(int perPage, QSizeF paperMm);

/// Where picture `n` (from 0) of a page lies, mm from its top left corner: in the middle of its cell, whole,
/// its caption under it. In true size where it fits so.
QRectF pagePlace(const PicturePage& page, int n, const PageLook& look, QSizeF paperMm);

/// Whether a picture is as large as the patient on a page.
bool isInTrueSize(const PicturePage& page, int n, const PageLook& look, QSizeF paperMm);

/// What stands under a picture that should be as large as the patient: "True size", and what is true of its
/// mm where they are not the patient's, or why it is not. Empty where it should not.
QString scaleText(const PicturePage& page, int n, const PageLook& look, QSizeF paperMm);

/// Paints the pages. An Error where the device cannot be written to.
Status paintPages(QPagedPaintDevice& device, const PageSource& pages, const PageLook& look);

}  // namespace volumen
