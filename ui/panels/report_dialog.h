#pragma once

#include <QDialog>
#include <QLabel>

#include "ui/data/picture_index.h"
#include "ui/workspace/derived_text.h"
#include "ui/workspace/session.h"

namespace volumen {

struct Series;

/// Shows a report with links to its open pictures. The title names the patient. A warning appears if the view
/// in focus shows another patient.
class ReportDialog : public QDialog {
  Q_OBJECT
 public:
  /// `open` holds all open pictures.
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
