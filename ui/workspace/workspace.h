#pragma once

#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ui/data/derived_key.h"
#include "ui/data/series_key.h"
#include "ui/data/series_proof.h"
#include "ui/workspace/chosen_window.h"
#include "ui/workspace/key_image.h"
#include "ui/workspace/measurement.h"
#include "ui/workspace/quality_goal.h"
#include "ui/workspace/regions_look.h"
#include "ui/workspace/segment_map.h"
#include "ui/workspace/shared_list.h"
#include "ui/workspace/shared_map.h"
#include "ui/workspace/view_id.h"
#include "ui/workspace/view_kind.h"
#include "viewer/scene/scene.h"
#include "viewer/segment/mask.h"
#include "viewer/slice/colour_map.h"
#include "viewer/slice/plane.h"
#include "viewer/slice/presentation.h"
#include "viewer/volume/rigid.h"

namespace volumen {

/// The preset that was chosen last and the look it gave.
struct ChosenPreset {
  std::string name;
  Scene scene;
  bool operator==(const ChosenPreset&) const = default;
};

/// Whether two shared values are equal.
template <class T>
bool sameValue(const std::shared_ptr<const T>& a, const std::shared_ptr<const T>& b) {
  return a == b || (a && b && *a == *b);
}

/// How one 3D view shows one series.
struct SceneLook {
  Scene scene;
  std::shared_ptr<const ChosenPreset> preset;
  bool operator==(const SceneLook& o) const { return scene == o.scene && sameValue(preset, o.preset); }
};

/// How one flat view shows one series.
struct FlatLook {
  glm::dvec2 panMm{0};  ///< where the picture's centre lies from the volume's, along right and down
  double zoom = 1;      ///< relative to the picture that shows all of the volume
  double slabMm = 0;
  SlabMode slabMode = SlabMode::max;
  PictureTurn turn{};     ///< of what would be seen without
  bool nearest = false;   ///< voxels as they are, not interpolated
  bool inverted = false;  ///< bright where it would be dark; colours stay
  int frame = 0;          ///< of frames: which, from 0
  bool layers = true;     ///< of frames: overlays and shutters
  SeriesKey overlay{};    ///< of slices: a second series over the first; empty: none
  ColourMap overlayColours = ColourMap::hotIron;
  double overlayOpacity = 0.5;
  DerivedKey presentation{};  ///< of frames: the presentation state that those it names are shown by
  std::optional<ChosenWindow> windowAlone{};  ///< of this view; none: that of the series (SeriesState)
  bool operator==(const FlatLook&) const = default;
};

/// Of FlatLook::zoom.
inline constexpr double leastZoom = 0.05, mostZoom = 200;

/// All of it in the view, as it lies, and no slab.
void makeWhole(FlatLook& look);

/// Turned further, about the middle of the view.
void turnFurther(FlatLook& look, PictureTurn by);

/// Whose window frames of a series are shown by where none was set: by default that of the series, of
/// pictures that areMadeOneByOne() that of each frame.
enum class FrameWindow { usual, ofSeries, ofEach };

/// What holds for a series in every view.
struct SeriesState {
  std::shared_ptr<const Series> series;
  Mask mask;  ///< what was taken away from it
  /// Of flat views that have none alone: what ChosenWindow says.
  std::optional<Window> window;
  int namedGrey = 0;
  FrameWindow frameWindow = FrameWindow::usual;
  ColourMap colours = ColourMap::grey;
  /// What a session knows of a series that was not found again: it is not loaded, `series` only names it.
  std::optional<MissingSeries> missing;
  bool operator==(const SeriesState& o) const {
    return sameValue(series, o.series) && mask == o.mask && window == o.window && namedGrey == o.namedGrey &&
           frameWindow == o.frameWindow && colours == o.colours && missing == o.missing;
  }
};

/// How a picture lies in the patient: orthogonal unit vectors.
struct PlaneDirections {
  glm::dvec3 right{1, 0, 0}, down{0, 1, 0};
  bool operator==(const PlaneDirections&) const = default;

