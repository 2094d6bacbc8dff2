#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>

#include "ui/overlays/picture_pages.h"

namespace volumen {

/// Asks how key images are laid out on pages, and whether to save or print them.
class PagesDialog : public QDialog {
  Q_OBJECT
 public:
  explicit PagesDialog(int pictures, QWidget* parent = nullptr);

  PageLook look() const { return {perPage_->currentData().toInt(), trueSize_->isChecked()}; }
  bool namesHidden() const { return hideNames_->isChecked(); }
  bool isForPaper() const { return isForPaper_; }

 private:
  QComboBox* perPage_;
  QCheckBox *trueSize_, *hideNames_;
  bool isForPaper_ = false;
};

}  // namespace volumen
