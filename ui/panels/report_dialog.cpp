#include "ui/panels/report_dialog.h"

#include <QTextBrowser>
#include <QUrl>
#include <QVBoxLayout>
#include <algorithm>

#include "io/study/series.h"
#include "results/series/series_facts.h"
#include "results/text/text.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/patients.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

ReportDialog::ReportDialog(const Session& session, const DerivedObjectPtr& object, const Report& report,
                           const std::vector<const Series*>& open, QWidget* parent)
    : QDialog(parent), session_(session), object_(object), other_(plainLabel()) {
  setObjectName(QStringLiteral("reportDialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  other_->setObjectName(QStringLiteral("reportOther"));
  other_->setWordWrap(true);
  resize(480, 560);
  const std::vector<ReferencedPicture> pictures = reportPictures(report);
  std::vector<bool> isHere;
  for (const ReferencedPicture& picture : pictures) isHere.push_back(findPicture(open, picture).has_value());
  auto* text = new QTextBrowser;
  text->setObjectName(QStringLiteral("reportText"));
  text->setAccessibleName(tr("Report"));
  text->setOpenLinks(false);
  text->setHtml(reportHtml(*object, report, isHere));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->addWidget(other_);
  column->addWidget(text);
  connect(text, &QTextBrowser::anchorClicked, this, [this, pictures](const QUrl& link) {
    const auto n = std::size_t(link.path().toULongLong());
    if (n < pictures.size()) Q_EMIT pictureChosen(pictures[n]);
  });
  whenChanged(session_, this, &ReportDialog::showPatient, showsOther);
  connect(&session_, &Session::preferencesChanged, this, &ReportDialog::showPatient);
  showPatient();
}

void ReportDialog::showPatient() {
  setWindowTitle(QStringLiteral("%1 - %2").arg(derivedName(*object_), patientText(*object_)));
  const Series* shown = seriesIn(session_.workspace(), session_.workspace().focus);
  const bool isOther = shown && shown->format == "DICOM" && !areOfOnePatient(*shown, *object_);
  other_->setVisible(isOther);
  if (isOther)
    other_->setText(tr("! The view shows another patient: %1. This report is of %2.")
                        .arg(patientText(*shown), patientText(*object_)));
}

}  // namespace volumen
