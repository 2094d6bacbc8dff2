#include "ui/panels/pages_dialog.h"

#include <QFormLayout>

#include "results/text/text.h"
#include "ui/panels/picture_dialog.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

constexpr int usualPerPage = 6;

}  // namespace

PagesDialog::PagesDialog(int pictures, QWidget* parent)
    : QDialog(parent),
      perPage_(choiceField({QStringLiteral("pagesPictures"), tr("Pictures a page")})),
      trueSize_(
          flagField({QStringLiteral("pagesTrueSize"), tr("True size: 1 mm of the patient is 1 mm on paper"),
                     tr("Of calibrated pictures that fit their place so; under others it is said")})),
      hideNames_(hideNamesField(QStringLiteral("pagesHideNames"))) {
  setObjectName(QStringLiteral("pagesDialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(tr("Key images as pages"));
  for (const int choice : {1, 2, 4, 6, 9, 12}) perPage_->addItem(QString::number(choice), choice);
  perPage_->setCurrentText(QString::number(usualPerPage));
  auto* form = new QFormLayout(this);
  form->addRow(plainLabel(pictures == 1 ? tr("1 key image") : tr("%1 key images").arg(pictures)));
  form->addRow(tr("Pictures a page"), perPage_);
  form->addRow(trueSize_);
  form->addRow(hideNames_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  const auto add = [&](const char* name, const QString& text, bool isForPaper) {
    auto* button = buttonOf<QPushButton>(QLatin1String(name), text, [this, isForPaper] {
      isForPaper_ = isForPaper;
      accept();
    });
    buttons->addButton(button, QDialogButtonBox::ActionRole);
    return button;
  };
  add("pagesPdf", tr("Save as PDF..."), false)->setDefault(true);
  add("pagesPrint", tr("Print..."), true);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  form->addRow(buttons);
}

}  // namespace volumen
