#pragma once

#include <QDialog>
#include <QLabel>

#include "ui/data/picture_index.h"
#include "ui/workspace/derived_text.h"
#include "ui/workspace/session.h"

namespace volumen {

struct Series;

/// A report to read, with links to its pictures that are open. Its title names the patient; where the view in
/// focus shows another one, it says so.
class ReportDialog : public QDialog {
  Q_OBJECT
 public:
  /// `open`: all pictures that are open.
  ReportDialog(const Session& session, const DerivedObjectPtr& object, const Report& report,
               const std::vector<const Series*>& open, QWidget* parent = nullptr);

 Q_SIGNALS:
  void pictureChosen(const volumen::ReferencedPicture& picture);

 private:
  void showPatient();

  const Session& session_;
  const DerivedObjectPtr object_;
  QLabel* other_;
};

}  // namespace volumen
