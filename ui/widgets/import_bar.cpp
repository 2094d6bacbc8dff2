#include "ui/widgets/import_bar.h"

#include <QHBoxLayout>
#include <QLocale>

#include "ui/widgets/plain_text.h"

namespace volumen {

ImportBar::ImportBar(QWidget* parent) : QWidget(parent), text_(plainLabel()), bar_(new QProgressBar) {
  setObjectName(QStringLiteral("importBar"));
  text_->setObjectName(QStringLiteral("importText"));
  bar_->setFixedSize(120, 12);
  bar_->setTextVisible(false);
  bar_->setAccessibleName(tr("Progress of the import"));
  auto* cancel = new QToolButton;
  cancel->setObjectName(QStringLiteral("cancelImport"));
  cancel->setText(tr("Cancel"));
  cancel->setAccessibleName(tr("Cancel import"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(8, 0, 8, 0);
  row->setSpacing(8);
  row->addWidget(text_);
  row->addWidget(bar_);
  row->addWidget(cancel);
  connect(cancel, &QToolButton::clicked, this, &ImportBar::cancelRequested);
  hide();
}

void ImportBar::setImporting(bool importing) {
  progress(0, 0);
  setVisible(importing);
}

void ImportBar::progress(qint64 done, qint64 total) {
  const QLocale locale;
  text_->setText(total > 0
                     ? tr("Importing: %1 of %2 files").arg(locale.toString(done), locale.toString(total))
                     : tr("Importing"));
  bar_->setRange(0, total > 0 ? 1000 : 0);
  if (total > 0) bar_->setValue(int(1000 * done / total));
}

}  // namespace volumen
