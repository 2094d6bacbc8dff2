#include <QMenu>
#include <QPointer>
#include <QToolButton>

#include <algorithm>
#include <cmath>

#include "results/text/value_text.h"
#include "ui/features/feature.h"
#include "ui/panels/windows_dialog.h"
#include "ui/views/flat_view.h"
#include "ui/widgets/listed_entries.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

// Lists the windows of the slice or frame in focus with their keys: in the View menu, the tool bar and the
// context menu. Edits the user's own windows in a dialog.
class WindowChoices : public Feature {
 public:
  explicit WindowChoices(Workbench& bench);

 private:
  void fillMenu(QMenu* menu);
  QList<QAction*> choicesOf(QMenu* menu, FlatView* view) const;
  QString whyNone() const;
  std::optional<OwnWindow> inUse() const;
  void showDialog();

  ListedEntries listed_;
  QPointer<WindowsDialog> dialog_;
};

WindowChoices::WindowChoices(Workbench& bench) : Feature(bench) {
  QMenu* menu = bench_.addMenu("windowMenu", tr("Window presets"), {{"viewMenu", 60, 85}});
  QToolButton* button = bench_.addMenuButton("windowButton", 15);
  button->setText(tr("W/L"));
  button->setToolTip(toolTipOf(tr("Windows of the slice or frame in focus, by name")));
  button->setMenu(menu);
  bench_.addAction({"editWindows",
                    tr("Edit windows..."),
                    {},
                    "",
                    false,
                    [this](bool) { showDialog(); },
                    {{"windowMenu", 20, 20}}});
  connect(menu, &QMenu::aboutToShow, this, [this, menu] { fillMenu(menu); });
  connect(&bench_, &Workbench::sliceMenuOpens, this, [this](QMenu* over, FlatView* view) {
    QAction* first = over->actions().value(0);
    over->insertActions(first, choicesOf(over, view));
    over->insertSeparator(first);
  });
}

void WindowChoices::fillMenu(QMenu* menu) {
  QList<QAction*> all = choicesOf(menu, bench_.flatViewInFocus());
  if (all.isEmpty()) {
    all << new QAction(whyNone(), menu);
    all.front()->setEnabled(false);
  }
  listed_.show(*menu, all);
}

QList<QAction*> WindowChoices::choicesOf(QMenu* menu, FlatView* view) const {
  QList<QAction*> all;
  if (!view) return all;
  const std::vector<FlatView::WindowChoice> windows = view->windows();
  // Several may be equal: the automatic window of frames can be the first of the file.
  const auto chosen = std::ranges::find_if(windows, &FlatView::WindowChoice::isChosen);
  for (int n = 0; n < int(windows.size()); ++n) {
    const QString key = windows[std::size_t(n)].key.text();
    QString name = windows[std::size_t(n)].name;
    name.replace(QLatin1Char('&'), QStringLiteral("&&"));
    auto* action = new QAction(key.isEmpty() ? name : name + QLatin1Char('\t') + key, menu);
    action->setCheckable(true);
    action->setChecked(n == chosen - windows.begin());
    // A playing clip may have other windows by then.
    connect(action, &QAction::triggered, view, [view, n, chosen = windows[std::size_t(n)].name] {
      const std::vector<FlatView::WindowChoice> now = view->windows();
      if (n < int(now.size()) && now[std::size_t(n)].name == chosen) view->chooseWindow(n);
    });
    all << action;
  }
  if (all.isEmpty()) return all;
  auto* invert = new QAction(tr("Invert") + QStringLiteral("\tI"), menu);
  connect(invert, &QAction::triggered, view, &FlatView::invert);
  return all << invert;
}

QString WindowChoices::whyNone() const {
  const FlatView* view = bench_.flatViewInFocus();
  return view && view->shown() ? tr("Colours are shown as they are: there is no window to set.")
                               : tr("Click a slice or a frame first.");
}

std::optional<OwnWindow> WindowChoices::inUse() const {
  const FlatView* view = bench_.flatViewInFocus();
  const std::optional<Window> stored = view ? view->windowShown() : std::nullopt;
  if (!stored) return {};
  const Series& series = view->shown()->series;
  const Window window = shownWindow(*stored, series);
  return OwnWindow{series.modality, shownScale(series).unit, {}, {window.centre, std::abs(window.width)}};
}

void WindowChoices::showDialog() {
  if (!dialog_) {
    dialog_ = new WindowsDialog(
        session_, [this] { return inUse(); }, bench_.dialogParent());
    dialog_->setAttribute(Qt::WA_DeleteOnClose);
  }
  dialog_->show();
  dialog_->activateWindow();
}

}  // namespace

std::unique_ptr<Feature> makeWindowChoices(Workbench& bench) {
  return std::make_unique<WindowChoices>(bench);
}

}  // namespace volumen
