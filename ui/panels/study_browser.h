#pragma once

#include <QTimer>
#include <QWidget>
#include <set>

#include "ui/controller/study_sources.h"
#include "ui/panels/study_model.h"

class QComboBox;
class QFrame;
class QLabel;
class QLineEdit;
class QListWidgetItem;
class QPushButton;
class QTreeView;

namespace volumen {

class SeriesStrip;
class StudyColumns;

/// The studies of a source: patients, studies and series in a tree that is searched as one types and sorted
/// by its columns, and the series of the chosen study as thumbnails. Asks the source for everything; what it
/// knows is the last answer. Where there are several sources, one is chosen above.
class StudyBrowser : public QWidget {
  Q_OBJECT
 public:
  explicit StudyBrowser(StudySources& sources, QWidget* parent = nullptr);

  /// Reads the list again: other programs may have changed it.
  void refresh();
  /// Writes all again, after names were hidden or shown.
  void showNames();
  /// Puts the cursor into the search field.
  void startSearch();
  /// Lists all again.
  void clearSearch();
  bool isEmpty() const { return model_->list().patients.empty() && shown_.words.empty(); }

 Q_SIGNALS:
  /// `beside`: what is on screen stays.
  void openRequested(const volumen::IndexedChoice& choice, bool beside);
  /// A study or series that cannot be opened, as its files are not there.
  void offlineRequested();
  void importRequested();
  void hideRequested();
  /// The list was read.
  void listChanged();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void dragEnterEvent(QDragEnterEvent*) override;
  void dropEvent(QDropEvent*) override;

 private:
  // What of the tree stays when the list is read again.
  struct TreeState {
    std::set<StudyRowKey> expanded, collapsed, selected;
    StudyRowKey current;
    int scrolled = 0;
  };

  void makeSearchRow();
  void makeTree();
  void makeRemovedBar();
  void makeNotice();
  void makeSourceBox();
  void listen();
  void showSource();
  void ask();
  void showList(const StudyListRequest& request, const StudyListPtr& list);
  void setUsable(bool usable);
  TreeState treeState(bool isSameSearch) const;
  void restore(const TreeState& state);
  void showSeriesOf(const QModelIndex& index);
  void showNotice(const QString& sentence);
  void activate(const QModelIndex& index);
  void open(const IndexedChoice& choice, bool isOffline, bool beside);
  void openCurrent(bool beside);
  void openBest(const QModelIndex& row, bool beside);
  void removeChosen();
  void showMenu(QWidget* from, QPoint position);
  bool searchKey(QKeyEvent* event);
  bool listKey(QObject* watched, QKeyEvent* event, bool isPress);

  StudySources& sources_;
  StudyModel* model_;
  QComboBox* sourceBox_;
  QLineEdit* search_;
  QPushButton* import_;
  QTreeView* tree_;
  StudyColumns* columns_ = nullptr;
  SeriesStrip* strip_;
  QLabel* notice_;
  QFrame* removedBar_;
  QLabel* removedText_;
  QPushButton* undo_;
  QTimer ask_;
  StudySort sort_;
  StudyListRequest asked_, shown_;
  std::unique_ptr<QObject> listening_;  // of what the source that is listed says
  std::vector<std::int64_t> removed_;   // by the last step
};

}  // namespace volumen
