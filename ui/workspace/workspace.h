#pragma once

#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "io/study/series_key.h"
#include "results/segments/segment_map.h"
#include "ui/data/derived_key.h"
#include "ui/data/series_proof.h"
#include "ui/workspace/chosen_window.h"
#include "ui/workspace/key_image.h"
#include "ui/workspace/measurement.h"
#include "ui/workspace/quality_goal.h"
#include "ui/workspace/regions_look.h"
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

/// Returns whether two shared values are equal.
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
  glm::dvec2 panMm{0};  ///< offset of the picture's centre from the volume's, along right and down
  double zoom = 1;      ///< relative to the picture that shows the full volume
  double slabMm = 0;
  SlabMode slabMode = SlabMode::max;
  PictureTurn turn{};     ///< from the unturned picture
  bool nearest = false;   ///< voxels without interpolation
  bool inverted = false;  ///< bright where it would be dark; colours stay
  int frame = 0;          ///< frames: index from 0
  bool layers = true;     ///< frames: shows overlays and shutters
  SeriesKey overlay{};    ///< slices: the series over the first; empty: none
  ColourMap overlayColours = ColourMap::hotIron;
  double overlayOpacity = 0.5;
  DerivedKey presentation{};                  ///< frames: the presentation state of those it names
  std::optional<ChosenWindow> windowAlone{};  ///< this view's own; empty: that of the series (SeriesState)
  bool operator==(const FlatLook&) const = default;
};

/// Limits of FlatLook::zoom.
inline constexpr double leastZoom = 0.05, mostZoom = 200;

/// Fits the full picture into the view, unturned and without a slab.
void makeWhole(FlatLook& look);

/// Turns the picture further, about the middle of the view.
void turnFurther(FlatLook& look, PictureTurn by);

/// Whose window frames of a series use if none was set. The usual one is that of the series, but for pictures
/// that areMadeOneByOne() that of each frame.
enum class FrameWindow { usual, ofSeries, ofEach };

/// The state of a series in every view.
struct SeriesState {
  std::shared_ptr<const Series> series;
  Mask mask;  ///< removes the table and the parts in lassos
  /// For flat views without their own window, as in ChosenWindow.
  std::optional<Window> window;
  int namedGrey = 0;
  FrameWindow frameWindow = FrameWindow::usual;
  ColourMap colours = ColourMap::grey;
  /// The session's entry of a series that was not found. It is not loaded, and `series` only names it.
  std::optional<MissingSeries> missing;
  bool operator==(const SeriesState& o) const {
    return sameValue(series, o.series) && mask == o.mask && window == o.window && namedGrey == o.namedGrey &&
           frameWindow == o.frameWindow && colours == o.colours && missing == o.missing;
  }
};

/// The directions of a picture in the patient: orthogonal unit vectors.
struct PlaneDirections {
  glm::dvec3 right{1, 0, 0}, down{0, 1, 0};
  bool operator==(const PlaneDirections&) const = default;

  glm::dvec3 normal() const { return glm::cross(right, down); }
};

/// The three planes of a frame of reference: their common point and their directions. Their normals are
/// orthogonal.
struct Crosshair {
  glm::dvec3 at{0};  ///< patient mm
  PlaneDirections axial{}, coronal{{1, 0, 0}, {0, 0, -1}}, sagittal{{0, 1, 0}, {0, 0, -1}};
  bool byHand = false;  ///< the same directions for every series; else along the slices of each
  bool operator==(const Crosshair&) const = default;

  /// Returns the plane of a kind that shows slices.
  const PlaneDirections& plane(ViewKind kind) const { return this->*rowOf(kind).plane->directions; }
  /// Returns whether a plane is not one of the patient's planes.
  bool turned() const {
    const Crosshair own;
    return axial != own.axial || coronal != own.coronal || sagittal != own.sagittal;
  }
};

/// The content of a view: one series, and its looks of this and of earlier series.
struct ViewState {
  ViewKind kind = ViewKind::volume;
  SeriesKey series;  ///< empty: none
  SharedMap<SeriesKey, SceneLook> scenes;
  SharedMap<SeriesKey, FlatLook> flats;
  SharedMap<std::string, Crosshair> crosshairs;  ///< its own, by frame of reference, while it scrolls alone
  std::string wanted;  ///< name of a series that a hanging protocol wants here but lacks; empty: none
  bool operator==(const ViewState&) const = default;
};

/// The arrangement of views in the window.
struct Layout {
  enum class Kind {
    one,           ///< the view in focus
    planes,        ///< 2 x 2: axial, coronal, sagittal, 3D of one series
    besidePlanes,  ///< a large 3D view beside the three planes
    grid           ///< series in rows and columns, each in a comparison view
  };
  static constexpr int mostRows = 4, mostColumns = 5;

  Kind kind = Kind::one;
  int rows = 1, columns = 1;  ///< for a grid; else 1
  bool operator==(const Layout&) const = default;

