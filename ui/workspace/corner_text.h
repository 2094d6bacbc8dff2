#pragma once

#include <QStringList>
#include <utility>
#include <vector>

#include "ui/workspace/flat_plane.h"

namespace volumen {

/// Items in the corners of a view, one line each.
enum class CornerItem {
  patient,
  study,  ///< date and time
  series,
  projection,  ///< laterality and view position: "L MLO"
  overlay,
  sexAge,
  thickness,  ///< slice thickness; of the acquired slices if the plane is reformatted
  plane,
  number,
  step,  ///< phase, b-value, echo, ...
  slab,
  link,
  position,
  turn,  ///< rotation and mirroring of the picture
  mark,  ///< lossy compression, key image, presentation state
  mask,
  pixelSize
};

/// The lines of a view's corners. One table says which lines stay in a small view.
class CornerTexts {
 public:
  /// Adds a line; ignores empty texts.
  void add(CornerItem item, const QString& text);
  void add(CornerItem item, const QStringList& texts);
  /// Returns the text of an item; empty if there is none.
  QString text(CornerItem item) const;
  /// Returns the most important lines of a corner, `lines` at most, in reading order.
  QStringList left(int lines = 100) const { return corner(false, lines); }
  QStringList right(int lines = 100) const { return corner(true, lines); }

 private:
  QStringList corner(bool right, int lines) const;

  std::vector<std::pair<CornerItem, QString>> items_;
};

/// Returns "Turned 90°, mirrored", or an empty text for an unturned picture.
QString turnText(PictureTurn turn);

/// Returns date and time of a study, "2026-03-14 10:22:31", or "(no date)" for a DICOM file without one.
QString studyTimeText(const Series& series);

/// Returns sex and age at the study, "F, 45 y". Computes an age that is not given from the birth date.
/// Unknown parts are left out.
QString sexAgeText(const Series& series);

/// Returns laterality and view position, "L MLO", of `frame` (from 0, as in the file; -1: shared by all
/// frames).
QString projectionText(const Series& series, int frame);

/// Returns "Lossy 20:1" for lossy compressed pictures, "Lossy" if the ratio is unknown, else an empty text.
/// Files of a series may differ; one lossy file is enough.
QString lossyText(const Series& series);

/// Returns which volume of its series this is: timePointText(), else the values it was separated by, else its
/// b-value.
QString stepText(const Workspace& workspace, const SeriesKey& series);

/// Returns the lines shown in every view of a series, and the projection of `frame` (from 0; -1: shared by
/// all frames).
CornerTexts seriesCorner(const Series& series, int frame = -1);

/// The position of a plane relative to the acquired slices.
struct PlaneNumber {
  bool reformatted = false;  ///< true if the plane is not an acquired slice
  QString text;  ///< "12 / 31" for an acquired slice; else step and count, or the slices it lies between
};
PlaneNumber planeNumber(const Series& series, const VoxelGeometry& drawn, ViewKind kind,
                        const Crosshair& crosshair, const SlicePlane& plane);

/// Returns all lines of a flat view that shows `plane` of a series.
CornerTexts slicesCorner(const Workspace& workspace, ViewId view, const LoadedSeries& shown,
                         const SlicePlane& plane);

}  // namespace volumen
