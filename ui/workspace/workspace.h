#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ui/data/series_key.h"
#include "ui/data/series_proof.h"
#include "ui/workspace/quality_goal.h"
#include "ui/workspace/view_id.h"
#include "viewer/scene/scene.h"
#include "viewer/slice/plane.h"

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
  bool nearest = false;  ///< voxels as they are, not interpolated
  bool operator==(const FlatLook&) const = default;
};

/// What holds for a series in every view.
struct SeriesState {
  std::shared_ptr<const Series> series;
  bool tableRemoved = false;
  std::optional<Window> window;  ///< of flat views; a negative width is inverted; none: the series' own
  /// What a session knows of a series that was not found again: it is not loaded, `series` only names it.
  std::optional<SeriesProof> missing;
  bool operator==(const SeriesState& o) const {
    return sameValue(series, o.series) && tableRemoved == o.tableRemoved && window == o.window &&
           missing == o.missing;
  }
};

enum class ViewKind { volume, axial, coronal, sagittal };

/// What a view shows: one series, and what it made of that and of those it showed before.
struct ViewState {
  ViewKind kind = ViewKind::volume;
  SeriesKey series;  ///< empty: none
  std::map<SeriesKey, SceneLook> scenes;
  std::map<SeriesKey, FlatLook> flats;
  bool operator==(const ViewState&) const = default;
};

/// How views share the window.
enum class Layout {
  one,           ///< the view in focus
  planes,        ///< 2 x 2: axial, coronal, sagittal, 3D of one series
  besidePlanes,  ///< a large 3D view beside the three planes
  two,           ///< two series side by side
  four           ///< four series, 2 x 2
};

/// The views that every workspace has. The first four show one series together.
inline constexpr ViewId sceneViewId = 0, axialViewId = 1, coronalViewId = 2, sagittalViewId = 3,
                        firstComparedId = 4, viewCount = 8;

/// All that the user made: what the window shows and how. A plain value; every change of it is a step that
/// can be undone.
struct Workspace {
  Workspace();

  std::map<SeriesKey, SeriesState> series;  ///< those that were shown
  Layout layout = Layout::one;
  std::vector<ViewState> views;               ///< viewCount of them
  ViewId focus = sceneViewId;                 ///< the view that the panels work on
  QualityGoal goal;                           ///< of 3D pictures at rest
  std::map<std::string, glm::dvec3> cursors;  ///< by frame of reference, patient mm
  bool operator==(const Workspace&) const = default;

  const ViewState& view(ViewId id) const { return views[std::size_t(id)]; }
  ViewState& view(ViewId id) { return views[std::size_t(id)]; }
};

/// Lower-case word for settings and session files: "planes".
const char* layoutName(Layout layout);
std::optional<Layout> layoutNamed(const std::string& name);

/// The views on screen, row by row (besidePlanes: the large one first).
std::vector<ViewId> viewsOnScreen(const Workspace& workspace);

/// The 3D view that the panels work on: the one in focus, else the one of the same group.
ViewId sceneViewOf(const Workspace& workspace);

/// How a flat view shows its series; the defaults where it has none.
FlatLook flatLookOf(const ViewState& view);

/// What positions of a series are relative to: views of one frame share the cursor.
std::string frameOfReference(const Series& series);

/// With this series in a view, and in those of its group; by `first` where a 3D view has not shown it yet.
Workspace withSeries(Workspace workspace, ViewId view, const Series& series, const SceneLook& first);
/// With a series at hand that was missing.
Workspace withFound(Workspace workspace, const Series& series);
/// In another layout; the first view to compare, where it is empty, gets the series of the focus.
Workspace withLayout(Workspace workspace, Layout layout);
/// Without this series: views that show it are empty.
Workspace without(Workspace workspace, const SeriesKey& key);

}  // namespace volumen