  static const Layout one, planes, besidePlanes, two, four;
};
inline constexpr Layout Layout::one{};
inline constexpr Layout Layout::planes{Layout::Kind::planes, 1, 1};
inline constexpr Layout Layout::besidePlanes{Layout::Kind::besidePlanes, 1, 1};
inline constexpr Layout Layout::two{Layout::Kind::grid, 1, 2};
inline constexpr Layout Layout::four{Layout::Kind::grid, 2, 2};

/// The views that every workspace has. The first four show one series together; for frames only the axial one
/// does. The others are comparison views, the second half of them in the second window.
inline constexpr ViewId sceneViewId = 0, axialViewId = 1, coronalViewId = 2, sagittalViewId = 3,
                        firstComparedId = 4,
                        firstSecondId = firstComparedId + Layout::mostRows * Layout::mostColumns,
                        viewCount = firstSecondId + Layout::mostRows * Layout::mostColumns;

/// Returns whether a view is in the second window.
constexpr bool isInSecond(ViewId view) { return view >= firstSecondId; }

/// A window beside the main one, with its own grid of views.
struct SecondWindow {
  bool shown = false;
  Layout layout{Layout::Kind::grid, 1, 1};  ///< must be a grid
  ViewId mainFocus = sceneViewId;           ///< focus of the main window, while the workspace's focus is here
  bool operator==(const SecondWindow&) const = default;
};

/// Returns the kind that a view shows by default.
ViewKind usualKind(ViewId view);

/// The properties of a view that other views follow.
struct Links {
  bool scroll = true;   ///< position and directions, by frame of reference
  bool zoom = false;    ///< mm per pixel
  bool pan = false;     ///< the patient's point in the middle
  bool window = false;  ///< within one modality and unit; not for views with their own window
  bool operator==(const Links&) const = default;
};

/// Two frames of reference with linked positions.
struct FrameLink {
  std::string from, to;
  Rigid toFromFrom;
  bool registered = false;  ///< by registration, else by hand
  bool operator==(const FrameLink&) const = default;
};

/// The work on a series that was removed from the list, for when it is shown again.
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

/// The opened series and objects that are not in the list.
struct Unlisted {
  std::set<SeriesKey> series;
  std::set<DerivedKey> derived;
  bool operator==(const Unlisted&) const = default;
};

/// All that the user made: what the window shows and how. It is a plain value; every change of it is an undo
/// step. Copies share what none of them changed, so that a step costs only what it changes.
struct Workspace {
  Workspace();

  SharedMap<SeriesKey, SeriesState> series;  ///< all that were shown
  Layout layout = Layout::one;               ///< layout of the main window
  SecondWindow second;
  SharedList<ViewState> views;                   ///< viewCount of them
  ViewId focus = sceneViewId;                    ///< the view that the panels work on
  QualityGoal goal;                              ///< for 3D pictures at rest
  SharedMap<std::string, Crosshair> crosshairs;  ///< by frame of reference
  Links links;
  SharedList<FrameLink> frameLinks;
  SharedList<Measurement> measurements;        ///< in the order in which they were made
  bool measurementsShown = true;               ///< in flat views
  int selected = 0;                            ///< the measurement with handles; 0: none
  SharedList<KeyImage> keyImages;              ///< in the order in which they were marked
  SharedList<SegmentMap> segmentMaps;          ///< first the current map of each series; no map is empty
  SharedMap<DerivedKey, RegionsLook> regions;  ///< structure sets and segmentations over flat views
  SharedList<ClosedSeries> closed;             ///< not in session files
  Shared<Unlisted> unlisted;                   ///< not in session files
  bool operator==(const Workspace&) const = default;

  const ViewState& view(ViewId id) const { return views[std::size_t(id)]; }
  /// Returns a view for writing. Valid until the workspace is copied.
  ViewState& editView(ViewId id) { return views.edit(std::size_t(id)); }
};

/// Returns all layouts, each once.
const std::vector<Layout>& allLayouts();
/// Returns a lower-case word for settings and session files: "planes", "two"; for other grids rows and
/// columns, "3x4".
const char* layoutName(Layout layout);
std::optional<Layout> layoutNamed(const std::string& name);

/// Returns the views of the main window, row by row (besidePlanes: the large one first).
std::vector<ViewId> viewsInMain(const Workspace& workspace);
/// Returns the views of the second window, row by row; none while it is closed.
std::vector<ViewId> viewsInSecond(const Workspace& workspace);
/// Returns the views of the window that holds `view`.
std::vector<ViewId> viewsBeside(const Workspace& workspace, ViewId view);
/// Returns the views on screen in both windows, those of the main one first.
std::vector<ViewId> viewsOnScreen(const Workspace& workspace);
/// Returns the series in 3D views on screen.
std::vector<SeriesKey> seriesIn3d(const Workspace& workspace);
/// Returns these views, the one in focus before the others.
std::vector<ViewId> focusFirst(const Workspace& workspace, std::vector<ViewId> views);

