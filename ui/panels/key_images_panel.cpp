#include "ui/panels/key_images_panel.h"

#include <QAction>
#include <algorithm>

#include "ui/widgets/fields.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

constexpr int entryRole = Qt::UserRole;

QTreeWidgetItem* headingIn(QTreeWidget* list, const QString& text, const QString& tip) {
  auto* item = new QTreeWidgetItem(list, {text});
  item->setToolTip(0, toolTipOf(tip));
  item->setFlags(Qt::ItemIsEnabled);
  item->setExpanded(true);
  return item;
}

}  // namespace

KeyImagesPanel::KeyImagesPanel(Session& session, DerivedObjects& derived, OpenPictures pictures,
                               const QList<QAction*>& actions, QWidget* parent)
    : QWidget(parent),
      session_(session),
      derived_(derived),
      pictures_(std::move(pictures)),
      empty_(wrappedLabel(QStringLiteral("keyImagesEmpty"), tr("K marks the picture that is shown."))),
      list_(new QTreeWidget) {
  list_->setObjectName(QStringLiteral("keyImageList"));
  list_->setAccessibleName(tr("Key images"));
  list_->setHeaderHidden(true);
  list_->setIndentation(8);
  list_->setMinimumHeight(60);
  std::vector<LayoutPart> buttons;
  for (QAction* action : actions) {
    auto* button = buttonOf(action->objectName() + QStringLiteral("Button"));
    button->setDefaultAction(action);
    buttons.push_back(button);
  }
  buttons.push_back({});
  stack(this, {empty_, {list_, 1}, lineOf(buttons)}, 8);
  whenChanged(session_, this, &KeyImagesPanel::showAll, &Workspace::keyImages, &Workspace::series);
  connect(&session_, &Session::preferencesChanged, this, &KeyImagesPanel::showAll);
  connect(&derived_, &DerivedObjects::changed, this, &KeyImagesPanel::showAll);
  connect(list_, &QTreeWidget::itemClicked, this, [this](QTreeWidgetItem* item) {
    const QVariant n = item->data(0, entryRole);
    if (!n.isValid()) return;
    const ListedKeyImage picture = entries_[n.toULongLong()];
    Q_EMIT pictureChosen(*picture.series, picture.index);
  });
  showAll();
}

std::optional<PicturePlace> KeyImagesPanel::next(const SeriesKey& series, int index, int step) const {
  if (entries_.empty()) return {};
  const auto here = std::ranges::find_if(
      entries_, [&](const ListedKeyImage& e) { return keyOf(*e.series) == series && e.index == index; });
  const auto count = std::ptrdiff_t(entries_.size());
  const std::ptrdiff_t at = here == entries_.end() ? (step > 0 ? -1 : count) : here - entries_.begin();
  const ListedKeyImage& entry = entries_[std::size_t((at + step + count) % count)];
  return PicturePlace{entry.series.get(), entry.index};
}

void KeyImagesPanel::showAll() {
  list_->clear();
  entries_.clear();
  for (const KeyImageGroup& group : groups()) {
    QTreeWidgetItem* heading = headingIn(list_, group.name, group.isDocument ? group.name : QString());
    for (const ListedKeyImage& picture : group.pictures) addPicture(heading, picture);
    addNotHere(heading, group.notHere);
  }
  empty_->setVisible(list_->topLevelItemCount() == 0);
  list_->setVisible(list_->topLevelItemCount() > 0);
}

std::vector<KeyImageGroup> KeyImagesPanel::groups() const {
  return listKeyImages(session_.workspace(), derived_.all(), pictures_());
}

void KeyImagesPanel::addPicture(QTreeWidgetItem* parent, const ListedKeyImage& picture) {
  auto* item = new QTreeWidgetItem(parent, {keyImageName(picture)});
  item->setToolTip(0, toolTipOf(item->text(0)));
  item->setData(0, entryRole, qulonglong(entries_.size()));
  entries_.push_back(picture);
}

void KeyImagesPanel::addNotHere(QTreeWidgetItem* parent, std::size_t notHere) {
  if (notHere == 0) return;
  auto* item = new QTreeWidgetItem(
      parent, {notHere == 1 ? tr("1 picture is not here") : tr("%1 pictures are not here").arg(notHere)});
  item->setFlags(Qt::NoItemFlags);
}

}  // namespace volumen
