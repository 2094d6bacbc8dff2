#pragma once

#include <QObject>
#include <QUndoStack>
#include <functional>

#include "ui/session/picture_wish.h"
#include "ui/session/shown_series.h"
#include "viewer/scene/scene.h"

namespace volumen {

/// All that the window shows, as a value.
struct SessionState {
  ShownSeriesPtr series;  ///< null: nothing opened yet
  Scene scene;
  PictureWish wish;
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
  const PictureWish& wish() const { return state_.wish; }
  QUndoStack& undoStack() { return undoStack_; }

  /// Puts a series on screen with its first scene; what is asked of the picture stays. Forgets the steps made
  /// on the one before.
  void show(ShownSeriesPtr series);

  /// Makes `after` the scene, as one undo step called `text`. Edits in a row with one non-empty `mergeKey`
  /// are one step until endGesture(); a step that changes nothing is dropped.
  void edit(const QString& text, Scene after, const QString& mergeKey = {});
  /// The same for a change of the scene as it is now.
  void edit(const QString& text, const std::function<void(Scene&)>& change, const QString& mergeKey = {});

  /// The same for what is shown of the series: `after` is the one on screen with or without its table.
  void exchangeSeries(const QString& text, ShownSeriesPtr after);

  /// The same for what is asked of the picture beside the scene.
  void wishFor(const QString& text, const PictureWish& after, const QString& mergeKey = {});

  /// The mouse was released, the field was left: what follows is a step of its own.
  void endGesture() { ++gesture_; }

 Q_SIGNALS:
  void changed(const volumen::SessionState& before, const volumen::SessionState& after);

 private:
  friend class EditState;
  void push(const QString& text, SessionState after, const QString& mergeKey);
  void setState(const SessionState& state);

  SessionState state_;
  QUndoStack undoStack_;
  int gesture_ = 0;
};

}  // namespace volumen
