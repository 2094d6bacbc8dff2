#pragma once

#include <QDialog>

namespace volumen {

/// Shows the built-in documents (resources/docs): a list at the left, the selected page with its links at the
/// right. Not modal; deletes itself when closed.
class DocumentsWindow : public QDialog {
  Q_OBJECT
 public:
  explicit DocumentsWindow(QWidget* parent = nullptr);
};

}  // namespace volumen
