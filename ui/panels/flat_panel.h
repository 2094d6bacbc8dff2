#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QToolButton>

#include "ui/panels/value_fields.h"
#include "ui/widgets/number_row.h"
#include "ui/workspace/session.h"

class QVBoxLayout;

namespace volumen {

/// What slices or frames show, as their view knows it: it is there that frames are read.
struct FlatShown {
  ViewId view = 0;
  LoadedSeriesPtr series;        ///< frames as one of one slice; null: nothing is in memory
  std::optional<Window> window;  ///< in use, a negative width is inverted; none: colours
  QStringList windows;           ///< to choose by name
  int chosen = -1;               ///< of them; -1: none
};

/// The view that a panel of flat views works on.
struct FlatInFocus {
  std::function<std::optional<FlatShown>()> shown;  ///< none: no slices and no frames are in focus
  std::function<void(int)> chooseWindow;            ///< of FlatShown::windows
  std::function<void()> invert;
};

/// How slices or frames in focus are shown: window, colours, what lies over them, slab, interpolation; and
/// what is known of their series. Parts that mean nothing there are hidden.
class FlatPanel : public QWidget {
  Q_OBJECT
 public:
  /// `overlays`: the menu that chooses a series to lie over the slices in focus.
  FlatPanel(Session& session, FlatInFocus focus, QMenu* overlays, QWidget* parent = nullptr);

  /// Shows what is in focus now.
  void refresh();
  /// Whether it is seen: behind another tab nothing is worked out for it.
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
  void showSlab(const FlatShown& shown);
  void setWindow(WindowEnds ends);
  void setOverlayWindow(WindowEnds ends);
  /// Of all planes that show the same.
  void editLooks(const QString& text, const std::function<void(FlatLook&)>& change,
                 const QString& mergeKey = {});

  Session& session_;
  const FlatInFocus focus_;
  bool isWatched_ = false;
  std::optional<FlatShown> shown_;  // last
  QWidget *window_, *colours_, *overlay_, *slab_;
  QComboBox *choice_, *colourMap_, *overlayColours_, *slabMode_;
  ValueFields *values_, *overlayValues_;
  QCheckBox *inverted_, *interpolated_;
  QToolButton* overlayName_;
  QWidget* overlayParts_;
  NumberRow* opacity_;
  QDoubleSpinBox* slabMm_;
  QLabel *noWindow_, *noSlab_, *facts_;
};

}  // namespace volumen
