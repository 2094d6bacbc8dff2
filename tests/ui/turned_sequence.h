#pragma once

#include <QStringList>
#include <map>

#include "tests/fixtures/chance.h"
#include "tests/ui/journey.h"
#include "tests/ui/turned_twin.h"
#include "ui/views/slice_view.h"
#include "ui/views/view_grid.h"

namespace volumen::tests {

/// A window and its reference model. The window shows two series of one frame of reference, in planes and in
/// a grid of four. The first series has several time points. Random acts by mouse, keys and actions are
/// repeated on the model as the documents describe them.
class TurnedSequence : public Journey {
 public:
  explicit TurnedSequence(std::uint64_t seed);

  /// Does one random act and returns its description; empty if nothing could be done.
  QString act();
  /// Returns a difference from the reference model in any view of slices on screen; empty if there is none.
  QString wrong();
  /// Returns a difference once everything is undone, and once it is redone.
  QString wrongUndone();
  /// Returns a difference in another window that opens this one's session; empty if there is none.
  QString wrongInSession();
  /// Returns whether the reference model cannot decide, so that the sequence ends here.
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
  std::vector<LoadedSeriesPtr> later_;          // further time points of the first series
  std::vector<std::vector<glm::dvec3>> marks_;  // of each series, patient mm
  TurnedTwin twin_;
  std::map<int, Known> known_;  // by undo step
  int first_ = 0;               // undo step at which random acts begin
  ViewId focus_ = 0;
  QString detail_;
  QString fault_;  // in an act itself; it stays
};

}  // namespace volumen::tests
