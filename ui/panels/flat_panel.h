#pragma once

#include "ui/panels/value_fields.h"
#include "ui/widgets/bind.h"
#include "ui/workspace/session.h"

namespace volumen {

/// The state of a view of slices or frames. Only the view knows it, as it reads the frames.
struct FlatShown {
  ViewId view = 0;
  LoadedSeriesPtr series;        ///< frames appear as a series of one slice; null if not loaded
  std::optional<Window> window;  ///< in use, with negative width if inverted; empty for colours
  QStringList windows;           ///< windows to choose by name
  int chosen = -1;               ///< index of the one in use, -1 if none
};

/// Access to the view that a panel of flat views works on.
struct FlatInFocus {
  std::function<std::optional<FlatShown>()> shown;  ///< returns nothing unless slices or frames are in focus
  std::function<void(int)> chooseWindow;            ///< index into FlatShown::windows
  std::function<void()> invert;
};

/// Sets how the slices or frames in focus are shown: window, colours, overlay, slab, interpolation. Also
/// lists facts about their series. Parts that do not apply are hidden.
class FlatPanel : public QWidget {
  Q_OBJECT
 public:
  /// `overlays` is the menu that chooses the overlay of the slices in focus.
  FlatPanel(Session& session, FlatInFocus focus, QMenu* overlays, QWidget* parent = nullptr);

  /// Updates the panel for the view in focus.
  void refresh();
  /// Sets whether the panel is visible. Behind another tab it computes nothing.
  void setWatched(bool watched);

 protected:
  void showEvent(QShowEvent*) override;

 private:
  QWidget* makeWindow();
  QWidget* makeColours();
  QWidget* makeOverlay(QMenu* overlays);
  QWidget* makeSlab();
  void followSession();
  void showWindow(const FlatShown& shown);
  void showOverlay(const FlatShown& shown);
  void setWindow(WindowEnds ends);
  void setOverlayWindow(WindowEnds ends);
  /// Returns the look of the view, or of all planes that show the same series.
  Source<FlatLook> looks(bool ofAllPlanes);

  Session& session_;
  const FlatInFocus focus_;
  bool isWatched_ = false;
  std::optional<FlatShown> shown_;  // as last shown
  std::vector<Follower<FlatLook>> lookFollowers_;
  std::vector<Follower<SeriesState>> seriesFollowers_;
  QWidget *overlay_, *slab_;
  QComboBox *choice_, *colourMap_;
  ValueFields *values_, *overlayValues_;
  QCheckBox *inverted_, *interpolated_;
  QToolButton* overlayName_;
  QWidget* overlayParts_;
  QLabel *noWindow_, *noSlab_, *facts_;
};

}  // namespace volumen
