#pragma once

#include <QStringList>
#include <QTemporaryDir>
#include <glm/mat2x2.hpp>
#include <optional>
#include <tuple>

#include "tests/ui/hung_studies.h"
#include "tests/ui/random_walk.h"
#include "ui/views/view_grid.h"
#include "viewer/volume/volume.h"

namespace volumen::tests {

/// A presentation state: an area of the picture, rotated clockwise by quarter turns, then mirrored.
struct TwinState {
  glm::dvec2 areaFrom{0}, areaTo{0};  ///< pixels from 0, both ends included
  int quarters = 0;
  bool mirrored = false;
};

/// A mammogram, or a frame of a clip, with bright pixels that no turn maps onto each other.
struct TwinPicture {
  Breast breast{};
  glm::dvec2 spacing{0.1};  ///< mm from column to column and from row to row
  VolumePtr values;         ///< in its own mm, with the first pixel's centre at the origin
  std::vector<glm::ivec2> marks;
  std::vector<TwinState> states;
};

/// The state of a view.
struct TwinFrameLook {
  int picture = -1;      ///< -1 if it shows none
  int state = -1;        ///< -1 if as acquired
  glm::dmat2 seen{1};    ///< effect on the picture: turns and mirrors, x right and y down
  glm::dvec2 middle{0};  ///< offset of the view's middle from the picture's, mm, before turns
  double zoom = 1;
  bool inverted = false;
  bool isFacing = false;  ///< at the chest wall, as hung by a protocol
};

/// A length drawn on a picture, pixels.
struct TwinLine {
  int id = 0, picture = 0;
  glm::dvec2 from{0}, to{0};
  QString said;
};

/// The model of window.md, slices.md 2 and protocols.md.
struct FramesTwin {
  std::map<ViewId, TwinFrameLook> looks;
  std::vector<TwinLine> lines;
};

/// A walk through a window that shows four mammograms with two presentation states each, or a clip of four
/// frames. The mammograms are separate series or pictures of one.
class TurnedFrames : public RandomWalk<TurnedFrames, FramesTwin> {
 public:
  explicit TurnedFrames(int seed);

 private:
  friend RandomWalk;
  static const std::vector<Act>& acts();
  QString wrong();
  /// Facing views follow the size of the window, so only the appearance of positions must be restored.
  static Workspace comparable(const Workspace&) { return {}; }
  QString wrongInSession() { return {}; }  // opensSession() is among the acts
  ViewId anyView();
  void afterAct();
  void take(const FramesTwin& twin);
  /// Positions on screen. `seen` maps the picture's mm to the screen.
  struct Seen {
    glm::dmat2 seen{1};
    glm::dvec2 centre{0}, middle{0};  ///< pixels of the picture; mm on screen
    double mmPerPixel = 1;
    glm::dvec2 size{1}, spacing{1};
    glm::dvec2 placeOf(glm::dvec2 pixel) const;
    glm::dvec2 pixelAt(glm::dvec2 place) const;
  };

  FrameView* view(ViewId id) { return window.views()->viewAs<FrameView>(id); }
  bool write();
  bool writePicture(int n, const std::vector<Uint16>& pixels);
  void writeState(int picture, int state, int number);
  void showClip();
  void look();
  void takeHung();
  Seen seen(ViewId id);
  double fittedMm(const TwinFrameLook& look, glm::dvec2 size);
  TwinFrameLook& touched();
  bool isAsFaced(const TwinFrameLook& look) const;

  bool hangs();
  bool turns();
  bool pans();
  bool zooms();
  bool scrolls();
  bool presents();
  bool inverts();
  bool resets();
  bool showsOwnPixels();
  bool measures();
  bool plays();
  bool typesNumber();
  bool links();
  bool movesFocus();
  bool savesSession();
  bool opensSession();
  bool resizes();

  QString wrongNow();
  QString wrongIn(ViewId id);
  QString wrongPicture(ViewId id, const Seen& s);

  QTemporaryDir folder_, sessions_;
  bool isStack_ = false;  // the pictures belong to one series
  bool isClip_ = false;   // and are frames of one file
  std::vector<TwinPicture> pictures_;
  std::vector<ViewId> onScreen_;
  std::map<ViewId, glm::dvec2> sizes_;
  // Looks in which facing views were left.
  std::map<std::tuple<std::size_t, ViewId, int>, std::vector<TwinFrameLook>> faced_;
  std::optional<std::pair<FramesTwin, Workspace>> saved_;  // state in the last session file
  int savedTimes_ = 0;
};

}  // namespace volumen::tests
