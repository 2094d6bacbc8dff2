#include "ui/panels/send_dialog.h"

#include <QFormLayout>
#include <algorithm>

#include "ui/widgets/fields.h"

namespace volumen {

namespace {

constexpr int leastLettersOfArchive = 24;

}  // namespace

SendDialog::SendDialog(const QString& name, const QStringList& choices, const Archives& archives,
                       const QString& last, QWidget* parent)
    : QDialog(parent),
      choice_(choiceField({QStringLiteral("sendChoice"), tr("Images")}, choices)),
      archive_(choiceField({QStringLiteral("sendArchive"), tr("Archive")}, {}, leastLettersOfArchive)) {
  setObjectName(QStringLiteral("sendDialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(tr("Send to archive"));
  for (const Archive& archive : archives.archives) archive_->addItem(QString::fromStdString(archive.name));
  archive_->setCurrentIndex(std::max(0, archive_->findText(last)));
  auto* form = new QFormLayout(this);
  form->addRow(wrappedLabel(QStringLiteral("sendName"), name));
  form->addRow(choice_->accessibleName(), choice_);
  form->addRow(archive_->accessibleName(), archive_);
  auto* buttons = new QDialogButtonBox;
  addAccept(*this, *buttons, QStringLiteral("send"), tr("Send"));
  form->addRow(buttons);
}

}  // namespace volumen
