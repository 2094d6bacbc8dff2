#pragma once

#include <QDialog>

namespace volumen {

/// The documents that are compiled in (resources/docs), one page at a time: a list of them at the left, the
/// page with its links at the right. Not modal; deletes itself when closed.
class DocumentsWindow : public QDialog {
  Q_OBJECT
 public:
  explicit DocumentsWindow(QWidget* parent = nullptr);
};

}  // namespace volumen
