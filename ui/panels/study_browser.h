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
class QMenu;
class QPushButton;
class QTreeView;

namespace volumen {

class SeriesStrip;
class StudyColumns;

/// The studies of a source: a tree of patients, studies and series with search and sorting, and thumbnails of
/// the chosen study. Shows the last answer of the source. With several sources, a box before the search line
/// chooses one.
class StudyBrowser : public QWidget {
  Q_OBJECT
 public:
  explicit StudyBrowser(StudySources& sources, QWidget* parent = nullptr);

  /// Reads the list again, as other programs may have changed it.
  void refresh();
  /// Rewrites all texts after names were hidden or shown.
  void showNames();
  /// Moves the keyboard focus to the search field.
  void startSearch();
  /// Clears the search.
  void clearSearch();
  /// Returns whether there is nothing to list here. Archives may have studies.
  bool isEmpty() const {
    return sources_.offered().size() < 2 && model_->list().patients.empty() && shown_.words.empty();
  }

 Q_SIGNALS:
  /// If `beside`, the series on screen stay.
  void openRequested(const volumen::IndexedChoice& choice, bool beside);
  /// Requests to send a study or series of the listed source, called `name`, to an archive.
  void sendRequested(const volumen::IndexedChoice& choice, const QString& name);
  /// The user chose a study or series whose files are offline.
  void offlineRequested();
  void importRequested();
  void hideRequested();
  /// A list has been read.
  void listChanged();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void dragEnterEvent(QDragEnterEvent*) override;
  void dropEvent(QDropEvent*) override;

 private:
  // The state of the tree kept when the list is read again.
  struct TreeState {
    std::set<StudyRowKey> expanded, collapsed, selected;
    StudyRowKey current;
    int scrolled = 0;
    StudyRowKey anchor;  // the row that keeps its place on the screen
    int anchorY = 0;     // in pixels
  };

  QLayout* searchRow();
  void makeTree();
  void makeRemovedBar();
  void makeSourceBox();
  void showSources();
  void listen();
  void showPlaces(bool on);
  void showSource();
  void ask();
  void showList(const StudyListRequest& request, const StudyListPtr& list);
  void setUsable(bool usable);
  TreeState treeState(bool isSameSearch) const;
  QModelIndex anchor() const;
  void restore(const TreeState& state);
  void scrollBack(const TreeState& state);
  void showSeriesOf(const QModelIndex& index);
  void showUnavailable(const QString& sentence);
  QString noticeOn(const StudyList& list) const;
  void showNotice(const QString& sentence);
  void activate(const QModelIndex& index);
  void open(const IndexedChoice& choice, bool isOffline, bool beside);
  void openCurrent(bool beside);
  void openBest(const QModelIndex& row, bool beside);
  void removeChosen();
  void showMenu(QWidget* from, QPoint position);
  void addKeeping(QMenu* menu, const IndexedChoice& choice);
  void addSending(QMenu* menu, const IndexedChoice& choice, const IndexedSeries* series);
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
  QTimer ask_, sayBusy_;
  StudySort sort_;
  StudyListRequest asked_, shown_;
  StudyRowKey proposed_;                // row that became the current one by itself
  std::unique_ptr<QObject> listening_;  // receiver of the listed source's signals
  std::vector<std::int64_t> removed_;   // studies removed by the last step
};

}  // namespace volumen
