#include "ui/panels/pages_dialog.h"

#include <QDialogButtonBox>
#include <QFormLayout>
#include <QPushButton>

#include "results/text/text.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

constexpr int perPageChoices[] = {1, 2, 4, 6, 9, 12};
constexpr int usualPerPage = 6;

}  // namespace

PagesDialog::PagesDialog(int pictures, QWidget* parent)
    : QDialog(parent),
      perPage_(new QComboBox),
      trueSize_(new QCheckBox(tr("True size: 1 mm of the patient is 1 mm on paper"))),
      hideNames_(new QCheckBox(tr("Hide names, IDs and dates"))) {
  setObjectName(QStringLiteral("pagesDialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(tr("Key images as pages"));
  perPage_->setObjectName(QStringLiteral("pagesPictures"));
  perPage_->setAccessibleName(tr("Pictures a page"));
  for (const int choice : perPageChoices) perPage_->addItem(QString::number(choice), choice);
  perPage_->setCurrentText(QString::number(usualPerPage));
  trueSize_->setObjectName(QStringLiteral("pagesTrueSize"));
  trueSize_->setToolTip(
      toolTipOf(tr("Of calibrated pictures that fit their place so; under others it is said")));
  hideNames_->setObjectName(QStringLiteral("pagesHideNames"));
  hideNames_->setChecked(volumen::namesHidden());
  hideNames_->setEnabled(!volumen::namesHidden());
  auto* form = new QFormLayout(this);
  form->addRow(plainLabel(pictures == 1 ? tr("1 key image") : tr("%1 key images").arg(pictures)));
  form->addRow(tr("Pictures a page"), perPage_);
  form->addRow(trueSize_);
  form->addRow(hideNames_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  const auto add = [&](const char* name, const QString& text, bool isForPaper) {
    QPushButton* button = buttons->addButton(text, QDialogButtonBox::ActionRole);
    button->setObjectName(QLatin1String(name));
    connect(button, &QPushButton::clicked, this, [this, isForPaper] {
      isForPaper_ = isForPaper;
      accept();
    });
    return button;
  };
  add("pagesPdf", tr("Save as PDF..."), false)->setDefault(true);
  add("pagesPrint", tr("Print..."), true);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  form->addRow(buttons);
}

}  // namespace volumen
