#include "ui/panels/preset_bar.h"

#include <QAbstractItemView>
#include <QHBoxLayout>
#include <QInputDialog>
#include <QMenu>
#include <QPainter>
#include <QStyledItemDelegate>
#include <algorithm>

#include "results/text/text.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/untinted_icon.h"

namespace volumen {

namespace {

const QString automatic = QStringLiteral("auto");
constexpr int widestRow = 340;  // width of the list, pixels

// Stands for a missing thumbnail.
QIcon neutralIcon(const QPalette& palette) {
  QPixmap plain(PresetBar::thumbnailEdge, PresetBar::thumbnailEdge);
  plain.fill(palette.color(QPalette::Button));
  return plain;
}

// Draws the list's rows with larger icons than the closed box, and the line between them.
class ThumbnailDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    if (!isLine(index)) return QStyledItemDelegate::paint(painter, option, index);
    painter->setPen(option.palette.color(QPalette::Mid));
    const int y = option.rect.center().y();
    painter->drawLine(option.rect.left() + 6, y, option.rect.right() - 6, y);
  }
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    if (isLine(index)) return {0, 9};
    return QStyledItemDelegate::sizeHint(option, index).expandedTo({0, PresetBar::thumbnailEdge + 6});
  }

 protected:
  void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override {
    QStyledItemDelegate::initStyleOption(option, index);
    option->decorationSize = {PresetBar::thumbnailEdge, PresetBar::thumbnailEdge};
  }

 private:
  static bool isLine(const QModelIndex& index) { return !index.data(Qt::UserRole).isValid(); }
};

}  // namespace

PresetBar::PresetBar(Session& session, Entries entries, QWidget* parent)
    : QWidget(parent),
      session_(session),
      readEntries_(std::move(entries)),
      box_(choiceField({QStringLiteral("presets"), tr("Preset"), tr("Preset of opacity and colour")})) {
  box_->setMinimumContentsLength(8);
  box_->setMaxVisibleItems(10);
  box_->setIconSize({20, 20});
  box_->setItemDelegate(new ThumbnailDelegate(box_));
  box_->view()->setMinimumWidth(widestRow);
  // Opens a scrolling list below the box instead of a menu over it.
  box_->setStyleSheet(QStringLiteral("combobox-popup: 0;"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(box_);
  makeMenu();
  connect(box_, &QComboBox::activated, this, [this](int n) {
    showChosen();  // keeps the old choice until the preset is made
    if (session_.series()) Q_EMIT presetChosen(box_->itemData(n).toString());
  });
  connect(&session_, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    if (before.series != after.series) fill();
    showChosen();
  });
  fill();
}

void PresetBar::makeMenu() {
  auto* menu = new QMenu(this);
  save_ = menu->addAction(tr("Save as preset..."), this, &PresetBar::askName);
  save_->setObjectName(QStringLiteral("savePreset"));
  delete_ = menu->addAction(tr("Delete preset"), this, &PresetBar::deleteOwn);
  delete_->setObjectName(QStringLiteral("deletePreset"));
  auto* button = buttonOf(QStringLiteral("presetMenu"), QStringLiteral("\u22ee"));
  button->setAccessibleName(tr("Own presets"));
  button->setToolTip(tr("Save or delete a preset of your own"));
  button->setStyleSheet(QStringLiteral("QToolButton::menu-indicator { image: none; }"));
  button->setPopupMode(QToolButton::InstantPopup);
  button->setMenu(menu);
  layout()->addWidget(button);
}

std::vector<std::string> PresetBar::names() const {
  std::vector<std::string> all;
  for (int n = 0; n < box_->count(); ++n)
    if (box_->itemData(n).isValid()) all.push_back(box_->itemData(n).toString().toStdString());
  return all;
}

void PresetBar::add(const PresetEntry& entry) {
  const QString name = QString::fromStdString(entry.name);
  box_->addItem(neutralIcon(palette()), shownText(entry.name), name);
  if (entry.own) box_->setItemData(box_->count() - 1, tr("Your own preset"), Qt::ToolTipRole);
}

void PresetBar::fill() {
  entries_ = readEntries_();
  box_->clear();
  box_->addItem(neutralIcon(palette()), tr("automatic"), automatic);
  const std::string modality = session_.series() ? session_.series()->series.modality : std::string();
  const auto fits = [&](const PresetEntry& entry) { return modality.empty() || entry.modality == modality; };
  const auto middle = std::stable_partition(entries_.begin(), entries_.end(), fits);
  std::for_each(entries_.begin(), middle, [this](const PresetEntry& entry) { add(entry); });
  if (middle != entries_.end()) box_->insertSeparator(box_->count());
  std::for_each(middle, entries_.end(), [this](const PresetEntry& entry) { add(entry); });
  showChosen();
}

bool PresetBar::isOwn(const QString& name) const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const PresetEntry& e) { return e.own && e.name == name.toStdString(); });
}

void PresetBar::showChosen() {
  const auto& preset = session_.state().preset;
  const QString name = preset ? QString::fromStdString(preset->name) : automatic;
  for (int n = 0; n < box_->count(); ++n) {
    const QString each = box_->itemData(n).toString();
    if (each.isEmpty()) continue;
    QString text = each == automatic ? tr("automatic") : shownText(each.toStdString());
    if (each == name && session_.presetModified()) text = tr("%1 (modified)").arg(text);
    if (box_->itemText(n) != text) box_->setItemText(n, text);
  }
  box_->setPlaceholderText(tr("%1 (deleted)").arg(shownText(name.toStdString())));
  box_->setCurrentIndex(box_->findData(name));
  save_->setEnabled(session_.series() != nullptr);
  delete_->setEnabled(isOwn(name));
}

void PresetBar::showThumbnail(const QString& name, const QImage& image) {
  const int n = box_->findData(name);
  if (n < 0) return;
  box_->setItemIcon(n, untintedIcon(image));
}

void PresetBar::askName() {
  auto* dialog = new QInputDialog(this);
  dialog->setObjectName(QStringLiteral("presetNameDialog"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(tr("Save as preset"));
  dialog->setLabelText(tr("Name:"));
  const auto& preset = session_.state().preset;
  if (preset && isOwn(QString::fromStdString(preset->name)))
    dialog->setTextValue(QString::fromStdString(preset->name));
  connect(dialog, &QInputDialog::textValueSelected, this, &PresetBar::save);
  dialog->open();
}

void PresetBar::save(const QString& text) {
  const std::string name = shownText(text.toStdString()).toStdString();
  if (name.empty() || !session_.series()) return;
  if (const Status saved = saveOwnPreset(name, session_.scene(), *session_.series()); !saved)
    return Q_EMIT failed(QString::fromStdString(saved.message()));
  session_.choosePreset(tr("Save preset %1").arg(text), name, session_.scene());
  fill();
  Q_EMIT listChanged();
}

void PresetBar::deleteOwn() {
  if (const Status gone = deleteOwnPreset(session_.state().preset->name); !gone)
    return Q_EMIT failed(QString::fromStdString(gone.message()));
  fill();
  Q_EMIT listChanged();
}

}  // namespace volumen
