#include "ui/panels/export_dialog.h"

#include <QFormLayout>
#include <algorithm>

#include "results/text/text.h"
#include "ui/panels/picture_dialog.h"
#include "ui/widgets/fields.h"

namespace volumen {

namespace {

constexpr int leastLettersOfTarget = 24;

}  // namespace

ExportDialog::ExportDialog(const QString& name, const std::vector<ExportChoice>& choices,
                           const Archives& archives, const QString& archive, bool deidentified,
                           QWidget* parent)
    : QDialog(parent),
      choices_(choices),
      choice_(choiceField({QStringLiteral("exportChoice"), tr("What")})),
      target_(choiceField({QStringLiteral("exportTarget"), tr("Where to")}, {tr("A folder")},
                          leastLettersOfTarget)),
      hideNames_(hideNamesField(QStringLiteral("exportHideNames"))),
      deidentified_(
          flagField({QStringLiteral("exportDeidentified"), tr("Without the patient's identity"),
                     tr("Removes names, numbers, dates and private data (PS3.15 E), and makes new UIDs. "
                        "Pixels stay.")})),
      faceless_(flagField({QStringLiteral("exportFaceless"), tr("Without faces"),
                           tr("Makes air of the face of heads of CT and MR. What is left of the head may "
                              "still be recognised.")})) {
  setObjectName(QStringLiteral("exportDialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(tr("Export"));
  for (const ExportChoice& one : choices) choice_->addItem(one.text);
  for (const Archive& one : archives.archives) target_->addItem(QString::fromStdString(one.name));
  const auto& all = archives.archives;
  const auto proposed = std::ranges::find(all, archive.toStdString(), &Archive::name);
  target_->setCurrentIndex(proposed == all.end() ? 0 : int(proposed - all.begin()) + 1);
  deidentified_->setChecked(deidentified);
  auto* form = new QFormLayout(this);
  form->addRow(wrappedLabel(QStringLiteral("exportName"), name));
  form->addRow(choice_->accessibleName(), choice_);
  form->addRow(target_->accessibleName(), target_);
  form->addRow(hideNames_);
  form->addRow(deidentified_);
  form->addRow(faceless_);
  auto* buttons = new QDialogButtonBox;
  addAccept(*this, *buttons, QStringLiteral("exportButton"), tr("Export"));
  form->addRow(buttons);
  connect(choice_, &QComboBox::currentIndexChanged, this, &ExportDialog::enableFields);
  connect(deidentified_, &QCheckBox::toggled, this, &ExportDialog::enableFields);
  enableFields();
}

// Names are hidden in any case without identity, or if the window hides them. Faces go only without identity.
void ExportDialog::enableFields() {
  const ExportChoice& chosen = choices_[std::size_t(std::max(0, choice()))];
  hideNames_->setEnabled(chosen.isPicture && !deidentified() && !volumen::namesHidden());
  faceless_->setEnabled(chosen.hasFace && deidentified());
}

}  // namespace volumen
