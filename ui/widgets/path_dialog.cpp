#include "ui/widgets/path_dialog.h"

namespace volumen {

QFileDialog* openPathDialog(QWidget* parent, const PathQuestion& question) {
  auto* dialog = new QFileDialog(parent, question.title, question.folder, question.filters);
  dialog->setObjectName(QLatin1String(question.dialog));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(question.mode);
  if (!question.offered.isEmpty()) {
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setDefaultSuffix(QFileInfo(question.offered).suffix());
    dialog->selectFile(question.offered);
  }
  dialog->open();
  return dialog;
}

}  // namespace volumen
