#pragma once

#include <QLabel>
#include <QSlider>
#include <QTimer>
#include <QToolButton>
#include <memory>
#include <vector>

#include "ui/views/cine_player.h"
#include "ui/views/played_time_points.h"
#include "ui/widgets/typed_number.h"

namespace volumen {

/// A slim bar at the bottom of a view that plays frames, slices or time points: position, number, speed,
/// range, forwards and backwards, loop. It appears for clips and time points, while something is played, and
/// under a pointer at the bottom of the view. In narrow views fields are hidden; the slider and the play
/// button stay.
class CineBar : public QWidget {
  Q_OBJECT
 public:
  static constexpr int barHeight = 20;
  static constexpr double leastRate = 0.1, mostRate = 100;  // positions per second

  /// Offers time points to play. `isDrawn` returns whether the view shows the current state of the workspace.
  CineBar(Session& session, ViewId view, std::function<bool()> isDrawn, QWidget* parent);
  ~CineBar() override;

  /// Offers something else to play. If both are clips, it comes before time points with `before`.
  void add(std::unique_ptr<Playable> what, bool before);
  const CineRound& round() const { return round_; }

  bool isPlaying() const { return player_ != nullptr; }
  bool isBackwards() const { return player_ && player_->isBackwards(); }
  void togglePlay();
  void stop();
  /// Reports that a position is now on screen.
  void tellShown(int place);
  /// Returns the measured rate in positions per second; 0 if it is not known yet or nothing is played.
  double rate() const { return player_ ? player_->rate() : 0; }
  bool isLate() const { return player_ && player_->isLate(); }
  /// Moves by `steps` time points, within the range. Returns false if there are none.
  bool stepTime(int steps);
  /// Changes to the next usual speed, up or down, if there is one. Returns false if there is nothing to play.
  bool stepRate(int up);
  /// Updates the bar after a change of what can be played or of the position shown.
  void look();
  /// Tells the bar whether the pointer is at the bottom of the view.
  void pointAtEdge(bool isThere);

 Q_SIGNALS:
  /// The bar was shown or hidden.
  void shownChanged();

 protected:
  void leaveEvent(QEvent*) override;
  void resizeEvent(QResizeEvent*) override;
  void mousePressEvent(QMouseEvent*) override;

 private:
  void makeControls();
  void connectControls();
  QToolButton* addButton(const char* name, const QString& text, const QString& tip, bool checkable);
  TypedNumber* addNumber(const char* name, const QString& tip, const QString& widest);
  QLabel* addWord(const QString& word);
  static bool isThere(const Playable& what) { return what.stack().place.count > 1; }
  Playable* current() const;
  std::optional<int> placeTyped(const TypedNumber& field, int number);
  static void refuse(const TypedNumber& field, const QString& why);
  void goTo(int place);
  void takeFocus(QWidget* field);
  void endPlayer();
  void giveUp();
  bool isOvertaken(const Workspace& before, const Workspace& after) const;
  void seeSteps(int steps);
  void setRound(const CineRound& round);
  void showNumbers(const Stack& stack, const QString& axis);
  void showChoices(const QString& noun);
  void makeRoom();
  void setShown(bool wanted);

  Session& session_;
  const ViewId view_;
  int steps_;                                   // index of the undo stack
  std::vector<std::unique_ptr<Playable>> all_;  // in order of preference
  PlayedTimePoints* time_;
  Playable* chosen_ = nullptr;  // by the user
  CineRound round_;
  std::pair<SeriesKey, int> roundOf_{{}, 0};  // source and count of round_
  Playable* played_ = nullptr;                // what the player plays
  CinePlayer* player_ = nullptr;              // a child; null if nothing is played
  bool isPointedAt_ = false;
  QTimer pointedSoon_;
  QToolButton *play_, *what_, *back_, *loop_;
  QSlider* place_;
  TypedNumber *number_, *first_, *last_, *rate_;
  QLabel *from_, *to_, *aSecond_;
};

}  // namespace volumen
