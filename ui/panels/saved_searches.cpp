#include "ui/panels/saved_searches.h"

#include <QHeaderView>
#include <QLineEdit>
#include <QMenu>
#include <QSettings>
#include <QTableWidget>

#include "ui/widgets/fields.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

struct NamedSearch {
  QString name, words;
};

QString searchesKey() { return QStringLiteral("savedSearches"); }

// Settings hold names and words in turn.
std::vector<NamedSearch> keptSearches() {
  const QStringList texts = QSettings().value(searchesKey()).toStringList();
  std::vector<NamedSearch> searches;
  for (qsizetype n = 0; n + 1 < texts.size(); n += 2) searches.push_back({texts[n], texts[n + 1]});
  return searches;
}

void keepSearches(const std::vector<NamedSearch>& searches) {
  QStringList texts;
  for (const NamedSearch& search : searches) texts << search.name << search.words;
  QSettings().setValue(searchesKey(), texts);
}

// Renames, changes and removes saved searches. Each change is kept at once.
class SearchesDialog : public QDialog {
 public:
  explicit SearchesDialog(QWidget* parent);
  // Edits the name of the search that was saved last.
  void nameLast();

 private:
  void change(int row, int column);
  void remove();

  QTableWidget* table_;
};

SearchesDialog::SearchesDialog(QWidget* parent) : QDialog(parent), table_(new QTableWidget(0, 2)) {
  setObjectName(QStringLiteral("searchesDialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(SavedSearches::tr("Saved searches"));
  table_->setObjectName(QStringLiteral("searchesTable"));
  table_->setAccessibleName(SavedSearches::tr("Saved searches"));
  table_->setHorizontalHeaderLabels({SavedSearches::tr("Name"), SavedSearches::tr("Words")});
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  table_->verticalHeader()->hide();
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  for (const NamedSearch& search : keptSearches()) {
    const int row = table_->rowCount();
    table_->insertRow(row);
    table_->setItem(row, 0, new QTableWidgetItem(search.name));
    table_->setItem(row, 1, new QTableWidgetItem(search.words));
  }
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  addButton(*buttons, QStringLiteral("removeSearch"), SavedSearches::tr("Remove"), [this] { remove(); });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
  connect(table_, &QTableWidget::cellChanged, this, &SearchesDialog::change);
  stack(this, {{table_, 1}, buttons}, 12, 8);
  resize(460, 260);
}

void SearchesDialog::nameLast() {
  table_->setCurrentCell(table_->rowCount() - 1, 0);
  table_->editItem(table_->currentItem());
}

// Restores the cell if the text is empty.
void SearchesDialog::change(int row, int column) {
  std::vector<NamedSearch> searches = keptSearches();
  if (row >= int(searches.size())) return;
  NamedSearch& search = searches[std::size_t(row)];
  QString& kept = column == 0 ? search.name : search.words;
  const QString text = table_->item(row, column)->text().simplified();
  if (text.isEmpty()) return table_->item(row, column)->setText(kept);
  kept = text;
  keepSearches(searches);
}

void SearchesDialog::remove() {
  const int row = table_->currentRow();
  std::vector<NamedSearch> searches = keptSearches();
  if (row < 0 || row >= int(searches.size())) return;
  searches.erase(searches.begin() + row);
  keepSearches(searches);
  table_->removeRow(row);
}

}  // namespace

SavedSearches::SavedSearches(QLineEdit* search) : search_(search) {
  setObjectName(QStringLiteral("savedSearches"));
  setText(tr("Searches"));
  setToolTip(tr("Saved searches"));
  connect(this, &QToolButton::clicked, this, &SavedSearches::showMenu);
}

void SavedSearches::showMenu() {
  auto* menu = new QMenu(this);
  menu->setObjectName(QStringLiteral("savedSearchesMenu"));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  for (const NamedSearch& search : keptSearches()) {
    QString text = search.name;
    menu->addAction(text.replace(QLatin1Char('&'), QStringLiteral("&&")), this, [this, words = search.words] {
      search_->setText(words);
      Q_EMIT chosen();
    });
  }
  menu->addSeparator();
  menu->addAction(tr("Save this search"), this, &SavedSearches::save)
      ->setEnabled(!search_->text().simplified().isEmpty());
  menu->addAction(tr("Edit saved searches..."), this, &SavedSearches::edit)
      ->setEnabled(!keptSearches().empty());
  menu->popup(mapToGlobal(QPoint(0, height())));
}

// A search is named by its words until the user types a name.
void SavedSearches::save() {
  const QString words = search_->text().simplified();
  std::vector<NamedSearch> searches = keptSearches();
  searches.push_back({words, words});
  keepSearches(searches);
  auto* dialog = new SearchesDialog(window());
  dialog->open();
  dialog->nameLast();
}

void SavedSearches::edit() { (new SearchesDialog(window()))->open(); }

}  // namespace volumen
