#pragma once

#include <QDialog>
#include <QLabel>
#include <QPlainTextEdit>
#include <QPushButton>

#include "ui/workspace/segment_record.h"
#include "ui/workspace/session.h"

namespace volumen {

/// The steps that made the segments of the series in view, as the text of a recipe, to be changed and run
/// again. It follows what is done until a text is typed, which stays until it has been run or is discarded.
/// Not modal; deletes itself when closed.
class StepsDialog : public QDialog {
  Q_OBJECT
 public:
  explicit StepsDialog(Session& session, QWidget* parent = nullptr);

  /// What runWanted() came to: it was done, or why not.
  void showDone();
  void showRefused(const QString& why);

 Q_SIGNALS:
  /// A recipe for the segments of these names, in the map of this number, whose steps it was.
  void runWanted(const volumen::Recipe& recipe, int map);

 private:
  void showSteps();
  void showProblem();
  void run();

  Session& session_;
  QPlainTextEdit* text_;
  QLabel* note_;
  QPushButton *run_, *reset_;
  int map_ = 0;  // whose steps are shown
  QString ran_;  // the text that was run last
};

}  // namespace volumen
