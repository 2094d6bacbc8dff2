#pragma once

#include <QDialog>
#include <QLabel>
#include <QPlainTextEdit>
#include <QPushButton>

#include "results/segments/segment_record.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Shows the steps that made the segments in view as text of a recipe, to be edited and run again. Follows
/// the segments until a text is typed. Typed text stays until it is run or discarded. Not modal; deletes
/// itself when closed.
class StepsDialog : public QDialog {
  Q_OBJECT
 public:
  explicit StepsDialog(Session& session, QWidget* parent = nullptr);

  /// Show the result of runWanted(): success, or the reason of failure.
  void showDone();
  void showRefused(const QString& why);

 Q_SIGNALS:
  /// Requests to run a recipe that replaces the segments of these names in map number `map`.
  void runWanted(const volumen::Recipe& recipe, int map);

 private:
  void showSteps();
  void showProblem();
  void run();

  Session& session_;
  QPlainTextEdit* text_;
  QLabel* note_;
  QPushButton* run_;
  int map_ = 0;  // number of the map whose steps are shown
  QString ran_;  // the text last run
};

}  // namespace volumen
