#pragma once

#include <QObject>
#include <QUndoStack>
#include <functional>
#include <optional>
#include <set>

#include "ui/data/series_pool.h"
#include "ui/workspace/links.h"
#include "ui/workspace/made_tissue.h"
#include "ui/workspace/preferences.h"
#include "ui/workspace/segment_surfaces.h"
#include "ui/workspace/workspace.h"

namespace volumen {

/// What one 3D view shows, with its data at hand.
struct SessionState {
  LoadedSeriesPtr series;  ///< null: none, or it is not in memory yet
  Scene scene;
  QualityGoal goal;
  std::shared_ptr<const ChosenPreset> preset;  ///< null: no series
  bool operator==(const SessionState&) const = default;
};

/// The only object that holds state over time: the workspace with its steps, and the series in memory. Panels
/// work on one 3D view, the one in focus: they read state() and write edit(); they hear of every change,
/// their own included, through changed() and compare their part of before and after.
class Session : public QObject {
  Q_OBJECT
 public:
  explicit Session(QObject* parent = nullptr);

  const Workspace& workspace() const { return workspace_; }
  QUndoStack& undoStack() { return undoStack_; }

  /// Of the 3D view in focus.
  const SessionState& state() const { return state_; }
  const Scene& scene() const { return state_.scene; }
  const LoadedSeriesPtr& series() const { return state_.series; }
  const QualityGoal& goal() const { return state_.goal; }
  /// Of any view; flat ones have an empty one.
  const Scene& sceneOf(ViewId view) const;
  /// The same as it is drawn: with the surfaces of segments, where segmentsDrawn() says so.
  Scene drawnScene(ViewId view) const;
  /// The series of a 3D view as it is drawn: where its tissue is not shown everywhere, with air elsewhere,
  /// once that was made, until then as it was before. Null where seriesOf() is.
  LoadedSeriesPtr drawnSeries(ViewId view) const;
  /// What that was made of; null: it is seriesOf().
  const MadeTissue* tissueDrawn(ViewId view) const;
  /// The segments that are drawn in a 3D view: of those that are to be, the ones whose surface has been made,
  /// as they are or as they were before their last change.
  std::vector<SegmentInScene> segmentsDrawn(ViewId view) const;
  /// Those of them whose surface was not made, as they are.
  std::vector<SegmentNotDrawn> segmentsNotDrawn(ViewId view) const;
  /// A series of the workspace; null: it is not in memory.
  LoadedSeriesPtr seriesNamed(const SeriesKey& key) const;
  /// The series of a view; null: none, or it is not in memory.
  LoadedSeriesPtr seriesOf(ViewId view) const;

  /// What else is done to the workspace in the step that shows a series; `isNew`: it was never shown before.
  using Arrange = std::function<Workspace(Workspace, bool isNew)>;
  /// Puts a series into the view in focus (and its group), as it was left there, else by its first scene; one
  /// undo step, but for the first series of a window. Null: closes all, in one step, too.
  void show(LoadedSeriesPtr series);
  void show(LoadedSeriesPtr series, ViewId view, const Arrange& arrange = {});
  /// Puts the frames of a series into a view, as withFrames() does; one undo step, but for the first series.
  void showFrames(const Series& series, ViewId view, const Arrange& arrange = {});
  /// Shows the series of a view to compare in another plane, or in 3D: at first as the 3D view does that the
  /// panels work on, where it shows the same series. One undo step; nothing where the series is not in
  /// memory.
  void showAs(ViewId view, ViewKind kind);
  /// The same as show() for a series that is still in memory; false where it is not.
  bool showAgain(const Series& series, ViewId view, const Arrange& arrange = {});
  /// Makes `after` the workspace, whose views are empty for a series that will be shown next: one undo step
  /// together with that.
  void makeRoom(const QString& text, const Workspace& after);
  /// Keeps a series that views on screen wait for; shows any other.
  void take(LoadedSeriesPtr series, const Arrange& arrange = {});
  /// A series is being loaded; none is any more, and seriesNeeded() is told of the next that is missing once
  /// something changes or by askForMissing().
  void setLoading(const std::optional<SeriesKey>& series);
  /// A series will not come: it is asked for again where a view shows it anew.
  void setNotLoaded(const SeriesKey& series);
  /// Tells of a series that views on screen lack, unless one is being loaded.
  void askForMissing();
  /// Keeps a series in memory, for views that wait for it now or later.
  void keep(LoadedSeriesPtr series);
  /// Keeps a series without what a mask takes away.
  void takeMasked(const Mask& mask, LoadedSeriesPtr masked);
  /// Keeps these surfaces in place of those of the same segments, for as long as the segments are there and
  /// their series is in a 3D view on screen.
  void takeSurfaces(std::vector<MadeSurface> made);
  /// Forgets those of segments that are not drawn; whether there were any.
  bool dropHiddenSurfaces();
  const std::vector<MadeSurface>& surfaces() const { return surfaces_; }
  /// Keeps this in place of what was made of the same series, for as long as isTissueOnScreen().
  void takeTissue(MadeTissue made);
  const std::vector<MadeTissue>& tissues() const { return tissues_; }
  /// Makes a workspace that was read the one in use; one undo step, but for the first of a window; what was
  /// made on series that it does not know comes back with them.
  void open(const QString& text, const Workspace& workspace);
  /// Takes series off views, list and memory, and objects off the list: one undo step. What was made on a
  /// series comes back with it; what is laid out along its curves goes, too, unless something was made on it.
  void close(const std::vector<SeriesKey>& series, const std::vector<DerivedKey>& derived = {});
  /// The same for all of the workspace and for what else is in the list.
  void closeAll(const Unlisted& listed);
  /// Puts series and objects that were opened again back into the list: no step.
  void list(const std::vector<SeriesKey>& series, const std::vector<DerivedKey>& derived);

