#pragma once

#include <QObject>
#include <QUndoStack>
#include <functional>

#include "ui/session/preferences.h"
#include "ui/session/quality_goal.h"
#include "ui/session/shown_series.h"
#include "viewer/scene/scene.h"

namespace volumen {

/// The preset that was chosen last and the look it gave.
struct ChosenPreset {
  std::string name;
  Scene scene;
};

/// All that the window shows, as a value.
struct SessionState {
  ShownSeriesPtr series;  ///< null: nothing opened yet
  Scene scene;
  QualityGoal goal;
  std::shared_ptr<const ChosenPreset> preset;  ///< null: no series
  bool operator==(const SessionState&) const = default;
};

/// The only object that holds state over time. Panels read state() and write edit(); they hear of every
/// change, their own included, through changed() and compare their part of before and after.
class Session : public QObject {
  Q_OBJECT
 public:
  explicit Session(QObject* parent = nullptr);

  const SessionState& state() const { return state_; }
  const Scene& scene() const { return state_.scene; }
  const ShownSeriesPtr& series() const { return state_.series; }
  const QualityGoal& goal() const { return state_.goal; }
  QUndoStack& undoStack() { return undoStack_; }

  /// Puts a series on screen with its first scene; what is asked of the picture stays. Forgets the steps made
  /// on the one before.
  void show(ShownSeriesPtr series);

  /// Makes `after` the scene, as one undo step called `text`. Edits in a row with one non-empty `mergeKey`
  /// are one step until endGesture(); a step that changes nothing is dropped.
  void edit(const QString& text, Scene after, const QString& mergeKey = {});
  /// The same for a change of the scene as it is now.
  void edit(const QString& text, const std::function<void(Scene&)>& change, const QString& mergeKey = {});

  /// Gives the scene the look of a preset's, and remembers its name; one undo step.
  void choosePreset(const QString& text, const std::string& name, const Scene& look);
  /// Whether the look was changed since.
  bool presetModified() const;
  /// The same for what is shown of the series: `after` is the one on screen with or without its table.
  void exchangeSeries(const QString& text, ShownSeriesPtr after);

  /// The same for what is asked of the picture beside the scene.
  void setGoal(const QString& text, const QualityGoal& after, const QString& mergeKey = {});

  /// How the window is wanted: no part of the picture, and no step to undo.
  const Preferences& preferences() const { return preferences_; }
  void prefer(const Preferences& preferences);
  /// The same for a change of those in use.
  void prefer(const std::function<void(Preferences&)>& change);

  /// The mouse was released, the field was left: what follows is a step of its own.
  void endGesture() { ++gesture_; }

 Q_SIGNALS:
  void changed(const volumen::SessionState& before, const volumen::SessionState& after);

  void preferencesChanged(const volumen::Preferences& before, const volumen::Preferences& after);

 private:
  friend class EditState;
  void push(const QString& text, SessionState after, const QString& mergeKey);
  void setState(const SessionState& state);

  SessionState state_;
  Preferences preferences_;
  QUndoStack undoStack_;
  int gesture_ = 0;
};

}  // namespace volumen