  glm::dvec3 normal() const { return glm::cross(right, down); }
};

/// The three planes of a frame of reference: the point where they meet and how each lies; their normals are
/// orthogonal.
struct Crosshair {
  glm::dvec3 at{0};  ///< patient mm
  PlaneDirections axial{}, coronal{{1, 0, 0}, {0, 0, -1}}, sagittal{{0, 1, 0}, {0, 0, -1}};
  bool byHand = false;  ///< they lie so for every series; else for each along its slices
  bool operator==(const Crosshair&) const = default;

  /// That of a kind that shows slices.
  const PlaneDirections& plane(ViewKind kind) const { return this->*rowOf(kind).plane->directions; }
  /// Whether a plane is none of the patient's own.
  bool turned() const {
    const Crosshair own;
    return axial != own.axial || coronal != own.coronal || sagittal != own.sagittal;
  }
};

/// What a view shows: one series, and what it made of that and of those it showed before.
struct ViewState {
  ViewKind kind = ViewKind::volume;
  SeriesKey series;  ///< empty: none
  SharedMap<SeriesKey, SceneLook> scenes;
  SharedMap<SeriesKey, FlatLook> flats;
  SharedMap<std::string, Crosshair> crosshairs;  ///< its own, by frame of reference, while it scrolls alone
  std::string wanted;  ///< what a hanging protocol has no series for here: its name; empty: nothing
  bool operator==(const ViewState&) const = default;
};

/// How views share the window.
struct Layout {
  enum class Kind {
    one,           ///< the view in focus
    planes,        ///< 2 x 2: axial, coronal, sagittal, 3D of one series
    besidePlanes,  ///< a large 3D view beside the three planes
    grid           ///< series in rows and columns, each in a view to compare
  };
  static constexpr int mostRows = 4, mostColumns = 5;

  Kind kind = Kind::one;
  int rows = 1, columns = 1;  ///< of a grid; else 1
  bool operator==(const Layout&) const = default;

  static const Layout one, planes, besidePlanes, two, four;
};
inline constexpr Layout Layout::one{};
inline constexpr Layout Layout::planes{Layout::Kind::planes, 1, 1};
inline constexpr Layout Layout::besidePlanes{Layout::Kind::besidePlanes, 1, 1};
inline constexpr Layout Layout::two{Layout::Kind::grid, 1, 2};
inline constexpr Layout Layout::four{Layout::Kind::grid, 2, 2};

/// The views that every workspace has. The first four show one series together; as frames the axial one alone
/// does. The others are there to compare, the last of them in the second window.
inline constexpr ViewId sceneViewId = 0, axialViewId = 1, coronalViewId = 2, sagittalViewId = 3,
                        firstComparedId = 4,
                        firstSecondId = firstComparedId + Layout::mostRows * Layout::mostColumns,
                        viewCount = firstSecondId + Layout::mostRows * Layout::mostColumns;

/// Whether a view stands in the second window.
constexpr bool isInSecond(ViewId view) { return view >= firstSecondId; }

/// A window beside the main one, with a grid of views of its own.
struct SecondWindow {
  bool shown = false;
  Layout layout{Layout::Kind::grid, 1, 1};  ///< a grid
  ViewId mainFocus =
      sceneViewId;  ///< the view in focus of the main window, while that of the workspace is here
  bool operator==(const SecondWindow&) const = default;
};

/// What a view shows where nothing else was chosen.
ViewKind usualKind(ViewId view);

/// What of a view the views beside it follow.
struct Links {
  bool scroll = true;   ///< position and directions, by frame of reference
  bool zoom = false;    ///< mm per pixel
  bool pan = false;     ///< the patient's point in the middle
  bool window = false;  ///< within one modality and unit; not of views that have one alone
  bool operator==(const Links&) const = default;
};

/// Two frames of reference whose positions follow each other.
struct FrameLink {
  std::string from, to;
  Rigid toFromFrom;
  bool registered = false;  ///< else by hand
  bool operator==(const FrameLink&) const = default;
};

/// What was made on a series that was taken off the list, for when it is shown again.
struct ClosedSeries {
  std::shared_ptr<const Series> series;
  SharedList<Measurement> measurements;
  SharedList<KeyImage> keyImages;
  SharedList<SegmentMap> segmentMaps;
  bool operator==(const ClosedSeries& o) const {
    return sameValue(series, o.series) && measurements == o.measurements && keyImages == o.keyImages &&
           segmentMaps == o.segmentMaps;
  }
  bool holdsNothing() const { return measurements.empty() && keyImages.empty() && segmentMaps.empty(); }
};

/// What of all that was opened is not in the list.
struct Unlisted {
  std::set<SeriesKey> series;
  std::set<DerivedKey> derived;
  bool operator==(const Unlisted&) const = default;
};

/// All that the user made: what the window shows and how. A plain value; every change of it is a step that
/// can be undone. Copies share what none of them changed, so that a step costs what it changes.
struct Workspace {
  Workspace();