  /// How large the picture of a view is, device pixels: what links of zoom are reckoned with.
  void setViewSize(ViewId view, glm::ivec2 pixels) { viewSizes_[view] = pixels; }

  /// Makes `after`, with what is linked to it, the workspace, as one undo step called `text`. Edits in a row
  /// with one non-empty `mergeKey` are one step until endGesture(); a step that changes nothing is dropped.
  void change(const QString& text, Workspace after, const QString& mergeKey = {});
  void change(const QString& text, const std::function<void(Workspace&)>& edit, const QString& mergeKey = {});

  /// Calls `edit`, whose changes belong to the last step where one came after the first `steps`, else to one
  /// of their own: what plays by itself stays one step, and so does what is changed meanwhile, whose step
  /// then leads back to where it was played as that began.
  void playOn(int steps, const std::function<void()>& edit);
  /// Whether the change under way is one of playOn().
  bool playsOn() const { return playsNow_; }

  /// Makes `after` the workspace without a step: what follows from how large views are alone.
  void adapt(const Workspace& after);

  /// change() for the scene of the view in focus, or of any 3D view.
  void edit(const QString& text, Scene after, const QString& mergeKey = {});
  void edit(const QString& text, const std::function<void(Scene&)>& change, const QString& mergeKey = {});
  void edit(ViewId view, const QString& text, const std::function<void(Scene&)>& change,
            const QString& mergeKey = {});

  /// Gives the scene the look of a preset's, and remembers its name; one undo step.
  void choosePreset(const QString& text, const std::string& name, const Scene& look);
  /// Whether the look was changed since.
  bool presetModified() const;
  /// Shows a series of the workspace without what this mask takes away; one undo step.
  void setMask(const QString& text, const SeriesKey& series, const Mask& mask);
  /// That of a series; empty where the workspace does not know it.
  Mask maskOf(const SeriesKey& series) const;
  /// A series without what this mask takes away; null: it is not in memory.
  LoadedSeriesPtr seriesWith(const SeriesKey& series, const Mask& mask) const;

  /// The same for what is asked of the picture beside the scene.
  void setGoal(const QString& text, const QualityGoal& after, const QString& mergeKey = {});
  /// Which view the panels work on: no step to undo.
  void setFocus(ViewId view);
  /// Which measurement has handles, 0: none; no step either.
  void select(int measurement);

  /// How the window is wanted: no part of the picture, and no step to undo.
  const Preferences& preferences() const { return preferences_; }
  void prefer(const Preferences& preferences);
  /// The same for a change of those in use.
  void prefer(const std::function<void(Preferences&)>& change);

  SeriesPool& pool() { return *pool_; }
  /// The same, for those that live longer or on other threads.
  const std::shared_ptr<SeriesPool>& sharedPool() const { return pool_; }

  /// The mouse was released, the field was left: what follows is a step of its own.
  void endGesture() { ++gesture_; }

 Q_SIGNALS:
  /// Of the 3D view in focus, or of another one that came into focus.
  void changed(const volumen::SessionState& before, const volumen::SessionState& after);
  /// Of anything, or a series came into memory.
  void workspaceChanged(const volumen::Workspace& before, const volumen::Workspace& after);
  /// A view shows a series that is not in memory: take() it. One at a time, that of the view in focus first,
  /// but what is laid out along a curve after its source.
  void seriesNeeded(const volumen::Series& series);
  /// A view shows this series with its mask, and that volume is not in memory: takeMasked() it.
  void maskedNeeded(const volumen::SeriesKey& series);

  void preferencesChanged(const volumen::Preferences& before, const volumen::Preferences& after);

 private:
  friend class EditWorkspace;
  PoolKey poolKeyOf(const SeriesKey& series) const;
  bool isFresh() const;
  void begin(const QString& text, Workspace after);
  void push(const QString& text, Workspace after, const QString& mergeKey);
  SessionState stateInFocus() const;
  std::vector<PoolKey> wantedOnScreen() const;
  bool isMissing(const SeriesKey& series) const;
  void dropUndrawn();
  void setWorkspace(const Workspace& workspace);

  Workspace workspace_;
  const std::shared_ptr<SeriesPool> pool_ = std::make_shared<SeriesPool>();
  std::vector<MadeSurface> surfaces_;
  std::vector<MadeTissue> tissues_;
  SessionState state_;  // of the 3D view in focus
  Preferences preferences_;
  QUndoStack undoStack_;
  ViewSizes viewSizes_;
  int gesture_ = 0;
  bool playsNow_ = false;                        // in playOn()
  bool playsOn_ = false;                         // a change belongs to the last step
  std::optional<SeriesKey> loading_, askedFor_;  // the one in work, by whomever; the last of seriesNeeded()
  std::set<SeriesKey> notLoaded_;                // of those on screen: they did not come
};

}  // namespace volumen
