#pragma once

#include <QWidget>
#include <functional>

namespace volumen {

/// A window beside the main one for views that ViewGrid places; whoever has one shows and hides it.
class WindowBeside : public QWidget {
  Q_OBJECT
 public:
  /// Calls `step` for Tab (true) and Shift+Tab from one of its views; where that goes nowhere (false), they
  /// go on as everywhere else.
  explicit WindowBeside(const std::function<bool(bool next)>& step);

 Q_SIGNALS:
  void resized();
  /// It was closed by hand.
  void closed();

 protected:
  void resizeEvent(QResizeEvent*) override;
  void closeEvent(QCloseEvent*) override;
  bool focusNextPrevChild(bool next) override;

 private:
  const std::function<bool(bool)> step_;
};

}  // namespace volumen
