#include "ui/panels/preferences_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QMessageBox>
#include <QPushButton>
#include <algorithm>

#include "ui/panels/mouse_table.h"

namespace volumen {

PreferencesDialog::PreferencesDialog(Session& session, QWidget* parent)
    : QDialog(parent), session_(session), form_(new QFormLayout(this)) {
  setObjectName(QStringLiteral("preferencesDialog"));
  setWindowTitle(tr("Preferences"));
  form_->setHorizontalSpacing(16);
  addChoice<Theme>("theme", tr("Theme"), &Preferences::theme,
                   {{tr("Dark"), Theme::dark}, {tr("Light"), Theme::light}});
  addChoice<int>("textSize", tr("Text size"), &Preferences::textPercent,
                 {{tr("Normal"), 100}, {tr("Large"), 120}, {tr("Very large"), 140}});
  addMousePresets();
  form_->addRow(new MouseTable(session_));
  addFlag("zoomDragInverted", tr("Drag down to enlarge"), &Preferences::zoomDragInverted);
  addFlag("wheelInverted", tr("Turn the wheel towards you to enlarge"), &Preferences::wheelInverted);
  addFlag("curveDragInverted", tr("Drag up to move the curve to higher values"),
          &Preferences::curveDragInverted);
  addChoice<bool>("opacityAxis", tr("Opacity axis"), &Preferences::logarithmicOpacity,
                  {{tr("Linear"), false}, {tr("Logarithmic"), true}});
  addChoice<int>("memory", tr("Memory for series"), &Preferences::memoryPercent,
                 {{tr("10 % of the machine's"), 10}, {tr("25 %"), 25}, {tr("50 %"), 50}, {tr("75 %"), 75}});
  addFlag("crosshairLines", tr("Lines of the crosshair in planes"), &Preferences::crosshairLines);
  addFlag("referenceLines", tr("Reference lines of other views"), &Preferences::referenceLines);
  addFlag("referenceEnds", tr("Reference lines of their first and last slices"), &Preferences::referenceEnds);
  addFlag("hideNames", tr("Hide names, IDs, dates and file names"), &Preferences::hideNames);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::RestoreDefaults | QDialogButtonBox::Close);
  form_->addRow(buttons);
  buttons->button(QDialogButtonBox::RestoreDefaults)->setText(tr("Restore defaults"));
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
  QPushButton *restore = buttons->button(QDialogButtonBox::RestoreDefaults),
              *close = buttons->button(QDialogButtonBox::Close);
  restore->setAutoDefault(false);  // otherwise Enter would trigger it
  close->setDefault(true);
  connect(restore, &QPushButton::clicked, this, &PreferencesDialog::askToRestore);
}

// Choosing a preset drops all differences from the one before.
void PreferencesDialog::addMousePresets() {
  auto* box = new QComboBox;
  box->setObjectName(QStringLiteral("mousePreset"));
  box->setAccessibleName(tr("Mouse"));
  for (const MousePreset& preset : mousePresets()) box->addItem(preset.text);
  form_->addRow(tr("Mouse"), box);
  connect(box, &QComboBox::activated, this, [this](int n) {
    session_.prefer(withMousePreset(session_.preferences(), mousePresets()[std::size_t(n)].name));
  });
  follow([this, box] {
    const auto& all = mousePresets();
    const auto chosen = std::ranges::find(all, session_.preferences().mousePreset, &MousePreset::name);
    box->setCurrentIndex(chosen == all.end() ? 0 : int(chosen - all.begin()));
  });
}

void PreferencesDialog::askToRestore() {
  auto* box = new QMessageBox(QMessageBox::Question, windowTitle(),
                              tr("Set all preferences back to their defaults?"), QMessageBox::Cancel, this);
  box->setObjectName(QStringLiteral("restoreBox"));
  box->setTextFormat(Qt::PlainText);
  box->setAttribute(Qt::WA_DeleteOnClose);
  connect(box->addButton(tr("Restore defaults"), QMessageBox::AcceptRole), &QPushButton::clicked, this,
          [this] { session_.prefer(defaultsFor(session_.preferences())); });
  box->setDefaultButton(QMessageBox::Cancel);
  box->open();
}

void PreferencesDialog::follow(const std::function<void()>& show) {
  connect(&session_, &Session::preferencesChanged, this, show);
  show();
}

template <class Value>
void PreferencesDialog::addChoice(const char* name, const QString& label, Value Preferences::*member,
                                  const std::vector<std::pair<QString, Value>>& entries) {
  auto* box = new QComboBox;
  box->setObjectName(QLatin1String(name));
  box->setAccessibleName(label);
  for (const auto& [text, value] : entries) box->addItem(text);
  form_->addRow(label, box);
  connect(box, &QComboBox::activated, this, [this, member, entries](int n) {
    session_.prefer([&](Preferences& p) { p.*member = entries[std::size_t(n)].second; });
  });
  follow([this, box, member, entries] {
    for (std::size_t n = 0; n < entries.size(); ++n)
      if (entries[n].second == session_.preferences().*member) box->setCurrentIndex(int(n));
  });
}

void PreferencesDialog::addFlag(const char* name, const QString& label, bool Preferences::*member) {
  auto* box = new QCheckBox(label);
  box->setObjectName(QLatin1String(name));
  form_->addRow(box);
  connect(box, &QCheckBox::clicked, this,
          [this, member](bool on) { session_.prefer([&](Preferences& p) { p.*member = on; }); });
  follow([this, box, member] { box->setChecked(session_.preferences().*member); });
}

}  // namespace volumen
