#pragma once

#include <QSize>
#include <QStringList>
#include <map>

#include "results/series/loaded_series.h"
#include "ui/workspace/preferences.h"
#include "ui/workspace/workspace.h"

namespace volumen {

/// What pages and file names state of a picture.
struct PictureLabel {
  QStringList head = {};  ///< header lines of its page: patient and study
  QString caption = {};   ///< the line below it
  int group = 0;          ///< pictures of different groups are on different pages
  int number = 0;         ///< number in the name of its file
};

/// A flat view, and the workspace that holds its state at one moment.
struct PictureStop {
  Workspace workspace;
  ViewId view = 0;
  /// The series shown and measured in the view that are in memory; they stay there for it.
  std::map<SeriesKey, LoadedSeriesPtr> held = {};
  Preferences preferences = {};
  PictureLabel label = {};
};

/// The size of pictures of flat views, and what is written over them.
struct PictureLook {
  enum class Size {
    asSeen,  ///< the view's content, in its pixels (`seen`)
    wide,    ///< the same, `edge` pixels wide
    own,     ///< the full picture at its own pixel size
    whole,   ///< the full picture, its longer edge `edge` pixels
    paper    ///< `mm` about the middle of the view, as large as the patient
  };
  Size size = Size::asSeen;
  int edge = 1024;        ///< pixels, for `wide` and `whole`
  QSize seen{640, 640};   ///< logical pixels of the view
  QSizeF mm;              ///< for `paper`
  bool withTexts = true;  ///< also lines and measurements
  bool namesHidden = false;
};

}  // namespace volumen
