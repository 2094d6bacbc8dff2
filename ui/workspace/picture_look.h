#pragma once

#include <QSize>
#include <map>
#include <optional>

#include "ui/data/loaded_series.h"
#include "ui/workspace/preferences.h"
#include "ui/workspace/workspace.h"

namespace volumen {

/// Names a flat view and the workspace that holds its state at one moment.
struct PictureStop {
  Workspace workspace;
  ViewId view = 0;
  /// Of the series that it shows and that are measured in it those in memory, which stay there for it.
  std::map<SeriesKey, LoadedSeriesPtr> held = {};
  std::optional<Preferences> preferences = {};  ///< none: those of the session as the picture is made
};

/// How large pictures of flat views are, and what is written over them.
struct PictureLook {
  enum class Size {
    asSeen,  ///< what the view shows, `seen` at its pixels
    wide,    ///< the same, so many pixels wide
    own,     ///< all of the picture, a pixel for each of its own
    whole,   ///< all of the picture, its longer edge so many pixels
    paper    ///< `mm` about the middle of what the view shows, as large as the patient
  };
  Size size = Size::asSeen;
  int edge = 1024;        ///< of `wide` and `whole`: pixels
  QSize seen{640, 640};   ///< of the view, logical pixels
  QSizeF mm;              ///< of `paper`
  bool withTexts = true;  ///< and lines and measurements
  bool namesHidden = false;
};

}  // namespace volumen
