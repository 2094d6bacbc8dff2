#pragma once

#include <QWidget>
#include <functional>

namespace volumen {

/// A second window for views arranged by ViewGrid. Its owner shows and hides it.
class WindowBeside : public QWidget {
  Q_OBJECT
 public:
  /// Calls `step` for Tab (true) and Shift+Tab (false) from one of its views. If `step` returns false, the
  /// keys act as usual.
  explicit WindowBeside(const std::function<bool(bool next)>& step);

 Q_SIGNALS:
  void resized();
  /// The user closed the window.
  void closed();

 protected:
  void resizeEvent(QResizeEvent*) override;
  void closeEvent(QCloseEvent*) override;
  bool focusNextPrevChild(bool next) override;

 private:
  const std::function<bool(bool)> step_;
};

}  // namespace volumen
