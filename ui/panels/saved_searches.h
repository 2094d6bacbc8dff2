#pragma once

#include <QToolButton>

class QLineEdit;

namespace volumen {

/// A button whose menu lists the searches that the user saved, the same for every source of studies. Settings
/// keep them.
class SavedSearches : public QToolButton {
  Q_OBJECT
 public:
  /// `search` is the line whose words are saved, and which gets those that are chosen.
  explicit SavedSearches(QLineEdit* search);

 Q_SIGNALS:
  /// The line has the words of a saved search.
  void chosen();

 private:
  void showMenu();
  void save();
  void edit();

  QLineEdit* search_;
};

}  // namespace volumen
