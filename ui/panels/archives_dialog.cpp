#include "ui/panels/archives_dialog.h"

#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLineEdit>
#include <QListWidget>
#include <QSignalBlocker>
#include <QSpinBox>

#include "io/archive/search_archive.h"
#include "io/files/output_file.h"
#include "io/files/preset_files.h"
#include "io/files/private_folder.h"
#include "ui/widgets/fields.h"

namespace volumen {

namespace {

Status written(const Archives& archives) {
  if (Status made = makePrivateFolder(configFolder()); !made) return made;
  return writeWholeFile(userArchivesFile(), archivesToJson(archives));
}

}  // namespace

ArchivesDialog::ArchivesDialog(QWidget* parent)
    : QDialog(parent),
      list_(new QListWidget),
      fields_(new QWidget),
      port_(wholeField({QStringLiteral("archivePort"), tr("Port")}, 1, 65535)),
      told_(wrappedLabel(QStringLiteral("archiveTold"))) {
  setObjectName(QStringLiteral("archivesDialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(tr("Archives"));
  list_->setObjectName(QStringLiteral("archiveList"));
  list_->setAccessibleName(tr("Archives"));
  fields_->setLayout(form());
  auto* add = buttonOf<QPushButton>(QStringLiteral("addArchive"), tr("Add"), [this] { this->add(); });
  auto* remove =
      buttonOf<QPushButton>(QStringLiteral("removeArchive"), tr("Remove"), [this] { this->remove(); });
  auto* left = new QVBoxLayout;
  left->addWidget(list_, 1);
  left->addLayout(lineOf({add, remove}));
  auto* both = new QHBoxLayout;
  both->addLayout(left, 1);
  both->addWidget(fields_, 2);
  stack(this,
        {both, told_,
         wrappedLabel({}, tr("The study list offers changed archives after the next start of the program."))},
        12, 8);
  makeButtons();
  const Result<Archives> read = readArchives(userArchivesFile());
  if (read) archives_ = *read;
  for (const Archive& archive : archives_.archives) list_->addItem(QString::fromStdString(archive.name));
  connect(list_, &QListWidget::currentRowChanged, this, &ArchivesDialog::showChosen);
  list_->setCurrentRow(0);
  showChosen();
  if (read) return;
  told_->setText(QString::fromStdString(read.message()));
  for (auto* button : findChildren<QPushButton*>())
    if (button->objectName() != QStringLiteral("cancelArchives")) button->setEnabled(false);
}

QLineEdit* ArchivesDialog::textField(const char* word, const QString& label, std::string Archive::*member) {
  auto* field = new QLineEdit;
  field->setObjectName(QStringLiteral("archive_") + QLatin1String(word));
  field->setProperty("word", QLatin1String(word));
  field->setAccessibleName(label);
  texts_.emplace_back(field, member);
  connect(field, &QLineEdit::textEdited, this, [this, member](const QString& text) {
    Archive* archive = chosen();
    if (!archive) return;
    archive->*member = text.trimmed().toStdString();
    list_->currentItem()->setText(QString::fromStdString(archive->name));
  });
  return field;
}

QFormLayout* ArchivesDialog::form() {
  auto* form = new QFormLayout;
  form->setContentsMargins(0, 0, 0, 0);
  const auto add = [&](const char* word, const QString& label, std::string Archive::*member) {
    form->addRow(label, textField(word, label, member));
  };
  add("name", tr("Name"), &Archive::name);
  add("host", tr("Host or address"), &Archive::host);
  form->addRow(tr("Port"), port_);
  add("calledAe", tr("AE title of the archive"), &Archive::calledAe);
  add("callingAe", tr("AE title of this program"), &Archive::callingAe);
  form->addRow(buttonOf<QPushButton>(QStringLiteral("testArchive"), tr("Test"), [this] { test(); }));
  connect(port_, &QSpinBox::valueChanged, this, [this](int port) {
    if (Archive* archive = chosen()) archive->port = port;
  });
  return form;
}

void ArchivesDialog::makeButtons() {
  auto* buttons = new QDialogButtonBox;
  auto* cancel = buttons->addButton(QDialogButtonBox::Cancel);
  cancel->setObjectName(QStringLiteral("cancelArchives"));
  auto* save = buttons->addButton(QDialogButtonBox::Save);
  save->setObjectName(QStringLiteral("saveArchives"));
  save->setDefault(true);
  for (auto* other : findChildren<QPushButton*>()) other->setAutoDefault(false);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(save, &QPushButton::clicked, this, &ArchivesDialog::save);
  layout()->addWidget(buttons);
}

Archive* ArchivesDialog::chosen() {
  const int row = list_->currentRow();
  return row < 0 || row >= int(archives_.archives.size()) ? nullptr : &archives_.archives[std::size_t(row)];
}

void ArchivesDialog::showChosen() {
  tests_.giveUpAll();
  told_->clear();
  const Archive* archive = chosen();
  fields_->setEnabled(archive);
  const Archive shown = archive ? *archive : Archive();
  for (const auto& [field, member] : texts_) field->setText(QString::fromStdString(shown.*member));
  const QSignalBlocker blocker(port_);
  port_->setValue(shown.port);
}

void ArchivesDialog::add() {
  archives_.archives.emplace_back();
  list_->addItem(QString());
  list_->setCurrentRow(list_->count() - 1);
  texts_.front().first->setFocus();
}

void ArchivesDialog::remove() {
  const int row = list_->currentRow();
  if (!chosen()) return;
  archives_.archives.erase(archives_.archives.begin() + row);
  delete list_->takeItem(row);
  showChosen();
}

QString ArchivesDialog::problemOf(const Archive& archive) const {
  const Result<Archives> parsed = parseArchives(archivesToJson({{archive}}));
  if (parsed) return {};
  const QString problem = QString::fromStdString(parsed.message()).remove(QStringLiteral("archives[0]."));
  for (const auto& [field, member] : texts_)
    if (const QString word = field->property("word").toString(); problem.startsWith(word + QLatin1Char(' ')))
      return field->accessibleName() + problem.mid(word.size());
  return problem;
}

void ArchivesDialog::test() {
  tests_.giveUpAll();
  const Archive archive = *chosen();
  if (const QString problem = problemOf(archive); !problem.isEmpty()) return told_->setText(problem);
  told_->setText(tr("Testing..."));
  tests_.run(
      {}, [archive](const Job& job) { return testArchive(archive, job.cancel()); },
      [this, archive](const Status& answers) {
        told_->setText(answers ? tr("The archive \"%1\" answers.").arg(QString::fromStdString(archive.name))
                               : QString::fromStdString(answers.message()));
      });
}

// Chooses the first archive that is not valid, and tells why.
bool ArchivesDialog::isValid() {
  for (std::size_t n = 0; n < archives_.archives.size(); ++n) {
    const QString problem = problemOf(archives_.archives[n]);
    if (problem.isEmpty()) continue;
    list_->setCurrentRow(int(n));
    told_->setText(problem);
    return false;
  }
  const Result<Archives> parsed = parseArchives(archivesToJson(archives_));
  told_->setText(parsed ? QString() : QString::fromStdString(parsed.message()));
  return parsed.ok();
}

void ArchivesDialog::save() {
  if (!isValid()) return;
  if (const Status done = written(archives_); !done)
    return told_->setText(QString::fromStdString(done.message()));
  accept();
}

}  // namespace volumen
