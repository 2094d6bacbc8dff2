#pragma once

#include <QDialog>

#include "ui/data/picture_index.h"
#include "ui/workspace/derived_text.h"

namespace volumen {

struct Series;

/// A report to read, with links to its pictures that are open.
class ReportDialog : public QDialog {
  Q_OBJECT
 public:
  /// `open`: all pictures that are open.
  ReportDialog(const DerivedObject& object, const Report& report, const std::vector<const Series*>& open,
               QWidget* parent = nullptr);

 Q_SIGNALS:
  void pictureChosen(const volumen::ReferencedPicture& picture);
};

}  // namespace volumen
