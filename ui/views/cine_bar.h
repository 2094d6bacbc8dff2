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

/// A slim bar at the bottom of a view that goes through what can be played there, and plays it: place,
/// number, speed, range, back and forth, again and again. It is there for clips and steps in time, while
/// anything is played, and where the pointer rests at the bottom of the view. In narrow views its fields make
/// room, its place and its button stay.
class CineBar : public QWidget {
  Q_OBJECT
 public:
  static constexpr int barHeight = 20;
  static constexpr double leastRate = 0.1, mostRate = 100;  // places a second

  /// Steps in time can be played. `isDrawn`: whether the view shows what the workspace says.
  CineBar(Session& session, ViewId view, std::function<bool()> isDrawn, QWidget* parent);
  ~CineBar() override;

  /// Something else can be played; `before`: rather than steps in time, where both are clips.
  void add(std::unique_ptr<Playable> what, bool before);
  const CineRound& round() const { return round_; }

  bool isPlaying() const { return player_ != nullptr; }
  bool isBackwards() const { return player_ && player_->isBackwards(); }
  void togglePlay();
  void stop();
  /// A place came on screen.
  void tellShown(int place);
  /// What is played really, places a second; 0: not yet known, or nothing is.
  double rate() const { return player_ ? player_->rate() : 0; }
  bool isLate() const { return player_ && player_->isLate(); }
  /// So many steps on in time; stays within them. False: there are none.
  bool stepTime(int steps);
  /// To the next usual speed, up or down, where there is one; false: there is nothing to play.
  bool stepRate(int up);
  /// What can be played, or which place is shown, may be another.
  void look();
  /// Whether the pointer is at the bottom of the view.
  void pointAtEdge(bool isThere);

 Q_SIGNALS:
  /// It is there now, or no longer.
  void shownChanged();

 protected:
  void leaveEvent(QEvent*) override;
  void resizeEvent(QResizeEvent*) override;
  void mousePressEvent(QMouseEvent*) override;

 private:
  void makeControls();
  void connectControls();
  QToolButton* addButton(const char* name, const QString& text, const QString& tip, bool checkable);
  TypedNumber* addNumber(const char* name, const QString& tip, int width);
  QLabel* addWord(const QString& word);
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
  void showNumbers();
  void showChoices();
  void makeRoom();
  void setShown(bool wanted);

  Session& session_;
  const ViewId view_;
  int steps_;                                   // to undo, by now
  std::vector<std::unique_ptr<Playable>> all_;  // what is preferred first
  PlayedTimePoints* time_;
  Playable* chosen_ = nullptr;  // by hand
  CineRound round_;
  std::pair<SeriesKey, int> roundOf_{{}, 0};  // source and count
  Playable* played_ = nullptr;                // by the player
  CinePlayer* player_ = nullptr;              // a child; null: nothing is played
  bool isPointedAt_ = false;
  QTimer pointedSoon_;
  QToolButton *play_, *what_, *back_, *loop_;
  QSlider* place_;
  TypedNumber *number_, *first_, *last_, *rate_;
  QLabel *from_, *to_, *aSecond_;
};

}  // namespace volumen
