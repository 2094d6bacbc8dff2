#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QSpinBox>
#include <vector>

#include "ui/workspace/flat_plane.h"
#include "ui/workspace/picture_look.h"

class QFormLayout;
class QPushButton;

namespace volumen {

/// What pictures of a flat view are made.
enum class PicturesOf {
  view,   ///< one, as it is
  stack,  ///< a file for each place
  sheet   ///< one, in rows and columns
};

/// Asks how pictures of a flat view are made: how large, of which places, with which texts.
class PictureDialog : public QDialog {
  Q_OBJECT
 public:
  /// `stack`: the places of the view, in the order of their numbers, of which there are 1 to `count`; `seen`:
  /// its size, logical pixels.
  PictureDialog(PicturesOf of, std::vector<NumberedPlace> stack, int count, QSize seen,
                QWidget* parent = nullptr);

  PictureLook look() const;
  /// Which places of the stack.
  std::vector<NumberedPlace> places() const;
  int columns() const { return columns_->value(); }
  /// Whether anything may be written over or beside pictures.
  bool withTexts() const { return texts_->isChecked(); }

 private:
  void addSize();
  void addRange(int count);
  void addSheet();
  void addTexts();
  void addButtons();
  QSpinBox* number(const char* name, const QString& label, int least, int most, int value);
  int every() const;
  void showCount();

  const PicturesOf of_;
  const std::vector<NumberedPlace> stack_;
  const QSize seen_;
  QFormLayout* form_;
  QComboBox* size_;
  QSpinBox *width_, *first_, *last_, *every_, *rows_, *columns_;
  QCheckBox *texts_, *hideNames_;
  QLabel* count_;
  QPushButton* save_;
};

}  // namespace volumen
