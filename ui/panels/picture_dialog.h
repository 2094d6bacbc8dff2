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
  sheet   ///< a contact sheet of rows and columns
};

/// Asks for size, positions and texts of pictures of a flat view.
class PictureDialog : public QDialog {
  Q_OBJECT
 public:
  /// `stack` is that of the view, and `seen` its size in logical pixels.
  PictureDialog(PicturesOf of, Stack stack, QSize seen, QWidget* parent = nullptr);

  PictureLook look() const;
  /// Returns the chosen numbers that have a position, and these positions.
  std::vector<std::pair<int, int>> places() const;
  int columns() const { return columns_->value(); }
  /// Returns whether texts may be drawn over or beside pictures.
  bool withTexts() const { return texts_->isChecked(); }

 private:
  void addSize();
  void addNumbers(int count);
  void addTexts();
  void addButtons();
  QSpinBox* number(const char* name, const QString& label, int least, int most, int value, bool isShown);
  int every() const;
  void showCount();

  const PicturesOf of_;
  const Stack stack_;
  const QSize seen_;
  QFormLayout* form_;
  QComboBox* size_;
  QSpinBox *width_, *first_, *last_, *every_, *rows_, *columns_;
  QCheckBox *texts_, *hideNames_;
  QLabel* count_;
  QPushButton* save_;
};

}  // namespace volumen
