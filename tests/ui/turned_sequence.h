#pragma once

#include <QStringList>

#include "tests/ui/random_walk.h"
#include "tests/ui/turned_twin.h"
#include "ui/views/slice_view.h"
#include "ui/views/view_grid.h"

namespace volumen::tests {

/// A walk through a window that shows two series of one frame of reference, in planes and in a grid of four.
/// The first series has several time points.
class TurnedSequence : public RandomWalk<TurnedSequence, TurnedTwin> {
 public:
  explicit TurnedSequence(int seed);

 private:
  friend RandomWalk;
  static const std::vector<Act>& acts();
  QString wrong();
  bool isUndecided() const { return twin_.isAtTheLimit(); }
  ViewId anyView();
  void afterAct() { look(); }
  void take(const TurnedTwin& twin);
  SliceView* view(ViewId id) { return window.views()->viewAs<SliceView>(id); }
  void look();
  glm::dvec2 somewhere(ViewId id, double share);

  bool turns();
  bool pans();
  bool zooms();
  bool scrolls();
  bool movesCrosshair();
  bool turnsPlanes();
  bool alignsPlanes();
  bool resetsView();
  bool choosesLayout();
  bool choosesKind();
  bool links();
  bool inverts();
  bool overlays();
  bool measures();
  bool stepsInTime();
  bool plays();
  bool makesThicker();
  bool choosesSlab();
  bool showsOwnPixels();
  bool typesNumber();
  bool movesFocus();
  bool resizes();

  const Volume& volumeOf(const TwinLook& look) const;
  QString wrongIn(ViewId id);
  QString wrongPlace(ViewId id);
  QString wrongTexts(ViewId id);
  QString wrongPicture(ViewId id);
  QString wrongShapes(ViewId id);
  int expectedGreen(const TwinSeen& seen, const TwinLook& look, glm::ivec2 pixel, glm::dvec3 shift);

  std::vector<LoadedSeriesPtr> series_;
  std::vector<LoadedSeriesPtr> later_;          // further time points of the first series
  std::vector<std::vector<glm::dvec3>> marks_;  // of each series, patient mm
};

}  // namespace volumen::tests
