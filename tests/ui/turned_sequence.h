#pragma once

#include <QStringList>
#include <map>

#include "tests/fixtures/chance.h"
#include "tests/ui/journey.h"
#include "tests/ui/turned_twin.h"
#include "ui/views/slice_view.h"
#include "ui/views/view_grid.h"

namespace volumen::tests {

/// A window with two series of one frame of reference, in planes and in a grid of four, the first of them of
/// several time points, and its twin: what is done by chance to the one by mouse, keys and actions is done to
/// the other by what the documents say.
class TurnedSequence : public Journey {
 public:
  explicit TurnedSequence(std::uint64_t seed);

  /// One thing by chance; what, for people. Empty: nothing could be done.
  QString act();
  /// What is not as the twin has it, in any view of slices on screen; empty: all is.
  QString wrong();
  /// The same once everything is undone, and once it is done again.
  QString wrongUndone();
  /// What is not as it was in another window that opens the session of this one; empty: all is.
  QString wrongInSession();
  /// Whether the twin cannot tell, so that the sequence ends here.
  bool isUndecided() const { return twin_.isAtTheLimit(); }

 private:
  struct Known {
    TurnedTwin twin;
    Workspace workspace;
  };
  struct Act {
    const char* name;
    int often;
    bool (TurnedSequence::*act)();
  };
  static const std::vector<Act>& acts();

  Session& session() { return window.session(); }
  const Workspace& workspace() { return session().workspace(); }
  SliceView* view(ViewId id) { return window.views()->viewAs<SliceView>(id); }
  void look();
  void remember();
  void take(int step);
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
  bool undoes();
  bool redoes();

  const Volume& volumeOf(const TwinLook& look) const;
  QString wrongIn(ViewId id);
  QString wrongPlace(ViewId id);
  QString wrongTexts(ViewId id);
  QString wrongPicture(ViewId id);
  QString wrongShapes(ViewId id);
  int expectedGreen(const TwinSeen& seen, const TwinLook& look, glm::ivec2 pixel, glm::dvec3 shift);

  Chance chance_;
  std::vector<LoadedSeriesPtr> series_;
  std::vector<LoadedSeriesPtr> later_;          // time points of the first of them, behind it
  std::vector<std::vector<glm::dvec3>> marks_;  // of each series, patient
  TurnedTwin twin_;
  std::map<int, Known> known_;  // by steps of undo
  int first_ = 0;               // step at which chance begins
  ViewId focus_ = 0;
  QString detail_;
  QString fault_;  // in what was done itself; it stays
};

}  // namespace volumen::tests
