#pragma once

#include <vector>

#include "tests/ui/paint_window.h"
#include "tests/ui/random_walk.h"

namespace volumen::tests {

/// A window that edits segments at random by real events and keeps the state after each step.
class SegmentSequence : public PaintWindow {
 public:
  explicit SegmentSequence(int seed) : chance_(std::uint64_t(seed)) {
    (void)makeBoth();
    first_ = steps();
    states_ = {workspace()};
  }

  /// Does one random act, which is at most one undo step. Returns what is wrong, or an empty text.
  QString act();
  /// Undoes to the first state and redoes to the last. Returns what is wrong, or an empty text.
  QString wrongUndone();
  std::size_t states() const { return states_.size(); }

 private:
  struct Act {
    const char* name;
    int often;
    void (SegmentSequence::*run)();
  };
  static const std::vector<Act>& acts();

  bool isState(int n) { return isAs(states_[std::size_t(n)]); }
  QString wrongLabels();
  QString remember(int before, bool isNew);

  ViewId anyView() { return axialViewId + chance_.below(3); }
  // Returns a random pixel of a view, near the balls.
  QPoint anywhere(ViewId id) {
    return pixelOf(12.0 * chance_.vector(), id) + QPoint(chance_.below(9), chance_.below(9));
  }
  std::vector<QPoint> anyWay(ViewId id, int points) {
    std::vector<QPoint> way;
    for (int n = 0; n < points; ++n) way.push_back(anywhere(id));
    return way;
  }
  Qt::KeyboardModifiers ctrlOneIn(int n) { return chance_.oneIn(n) ? Qt::ControlModifier : Qt::NoModifier; }
  Qt::KeyboardModifiers anyKeys() {
    constexpr Qt::KeyboardModifier keys[] = {Qt::NoModifier, Qt::ControlModifier, Qt::AltModifier};
    return keys[chance_.below(3)];
  }
  int rows() { return list()->topLevelItemCount(); }  // segments of all maps
  void pressButton(const char* name) { (void)SegmentWindow::press(name); }

  void looksElsewhere();
  void looksFromAside();
  void paints();
  void outlines();
  void paintsSmartly();
  void tracesLevel();
  void takesPart();
  void takesPartIn3d();
  void finds();
  void grows();
  void changes();
  void makes();
  void fillsBetween();
  void cuts();
  void cutsIn3d();
  void showsTissue();
  void addsOrCopies();
  void removes();
  void chooses();
  void ticks();
  void colours();
  void fades();
  void renames();
  void showsIn3d();
  void follows();
  void undoes();
  void redoes();

  Chance chance_;
  int first_ = 0;                  // undo step at which random acts begin
  std::vector<Workspace> states_;  // states through which undo and redo lead
};

}  // namespace volumen::tests
