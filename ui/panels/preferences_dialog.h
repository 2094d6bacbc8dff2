#pragma once

#include <QDialog>
#include <functional>

#include "ui/workspace/session.h"

class QFormLayout;

namespace volumen {

/// Edit > Preferences. Every choice takes effect at once.
class PreferencesDialog : public QDialog {
  Q_OBJECT
 public:
  explicit PreferencesDialog(Session& session, QWidget* parent = nullptr);

 private:
  template <class Value>
  void addChoice(const char* name, const QString& label, Value Preferences::*member,
                 const std::vector<std::pair<QString, Value>>& entries);
  void addFlag(const char* name, const QString& label, bool Preferences::*member);
  void addMousePresets();
  void askToRestore();
  void follow(const std::function<void()>& show);

  Session& session_;
  QFormLayout* form_;
};

}  // namespace volumen
