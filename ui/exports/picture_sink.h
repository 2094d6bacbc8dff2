#pragma once

#include "io/export/secondary_capture.h"
#include "ui/exports/picture_maker.h"
#include "ui/overlays/picture_pages.h"

class QPrinter;

namespace volumen {

/// Where pictures go: a file, a folder, pages, the clipboard. Its functions run on the thread of an export.
/// What they share must leave no files that look complete if it is destroyed before `finish`.
struct PictureSink {
  /// Takes picture `n`, from 0 in order.
  std::function<Status(std::size_t n, const MadePicture& picture)> take;
  /// Completes an export of `count` pictures; the user cannot cancel it any more. Returns a sentence that
  /// reports success.
  std::function<Result<QString>(std::size_t count)> finish;
  /// Prepares for the first picture.
  std::function<Status()> begin = [] { return Status(); };
  bool isInWindow = false;  ///< its functions take no time and run on the window's thread instead
};

/// Writes the last picture to a PNG or JPEG file with its texts.
PictureSink pictureFile(const QString& path);

/// Writes `count` pictures to files beside each other: "head-007.png" for "head.png" and 7. If such files
/// exist, the names get a further number.
PictureSink numberedFiles(const QString& path, int count);

/// Writes PNG files to a new folder in `parent`, named by PictureLabel::number. The folder appears complete.
PictureSink newFolder(const QString& parent, const QString& name);

/// Writes `count` pictures of a series, all of one size, as a Secondary Capture. `tags.derivation` is made
/// from their texts.
PictureSink captureFile(const QString& path, const Series& series, const CaptureTags& tags, int count);

/// Writes `count` pictures of one size as a film: an animated PNG or MP4 by its name (FilmFile).
PictureSink filmFile(const QString& path, int count, int perSecond);

/// Puts the last picture on the clipboard.
PictureSink clipboard();

/// The arrangement of a contact sheet.
struct SheetLook {
  int columns = 5, rows = 4;
  bool withTexts = true;      ///< common lines above, a number and a scale on each picture
  bool sharesWindow = false;  ///< whether the lines above contain the window
};

/// Arranges the pictures on a contact sheet that goes into another sink.
PictureSink contactSheet(const SheetLook& look, const PictureSink& into);

/// Writes pages with the pictures to a PDF file.
PictureSink pdfPages(const QString& path, const QString& title, const PageLook& look);

/// Prints pages with the pictures.
PictureSink printedPages(const std::shared_ptr<QPrinter>& printer, const PageLook& look);

}  // namespace volumen
