#pragma once

#include <QObject>

class QHeaderView;
class QMenu;

namespace volumen {

/// Hides and shows columns of the study list by a context menu of its heads. Settings keep the choice.
class StudyColumns : public QObject {
  Q_OBJECT
 public:
  /// `header` belongs to the study list. Its sections are those of StudyColumn.
  explicit StudyColumns(QHeaderView* header);

  /// Adds an entry for each column that can be hidden.
  void addTo(QMenu* menu);

 private:
  void show(int column, bool shown);

  QHeaderView* header_;
};

}  // namespace volumen
