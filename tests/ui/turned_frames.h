#pragma once

#include <QStringList>
#include <QTemporaryDir>
#include <glm/mat2x2.hpp>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "tests/fixtures/chance.h"
#include "tests/ui/hung_studies.h"
#include "tests/ui/journey.h"
#include "ui/views/view_grid.h"
#include "viewer/volume/volume.h"

namespace volumen::tests {

/// How a presentation state has a picture shown: an area of it, turned by quarters clockwise, then mirrored.
struct TwinState {
  glm::dvec2 areaFrom{0}, areaTo{0};  ///< pixels, both ends inside, from 0
  int quarters = 0;
  bool mirrored = false;
};

/// A mammogram, or a frame of a clip, with bright pixels that no turn maps onto each other.
struct TwinPicture {
  Breast breast{};
  glm::dvec2 spacing{0.1};  ///< mm from column to column and from row to row
  VolumePtr values;         ///< in its own mm, the centre of the first pixel at the origin
  std::vector<glm::ivec2> marks;
  std::vector<TwinState> states;
};

/// A view of them.
struct TwinFrameLook {
  int picture = -1;      ///< -1: it shows none
  int state = -1;        ///< -1: as acquired
  glm::dmat2 seen{1};    ///< what was done to the picture: turns and mirrors, x right and y down
  glm::dvec2 middle{0};  ///< mm of the view's middle from that of the picture, before it was turned
  double zoom = 1;
  bool inverted = false;
  bool isFacing = false;  ///< at the chest wall, as a protocol hung it
};

/// A length that was drawn on a picture, pixels.
struct TwinLine {
  int id = 0, picture = 0;
  glm::dvec2 from{0}, to{0};
  QString said;
};

/// A window with four mammograms, series of their own or pictures of one, each with two presentation states,
/// or with a clip of four frames, and their twin from window.md, slices.md 2 and protocols.md: what is done
/// to the one by mouse, keys and menus is done to the other by what these say.
class TurnedFrames : public Journey {
 public:
  explicit TurnedFrames(std::uint64_t seed);

  QString act();
  QString wrong();
  QString wrongUndone();

 private:
  using Looks = std::map<ViewId, TwinFrameLook>;
  struct Known {
    Looks looks;
    std::vector<TwinLine> lines;
    Workspace workspace;
  };
  struct Act {
    const char* name;
    int often;
    bool (TurnedFrames::*act)();
  };
  /// Where places are on screen: `seen` goes from the picture's mm to the screen.
  struct Seen {
    glm::dmat2 seen{1};
    glm::dvec2 centre{0}, middle{0};  ///< pixels of the picture; mm on screen
    double mmPerPixel = 1;
    glm::dvec2 size{1}, spacing{1};
    glm::dvec2 placeOf(glm::dvec2 pixel) const;
    glm::dvec2 pixelAt(glm::dvec2 place) const;
  };

  Session& session() { return window.session(); }
  const Workspace& workspace() { return session().workspace(); }
  FrameView* view(ViewId id) { return window.views()->viewAs<FrameView>(id); }
  bool write();
  bool writePicture(int n, const std::vector<Uint16>& pixels);
  void writeState(int picture, int state, int number);
  void showClip();
  void look();
  void takeHung();
  Seen seen(ViewId id);
  double fittedMm(const TwinFrameLook& look, glm::dvec2 size);
  void remember();
  void take(int step);
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
  bool undoes();
  bool redoes();

  QString wrongNow();
  QString wrongIn(ViewId id);
  QString wrongPicture(ViewId id, const Seen& s);

  Chance chance_;
  QTemporaryDir folder_, sessions_;
  bool isStack_ = false;  // the pictures are those of one series
  bool isClip_ = false;   // and frames of one file
  std::vector<TwinPicture> pictures_;
  Looks looks_;
  std::vector<TwinLine> lines_;
  std::vector<ViewId> onScreen_;
  std::map<ViewId, glm::dvec2> sizes_;
  std::map<std::tuple<std::size_t, ViewId, int>, std::vector<TwinFrameLook>> faced_;  // as facing left views
  std::map<int, Known> known_;
  std::optional<Known> saved_;  // in the last session file
  int savedTimes_ = 0;
  int first_ = 0;
  ViewId focus_ = firstComparedId;
  QString detail_;
  QString fault_;  // in what was done itself; it stays
};

}  // namespace volumen::tests
