#pragma once

#include <QObject>
#include <QUndoStack>
#include <functional>
#include <optional>

#include "ui/data/series_pool.h"
#include "ui/workspace/links.h"
#include "ui/workspace/packed_labels.h"
#include "ui/workspace/preferences.h"
#include "ui/workspace/requests.h"
#include "ui/workspace/workspace.h"

namespace volumen {

/// The content of one 3D view, with its data.
struct SessionState {
  LoadedSeriesPtr series;  ///< null: none, or not in memory yet
  Scene scene;
  QualityGoal goal;
  std::shared_ptr<const ChosenPreset> preset;  ///< null: no series
  bool operator==(const SessionState&) const = default;
};

/// The only object that holds state over time: the workspace with its undo steps, and the series in memory.
/// Panels work on one 3D view, the one in focus. They read state() and write through edit(). changed() tells
/// them of every change, their own included, and they compare their part of before and after.
class Session : public QObject {
  Q_OBJECT
 public:
  explicit Session(QObject* parent = nullptr);

  const Workspace& workspace() const { return workspace_; }
  QUndoStack& undoStack() { return undoStack_; }

  /// Returns the state of the 3D view in focus.
  const SessionState& state() const { return state_; }
  const Scene& scene() const { return state_.scene; }
  const LoadedSeriesPtr& series() const { return state_.series; }
  const QualityGoal& goal() const { return state_.goal; }
  /// Returns the scene of any view; flat views have an empty one.
  const Scene& sceneOf(ViewId view) const;
  /// Returns a series of the workspace; null if it is not in memory.
  LoadedSeriesPtr seriesNamed(const SeriesKey& key) const;
  /// Returns the series of a view; null if there is none or it is not in memory.
  LoadedSeriesPtr seriesOf(ViewId view) const;

  /// Makes further changes in the undo step that shows a series. `isNew`: it was never shown before.
  using Arrange = std::function<Workspace(Workspace, bool isNew)>;
  /// Shows a series in the view in focus and its group, as it was left there, else by its first scene. This
  /// is one undo step, except for the first series of a window. Null closes all, also in one step.
  void show(LoadedSeriesPtr series);
  void show(LoadedSeriesPtr series, ViewId view, const Arrange& arrange = {});
  /// Shows the frames of a series in a view, as withFrames() does. One undo step, except for the first
  /// series.
  void showFrames(const Series& series, ViewId view, const Arrange& arrange = {});
  /// Shows the series of a comparison view in another plane or in 3D. It looks at first as in the panels' 3D
  /// view if that shows the same series. One undo step. Does nothing if the series is not in memory.
  void showAs(ViewId view, ViewKind kind);
  /// Does the same as show() for a series still in memory. Returns false if it is not.
  bool showAgain(const Series& series, ViewId view, const Arrange& arrange = {});
  /// Makes `after` the workspace, whose views are empty for a series to be shown next. It is one undo step
  /// together with showing that.
  void makeRoom(const QString& text, const Workspace& after);
  /// Keeps a series in memory, with a mask applied if given, for views that wait for it now or later.
  void keep(LoadedSeriesPtr series, const Mask& mask = {});
  /// Makes a workspace that was read the present one, in one undo step, except for the first of a window.
  /// Work on series that it does not know comes back with them.
  void open(const QString& text, const Workspace& workspace);
  /// Removes series from views, list and memory, and objects from the list, in one undo step. Work on a
  /// series comes back with it. Its curved reformats go too, unless there is work on them.
  void close(const std::vector<SeriesKey>& series, const std::vector<DerivedKey>& derived = {});
  /// Does the same for the whole workspace and all else in the list.
  void closeAll(const Unlisted& listed);
  /// Puts reopened series and objects back into the list, without an undo step.
  void list(const std::vector<SeriesKey>& series, const std::vector<DerivedKey>& derived);

  /// Sets the size of a view's picture in device pixels, which linked zoom needs.
  void setViewSize(ViewId view, glm::ivec2 pixels) { viewSizes_[view] = pixels; }

  /// Makes `after`, with linked changes, the workspace, in one undo step called `text`. Consecutive edits
  /// with one non-empty `mergeKey` are one step until endGesture(). Drops a step that changes nothing.
  void change(const QString& text, Workspace after, const QString& mergeKey = {});
  void change(const QString& text, const std::function<void(Workspace&)>& edit, const QString& mergeKey = {});

