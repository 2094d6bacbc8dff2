#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QDialogButtonBox>

#include "ui/overlays/picture_pages.h"

namespace volumen {

/// How many things a report may have.
struct ReportCounts {
  int pictures = 0, measurements = 0, segments = 0;
};

/// Asks what a report has and how its key images are laid out on pages, and whether to save or print it.
class PagesDialog : public QDialog {
  Q_OBJECT
 public:
  explicit PagesDialog(const ReportCounts& counts, QWidget* parent = nullptr);

  PageLook look() const { return {perPage_->currentData().toInt(), trueSize_->isChecked()}; }
  bool withMeasurements() const { return measurements_->isChecked(); }
  bool withSegments() const { return segments_->isChecked(); }
  bool namesHidden() const { return hideNames_->isChecked(); }
  bool isForPaper() const { return isForPaper_; }

 private:
  QDialogButtonBox* buttons(bool hasPictures);

  QComboBox* perPage_;
  QCheckBox *trueSize_, *measurements_, *segments_, *hideNames_;
  bool isForPaper_ = false;
};

}  // namespace volumen
