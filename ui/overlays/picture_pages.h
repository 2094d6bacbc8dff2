#pragma once

#include <QImage>
#include <QRectF>
#include <QStringList>
#include <functional>
#include <optional>
#include <vector>

#include "ui/overlays/page_tables.h"
#include "viewer/volume/result.h"

class QPagedPaintDevice;
class QPainter;

namespace volumen {

struct Series;

/// An image on a page with its caption.
struct PagePicture {
  QImage image;
  std::optional<double> mmPerPixel;  ///< empty: not calibrated
  QString caption;
  QString lengthsWord = {};  ///< the meaning of its mm: "at detector"; empty: patient mm
};

/// The images or tables on one page, and the left-aligned header lines above them.
struct PicturePage {
  QStringList head;
  std::vector<PagePicture> pictures;
  std::vector<PageTable> tables = {};
};

/// Pages that are made one at a time, when they are painted.
struct PageSource {
  std::size_t count = 0;
  std::function<PicturePage(std::size_t n)> page;
};

/// Images per page, and whether they are in true size if they fit.
struct PageLook {
  int perPage = 6;
  bool inTrueSize = false;
};

/// Returns the header lines of a page: patient and study.
QStringList pageHead(const Series& series);

/// Returns the room of a single image on a page, in mm.
QSizeF roomOfPage(const QStringList& head, QSizeF paperMm);

/// Returns columns and rows of a page of this size for `perPage` images.
QSize pageGrid(int perPage, QSizeF paperMm);

/// Returns the rectangle of image `n` (from 0) on a page, in mm from the top left corner. It is centred and
/// fits into its cell above its caption, in true size if possible.
QRectF pagePlace(const PicturePage& page, int n, const PageLook& look, QSizeF paperMm);

/// True if an image has true size on a page.
bool isInTrueSize(const PicturePage& page, int n, const PageLook& look, QSizeF paperMm);

/// Returns the note below an image that is to have true size: "True size" and the meaning of mm other than
/// the patient's, or why it is not. Empty if true size is not requested.
QString scaleText(const PicturePage& page, int n, const PageLook& look, QSizeF paperMm);

/// Returns the tables as they fit on pages of a device below this header, one element a page.
std::vector<std::vector<PageTable>> tablesOnPages(const std::vector<PageTable>& tables,
                                                  const QStringList& head, QPagedPaintDevice& device);

/// Paints the pages. Each ends with "Not for clinical use", the version and the date. The Error: the device
/// cannot be written to.
Status paintPages(QPagedPaintDevice& device, const PageSource& pages, const PageLook& look);

}  // namespace volumen
