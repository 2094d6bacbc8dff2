#include "ui/panels/key_images_panel.h"

#include <QAction>
#include <QHBoxLayout>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/data/frame_series.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/derived_text.h"
#include "ui/workspace/text.h"

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
      empty_(plainLabel(tr("K marks the picture that is shown."))),
      list_(new QTreeWidget) {
  empty_->setObjectName(QStringLiteral("keyImagesEmpty"));
  empty_->setWordWrap(true);
  list_->setObjectName(QStringLiteral("keyImageList"));
  list_->setAccessibleName(tr("Key images"));
  list_->setHeaderHidden(true);
  list_->setIndentation(8);
  list_->setMinimumHeight(60);
  auto* row = new QHBoxLayout;
  row->setSpacing(4);
  for (QAction* action : actions) {
    auto* button = new QToolButton;
    button->setDefaultAction(action);
    button->setObjectName(action->objectName() + QStringLiteral("Button"));
    row->addWidget(button);
  }
  row->addStretch();
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->setSpacing(4);
  column->addWidget(empty_);
  column->addWidget(list_, 1);
  column->addLayout(row);
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            if (before.keyImages != after.keyImages || before.series != after.series) showAll();
          });
  connect(&session_, &Session::preferencesChanged, this, &KeyImagesPanel::showAll);
  connect(&derived_, &DerivedObjects::changed, this, &KeyImagesPanel::showAll);
  connect(list_, &QTreeWidget::itemClicked, this, [this](QTreeWidgetItem* item) {
    const QVariant n = item->data(0, entryRole);
    if (!n.isValid()) return;
    const Entry entry = entries_[n.toULongLong()];
    Q_EMIT pictureChosen(*entry.series, entry.index);
  });
  showAll();
}

std::optional<PicturePlace> KeyImagesPanel::next(const SeriesKey& series, int index, int step) const {
  if (entries_.empty()) return {};
  const auto here = std::ranges::find_if(
      entries_, [&](const Entry& e) { return keyOf(*e.series) == series && e.index == index; });
  const auto count = std::ptrdiff_t(entries_.size());
  const std::ptrdiff_t at = here == entries_.end() ? (step > 0 ? -1 : count) : here - entries_.begin();
  const Entry& entry = entries_[std::size_t((at + step + count) % count)];
  return PicturePlace{entry.series.get(), entry.index};
}

void KeyImagesPanel::showAll() {
  list_->clear();
  entries_.clear();
  addOwn();
  const std::vector<const Series*> open = pictures_();
  for (const DerivedObjectPtr& object : derived_.all())
    if (object->kind == DerivedKind::keyObjects) addDocument(*object, open);
  empty_->setVisible(list_->topLevelItemCount() == 0);
  list_->setVisible(list_->topLevelItemCount() > 0);
}

void KeyImagesPanel::addPicture(QTreeWidgetItem* parent, const std::shared_ptr<const Series>& series,
                                int index) {
  const QString which =
      opensAsFrames(*series) ? tr("frame %1").arg(index + 1) : tr("slice %1").arg(index + 1);
  auto* item = new QTreeWidgetItem(parent, {QStringLiteral("%1, %2").arg(seriesText(*series), which)});
  item->setToolTip(0, toolTipOf(item->text(0)));
  item->setData(0, entryRole, qulonglong(entries_.size()));
  entries_.push_back({series, index});
}

void KeyImagesPanel::addOwn() {
  const Workspace& workspace = session_.workspace();
  QTreeWidgetItem* heading = nullptr;
  for (const KeyImage& image : workspace.keyImages) {
    const auto state = workspace.series.find(image.series);
    if (state == workspace.series.end()) continue;
    if (!heading) heading = headingIn(list_, tr("Marked here"), {});
    const ReferencedPicture picture{image.sopInstanceUid, {}, {image.frame}, {}};
    const std::vector<int> named = picturesNamed({picture}, *state->second.series);
    if (!named.empty()) addPicture(heading, state->second.series, named.front());
  }
}

void KeyImagesPanel::addDocument(const DerivedObject& document, const std::vector<const Series*>& open) {
  QString name = derivedName(document);
  const QString text = shownText(document.text);
  if (!text.isEmpty()) name += QStringLiteral(" (%1)").arg(text);
  QTreeWidgetItem* heading = headingIn(list_, name, name);
  std::size_t notHere = 0;
  for (const ReferencedPicture& picture : document.pictures) {
    const std::optional<PicturePlace> place = findPicture(open, picture);
    if (place)
      addPicture(heading, std::make_shared<const Series>(*place->series), place->index);
    else
      ++notHere;
  }
  if (notHere == 0) return;
  auto* item = new QTreeWidgetItem(
      heading, {notHere == 1 ? tr("1 picture is not here") : tr("%1 pictures are not here").arg(notHere)});
  item->setFlags(Qt::NoItemFlags);
}

}  // namespace volumen
