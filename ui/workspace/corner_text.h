#pragma once

#include <QStringList>
#include <utility>
#include <vector>

#include "ui/workspace/flat_plane.h"

namespace volumen {

/// What a corner of a view says, one line each.
enum class CornerItem {
  patient,
  study,  ///< its date and time
  series,
  projection,  ///< side and view: "L MLO"
  overlay,
  sexAge,
  thickness,  ///< of the slices, and of which this is a reformat
  plane,
  number,
  step,  ///< phase, b-value, echo, ...
  slab,
  link,
  position,
  turn,  ///< of the picture
  mark,  ///< lossy compression, a key image, a presentation state
  mask,
  pixelSize
};

/// The lines of a view's corners. Which of them stay where there is little room says one table.
class CornerTexts {
 public:
  /// Empty: nothing is said.
  void add(CornerItem item, const QString& text);
  void add(CornerItem item, const QStringList& texts);
  /// At most so many lines of each corner, those that matter most, in the order in which they are read.
  QStringList left(int lines = 100) const { return corner(false, lines); }
  QStringList right(int lines = 100) const { return corner(true, lines); }

 private:
  QStringList corner(bool right, int lines) const;

  std::vector<std::pair<CornerItem, QString>> items_;
};

/// "Turned 90 degrees, mirrored"; empty where nothing is.
QString turnText(PictureTurn turn);

/// "2026-03-14 10:22:31" of a study; "(no date)" where a DICOM file has none.
QString studyTimeText(const Series& series);

/// "F, 45 y": the age at the study, from the birth date where it is not given; empty where neither is known.
QString sexAgeText(const Series& series);

/// "L MLO": side and view position of a frame, from 0, as in the file; -1: what all frames share.
QString projectionText(const Series& series, int frame);

/// "3 mm thick, 3.3 mm apart"; the distance alone where no thickness is given, and only where it differs;
/// "unevenly apart".
QString thicknessText(const Series& series);

/// "Lossy 20:1" of pictures with losses by compression, "Lossy" where the file does not say how strong it
/// was; empty of others. The files of a series may differ: it is said where any has losses.
QString lossyText(const Series& series);

/// Which volume of its series it is: timePointText(), else what separated it from others.
QString stepText(const Workspace& workspace, const SeriesKey& series);

/// Whose pictures these are: what holds in every view of a series, and of `frame`, from 0, its side and view;
/// -1: of none.
CornerTexts seriesCorner(const Series& series, int frame = -1);

/// How a plane lies to the slices as acquired.
struct PlaneNumber {
  bool reformatted = false;  ///< it is none of the slices as acquired
  QString text;  ///< "12 / 31" of these; of others the step and how many, or between which it lies
};
PlaneNumber planeNumber(const Series& series, const VoxelGeometry& drawn, ViewKind kind,
                        const Crosshair& crosshair, const SlicePlane& plane);

/// All that a flat view says of slices of a series; `plane`: the one that it shows.
CornerTexts slicesCorner(const Workspace& workspace, ViewId view, const LoadedSeries& shown,
                         const SlicePlane& plane);

}  // namespace volumen
