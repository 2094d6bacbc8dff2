#include "ui/panels/preferences_dialog.h"

#include <QFormLayout>
#include <QMessageBox>

#include "ui/panels/archives_dialog.h"
#include "ui/panels/mouse_table.h"
#include "ui/panels/sources.h"

namespace volumen {

PreferencesDialog::PreferencesDialog(Session& session, JobLane& tests, QWidget* parent)
    : QDialog(parent), session_(session), tests_(tests) {
  setObjectName(QStringLiteral("preferencesDialog"));
  setWindowTitle(tr("Preferences"));
  auto* form = new QFormLayout(this);
  form->setHorizontalSpacing(16);
  addFields(*form);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::RestoreDefaults | QDialogButtonBox::Close);
  form->addRow(buttons);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
  QPushButton *restore = buttons->button(QDialogButtonBox::RestoreDefaults),
              *close = buttons->button(QDialogButtonBox::Close);
  restore->setText(tr("Restore defaults"));
  restore->setAutoDefault(false);  // otherwise Enter would trigger it
  close->setDefault(true);
  connect(restore, &QPushButton::clicked, this, &PreferencesDialog::askToRestore);
}

void PreferencesDialog::addFields(QFormLayout& form) {
  const Source<Preferences> source = preferencesSource(session_);
  const auto choice = [&](const QString& name, const QString& label, const QStringList& entries,
                          const Lens<Preferences, int>& lens) {
    form.addRow(label, source.bind(choiceField({name, label}, entries), {}, lens));
  };
  const auto flag = [&](const QString& name, const QString& label, bool Preferences::*member) {
    form.addRow(source.bind(flagField({name, label}), {}, at(member)));
  };
  choice(QStringLiteral("theme"), tr("Theme"), {tr("Dark"), tr("Light")},
         among(at(&Preferences::theme), {Theme::dark, Theme::light}));
  choice(QStringLiteral("textSize"), tr("Text size"), {tr("Normal"), tr("Large"), tr("Very large")},
         among(at(&Preferences::textPercent), {100, 120, 140}));
  QStringList presets;
  std::vector<std::string> names;
  for (const MousePreset& preset : mousePresets()) presets << preset.text, names.push_back(preset.name);
  // Choosing a preset drops all differences from the one before.
  const Lens<Preferences, std::string> preset{
      [](const Preferences& p) { return p.mousePreset; },
      [](Preferences& p, const std::string& name) { p = withMousePreset(p, name); }};
  choice(QStringLiteral("mousePreset"), tr("Mouse"), presets, among(preset, names));
  form.addRow(new MouseTable(session_));
  flag(QStringLiteral("zoomDragInverted"), tr("Drag down to enlarge"), &Preferences::zoomDragInverted);
  flag(QStringLiteral("wheelInverted"), tr("Turn the wheel towards you to enlarge"),
       &Preferences::wheelInverted);
  flag(QStringLiteral("curveDragInverted"), tr("Drag up to move the curve to higher values"),
       &Preferences::curveDragInverted);
  choice(QStringLiteral("opacityAxis"), tr("Opacity axis"), {tr("Linear"), tr("Logarithmic")},
         among(at(&Preferences::logarithmicOpacity), {false, true}));
  choice(QStringLiteral("memory"), tr("Memory for series"),
         {tr("10 % of the machine's"), tr("25 %"), tr("50 %"), tr("75 %")},
         among(at(&Preferences::memoryPercent), {10, 25, 50, 75}));
  flag(QStringLiteral("crosshairLines"), tr("Lines of the crosshair in planes"),
       &Preferences::crosshairLines);
  flag(QStringLiteral("referenceLines"), tr("Reference lines of other views"), &Preferences::referenceLines);
  flag(QStringLiteral("referenceEnds"), tr("Reference lines of their first and last slices"),
       &Preferences::referenceEnds);
  flag(QStringLiteral("hideNames"), tr("Hide names, IDs, dates and file names"), &Preferences::hideNames);
  auto* archives = buttonOf<QPushButton>(QStringLiteral("editArchives"), tr("Edit archives..."), [this] {
    auto* dialog = new ArchivesDialog(tests_, this);
    connect(dialog, &QDialog::accepted, this, &PreferencesDialog::archivesSaved);
    dialog->open();
  });
  archives->setAutoDefault(false);
  form.addRow(tr("Archives (PACS)"), archives);
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

}  // namespace volumen