  /// Calls `edit`. Its changes join the last undo step unless that is among the first `steps`, else they make
  /// a new one. Playback is thus one step. A change made meanwhile is a step that takes in what plays on; its
  /// undo returns to the position at which it was made.
  void playOn(int steps, const std::function<void()>& edit);
  /// Returns whether playOn() makes the present change.
  bool playsOn() const { return playsNow_; }

  /// Makes `after` the workspace without an undo step, for changes that follow from view sizes alone.
  void adapt(const Workspace& after);

  /// Calls change() for the scene of the view in focus, or of any 3D view.
  void edit(const QString& text, Scene after, const QString& mergeKey = {});
  void edit(const QString& text, const std::function<void(Scene&)>& change, const QString& mergeKey = {});
  void edit(ViewId view, const QString& text, const std::function<void(Scene&)>& change,
            const QString& mergeKey = {});

  /// Gives the scene the look of a preset and remembers its name, in one undo step.
  void choosePreset(const QString& text, const std::string& name, const Scene& look);
  /// Returns whether the look has changed since.
  bool presetModified() const;
  /// Applies a mask to a series of the workspace, in one undo step.
  void setMask(const QString& text, const SeriesKey& series, const Mask& mask);
  /// Returns the mask of a series; empty if the workspace does not know it.
  Mask maskOf(const SeriesKey& series) const;
  /// Returns a series with a mask applied; null if it is not in memory.
  LoadedSeriesPtr seriesWith(const SeriesKey& series, const Mask& mask) const;

  /// Calls change() for what is requested of the picture at rest.
  void setGoal(const QString& text, const QualityGoal& after, const QString& mergeKey = {});
  /// Sets the view that the panels work on, without an undo step.
  void setFocus(ViewId view);
  /// Sets the measurement with handles (0: none), without an undo step.
  void select(int measurement);

  /// Returns the user's preferences. They are no part of the picture and of no undo step.
  const Preferences& preferences() const { return preferences_; }
  void prefer(const Preferences& preferences);
  /// Changes the present preferences.
  void prefer(const std::function<void(Preferences&)>& change);

  /// Returns what was asked for and is not there yet.
  const Requests& requests() const { return requests_; }
  /// Changes the requests.
  void request(const std::function<void(Requests&)>& change);

  SeriesPool& pool() { return *pool_; }
  /// Returns the same for holders that live longer or on other threads.
  const std::shared_ptr<SeriesPool>& sharedPool() const { return pool_; }

  /// Ends a gesture, as on a mouse release or when a field is left: the next edit is a step of its own.
  void endGesture() { ++gesture_; }

 Q_SIGNALS:
  /// The 3D view in focus changed, or another one came into focus.
  void changed(const volumen::SessionState& before, const volumen::SessionState& after);
  /// Anything changed, or a series came into memory.
  void workspaceChanged(const volumen::Workspace& before, const volumen::Workspace& after);
  /// neededSeries() may have changed. Sent after the signals about the workspace.
  void needsChanged();

  void preferencesChanged(const volumen::Preferences& before, const volumen::Preferences& after);

  /// The oldest undo steps were dropped, as their labels have no room even packed.
  void stepsDropped(int steps);
  /// One of them was to be undone or done again: nothing changed.
  void droppedStepMet();

 private:
  friend class EditWorkspace;
  PoolKey poolKeyOf(const SeriesKey& series) const;
  bool isFresh() const;
  void begin(const QString& text, Workspace after);
  void push(const QString& text, Workspace after, const QString& mergeKey);
  void fitUndo();
  SessionState stateInFocus() const;
  void setWorkspace(const Workspace& workspace);

  Workspace workspace_;
  const std::shared_ptr<SeriesPool> pool_ = std::make_shared<SeriesPool>();
  SessionState state_;  // state of the 3D view in focus
  Preferences preferences_;
  Requests requests_;
  LabelPacker packer_;  // of the undo steps' labels
  QUndoStack undoStack_;
  ViewSizes viewSizes_;
  int gesture_ = 0;
  bool playsNow_ = false;  // inside playOn()
  bool playsOn_ = false;   // a change belongs to the last step
};

}  // namespace volumen
