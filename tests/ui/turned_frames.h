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

/// A window and its reference model from window.md, slices.md 2 and protocols.md. The window shows four
/// mammograms with two presentation states each, or a clip of four frames. The mammograms are separate series
/// or pictures of one. Acts by mouse, keys and menus are repeated on the model as the documents describe
/// them.
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
  /// Positions on screen. `seen` maps the picture's mm to the screen.
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
  bool isStack_ = false;  // the pictures belong to one series
  bool isClip_ = false;   // and are frames of one file
  std::vector<TwinPicture> pictures_;
  Looks looks_;
  std::vector<TwinLine> lines_;
  std::vector<ViewId> onScreen_;
  std::map<ViewId, glm::dvec2> sizes_;
  // Looks in which facing views were left.
  std::map<std::tuple<std::size_t, ViewId, int>, std::vector<TwinFrameLook>> faced_;
  std::map<int, Known> known_;
  std::optional<Known> saved_;  // state in the last session file
  int savedTimes_ = 0;
  int first_ = 0;
  ViewId focus_ = firstComparedId;
  QString detail_;
  QString fault_;  // in an act itself; it stays
};

}  // namespace volumen::tests
