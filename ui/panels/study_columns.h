#pragma once

#include <QObject>

class QHeaderView;
class QMenu;

namespace volumen {

/// Which columns of the study list are shown: chosen by a right click on their heads, and kept from one start
/// to the next.
class StudyColumns : public QObject {
  Q_OBJECT
 public:
  /// Of the list that this is the head of; its sections are those of StudyColumn.
  explicit StudyColumns(QHeaderView* header);

  /// An entry for each that can be hidden.
  void addTo(QMenu* menu);

 private:
  void show(int column, bool shown);

  QHeaderView* header_;
};

}  // namespace volumen