  SharedMap<SeriesKey, SeriesState> series;  ///< those that were shown
  Layout layout = Layout::one;               ///< of the main window
  SecondWindow second;
  SharedList<ViewState> views;                   ///< viewCount of them
  ViewId focus = sceneViewId;                    ///< the view that the panels work on
  QualityGoal goal;                              ///< of 3D pictures at rest
  SharedMap<std::string, Crosshair> crosshairs;  ///< by frame of reference
  Links links;
  SharedList<FrameLink> frameLinks;
  SharedList<Measurement> measurements;        ///< in the order in which they were made
  bool measurementsShown = true;               ///< in flat views
  int selected = 0;                            ///< the measurement with handles; 0: none
  SharedList<KeyImage> keyImages;              ///< in the order in which they were marked
  SharedList<SegmentMap> segmentMaps;          ///< of each series first the one worked on; none is empty
  SharedMap<DerivedKey, RegionsLook> regions;  ///< structure sets and segmentations over flat views
  SharedList<ClosedSeries> closed;             ///< in no session file
  Shared<Unlisted> unlisted;                   ///< in no session file
  bool operator==(const Workspace&) const = default;

  const ViewState& view(ViewId id) const { return views[std::size_t(id)]; }
  /// To write into; valid until the workspace is copied.
  ViewState& editView(ViewId id) { return views.edit(std::size_t(id)); }
};

/// All that there are, each once.
const std::vector<Layout>& allLayouts();
/// Lower-case word for settings and session files: "planes", "two", of other grids rows and columns, "3x4".
const char* layoutName(Layout layout);
std::optional<Layout> layoutNamed(const std::string& name);

/// The views of the main window, row by row (besidePlanes: the large one first).
std::vector<ViewId> viewsInMain(const Workspace& workspace);
/// Those of the second window, row by row; none while it is closed.
std::vector<ViewId> viewsInSecond(const Workspace& workspace);
/// Those of the window in which this view stands.
std::vector<ViewId> viewsBeside(const Workspace& workspace, ViewId view);
/// The views on screen, in both windows, those of the main one first.
std::vector<ViewId> viewsOnScreen(const Workspace& workspace);

/// The layout of the window in which a view stands.
Layout layoutOf(const Workspace& workspace, ViewId view);

/// The view in focus of the main window: that of the workspace, or that of before the second window had it.
ViewId mainFocusOf(const Workspace& workspace);
/// With this view in focus, in whichever window.
Workspace withFocus(Workspace workspace, ViewId view);
/// With the focus of another workspace.
Workspace withFocusOf(Workspace workspace, const Workspace& other);

/// The 3D view that the panels work on: the one in focus, else the one of the same group.
ViewId sceneViewOf(const Workspace& workspace);

/// Whether that shows what is in focus: the same series, another step of it, or what the group shows
/// together.
bool sceneIsOfFocus(const Workspace& workspace);

/// Whether anything but cursors and what was made by hand is different: which views and series there are, and
/// how they are shown.
bool showsOther(const Workspace& before, const Workspace& after);

/// The series of a view; null: none.
const Series* seriesIn(const Workspace& workspace, ViewId view);

/// How a flat view shows its series; the defaults where it has none.
FlatLook flatLookOf(const ViewState& view);

/// What positions of a series are relative to: views of one frame share the cursor.
std::string frameOfReference(const Series& series);

/// With this series in a view, and in those of its group; by `first` where a 3D view has not shown it yet.
Workspace withSeries(Workspace workspace, ViewId view, const Series& series, const SceneLook& first);
/// With a series at hand that was missing.
Workspace withFound(Workspace workspace, const Series& series);
/// The views that show slices of the same series as this one does: of a group all, of views to compare one,
/// none where it shows 3D.
std::vector<ViewId> planesOf(const Workspace& workspace, ViewId view);
/// With this change in each of them.
Workspace withFlatLooks(Workspace workspace, ViewId view, const std::function<void(FlatLook&)>& change);
/// With a second series over what planesOf() shows; null: with none.
Workspace withOverlay(Workspace workspace, ViewId view, const Series* overlay);
/// With the planes of the group showing `under` and over it the group's series.
Workspace fusedWith(Workspace workspace, const Series& under);
/// The layout that readers of a modality expect: planes and 3D; one view where there are few slices.
Layout usualLayout(const Series& series);
/// In that layout; where it is one view, in that of the slices as acquired.
Workspace withUsualLayout(Workspace workspace, const Series& series);
/// With the slices as acquired in focus, where they stand beside 3D: keys measure.
Workspace withSlicesInFocus(Workspace workspace);
/// Whether a layout shows several series side by side.
bool comparesSeries(Layout layout);
/// With the frames of this series in a view, or in the axial one of its group; where the view showed slices
/// of it, from the one at the cursor on.
Workspace withFrames(Workspace workspace, ViewId view, const Series& series);
/// The view that shows frames where this one is asked to: itself, or the axial one of its group.
ViewId framesViewOf(ViewId view);
bool showsFrames(const Workspace& workspace, ViewId view);
/// With the main window in another layout; the first view to compare, where it is empty, gets the series of
/// its focus.
Workspace withLayout(Workspace workspace, Layout layout);
/// With the second window in another grid; one view where the layout is none.
Workspace withSecondLayout(Workspace workspace, Layout layout);
/// With the second window open and its first view in focus; or closed, what its views show kept for when it
/// is opened again.
Workspace withSecondShown(Workspace workspace, bool shown);
/// With a view to compare showing another plane, or 3D; `first` where it has not shown its series so yet.
/// Views of the group stay as they are.
Workspace withKind(Workspace workspace, ViewId view, ViewKind kind, const SceneLook& first);
bool canChangeKind(ViewId view);
/// Without this series: views that show it are empty, and what was measured on it comes back with it.
Workspace without(Workspace workspace, const SeriesKey& key);
/// With these segments in place of those that the map of this number of their series has, and of maps of
/// other grids; without segments that map is not there. What was changed of their labels without a step is
/// made by hand (segment_record.h).
Workspace withSegmentMap(Workspace workspace, const SegmentMap& map);
/// The map of a series that is worked on; null: it has no segments.
const SegmentMap* segmentMapOf(const Workspace& workspace, const SeriesKey& series);
/// The one of this number; null: there is none.
const SegmentMap* segmentMapOf(const Workspace& workspace, const SeriesKey& series, int number);
/// All maps of a series, by their numbers.
std::vector<const SegmentMap*> segmentMapsOf(const Workspace& workspace, const SeriesKey& series);
/// With the closed series that something was made on, in no view.
Workspace withClosed(Workspace workspace);
/// Another workspace in place of this one: what was made on series that it does not know comes back with
/// them.
Workspace replacedBy(Workspace workspace, Workspace next);

}  // namespace volumen