/// Returns the layout of the window that holds `view`.
Layout layoutOf(const Workspace& workspace, ViewId view);

/// Returns the main window's view in focus: the workspace's, or the last one before the second window got the
/// focus.
ViewId mainFocusOf(const Workspace& workspace);
/// Sets the focus to a view in either window.
Workspace withFocus(Workspace workspace, ViewId view);
/// Takes over the focus of another workspace.
Workspace withFocusOf(Workspace workspace, const Workspace& other);

/// Returns the 3D view that the panels work on: the one in focus, else that of its group, else one on screen.
ViewId sceneViewOf(const Workspace& workspace);

/// Returns whether that view shows what is in focus: the same series, another time point of it, or the series
/// of the group.
bool sceneIsOfFocus(const Workspace& workspace);

/// Returns whether the views and series, or how they are shown, differ. Cursors and hand-made work do not
/// count.
bool showsOther(const Workspace& before, const Workspace& after);

/// Returns the series of a view, or null.
const Series* seriesIn(const Workspace& workspace, ViewId view);

/// Returns the look of the series in a flat view; defaults if it has none.
FlatLook flatLookOf(const ViewState& view);

/// Returns the frame of reference of a series. Views with the same one share the cursor.
std::string frameOfReference(const Series& series);

/// Shows a series in a view and its group. `first` is the look in 3D views that have not shown it yet.
Workspace withSeries(Workspace workspace, ViewId view, const Series& series, const SceneLook& first);
/// Returns the workspace after a missing series was found.
Workspace withFound(Workspace workspace, const Series& series);
/// Returns the flat views that show the same series as `view`: all of a group; of comparison views itself, or
/// none if it shows 3D.
std::vector<ViewId> planesOf(const Workspace& workspace, ViewId view);
/// Applies a change to each of them.
Workspace withFlatLooks(Workspace workspace, ViewId view, const std::function<void(FlatLook&)>& change);
/// Lays a second series over what planesOf() shows; null removes it.
Workspace withOverlay(Workspace workspace, ViewId view, const Series* overlay);
/// Shows `under` in the planes of the group, and over it the group's series.
Workspace fusedWith(Workspace workspace, const Series& under);
/// Returns the layout that readers expect: planes and 3D, or one view if there are few slices.
Layout usualLayout(const Series& series);
/// Applies that layout. If it is one view, shows the acquired slices.
Workspace withUsualLayout(Workspace workspace, const Series& series);
/// Puts the acquired slices in focus if they are beside 3D, because keys start measurements there.
Workspace withSlicesInFocus(Workspace workspace);
/// Returns whether a layout compares several series.
bool comparesSeries(Layout layout);
/// Shows the frames of a series in a view, or in the axial view of its group. Begins at the cursor's slice if
/// the view showed slices of it.
Workspace withFrames(Workspace workspace, ViewId view, const Series& series);
/// Returns the view that shows frames for `view`: itself, or the axial one of its group.
ViewId framesViewOf(ViewId view);
bool showsFrames(const Workspace& workspace, ViewId view);
/// Changes the layout of the main window. If its first view is empty, that gets the series in focus.
Workspace withLayout(Workspace workspace, Layout layout);
/// Changes the grid of the second window; to one view if the layout is no grid.
Workspace withSecondLayout(Workspace workspace, Layout layout);
/// Opens the second window and puts its first view in focus, or closes it. Its views are kept for the next
/// time.
Workspace withSecondShown(Workspace workspace, bool shown);
/// Shows another plane or 3D in a comparison view. `first` is the look if it has not shown its series in 3D
/// yet. Views of the group stay as they are.
Workspace withKind(Workspace workspace, ViewId view, ViewKind kind, const SceneLook& first);
bool canChangeKind(ViewId view);
/// Removes a series. Views that show it become empty, and work on it comes back with it.
Workspace without(Workspace workspace, const SeriesKey& key);
/// Replaces the map with the number of `map`, and removes maps of other grids. Removes a map without
/// segments. Labels that changed without a step count as made by hand (segment_record.h).
Workspace withSegmentMap(Workspace workspace, const SegmentMap& map);
/// Returns the current map of a series; null if it has no segments.
const SegmentMap* segmentMapOf(const Workspace& workspace, const SeriesKey& series);
/// Returns the map with this number, or null.
const SegmentMap* segmentMapOf(const Workspace& workspace, const SeriesKey& series, int number);
/// Returns all maps of a series, by number.
std::vector<const SegmentMap*> segmentMapsOf(const Workspace& workspace, const SeriesKey& series);
/// Brings back the closed series with work on them, in no view.
Workspace withClosed(Workspace workspace);
/// Replaces the workspace. Work on series that `next` does not know comes back with them.
Workspace replacedBy(Workspace workspace, Workspace next);

}  // namespace volumen
