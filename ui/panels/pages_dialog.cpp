#include "ui/panels/pages_dialog.h"

#include <QFormLayout>

#include "results/text/text.h"
#include "ui/panels/picture_dialog.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

constexpr int usualPerPage = 6;

// Makes the field of a table. It is on if there is anything for it.
QCheckBox* tableField(const QString& name, const QString& text, int count, const QString& none) {
  QCheckBox* field = flagField({name, count > 0 ? QStringLiteral("%1 (%2)").arg(text).arg(count) : text});
  field->setEnabled(count > 0);
  field->setChecked(count > 0);
  if (count == 0) field->setToolTip(toolTipOf(none));
  return field;
}

QString picturesText(int pictures) {
  if (pictures == 0) return PagesDialog::tr("No key image: K marks the picture that is shown.");
  return pictures == 1 ? PagesDialog::tr("1 key image") : PagesDialog::tr("%1 key images").arg(pictures);
}

}  // namespace

PagesDialog::PagesDialog(const ReportCounts& counts, QWidget* parent)
    : QDialog(parent),
      perPage_(choiceField({QStringLiteral("pagesPictures"), tr("Pictures a page")})),
      trueSize_(
          flagField({QStringLiteral("pagesTrueSize"), tr("True size: 1 mm of the patient is 1 mm on paper"),
                     tr("Of calibrated pictures that fit their place so; under others it is said")})),
      measurements_(tableField(QStringLiteral("pagesMeasurements"), tr("Measurements"), counts.measurements,
                               tr("There is no measurement with a number."))),
      segments_(tableField(QStringLiteral("pagesSegments"), tr("Segments"), counts.segments,
                           tr("There is no segment yet."))),
      hideNames_(hideNamesField(QStringLiteral("pagesHideNames"))) {
  setObjectName(QStringLiteral("pagesDialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(tr("Report"));
  for (const int choice : {1, 2, 4, 6, 9, 12}) perPage_->addItem(QString::number(choice), choice);
  perPage_->setCurrentText(QString::number(usualPerPage));
  for (QWidget* field : {static_cast<QWidget*>(perPage_), static_cast<QWidget*>(trueSize_)})
    field->setEnabled(counts.pictures > 0);
  auto* form = new QFormLayout(this);
  form->addRow(plainLabel(picturesText(counts.pictures)));
  form->addRow(tr("Pictures a page"), perPage_);
  form->addRow(trueSize_);
  form->addRow(tr("Tables"), measurements_);
  form->addRow(QString(), segments_);
  form->addRow(hideNames_);
  form->addRow(buttons(counts.pictures > 0));
}

QDialogButtonBox* PagesDialog::buttons(bool hasPictures) {
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  const auto add = [&](const char* name, const QString& text, bool isForPaper) {
    auto* button = buttonOf<QPushButton>(QLatin1String(name), text, [this, isForPaper] {
      isForPaper_ = isForPaper;
      accept();
    });
    buttons->addButton(button, QDialogButtonBox::ActionRole);
    for (QCheckBox* table : {measurements_, segments_})
      connect(table, &QCheckBox::toggled, button, [this, button, hasPictures] {
        button->setEnabled(hasPictures || withMeasurements() || withSegments());
      });
    return button;
  };
  add("pagesPdf", tr("Save as PDF..."), false)->setDefault(true);
  add("pagesPrint", tr("Print..."), true);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  return buttons;
}

}  // namespace volumen
