#include "ui/panels/report_dialog.h"

#include <QTextBrowser>
#include <QUrl>
#include <QVBoxLayout>
#include <algorithm>

#include "io/study/series.h"

namespace volumen {

ReportDialog::ReportDialog(const DerivedObject& object, const Report& report,
                           const std::vector<const Series*>& open, QWidget* parent)
    : QDialog(parent) {
  setObjectName(QStringLiteral("reportDialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(derivedName(object));
  resize(480, 560);
  const std::vector<ReferencedPicture> pictures = reportPictures(report);
  std::vector<bool> isHere;
  for (const ReferencedPicture& picture : pictures) isHere.push_back(findPicture(open, picture).has_value());
  auto* text = new QTextBrowser;
  text->setObjectName(QStringLiteral("reportText"));
  text->setAccessibleName(tr("Report"));
  text->setOpenLinks(false);
  text->setHtml(reportHtml(object, report, isHere));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->addWidget(text);
  connect(text, &QTextBrowser::anchorClicked, this, [this, pictures](const QUrl& link) {
    const auto n = std::size_t(link.path().toULongLong());
    if (n < pictures.size()) Q_EMIT pictureChosen(pictures[n]);
  });
}

}  // namespace volumen
