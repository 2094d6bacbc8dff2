#pragma once

#include <QDialog>
#include <QSpinBox>
#include <vector>

#include "ui/widgets/fields.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/picture_look.h"
#include "ui/workspace/stack.h"

class QFormLayout;

namespace volumen {

/// Makes the field that hides names in pictures. It cannot be changed while the window hides them.
QCheckBox* hideNamesField(const QString& name);

/// The kinds of pictures made of a flat view.
enum class PicturesOf {
  view,   ///< the view as it is
  stack,  ///< one file for each position of the stack
  sheet,  ///< a contact sheet of rows and columns
  film,   ///< one file of the positions of the stack or the time points, without names
  turn    ///< one file of a full turn of a 3D view or of its time points
};

/// Asks for size, positions and texts of pictures of a flat view, or of a film of a 3D view.
class PictureDialog : public QDialog {
  Q_OBJECT
 public:
  /// `stack` is that of the view, and `seen` its size in logical pixels. A film or turn can be of
  /// several `timePoints` instead.
  PictureDialog(PicturesOf of, Stack stack, QSize seen, QWidget* parent = nullptr, int timePoints = 0);

  PictureLook look() const;
  /// Returns the chosen numbers that have a position, and these positions.
  std::vector<std::pair<int, int>> places() const;
  int columns() const { return columns_->value(); }
  /// Returns whether places() are those of time points.
  bool isOfTimePoints() const { return filmOf_->currentIndex() == 1; }
  /// Returns the ending of a film's file: ".png" or ".mp4".
  QString filmEnding() const;
  /// Returns how many pictures a film shows in a second.
  int perSecond() const { return perSecond_->value(); }
  void setPerSecond(int pictures) { perSecond_->setValue(pictures); }
  /// Returns how many pictures a turn has.
  int turnPictures() const { return turnPictures_->value(); }
  /// Returns whether texts may be drawn over or beside pictures.
  bool withTexts() const { return texts_->isChecked(); }

 private:
  void addSize();
  void addNumbers(int count);
  void addFilm(int timePoints);
  void offerNumbers(int count);
  void followFilmOf(int timePoints);
  void addTexts();
  void addButtons();
  QSpinBox* number(const char* name, const QString& label, int least, int most, int value, bool isShown);
  bool isFilm() const { return of_ == PicturesOf::film || of_ == PicturesOf::turn; }
  int every() const;
  void showCount();

  const PicturesOf of_;
  const Stack stack_, timePoints_;
  const QSize seen_;
  QFormLayout* form_;
  QComboBox* size_;
  QSpinBox *width_, *first_, *last_, *every_, *rows_, *columns_, *perSecond_, *turnPictures_;
  QComboBox *filmOf_, *filmFormat_;
  QCheckBox *texts_, *hideNames_;
  QLabel* count_;
  QPushButton* save_;
};

}  // namespace volumen
